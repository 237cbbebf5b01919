//! From a list of boxes to a tree.

pub(crate) mod binned;
mod clip;
mod collapse;
mod grow;
pub(crate) mod item;
pub(crate) mod items;
mod lanes;
pub(crate) mod morton;
pub(crate) mod pack;
mod radix;
pub(crate) mod spatial;
