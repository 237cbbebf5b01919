//! Contour lines of a grid of numbers, such as the lines of equal time in shadow: [`contour_lines`] finds them, and
//! [`write_contours_geojson`] writes them as GeoJSON.
//!
//! They are found by marching squares (Lorensen, Cline, "Marching cubes", 1987, in the plane) on the bilinear surface through the
//! middles of cells, so a line lies where it should to a fraction of a cell. The crates for this close each line around
//! what has no number, as if that were low ground: a building would have lines of all levels along its walls. Here a line ends there.

mod geojson;
mod lines;

pub use geojson::write_contours_geojson;
pub use lines::{ContourLine, contour_lines};
