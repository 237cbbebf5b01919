//! The walk that finds by which building a place lies in shadow, not only that it does.
//!
//! It keeps each stretch of time in which a polygon covers the sun. An arc is left out only when it is known, for all places
//! and all of it, that two buildings cover it and that what is nearest of all is among what was found. Two buildings: owners
//! are of two kinds, by a bit of their number (what is no building is of both), each kind has a cover of its own, and both are full. The nearest: whatever
//! else there is begins farther away than the farthest corner of what filled them.

use ombra_city::Facet;

use super::lanes::{Lanes, Mask as _};
use super::polygon::{Keep, polygon};
use super::walk::{Around, Waiting, trimmed};
use crate::cover::Cover;
use crate::occluder::{Occluder, Occluders};
use crate::tile::{PLACES, Tile};
use crate::way::MOST;
use crate::ways::Ways;

/// In which part of an arc a polygon covers the sun, for each place of a tile: none where it ends before it begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Record {
    pub(crate) from: [f32; PLACES],
    pub(crate) to: [f32; PLACES],
    pub(crate) arc: u32,
    /// Which polygon.
    pub(crate) which: u32,
    /// See [`Occluder::owner`].
    pub(crate) owner: u32,
    /// The squares of how near the polygon may be to any of the places, and how far, level.
    pub(crate) near: f32,
    pub(crate) far: f32,
}

/// What was found, and how much of it is known to be all.
#[derive(Debug, Default)]
pub(crate) struct Found {
    pub(crate) records: Vec<Record>,
    /// Of the polygon that is looked at, as in a record.
    which: u32,
    owner: u32,
    near: f32,
    far: f32,
    /// The arcs that need not be looked at for it.
    left_out: u64,
    /// The arcs of which it covers something.
    covers: u64,
}

impl Found {
    /// Of what covers the sun nowhere yet.
    #[inline(always)]
    fn record(&self, arc: usize) -> Record {
        Record {
            from: [1.0; PLACES],
            to: [0.0; PLACES],
            arc: arc as u32,
            which: self.which,
            owner: self.owner,
            near: self.near,
            far: self.far,
        }
    }
}

impl Keep for Found {
    #[inline(always)]
    fn left_out(&self, _: &Cover) -> u64 {
        self.left_out
    }

    #[inline(always)]
    unsafe fn stretches<P: Lanes>(&mut self, arc: usize, places: P::Mask, from: P, to: P) {
        // SAFETY: the caller's promise; there is room for sixteen.
        unsafe {
            if places.bits() == 0 {
                return;
            }
            let (nowhere, never) = (P::splat(1.0), P::splat(0.0));
            let mut record = self.record(arc);
            from.or_where_not(places, nowhere)
                .store(record.from.as_mut_ptr());
            to.or_where_not(places, never).store(record.to.as_mut_ptr());
            self.records.push(record);
        }
        self.covers |= 1 << arc;
    }

    #[inline(never)]
    fn stretch(&mut self, arc: usize, place: usize, from: f32, to: f32) {
        let mut record = self.record(arc);
        record.from[place] = from;
        record.to[place] = to;
        self.records.push(record);
        self.covers |= 1 << arc;
    }
}

/// Nothing is kept of what was kept before; these arcs are left out.
struct Besides(u64);

impl Keep for Besides {
    #[inline(always)]
    fn left_out(&self, _: &Cover) -> u64 {
        self.0
    }

    #[inline(always)]
    unsafe fn stretches<P: Lanes>(&mut self, _: usize, _: P::Mask, _: P, _: P) {}

    #[inline(always)]
    fn stretch(&mut self, _: usize, _: usize, _: f32, _: f32) {}
}

