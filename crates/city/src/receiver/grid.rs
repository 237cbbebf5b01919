//! A grid of square cells over the ground.

use ombra_geometry::Aabb;

use crate::Facet;

/// The most cells of a grid: 268 million.
pub const MAX_CELLS: u64 = 1 << 28;

/// The most places on faces, and in a list of places: 67 million.
pub const MAX_PLACES: u64 = 1 << 26;

/// Square cells over the ground, in local metres, rows from north to south. A place is the middle of its
/// cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// The south-west corner of the south-west cell: metres east and north of the origin.
    pub corner: [f64; 2],
    /// Length of a cell's side in metres, more than 0.
    pub cell: f64,
    /// Cells in a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
}

/// Why there is no such grid.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GridError {
    /// A cell without an extent, or with too much of one.
    #[error("a cell is {0} m wide; 0.01 m to 10000 m is wanted")]
    Cell(f64),
    /// Corners that enclose nothing.
    #[error("from {from:?} to {to:?} there is no area: the south-west corner comes first")]
    Empty {
        /// The south-western corner.
        from: [f64; 2],
        /// The north-eastern corner.
        to: [f64; 2],
    },
    /// More than a machine should be asked for.
    #[error(
        "{width} x {height} cells are more than {MAX_CELLS}: take larger cells or a smaller area"
    )]
    Large {
        /// From west to east.
        width: f64,
        /// From north to south.
        height: f64,
    },
    /// More places on faces than a machine should be asked for.
    #[error("more than {MAX_PLACES} places: take larger cells or a smaller city")]
    ManyPlaces,
}

impl Grid {
    /// Over all that casts shadow; cells that are cut by the edge of that are whole.
    ///
    /// # Errors
    /// See [`within`](Self::within).
    pub fn over(facets: &[Facet], cell: f64) -> Result<Self, GridError> {
        let boxes = facets.iter().map(|facet| Aabb::around(facet.corners));
        let bounds = boxes.fold(Aabb::EMPTY, Aabb::union);
        if bounds.is_empty() {
            return Err(GridError::Empty {
                from: [0.0; 2],
                to: [0.0; 2],
            });
        }
        let ([x, y, _], [u, v, _]) = (bounds.min.to_array(), bounds.max.to_array());
        Self::within([x, y].map(f64::from), [u, v].map(f64::from), cell)
    }

    /// From the south-western corner of an area to the north-eastern one, in local metres. Cells lie on whole
    /// multiples of their size, so that grids of neighbouring areas fit together.
    ///
    /// # Errors
    /// A cell below 1 cm or above 10 km, an area without an extent, more than [`MAX_CELLS`].
    pub fn within(from: [f64; 2], to: [f64; 2], cell: f64) -> Result<Self, GridError> {
        if !(0.01..=10_000.0).contains(&cell) {
            return Err(GridError::Cell(cell));
        }
        let finite = from.iter().chain(&to).all(|x| x.is_finite());
        if !(finite && from[0] < to[0] && from[1] < to[1]) {
            return Err(GridError::Empty { from, to });
        }
        let first = from.map(|x| (x / cell).floor());
        let after = to.map(|x| (x / cell).ceil());
        let [width, height] = [0, 1].map(|axis| (after[axis] - first[axis]).max(1.0));
        if width * height > MAX_CELLS as f64 {
            return Err(GridError::Large { width, height });
        }
        Ok(Self {
            corner: first.map(|k| k * cell),
            cell,
            width: width as u32,
            height: height as u32,
        })
    }

    /// The north-west corner of the north-west cell: metres east and north of the origin.
    #[must_use]
    pub fn north_west(&self) -> [f64; 2] {
        let [west, south] = self.corner;
        [west, south + f64::from(self.height) * self.cell]
    }

    /// How many cells.
    #[must_use]
    pub const fn count(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// The middle of a cell, local metres; row 0 is the northernmost.
    #[must_use]
    pub fn centre(&self, column: u32, row: u32) -> [f64; 2] {
        let south = f64::from(self.height - 1 - row);
        [
            self.corner[0] + (f64::from(column) + 0.5) * self.cell,
            self.corner[1] + (south + 0.5) * self.cell,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_lie_on_multiples_of_their_size() {
        let grid = Grid::within([-1.2, 3.9], [2.0, 6.1], 0.5).unwrap();
        assert_eq!((grid.corner, grid.width, grid.height), ([-1.5, 3.5], 7, 6));
        assert_eq!(grid.centre(0, 5), [-1.25, 3.75]);
        assert_eq!(grid.centre(6, 0), [1.75, 6.25]);
        assert_eq!(grid.count(), 42);
    }

    #[test]
    fn what_is_no_grid_is_refused() {
        let within = |from, to, cell| Grid::within(from, to, cell).unwrap_err().to_string();
        assert!(within([0.0; 2], [1.0; 2], 0.0).contains("0.01 m"));
        assert!(within([0.0; 2], [1.0; 2], f64::NAN).contains("0.01 m"));
        assert!(within([0.0; 2], [0.0, 1.0], 1.0).contains("no area"));
        assert!(within([0.0; 2], [f64::NAN, 1.0], 1.0).contains("no area"));
        assert!(within([0.0; 2], [1e6; 2], 0.01).contains("larger cells"));
    }
}
