//! Where shadow is measured.

mod face;
mod grid;
mod study;

pub use face::{FaceChart, FaceKind, FacePlace, STAND_OFF};
pub use grid::{Grid, GridError, MAX_CELLS, MAX_PLACES};
pub use study::{StudyArea, StudyError};
