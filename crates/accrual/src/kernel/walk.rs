//! The walk down the tree: which polygons may come before which arcs, for a tile.
//!
//! A node's box, made larger by the tile, lies within an interval of azimuth, and so before an interval of
//! arcs; and it is no higher above the tile than so much, at a distance that is no less than so much, so
//! all arcs that stand higher pass over it. Arcs that are covered already are left out before that, so
//! the test gets stricter as the day fills: what is near comes first.

use ombra_accel::{BoxChild, BoxNode};
use ombra_geometry::Aabb;

use super::lanes::{Lanes, Mask as _};
use super::polygon::{Nothing, polygon};
use crate::cover::Cover;
use crate::occluder::Occluders;
use crate::tile::Tile;
use crate::ways::{TURN_PAD, Ways};

/// What waits to be looked at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Waiting {
    /// As in the node above.
    pub(super) child: BoxChild,
    pub(super) arcs: [u8; 2],
    /// The squared tangent of its altitude.
    pub(super) steep: f32,
    /// The square of how far away its box begins, level.
    pub(super) distance: f32,
}

/// Nothing of the ways is covered: a cover for each way of each tile.
pub(super) fn clear(ways: &Ways, covers: &mut [Cover]) {
    for (cover, way) in covers.iter_mut().zip(ways.list().iter().cycle()) {
        cover.clear(way.len());
    }
}

