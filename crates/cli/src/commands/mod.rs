//! The commands, one file each.

pub(crate) mod bench;
pub(crate) mod compare;
pub(crate) mod explain;
pub(crate) mod info;
pub(crate) mod lists;
pub(crate) mod minray;
pub(crate) mod render;
pub(crate) mod study;
