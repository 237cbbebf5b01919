//! The walk of one ray down a tree whose leaves are lists of primitives of any kind.
//!
//! Boxes are tested as for triangles, eight at once in single precision; what a leaf lists is shown to
//! a visitor, which tests it in whatever precision it likes. The kernel is one node's worth of work, so
//! that visitors need not be compiled once for each level of instructions.
//!
//! # Why no box is missed
//! The reasons are those of `ray.rs`, but that the ray comes in double precision and its t is not
//! rounded when a hit is found. Rounding the origin moves a plane by half of ε |o|, rounding the
//! direction by half of ε F, and the range of t is rounded outward. With the 12 ε F of `hit_pad`, the
//! 2⁻²⁹ F of small components and the 3 ε (|o| + F) of the test that is below
//! 16 ε F + 4 ε (|o| + F), which the pads of `ray.rs` are made for.

use std::mem::MaybeUninit;
use std::ops::ControlFlow;

use super::super::node::{Child, Node};
use super::super::store::Store;
use super::super::wide::WideTree;
use super::box_ray::BoxRay;
use super::dispatch::enter;
use super::layout::Full;
use super::level::{Lanes, Level};
use super::ray::Near;
use super::walk::{STACK, Slabs};
use crate::{Span, TraversalRay, Visitor};

/// [`BoxRay::new`], for each level.
///
/// # Safety
/// - The processor has the instructions of `L`.
#[inline(always)]
pub(super) unsafe fn readied<L: Lanes>(ray: &TraversalRay, near: &Near) -> Option<BoxRay> {
    let TraversalRay { ray, .. } = ray;
    let (origin, direction) = (ray.origin.cast::<f32>(), ray.direction.cast::<f32>());
    let t_min = at_most(ray.t_min);
    BoxRay::new(origin.to_array(), direction.to_array(), t_min, near)
}

/// A single that is not above a number, and next to it.
#[inline]
fn at_most(x: f64) -> f32 {
    -at_least(-x)
}

/// A single that is not below a number, and next to it.
#[inline]
fn at_least(x: f64) -> f32 {
    // Rounding takes away less than half of what is added. Below all finite singles, or NaN for −∞, it
    // is the least of them.
    let above = (x + x.abs() * f64::from(f32::EPSILON) + f64::from(f32::MIN_POSITIVE)) as f32;
    if above >= f32::MIN { above } else { f32::MIN }
}

/// Walks down a tree and shows the visitor what the leaves list.
#[inline]
pub(crate) fn walk_lists<V: Visitor>(
    level: Level,
    tree: &WideTree<Store<Node>>,
    list: &[u32],
    ray: &BoxRay,
    visitor: &mut V,
) -> ControlFlow<()> {
    let nodes = &tree.nodes[..];
    let mut children = [const { MaybeUninit::<Child>::uninit() }; STACK];
    let mut entries = [const { MaybeUninit::<f32>::uninit() }; STACK];
    let children = children.as_mut_ptr().cast::<Child>();
    let entries = entries.as_mut_ptr().cast::<f32>();
    let mut t_max = at_least(visitor.t_max());
    let mut waiting = 0;
    let mut child = tree.root;
    loop {
        if child.is_leaf() {
            visitor.leaf(&list[child.range()], Span::ALL)?;
            t_max = at_least(visitor.t_max());
        } else {
            visitor.node();
            let node = &nodes[child.index()];
            // SAFETY: no node lies deeper than `MAX_DEPTH`, so at most so many times seven siblings
            // wait, and there are places for eight more.
            let (to, entries) = unsafe { (children.add(waiting), entries.add(waiting)) };
            waiting += enter(level, node, ray, t_max, to, entries);
        }
        loop {
            if waiting == 0 {
                return ControlFlow::Continue(());
            }
            waiting -= 1;
            // SAFETY: what waits was written.
            let entry = unsafe {
                child = *children.add(waiting);
                *entries.add(waiting)
            };
            if entry <= t_max {
                break;
            }
        }
    }
}

/// Tests the boxes of a node: writes the children that are entered and where, the nearest last, and
/// counts them.
///
/// # Safety
/// - The processor has the instructions of `L`.
/// - Eight may be written at `to` and at `entries`.
#[inline(always)]
pub(super) unsafe fn entered<L: Lanes>(
    node: &Node,
    ray: &BoxRay,
    t_max: f32,
    to: *mut Child,
    entries: *mut f32,
) -> usize {
    // SAFETY: the caller's promise.
    unsafe {
        let slabs = Slabs::<L>::new(ray);
        let (near, far) = slabs.entries::<Full<'_>>(node, L::splat(t_max));
        let order = node.order[(ray.octant & 7) as usize];
        let pushed = near.push(far, order, node.child.as_ptr(), to, entries);
        pushed.count_ones() as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_rounded_outward() {
        assert_eq!(at_least(f64::INFINITY), f32::INFINITY);
        assert_eq!(at_least(f64::NEG_INFINITY), f32::MIN);
        for x in [0.1, -0.1, 1.0, 1e300, -1e300, 1e-300, 0.0] {
            assert!(
                f64::from(at_most(x)) <= x && x <= f64::from(at_least(x)),
                "{x}"
            );
        }
    }
}
