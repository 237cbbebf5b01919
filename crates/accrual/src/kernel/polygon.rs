//! One polygon against a tile and some arcs.

use super::lanes::{Lanes, Mask as _};
use super::reference::{Side, covered};
use super::walk::trimmed;
use crate::cover::{Cover, JOIN};
use crate::occluder::Occluder;
use crate::tile::{PLACES, Tile};
use crate::way::Way;

/// Three numbers for each place.
type Vectors<P> = [P; 3];

/// The product of vectors with one vector.
///
/// # Safety
/// - The processor has the instructions of `P`; so below.
#[inline(always)]
pub(super) unsafe fn dot<P: Lanes>([x, y, z]: Vectors<P>, [a, b, c]: [f32; 3]) -> P {
    // SAFETY: the caller's promise.
    unsafe {
        (x.times(P::splat(a)))
            .plus(y.times(P::splat(b)))
            .plus(z.times(P::splat(c)))
    }
}

/// The normals of the planes through the places and one edge, inward for who sees the corners
/// counter-clockwise.
///
/// # Safety
/// - As above.
#[inline(always)]
unsafe fn plane<P: Lanes>([x, y, z]: [f32; 3], [dx, dy, dz]: Vectors<P>) -> Vectors<P> {
    // SAFETY: the caller's promise.
    unsafe {
        let (x, y, z) = (P::splat(x), P::splat(y), P::splat(z));
        [
            y.times(dz).minus(z.times(dy)),
            z.times(dx).minus(x.times(dz)),
            x.times(dy).minus(y.times(dx)),
        ]
    }
}

/// What is done with stretches of time in which a polygon covers the sun, beside the covering.
///
/// # Safety
/// - What is left out holds the arcs that the way of the cover does not have.
pub(super) unsafe trait Keep {
    /// The arcs that need not be looked at.
    fn left_out(&self, cover: &Cover) -> u64;

    /// Takes a stretch of one arc for each of some places.
    ///
    /// # Safety
    /// - The processor has the instructions of `P`, which are sixteen.
    unsafe fn stretches<P: Lanes>(&mut self, arc: usize, places: P::Mask, from: P, to: P);

    /// Takes a stretch of one arc for one place.
    fn stretch(&mut self, arc: usize, place: usize, from: f32, to: f32);
}

/// Nothing is kept: what is covered wholly is left out.
pub(super) struct Nothing;

// SAFETY: a cover is full from the beginning where its way has no arc.
unsafe impl Keep for Nothing {
    #[inline(always)]
    fn left_out(&self, cover: &Cover) -> u64 {
        cover.full
    }

    #[inline(always)]
    unsafe fn stretches<P: Lanes>(&mut self, _: usize, _: P::Mask, _: P, _: P) {}

    #[inline(always)]
    fn stretch(&mut self, _: usize, _: usize, _: f32, _: f32) {}
}

/// Covers what the polygon covers of some arcs of each way, for all places of a tile: a cover for each way. The box around
/// the polygon is no steeper above any place than `steep`, the squared tangent of its altitude.
///
/// Of each plane through a place and an edge only the sign matters on which side the sun is. Along an
/// arc that is a polynomial of degree two in time, with at most one root where the signs at the ends
/// differ. Where it might have two, within the sag of the arc, the plain way takes over.
///
/// # Safety
/// - The processor has the instructions of `P`, which are sixteen.
#[inline(always)]
pub(super) unsafe fn polygon<P: Lanes, K: Keep>(
    occluder: &Occluder,
    ways: &[Way],
    arcs: [usize; 2],
    steep: f32,
    tile: &Tile,
    covers: &mut [Cover],
    keep: &mut K,
) {
    let is_needed = (ways.iter().zip(&*covers)).any(|(way, cover)| {
        let own = trimmed(arcs, keep.left_out(cover));
        own[0] <= own[1] && way.lowest(own) < steep
    });
    if !is_needed {
        return;
    }
    const { assert!(P::COUNT == PLACES) }
    // SAFETY: the caller's promise.
    unsafe {
        let zero = P::splat(0.0);
        let at = [
            P::load(tile.at[0].as_ptr()),
            P::load(tile.at[1].as_ptr()),
            P::load(tile.at[2].as_ptr()),
        ];
        let mut away = [[zero; 3]; 4];
        for (away, corner) in away.iter_mut().zip(&occluder.corner) {
            for axis in 0..3 {
                away[axis] = P::splat(corner[axis]).minus(at[axis]);
            }
        }
        // From which side the places see it; from within its plane nothing is seen.
        let side = dot(away[0], occluder.normal);
        let mut seen = side.below(zero);
        let behind = zero.below(side);
        if occluder.is_two_sided {
            seen = seen.or(behind);
        }
        if seen.bits() == 0 {
            return;
        }
        let mut planes = [[zero; 3]; 4];
        let mut sizes = [zero; 4];
        for j in 0..4 {
            planes[j] = plane(occluder.edge[j], away[j]);
            if occluder.is_two_sided {
                for along in &mut planes[j] {
                    *along = zero.minus(*along).or_where_not(behind, *along);
                }
            }
            let [x, y, z] = planes[j];
            sizes[j] = x.size().plus(y.size()).plus(z.size());
        }
        for (way, cover) in ways.iter().zip(covers) {
            let [first, last] = trimmed(arcs, keep.left_out(cover));
            if first > last || steep <= way.lowest([first, last]) {
                continue;
            }
            // Not less than how far the sun may depart from the chord, as seen from each plane.
            let sag = P::splat(way.sag);
            let mut near = [zero; 4];
            let mut from = [zero; 4];
            for j in 0..4 {
                near[j] = sizes[j].times(sag);
                from[j] = dot(planes[j], *way.knots.get_unchecked(first));
            }
            for arc in first..=last {
                let knot = *way.knots.get_unchecked(arc + 1);
                let mut to = [zero; 4];
                let mut open = seen;
                for j in 0..4 {
                    to[j] = dot(planes[j], knot);
                    // Outside all along.
                    let highest = from[j].larger(to[j]).plus(near[j]);
                    open = open.and_not(highest.below(zero));
                }
                if open.bits() != 0 {
                    one_arc(&planes, &near, from, to, open, way, arc, cover, keep);
                }
                from = to;
            }
        }
    }
}

