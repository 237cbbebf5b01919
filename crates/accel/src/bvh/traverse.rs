//! The walk down the tree along a ray, nearer child first.

use std::ops::ControlFlow;

use arrayvec::ArrayVec;

use super::MAX_DEPTH;
use super::lanes::Lanes;
use super::layout::{Layout, Siblings};
use crate::{Span, TraversalRay, Visitor};

impl Layout {
    /// See [`Structure::traverse`](crate::Structure::traverse).
    pub(super) fn traverse<V: Visitor>(
        &self,
        ray: &TraversalRay,
        visitor: &mut V,
    ) -> ControlFlow<()> {
        let Some(root) = &self.root else {
            return ControlFlow::Continue(());
        };
        let slabs = Slabs::new(ray);
        let mut t_max = slabs.limit(visitor.t_max());
        visitor.node();
        // If the root has children its own box need not be tested: theirs together are as large.
        let alone = root.is_leaf().then(|| Siblings::new([*root; 2]));
        if alone.is_some_and(|root| !slabs.entries(&root, t_max).entered[0]) {
            return ControlFlow::Continue(());
        }
        // One node may wait at each level.
        let mut waiting = ArrayVec::<Waiting, MAX_DEPTH>::new();
        let mut next = Some((root.first, root.count));
        while let Some((first, count)) = next {
            if count > 0 {
                let leaf = first as usize..first as usize + count as usize;
                visitor.leaf(&self.primitives[leaf], Span::ALL)?;
                t_max = slabs.limit(visitor.t_max());
                next = pop(&mut waiting, t_max);
                continue;
            }
            let siblings = &self.siblings[first as usize];
            visitor.node();
            visitor.node();
            let Entries { near, entered } = slabs.entries(siblings, t_max);
            let child = |i: usize| (siblings.first[i], siblings.count[i]);
            next = match (entered[0], entered[1]) {
                (false, false) => pop(&mut waiting, t_max),
                (true, false) => Some(child(0)),
                (false, true) => Some(child(1)),
                (true, true) => {
                    let nearer = usize::from(near[1] < near[0]);
                    let (first, count) = child(1 - nearer);
                    waiting.push(Waiting {
                        first,
                        count,
                        entry: near[1 - nearer],
                    });
                    Some(child(nearer))
                }
            };
        }
        ControlFlow::Continue(())
    }
}

/// A node that waits for its turn.
#[derive(Clone, Copy)]
struct Waiting {
    first: u32,
    count: u32,
    entry: f32,
}

/// The next node that is not beyond `t_max`.
#[inline]
fn pop(waiting: &mut ArrayVec<Waiting, MAX_DEPTH>, t_max: f32) -> Option<(u32, u32)> {
    while let Some(node) = waiting.pop() {
        if node.entry <= t_max {
            return Some((node.first, node.count));
        }
    }
    None
}

/// The test of a box in single precision, such that no box is missed which the law wants shown.
///
/// # Why it is conservative
/// 1. Padding a box by p is the same as moving the origin towards each plane by p: the walk's origin
///    (see `traversal_ray.rs`) is moved up by `single_box_pad` for the lower planes and down for the
///    upper ones, and rounded to single precision with as much more of a pad as that takes.
/// 2. Everything is in units of the direction's largest component m: τ' = (t − `box_start`) · m. So
///    the reciprocals of the direction are at least 1, and for a hit that counts |τ'| is at most R,
///    the distance from the walk's origin to the far side of the structure, padded. One rounding of
///    a difference, one of a reciprocal and one of their product move a plane by less than 2 ε R,
///    where ε is that of single precision. `single_box_pad` is 12 ε R more than what double
///    precision needs, so a box's interval holds the τ' of each hit that counts with more than
///    10 ε R to spare on both sides, and rounding `t_min` and `t_max` does no harm.
/// 3. Where the direction's component is 0 its reciprocal is set to a large number L instead of ∞,
///    so that 0 · ∞ does not occur. A hit that counts has the origin at least 12 ε R within the
///    slab, so its interval is at least ± 12 ε R L, far beyond R.
/// 4. Differences that overflow become ± ∞ with the right sign, and comparisons include equality.
#[derive(Clone, Copy, Debug)]
struct Slabs {
    /// By axis: the origin for lower planes in the first two, that for upper ones in the last two, as in
    /// [`Siblings::planes`].
    origin: [Lanes; 3],
    /// By axis, four times the same.
    inverse: [Lanes; 3],
    /// m.
    unit: f64,
    /// The t of the walk's origin.
    start: f64,
    /// In units of τ'.
    t_min: f32,
}

