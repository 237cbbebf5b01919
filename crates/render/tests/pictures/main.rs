//! What pictures are believed to show, scene by scene.

mod glass;
mod lights;
mod measures;
mod mirrors;
mod no_acne;
mod same_bytes;
mod stage;
mod trees;
mod watching;
