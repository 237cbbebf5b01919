//! The kernel: a tile of places against the tree of polygons and the whole way of the sun.
#![expect(
    unsafe_code,
    reason = "vector instructions, and reads without a check of what a tree is known to hold"
)]

mod bits;
mod differs;
mod dispatch;
mod lanes;
mod near;
mod polygon;
mod prefetch;
mod reference;
mod stretches;
mod walk;
mod whose;

pub(crate) use bits::bits;
pub(crate) use dispatch::{
    FindRoom, Job, Room, Shown, add_seconds, changes, find_stretches, may_cover,
};
#[cfg(test)]
pub(crate) use reference::{Side, covered};
pub(crate) use whose::NOBODY;