/// What stands for 1/0. Its products with what is left of a pad are still beyond every distance.
const LARGE: f64 = 1.0e38;

/// A pad is at least this, so that it does not vanish where numbers are as small as they get.
const LEAST_PAD: f64 = 8.0e-45;

impl Slabs {
    fn new(ray: &TraversalRay) -> Self {
        let unit = ray.ray.direction.max_norm();
        let largest = ray.box_origin.to_vector().max_norm();
        // Rounding the origin, and adding the pad to it, moves it by one step of singles at most.
        let step = f64::from(f32::EPSILON) * (largest + ray.single_box_pad);
        let pad = rounded_up(ray.single_box_pad.max(LEAST_PAD) + step);
        let origin = |o: f64| {
            // Beyond the largest single the origin is moved no further inward than to it.
            let nearest = o as f32;
            let above = if nearest > f32::MIN {
                nearest
            } else {
                f32::MIN
            } + pad;
            let below = if nearest < f32::MAX {
                nearest
            } else {
                f32::MAX
            } - pad;
            Lanes::new([above, above, below, below])
        };
        let inverse = |i: f64| Lanes::splat((unit * i).clamp(-LARGE, LARGE) as f32);
        let (from, way) = (ray.box_origin, ray.inverse_direction());
        Self {
            origin: [origin(from.x), origin(from.y), origin(from.z)],
            inverse: [inverse(way.x), inverse(way.y), inverse(way.z)],
            unit,
            start: ray.box_start,
            t_min: -rounded_up((ray.box_start - ray.ray.t_min) * unit),
        }
    }

    /// A `t_max` in units of τ'.
    #[inline]
    fn limit(&self, t_max: f64) -> f32 {
        rounded_up((t_max - self.start) * self.unit)
    }

    /// Where the ray enters each of two boxes, and whether it does.
    #[inline(always)]
    fn entries(&self, siblings: &Siblings, t_max: f32) -> Entries {
        let (mut near, mut far) = (Lanes::splat(self.t_min), Lanes::splat(t_max));
        for axis in 0..3 {
            let way = Lanes::new(siblings.planes[axis]).minus(self.origin[axis]);
            let at = way.times(self.inverse[axis]);
            let opposite = at.last_two_first();
            near = at.smaller(opposite).larger(near);
            far = at.larger(opposite).smaller(far);
        }
        Entries {
            near: near.first_two(),
            entered: near.first_two_at_most(far),
        }
    }
}

/// Where a ray enters each of two boxes, in units of τ', and whether it does so before it leaves.
#[derive(Clone, Copy, Debug)]
struct Entries {
    near: [f32; 2],
    entered: [bool; 2],
}

/// A single that is not below `x` and at most two steps above the smallest such one, or above 0 by
/// what singles are worth next to it. Unlike `f32::next_up` it does not branch.
#[inline]
fn rounded_up(x: f64) -> f32 {
    // Minus infinity would meet its opposite below.
    let nearest = x as f32;
    let nearest = if nearest > f32::MIN {
        nearest
    } else {
        f32::MIN
    };
    nearest + (nearest.abs() * f32::EPSILON + f32::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_up_never_rounds_down() {
        let singles = [0.0, 1e-45, 1e-38, 3e-39, 0.1, 1.0, 1.5, 1e7, 3e38, f32::MAX];
        for single in singles.into_iter().flat_map(|x| [x, -x]) {
            let at = f64::from(single);
            for x in [at, at * (1.0 + 1e-9), at * (1.0 - 1e-9), at + 1e-46] {
                let up = rounded_up(x);
                assert!(f64::from(up) >= x, "{x} became {up}");
                let near = at.abs() * 4e-7 + 4e-38;
                assert!(
                    up.is_infinite() || f64::from(up) - x <= near,
                    "{x} became {up}"
                );
            }
        }
        assert_eq!(rounded_up(f64::INFINITY), f32::INFINITY);
        assert_eq!(rounded_up(1e300), f32::INFINITY);
        assert!(rounded_up(-1e300) <= -3.4e38);
        assert!(rounded_up(f64::NEG_INFINITY) <= -3.4e38);
    }
}