/// Finds what comes before the one way of `ways`, seen from a tile. The two covers are for the two kinds of owners.
///
/// # Safety
/// - The processor has the instructions of both.
#[inline(always)]
pub(super) unsafe fn find<N: Lanes, P: Lanes>(
    occluders: &Occluders,
    ways: &Ways,
    tile: &Tile,
    covers: &mut [Cover; 2],
    waiting: &mut Vec<Waiting>,
    found: &mut Found,
) {
    let list = ways.list();
    found.records.clear();
    waiting.clear();
    for cover in &mut *covers {
        cover.clear(ways.len());
    }
    let nodes = occluders.tree.nodes();
    let none = if ways.len() < MOST {
        u64::MAX << ways.len()
    } else {
        0
    };
    // By arc the square of how far what was found of it reaches, and the most of those that are full.
    let mut far = [0.0_f32; MOST];
    let (mut full, mut farthest) = (none, 0.0_f32);
    // SAFETY: the caller's promise.
    unsafe {
        let around = Around::<N>::new(tile.bounds, occluders.reach);
        let mut node = occluders.tree.root();
        let (mut arcs, mut left_out) = ([0, ways.len() - 1], none);
        'search: loop {
            around.push(occluders, &nodes[node], arcs, ways, left_out, waiting);
            loop {
                let Some(next) = waiting.pop() else {
                    break 'search;
                };
                left_out = if farthest <= next.distance {
                    full
                } else {
                    nearer(full, none, &far, next.distance)
                };
                arcs = trimmed(next.arcs.map(usize::from), left_out);
                if arcs[0] > arcs[1] {
                    continue;
                }
                let Some(which) = next.child.leaf() else {
                    node = next.child.node();
                    continue 'search;
                };
                let occluder = &occluders.list[which];
                (found.which, found.owner) = (which as u32, occluder.owner);
                (found.near, found.far) = (next.distance, reach(occluder, tile));
                (found.left_out, found.covers) = (left_out, 0);
                let (own, steep) = (&mut covers[kind(occluder.owner)..][..1], next.steep);
                polygon::<P, _>(occluder, list, arcs, steep, tile, own, found);
                if occluder.owner >= Facet::CONTEXT {
                    // Of what is no building there is no other: it counts as two.
                    let own = &mut covers[1 - kind(occluder.owner)..][..1];
                    polygon::<P, _>(
                        occluder,
                        list,
                        arcs,
                        steep,
                        tile,
                        own,
                        &mut Besides(left_out),
                    );
                }
                let mut grown = found.covers & !full;
                if grown != 0 {
                    full |= covers[0].full & covers[1].full;
                    while grown != 0 {
                        let arc = grown.trailing_zeros() as usize;
                        grown &= grown - 1;
                        far[arc] = far[arc].max(found.far);
                        if full >> arc & 1 == 1 {
                            farthest = farthest.max(far[arc]);
                        }
                    }
                }
            }
        }
    }
}

/// Of the two kinds of owners one: a bit of the number, well mixed, for neighbours are often numbered one after another.
#[inline(always)]
fn kind(owner: u32) -> usize {
    (owner.wrapping_mul(0x9e37_79b9) >> 31) as usize
}

/// Those of the full arcs of which what was found reaches no farther than this.
#[inline(never)]
fn nearer(full: u64, none: u64, far: &[f32; MOST], distance: f32) -> u64 {
    let mut nearer = none;
    let mut left = full & !none;
    while left != 0 {
        let arc = left.trailing_zeros() as usize;
        left &= left - 1;
        nearer |= u64::from(far[arc] <= distance) << arc;
    }
    nearer
}

/// The square of how far the farthest corner is from the farthest place, level.
#[inline(always)]
fn reach(occluder: &Occluder, tile: &Tile) -> f32 {
    let [least, most] = [tile.bounds.min, tile.bounds.max].map(|end| end.to_array());
    let mut farthest = 0.0_f32;
    for corner in &occluder.corner {
        let away = [0, 1].map(|axis| (corner[axis] - least[axis]).max(most[axis] - corner[axis]));
        farthest = farthest.max(away[0] * away[0] + away[1] * away[1]);
    }
    farthest
}