/// Covers what more of the ways is covered for the tiles: a cover for each way of each tile. `N` has eight lanes, `P`
/// sixteen.
///
/// # Safety
/// - The processor has the instructions of both.
#[inline(always)]
pub(super) unsafe fn walk<N: Lanes, P: Lanes>(
    occluders: &Occluders,
    ways: &Ways,
    tiles: &[Tile],
    covers: &mut [Cover],
    waiting: &mut Vec<Waiting>,
) {
    let count = ways.list().len();
    waiting.clear();
    let nodes = occluders.tree.nodes();
    // SAFETY: the caller's promise.
    unsafe {
        let around = Around::<N>::new(Tile::around(tiles), occluders.reach);
        let mut node = occluders.tree.root();
        let mut arcs = [0, ways.len() - 1];
        let mut full = covers
            .iter()
            .fold(u64::MAX, |full, cover| full & cover.full);
        'search: loop {
            around.push(occluders, &nodes[node], arcs, ways, full, waiting);
            loop {
                let Some(next) = waiting.pop() else {
                    break 'search;
                };
                arcs = trimmed(next.arcs.map(usize::from), full);
                if arcs[0] > arcs[1] {
                    continue;
                }
                match next.child.leaf() {
                    None => {
                        node = next.child.node();
                        continue 'search;
                    }
                    Some(which) => {
                        let occluder = &occluders.list[which];
                        full = u64::MAX;
                        for (tile, covers) in tiles.iter().zip(covers.chunks_exact_mut(count)) {
                            let (list, steep) = (ways.list(), next.steep);
                            polygon::<P, _>(
                                occluder,
                                list,
                                arcs,
                                steep,
                                tile,
                                covers,
                                &mut Nothing,
                            );
                            for cover in covers {
                                full &= cover.full;
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Whether the walk comes to any polygon, seen from anywhere in a box, while these arcs of all ways are covered wholly. Where it does not, none
/// covers anything of the others.
///
/// # Safety
/// - The processor has the instructions of `N`.
#[inline(always)]
pub(super) unsafe fn reaches<N: Lanes>(
    occluders: &Occluders,
    ways: &Ways,
    around: Aabb,
    full: u64,
    waiting: &mut Vec<Waiting>,
) -> bool {
    waiting.clear();
    let nodes = occluders.tree.nodes();
    // SAFETY: the caller's promise.
    unsafe {
        let around = Around::<N>::new(around, occluders.reach);
        let mut node = occluders.tree.root();
        let mut arcs = [0, ways.len() - 1];
        loop {
            around.push(occluders, &nodes[node], arcs, ways, full, waiting);
            let Some(next) = waiting.pop() else {
                return false;
            };
            if next.child.leaf().is_some() {
                return true;
            }
            node = next.child.node();
            arcs = next.arcs.map(usize::from);
        }
    }
}

/// Without what is covered for all places at either end.
#[inline(always)]
pub(super) fn trimmed([first, last]: [usize; 2], full: u64) -> [usize; 2] {
    let left = !full >> first << first;
    let left = left & (u64::MAX >> (63 - last));
    if left == 0 {
        return [1, 0];
    }
    [
        left.trailing_zeros() as usize,
        63 - left.leading_zeros() as usize,
    ]
}

/// Tiles as boxes are looked at from them.
pub(super) struct Around<N> {
    least: [N; 3],
    most: [N; 3],
}

impl<N: Lanes> Around<N> {
    /// # Safety
    /// - The processor has the instructions of `N`.
    #[inline(always)]
    pub(super) unsafe fn new(around: Aabb, reach: f32) -> Self {
        let ([x, y, z], [u, v, w]) = (around.min.to_array(), around.max.to_array());
        let size = x.abs().max(y.abs()).max(z.abs());
        let size = size.max(u.abs()).max(v.abs()).max(w.abs());
        // Against rounding of differences.
        let pad = 2.0 * f32::EPSILON * (size + reach) + f32::MIN_POSITIVE;
        // SAFETY: the caller's promise.
        unsafe {
            Self {
                least: [N::splat(x - pad), N::splat(y - pad), N::splat(z - pad)],
                most: [N::splat(u + pad), N::splat(v + pad), N::splat(w + pad)],
            }
        }
    }

    /// Pushes those children that may cover something, the nearest last.
    ///
    /// # Safety
    /// - The processor has the instructions of `N`.
    #[inline(always)]
    pub(super) unsafe fn push(
        &self,
        occluders: &Occluders,
        node: &BoxNode,
        arcs: [usize; 2],
        ways: &Ways,
        full: u64,
        waiting: &mut Vec<Waiting>,
    ) {
        const { assert!(N::COUNT == 8) }
        let (mut from, mut to) = ([0.0_f32; 8], [0.0_f32; 8]);
        let (mut steep, mut distance) = ([0.0_f32; 8], [0.0_f32; 8]);
        // SAFETY: the caller's promise; a node has eight boxes.
        let (left, within) = unsafe {
            let zero = N::splat(0.0);
            let lx = N::load(node.lower[0].as_ptr()).minus(self.most[0]);
            let ly = N::load(node.lower[1].as_ptr()).minus(self.most[1]);
            let hx = N::load(node.upper[0].as_ptr()).minus(self.least[0]);
            let hy = N::load(node.upper[1].as_ptr()).minus(self.least[1]);
            let up = N::load(node.upper[2].as_ptr()).minus(self.least[2]);
            let above = zero.below(up).bits();
            if above == 0 {
                return;
            }
            let dx = lx.larger(zero.minus(hx)).larger(zero);
            let dy = ly.larger(zero.minus(hy)).larger(zero);
            let squared = dx.times(dx).plus(dy.times(dy));
            let within = !zero.below(squared).bits();
            // The two corners between which the box lies, clockwise: north of the tile the western one
            // comes first, south of it the eastern one.
            let (north, south) = (zero.below(ly), hy.below(zero));
            let (east, west) = (zero.below(lx), hx.below(zero));
            let beside = lx.or_where_not(east, hx);
            let ax = lx.or_where_not(north, hx.or_where_not(south, beside));
            let ay = (hy.or_where_not(east, ly)).or_where_not(
                north,
                (ly.or_where_not(west, hy)).or_where_not(south, hy.or_where_not(east, ly)),
            );
            let bx = hx.or_where_not(north, lx.or_where_not(south, beside));
            let by = (hy.or_where_not(west, ly)).or_where_not(
                north,
                (ly.or_where_not(east, hy)).or_where_not(south, ly.or_where_not(east, hy)),
            );
            let (a, b) = (turns(ax, ay), turns(bx, by));
            let (a, b) = if ways.sign < 0.0 { (b, a) } else { (a, b) };
            let a = relative(a, ways, -TURN_PAD);
            let b = relative(b, ways, TURN_PAD);
            // Most of what is in vain is seen here, for all eight at once.
            let [begin, end] = ways.turns_of(arcs).map(|turn| N::splat(turn));
            let beside = b.below(begin).or(end.below(a)).and_not(b.below(a));
            let tangent = up.times(up).over(squared);
            let higher = N::splat(ways.lowest(arcs)).below(tangent).bits();
            let left = above & higher & (within | !beside.bits());
            a.store(from.as_mut_ptr());
            b.store(to.as_mut_ptr());
            tangent.store(steep.as_mut_ptr());
            squared.store(distance.as_mut_ptr());
            (left, within)
        };
        let begin = waiting.len();
        let mut left = left;
        let mut keys = [0.0_f32; 8];
        while left != 0 {
            let k = left.trailing_zeros() as usize;
            left &= left - 1;
            let mut own = arcs;
            if within >> k & 1 == 0 {
                let [first, last] = ways.between(from[k], to[k]);
                own = [arcs[0].max(first), arcs[1].min(last)];
                if own[0] > own[1] {
                    continue;
                }
            }
            own = trimmed(own, full);
            if own[0] > own[1] || steep[k] <= ways.lowest(own) {
                continue;
            }
            occluders.ask_for(node.child[k]);
            // The farthest first.
            let key = distance[k];
            let mut place = waiting.len() - begin;
            waiting.push(Waiting {
                child: node.child[k],
                arcs: own.map(|arc| arc as u8),
                steep: steep[k],
                distance: key,
            });
            while place > 0 && keys[place - 1] < key {
                keys[place] = keys[place - 1];
                waiting.swap(begin + place, begin + place - 1);
                place -= 1;
            }
            keys[place] = key;
        }
    }
}

/// See [`turn`](crate::way::turn).
///
/// # Safety
/// - The processor has the instructions of `N`.
#[inline(always)]
unsafe fn turns<N: Lanes>(east: N, north: N) -> N {
    // SAFETY: the caller's promise.
    unsafe {
        let zero = N::splat(0.0);
        let q = east.over(east.size().plus(north.size()));
        let behind = north.below(zero);
        let west = q.below(zero);
        let ahead = N::splat(4.0).plus(q).or_where_not(west, q);
        N::splat(2.0).minus(q).or_where_not(behind, ahead)
    }
}

/// Turns as counted from the start of a way along it, from 0 to 4, and later by so much.
///
/// # Safety
/// - The processor has the instructions of `N`.
#[inline(always)]
unsafe fn relative<N: Lanes>(turns: N, ways: &Ways, later: f32) -> N {
    // SAFETY: the caller's promise.
    unsafe {
        let (zero, whole) = (N::splat(0.0), N::splat(4.0));
        let turns = turns.minus(N::splat(ways.start)).times(N::splat(ways.sign));
        let turns = turns.plus(N::splat(later));
        let turns = turns.plus(whole).or_where_not(turns.below(zero), turns);
        turns.or_where_not(turns.below(whole), turns.minus(whole))
    }
}
