//! The walk down the tree along a ray, nearer child first.

use std::ops::ControlFlow;

use arrayvec::ArrayVec;

use super::MAX_DEPTH;
use super::layout::{Layout, Node, Siblings};
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
        if slabs.entry(root, t_max).is_none() {
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
            let Siblings([a, b]) = &self.siblings[first as usize];
            visitor.node();
            visitor.node();
            next = match (slabs.entry(a, t_max), slabs.entry(b, t_max)) {
                (None, None) => pop(&mut waiting, t_max),
                (Some(_), None) => Some((a.first, a.count)),
                (None, Some(_)) => Some((b.first, b.count)),
                (Some(to_a), Some(to_b)) => {
                    let (near, far, to_far) = if to_b < to_a {
                        (b, a, to_a)
                    } else {
                        (a, b, to_b)
                    };
                    waiting.push(Waiting {
                        first: far.first,
                        count: far.count,
                        entry: to_far,
                    });
                    Some((near.first, near.count))
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
///    upper ones, and then rounded to single precision outward.
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
    /// The origin for lower planes.
    above: [f32; 3],
    /// The origin for upper planes.
    below: [f32; 3],
    inverse: [f32; 3],
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
        let pad = ray.single_box_pad.max(LEAST_PAD);
        let origin = ray.box_origin.to_array();
        let unit = ray.ray.direction.max_norm();
        let inverse = ray.inverse_direction.to_array();
        Self {
            above: origin.map(|o| rounded_up(o + pad)),
            below: origin.map(|o| -rounded_up(-(o - pad))),
            inverse: inverse.map(|i| (unit * i).clamp(-LARGE, LARGE) as f32),
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

    /// Where the ray enters a box, in units of τ'; `None` if it does not, or beyond `t_max`.
    #[inline]
    fn entry(&self, node: &Node, t_max: f32) -> Option<f32> {
        let (mut near, mut far) = (self.t_min, t_max);
        for axis in 0..3 {
            let lower = (node.min[axis] - self.above[axis]) * self.inverse[axis];
            let upper = (node.max[axis] - self.below[axis]) * self.inverse[axis];
            near = larger(near, smaller(lower, upper));
            far = smaller(far, larger(lower, upper));
        }
        (near <= far).then_some(near)
    }
}

/// The smaller of two numbers that are not NaN: unlike `f32::min`, one instruction.
#[inline]
fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The larger of two numbers that are not NaN.
#[inline]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The smallest single that is not below `x`.
#[inline]
fn rounded_up(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) < x {
        nearest.next_up()
    } else {
        nearest
    }
}
