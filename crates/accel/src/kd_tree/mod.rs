//! The kd-tree: one tree, four ways to walk it.
//!
//! The idea: cut the box in two by a plane across one axis, where the surface area heuristic says
//! that it pays; again in each half. In a leaf stand the primitives that overlap it. A ray visits
//! the leaves near to far. The four walks visit the same leaves; they differ in what they remember
//! on the way: a stack of all that is still to do, nothing at all, a little, or, in the tree itself,
//! the way from each leaf to its neighbours.
//!
//! The four are compared, among others, in Santos et al., "Review and Comparative Study of Ray
//! Traversal Algorithms on a Modern GPU Architecture", 2014. The later three were made for graphics
//! processors, where memory for a stack is dear. Where a stack costs next to nothing, as here, the
//! plain one, the short one and ropes come out close, and kd-restart pays for its ways down.

mod build;
mod node;
mod restart;
mod ropes;
mod sah;
mod short_stack;
mod stack;

pub use restart::KdRestart;
pub use ropes::KdRopes;
pub use short_stack::KdShortStack;
pub use stack::KdStack;