/// The same for one arc, for those places that are open.
///
/// # Safety
/// - As above.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "what a loop hands to its body")]
unsafe fn one_arc<P: Lanes, K: Keep>(
    planes: &[Vectors<P>; 4],
    near: &[P; 4],
    from: [P; 4],
    to: [P; 4],
    open: P::Mask,
    way: &Way,
    arc: usize,
    cover: &mut Cover,
    keep: &mut K,
) {
    // SAFETY: the caller's promise.
    unsafe {
        let (zero, one) = (P::splat(0.0), P::splat(1.0));
        let (mut begin, mut end) = (zero, one);
        let mut open = open;
        let mut grazing = open.and_not(open);
        let along = *way.bulges.get_unchecked(arc);
        for j in 0..4 {
            let (a, b) = (from[j], to[j]);
            // Inside all along: so it is with most edges of large polygons.
            if open.and(a.smaller(b).below(near[j])).bits() == 0 {
                continue;
            }
            let bulge = dot(planes[j], along);
            let (enters, leaves) = (a.below(zero), b.below(zero));
            let both = enters.and(leaves);
            let crosses = enters.or(leaves).and_not(both);
            // Where the sun may cross twice: it turns on the way, nearer than the bulge, which is on the
            // other side.
            let nearest = a.size().smaller(b.size());
            let far = bulge.size().times(P::splat(0.25)).below(nearest);
            let away = (zero.below(bulge).and_not(both)).or(both.and_not(zero.below(bulge)));
            let bends = b.minus(a).size().below(bulge.size());
            let twice = bends.and(open).and_not(far).and_not(crosses).and_not(away);
            grazing = grazing.or(twice.and(nearest.below(near[j])));
            // Where it begins on the plane the root is 0/0.
            grazing = grazing.or(crosses.and_not(zero.below(a.size())));
            open = open.and_not(both.and_not(twice));
            if open.and(crosses).bits() == 0 {
                continue;
            }
            let slope = b.minus(a).plus(bulge);
            let square = slope.times(slope).plus(P::splat(4.0).times(bulge).times(a));
            let root = square.larger(zero).root();
            let signed = zero.minus(root).or_where_not(enters, root);
            // Two forms of one root: of the sums that are divided the one that does not cancel.
            let alike = zero.below(signed.times(slope));
            let above = slope.plus(signed).or_where_not(alike, a.plus(a));
            let below = bulge.plus(bulge).or_where_not(alike, signed.minus(slope));
            let u = above.over(below);
            let later = u.larger(begin);
            begin = later.or_where_not(crosses.and(enters), begin);
            let sooner = u.smaller(end);
            end = sooner.or_where_not(crosses.and_not(enters), end);
        }
        grazing = grazing.and(open);
        if grazing.bits() != 0 {
            let bulges = [0, 1, 2, 3].map(|j| dot(planes[j], along));
            graze(from, to, bulges, grazing.bits(), arc, cover, keep);
            open = open.and_not(grazing);
        }
        open = open.and(begin.below(end));
        if open.or(grazing).bits() == 0 {
            return;
        }
        keep.stretches(arc, open, begin, end);
        // The union: what touches the covered beginning, else the covered end.
        let join = P::splat(JOIN);
        let (rows_before, rows_after) = (
            cover.before[arc].as_mut_ptr(),
            cover.after[arc].as_mut_ptr(),
        );
        let (before, after) = (P::load(rows_before), P::load(rows_after));
        let first = open.and_not(before.plus(join).below(begin));
        let rest = open.and_not(first);
        let second = rest.and_not(end.plus(join).below(after));
        let before = end.larger(before).or_where_not(first, before);
        let after = begin.smaller(after).or_where_not(second, after);
        before.store(rows_before);
        after.store(rows_after);
        let mut left = rest.and_not(second).bits();
        if left != 0 {
            let (mut begins, mut ends) = ([0.0; PLACES], [0.0; PLACES]);
            begin.store(begins.as_mut_ptr());
            end.store(ends.as_mut_ptr());
            while left != 0 {
                let place = left.trailing_zeros() as usize;
                left &= left - 1;
                cover.add_piece(arc, place, begins[place], ends[place]);
            }
        }
        let (mut before, mut after) = (before, after);
        if cover.in_pieces >> arc & 1 == 1 {
            cover.settle(arc);
            before = P::load(cover.before[arc].as_ptr());
            after = P::load(cover.after[arc].as_ptr());
        }
        let gap = before.plus(join).below(after);
        cover.full |= u64::from(gap.bits() == 0) << arc;
    }
}

