//! The kernels: ray against tree of triangles, in single precision, at each level of instructions.
#![expect(
    unsafe_code,
    reason = "vector instructions, and reads without a check of what a tree is known to hold"
)]

mod box_ray;
mod dispatch;
mod layout;
mod level;
mod lists;
mod many;
mod packet;
mod prefetch;
mod ray;
mod small;
mod stream;
mod walk;

pub use level::Level;
pub use prefetch::prefetch;

pub(super) use layout::Full;
pub(super) use small::Small;

pub(super) use dispatch::{any, any_many, closest, closest_many, ready, search, search_counted};
pub(super) use lists::walk_lists;
pub(super) use ray::{Near, SingleRay};
pub(crate) use ray::{not_above, rounded};
pub(super) use walk::{Found, MAX_DEPTH, STACK, Tree, stack};
