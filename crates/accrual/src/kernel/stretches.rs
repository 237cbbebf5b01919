//! The walk that finds by which building a place lies in shadow, not only that it does.
//!
//! It keeps each stretch of time in which a polygon covers the sun. An arc is left out only when it is known, for all places
//! of a tile and all of it, that two buildings cover it and that what is nearest of all is among what was found. Two buildings:
//! one polygon each covers all of it, or else, owners are of two kinds, by a bit of their number, each kind has a cover of its own, and
//! both are full. The nearest: whatever else there is begins farther away than one that covers all of it, or
//! than the farthest corner of what filled the covers.

use arrayvec::ArrayVec;

use super::bits::bits;
use super::lanes::{Lanes, Mask as _};
use super::near::farthest;
use super::polygon::{Keep, polygon};
use super::walk::{Around, Waiting, trimmed};
use super::whose::NOBODY;
use crate::cover::{Cover, JOIN};
use crate::exact::TILES;
use crate::occluder::{Occluder, Occluders};
use crate::tile::{PLACES, Tile};
use crate::way::MOST;
use crate::ways::Ways;

/// In which part of an arc a polygon covers the sun, for each place of a tile: none where it ends before it begins.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Record {
    pub(crate) from: [f32; PLACES],
    pub(crate) to: [f32; PLACES],
    /// Which polygon.
    pub(crate) which: u32,
    /// See [`Occluder::owner`].
    pub(crate) owner: u32,
    /// The one before of the same arc of the same tile.
    pub(super) before: Option<u32>,
}

/// What was found for the arcs of a tile, and how much of it is known to be all.
#[derive(Debug)]
pub(super) struct Seen {
    /// For the two kinds of owners.
    covers: [Cover; 2],
    /// The arcs that two cover, or that are not there.
    full: u64,
    /// Those that are not there.
    none: u64,
    /// By arc who covers all of it with one polygon, and the arcs of which there are two such.
    whole: [u32; MOST],
    twice: u64,
    /// By arc the square of how far away what begins is behind what was found: beyond what reaches farthest of all, or beyond what
    /// covers all of it.
    reach: [f32; MOST],
    behind: [f32; MOST],
    /// The most of those that are full.
    farthest: f32,
    /// By arc the last record.
    pub(super) last: [Option<u32>; MOST],
}

impl Seen {
    pub(super) fn new() -> Self {
        Self {
            covers: [Cover::new(), Cover::new()],
            full: 0,
            none: 0,
            whole: [NOBODY; MOST],
            twice: 0,
            reach: [0.0; MOST],
            behind: [f32::INFINITY; MOST],
            farthest: 0.0,
            last: [None; MOST],
        }
    }

    /// Nothing is found yet of so many arcs.
    fn clear(&mut self, arcs: usize) {
        for cover in &mut self.covers {
            cover.clear(arcs);
        }
        self.full = self.covers[0].full;
        self.none = self.full;
        self.whole = [NOBODY; MOST];
        self.twice = 0;
        self.reach = [0.0; MOST];
        self.behind = [f32::INFINITY; MOST];
        self.farthest = 0.0;
        self.last = [None; MOST];
    }

    /// Which of some arcs are such that nothing matters that begins so far away.
    #[inline(always)]
    fn left_out(&self, distance: f32, [first, last]: [usize; 2]) -> u64 {
        if self.farthest <= distance {
            return self.full;
        }
        let among = u64::MAX << first & u64::MAX >> (63 - last);
        // Others are left out as well: nobody asks for them.
        let mut left_out = self.full & (!among | self.none);
        for arc in bits(self.full & among & !self.none) {
            let is_behind = self.behind[arc].min(self.reach[arc]) <= distance;
            left_out |= u64::from(is_behind) << arc;
        }
        left_out
    }

    /// An owner covers an arc wholly with one polygon, and what is so far away is behind it.
    #[inline(always)]
    fn cover(&mut self, arc: usize, owner: u32, behind: f32) {
        self.behind[arc] = self.behind[arc].min(behind);
        let other = self.whole[arc];
        self.whole[arc] = owner;
        if other != NOBODY && other != owner {
            self.twice |= 1 << arc;
        }
    }

    /// More of these arcs was found, which reaches so far.
    #[inline(always)]
    fn grow(&mut self, arcs: u64, reach: f32) {
        self.full |= self.covers[0].full & self.covers[1].full | self.twice;
        for arc in bits(arcs) {
            self.reach[arc] = self.reach[arc].max(reach);
            if self.full >> arc & 1 == 1 {
                let far = self.reach[arc].min(self.behind[arc]);
                self.farthest = self.farthest.max(far);
            }
        }
    }
}

