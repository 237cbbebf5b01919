//! Where shadow is measured.

mod grid;

pub use grid::{Grid, GridError, MAX_CELLS};
