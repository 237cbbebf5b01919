//! The same tree in half the memory: boxes in a byte a plane, corners that triangles share kept once.
//!
//! What walks see are the very corners, so answers are the same to the bit; boxes are somewhat
//! larger than they need to be, so rays visit a few more nodes, and to take nodes and leaves apart costs
//! some instructions each.

mod block;
mod node;
mod pack;

pub(super) use block::{Blocks, SHARED, counts};
pub(super) use node::SmallNode;
pub(super) use pack::pack;