/// Places where the sun may cross an edge twice: one after another.
///
/// # Safety
/// - As above.
#[inline(never)]
unsafe fn graze<P: Lanes, K: Keep>(
    from: [P; 4],
    to: [P; 4],
    bulges: [P; 4],
    places: u32,
    arc: usize,
    cover: &mut Cover,
    keep: &mut K,
) {
    let mut numbers = [[[0.0_f32; PLACES]; 3]; 4];
    for (j, numbers) in numbers.iter_mut().enumerate() {
        // SAFETY: the caller's promise; there is room for sixteen.
        unsafe {
            from[j].store(numbers[0].as_mut_ptr());
            to[j].store(numbers[1].as_mut_ptr());
            bulges[j].store(numbers[2].as_mut_ptr());
        }
    }
    for place in (0..PLACES).filter(|place| places >> place & 1 == 1) {
        let sides = numbers.map(|[from, to, bulge]| Side {
            from: from[place],
            to: to[place],
            bulge: bulge[place],
        });
        covered(&sides, |begin, end| {
            keep.stretch(arc, place, begin, end);
            cover.add(arc, place, begin, end);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::super::lanes::{Pair, Portable};
    use super::*;

    type Sixteen = Pair<Portable>;

    /// A way of one arc that bulges by one along x.
    fn way() -> Way {
        Way {
            knots: vec![[0.0, 1.0, 0.0]; 2],
            bulges: vec![[1.0, 0.0, 0.0]],
            starts: vec![0.0],
            seconds: vec![1200.0],
            sag: 0.25,
            flat: vec![0.0; 2],
            turns: vec![0.0; 2],
            is_clockwise: true,
        }
    }

    #[test]
    fn an_edge_covers_what_the_plain_way_says() {
        let way = way();
        let mut seed = 1_u32;
        let mut random = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) as f32 / (1 << 24) as f32
        };
        let (mut partly, mut tiny) = (0, 0);
        for _ in 0..20_000 {
            // Of any size, so that the sun may begin nearly on the plane, and run nearly along it.
            let mut size = || {
                let sign = if random() < 0.5 { -1.0 } else { 1.0 };
                sign * 10_f32.powf(-10.0 * random())
            };
            let [from, to, bulge] = [(); 3].map(|()| size());
            let outer = Side { from, to, bulge };
            let always = Side {
                from: 2.0,
                to: 2.0,
                bulge: 0.0,
            };
            let sides = [outer, always, always, always];
            let mut plainly = Cover::new();
            plainly.clear(1);
            covered(&sides, |from, to| plainly.add(0, 0, from, to));
            let mut found = Cover::new();
            found.clear(1);
            // SAFETY: every processor has these instructions; there is one arc.
            unsafe {
                let splat = |x: f32| Sixteen::splat(x);
                let planes = sides.map(|side| [splat(side.bulge), splat(0.0), splat(0.0)]);
                let near = sides.map(|side| splat(0.25 * side.bulge.abs()));
                let [from, to] = [sides.map(|s| splat(s.from)), sides.map(|s| splat(s.to))];
                let all = splat(0.0).below(splat(1.0));
                let keep = &mut Nothing;
                one_arc(&planes, &near, from, to, all, &way, 0, &mut found, keep);
            }
            let share = |cover: &Cover| {
                let mut seconds = [0.0; PLACES];
                cover.add_seconds(&way.seconds, &mut seconds);
                seconds
            };
            let (found, plainly) = (share(&found), share(&plainly)[0]);
            for seconds in found {
                assert!(
                    (seconds - plainly).abs() < 0.01,
                    "{outer:?}: {seconds} and plainly {plainly}"
                );
            }
            partly += usize::from(plainly > 0.1 && plainly < 1199.9);
            tiny += usize::from(outer.from.abs() < 1e-6 && plainly > 0.1 && plainly < 1199.9);
        }
        assert!(partly > 5000 && tiny > 1000, "{partly} {tiny}");
    }
}