/// What one polygon covers for one tile.
struct Found<'a> {
    records: &'a mut Vec<Record>,
    last: &'a mut [Option<u32>; MOST],
    which: u32,
    owner: u32,
    /// The arcs that need not be looked at.
    left_out: u64,
    /// The arcs of which it covers something, and all for all places.
    covers: u64,
    wholly: u64,
}

impl Found<'_> {
    #[inline(always)]
    fn push(&mut self, arc: usize, from: [f32; PLACES], to: [f32; PLACES]) {
        let last = self.records.len() as u32;
        self.records.push(Record {
            from,
            to,
            which: self.which,
            owner: self.owner,
            before: self.last[arc].replace(last),
        });
        self.covers |= 1 << arc;
    }
}

// SAFETY: what is left out holds the arcs that the way does not have, as `Seen::full` does from the beginning.
unsafe impl Keep for Found<'_> {
    #[inline(always)]
    fn left_out(&self, _: &Cover) -> u64 {
        self.left_out
    }

    #[inline(always)]
    unsafe fn stretches<P: Lanes>(&mut self, arc: usize, places: P::Mask, from: P, to: P) {
        let (mut begins, mut ends) = ([0.0; PLACES], [0.0; PLACES]);
        // SAFETY: the caller's promise; there is room for sixteen.
        unsafe {
            if places.bits() == 0 {
                return;
            }
            let partly = P::splat(JOIN)
                .below(from)
                .or(to.below(P::splat(1.0 - JOIN)));
            let is_whole = places.and_not(partly).bits() == u32::from(u16::MAX);
            self.wholly |= u64::from(is_whole) << arc;
            from.or_where_not(places, P::splat(1.0))
                .store(begins.as_mut_ptr());
            to.or_where_not(places, P::splat(0.0))
                .store(ends.as_mut_ptr());
        }
        self.push(arc, begins, ends);
    }

    #[inline(never)]
    fn stretch(&mut self, arc: usize, place: usize, from: f32, to: f32) {
        let (mut begins, mut ends) = ([1.0; PLACES], [0.0; PLACES]);
        (begins[place], ends[place]) = (from, to);
        self.push(arc, begins, ends);
    }
}

/// Finds what comes before the one way of `ways`, seen from tiles: `seen` has as many.
///
/// # Safety
/// - The processor has the instructions of both.
#[inline(always)]
pub(super) unsafe fn find<N: Lanes, P: Lanes>(
    occluders: &Occluders,
    ways: &Ways,
    tiles: &[Tile],
    seen: &mut [Seen],
    waiting: &mut Vec<Waiting>,
    records: &mut Vec<Record>,
) {
    let list = ways.list();
    records.clear();
    waiting.clear();
    for seen in &mut *seen {
        seen.clear(ways.len());
    }
    let nodes = occluders.tree.nodes();
    // SAFETY: the caller's promise.
    unsafe {
        let around = Around::<N>::new(Tile::around(tiles), occluders.reach);
        let mut node = occluders.tree.root();
        let mut arcs = [0, ways.len() - 1];
        let mut left_out = seen[0].full;
        'search: loop {
            around.push(occluders, &nodes[node], arcs, ways, left_out, waiting);
            loop {
                let Some(next) = waiting.pop() else {
                    break 'search;
                };
                arcs = next.arcs.map(usize::from);
                let each: ArrayVec<u64, TILES> = seen
                    .iter()
                    .map(|seen| seen.left_out(next.distance, arcs))
                    .collect();
                left_out = each.iter().fold(u64::MAX, |all, own| all & own);
                arcs = trimmed(arcs, left_out);
                if arcs[0] > arcs[1] {
                    continue;
                }
                let Some(which) = next.child.leaf() else {
                    node = next.child.node();
                    continue 'search;
                };
                let occluder = &occluders.list[which];
                let (kind, steep) = (kind(occluder.owner), next.steep);
                for ((tile, seen), left_out) in tiles.iter().zip(&mut *seen).zip(each) {
                    let mut found = Found {
                        records,
                        last: &mut seen.last,
                        which: which as u32,
                        owner: occluder.owner,
                        left_out,
                        covers: 0,
                        wholly: 0,
                    };
                    let own = &mut seen.covers[kind..][..1];
                    polygon::<P, _>(occluder, list, arcs, steep, tile, own, &mut found);
                    let covers = found.covers & !seen.full;
                    let wholly = found.wholly & !seen.full;
                    for arc in bits(wholly) {
                        let behind = farthest::<P>(occluder, tile, &list[0], arc);
                        seen.cover(arc, occluder.owner, behind);
                    }
                    if covers != 0 {
                        seen.grow(covers, reach(occluder, tile));
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
