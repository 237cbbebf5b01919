//! Maps of numbers, such as minutes in shadow: out as GeoTIFF ([`write_geotiff`]) and as a picture
//! for a report ([`map_picture`]), or as tiles for maps on the web ([`TileSet`]).
//!
//! ```
//! use ombra_city::{Crs, Grid, Origin};
//! use ombra_formats::raster::{MapStyle, Raster, Unit, map_picture, write_geotiff};
//!
//! let origin = Origin::new(Crs::wgs84(), [4.36, 52.01])?;
//! let grid = Grid { corner: [-10.0, -10.0], cell: 10.0, width: 2, height: 2 };
//! // The north-west cell lies in a building.
//! let values = [f32::NAN, 12.5, 300.0, 0.0];
//! let raster = Raster::new(&origin, grid, Unit::Minutes, &values)?;
//!
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("shadow.tif");
//! let metadata = [("command".to_owned(), "ombra shadows delft.city.json".to_owned())];
//! write_geotiff(&path, &raster, &metadata)?;
//! let style = MapStyle { title: "Delft".to_owned(), unit: Unit::Hours, ..MapStyle::default() };
//! let picture = map_picture(&raster, &style);
//! assert!(picture.width() >= 900);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cells;
mod geotiff;
mod map;
mod tiles;

use ombra_city::{Grid, Origin};

pub use geotiff::{Band, write_geotiff, write_geotiff_bands};
pub use map::{MapStyle, Scale, Shades, map_picture};
pub use tiles::{MAX_TILES, TileSet};

use cells::Cells;

/// What the numbers of a raster count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unit {
    /// Minutes.
    #[default]
    Minutes,
    /// Hours.
    Hours,
}

impl Unit {
    /// The word for it: "minutes" or "hours".
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Minutes => "minutes",
            Self::Hours => "hours",
        }
    }

    /// Its symbol: "min" or "h".
    #[must_use]
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Minutes => "min",
            Self::Hours => "h",
        }
    }

    const fn minutes(self) -> f32 {
        match self {
            Self::Minutes => 1.0,
            Self::Hours => 60.0,
        }
    }
}

/// One number for each cell of a grid.
#[derive(Clone, Copy, Debug)]
pub struct Raster<'a> {
    origin: &'a Origin,
    grid: Grid,
    unit: Unit,
    values: &'a [f32],
}

/// Why numbers are no raster.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RasterError {
    /// No cell at all.
    #[error("a raster of {width}x{height} cells has no cell; at least 1x1 is needed")]
    Empty {
        /// Cells in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// Not one number a cell.
    #[error("a raster of {width}x{height} cells needs that many values, but there are {values}")]
    ValueCount {
        /// Cells in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// How many numbers there are.
        values: usize,
    },
    /// A cell without a size.
    #[error("a cell of {0} m has no size; more than 0 m is needed")]
    Cell(f64),
    /// A corner that is nowhere, or so far away that the cells cannot be told apart.
    #[error("cells of {cell} m cannot be told apart at {x}, {y} m from the origin")]
    TooFar {
        /// Metres east.
        x: f64,
        /// Metres north.
        y: f64,
        /// Length of a cell's side in metres.
        cell: f64,
    },
    /// A number that is infinite.
    #[error("the value at row {row}, column {column} is infinite; NaN says that there is none")]
    Infinite {
        /// Its row, from 0 in the north.
        row: usize,
        /// Its column, from 0 in the west.
        column: usize,
    },
}

impl<'a> Raster<'a> {
    /// The numbers of a grid's cells, row by row from the **north**, each row from the west. NaN
    /// says that a cell has none, as inside of a building.
    ///
    /// # Errors
    /// When there are not as many numbers as cells, or none; when a number is infinite; when the
    /// grid has no place or no size.
    pub fn new(
        origin: &'a Origin,
        grid: Grid,
        unit: Unit,
        values: &'a [f32],
    ) -> Result<Self, RasterError> {
        let Grid {
            corner,
            cell,
            width,
            height,
        } = grid;
        if width == 0 || height == 0 {
            return Err(RasterError::Empty { width, height });
        }
        if u64::from(width) * u64::from(height) != values.len() as u64 {
            let values = values.len();
            return Err(RasterError::ValueCount {
                width,
                height,
                values,
            });
        }
        if !(cell > 0.0 && cell.is_finite()) {
            return Err(RasterError::Cell(cell));
        }
        let [x, north] = grid.north_west();
        let east = x + f64::from(width) * cell;
        let apart = |at: f64| at.is_finite() && at + cell > at && at - cell < at;
        if ![x, east, corner[1], north].into_iter().all(apart) {
            let y = corner[1];
            return Err(RasterError::TooFar { x, y, cell });
        }
        if let Some(at) = values.iter().position(|v| v.is_infinite()) {
            let (row, column) = (at / width as usize, at % width as usize);
            return Err(RasterError::Infinite { row, column });
        }
        Ok(Self {
            origin,
            grid,
            unit,
            values,
        })
    }

    /// Where the local metres begin.
    #[must_use]
    pub const fn origin(&self) -> &'a Origin {
        self.origin
    }

    /// Where the cells are.
    #[must_use]
    pub const fn grid(&self) -> Grid {
        self.grid
    }

    /// What the numbers count.
    #[must_use]
    pub const fn unit(&self) -> Unit {
        self.unit
    }

    /// The numbers, row by row from the north.
    #[must_use]
    pub const fn values(&self) -> &'a [f32] {
        self.values
    }

    fn cells(&self) -> Cells<'a> {
        Cells {
            width: self.grid.width as usize,
            height: self.grid.height as usize,
            values: self.values.into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use ombra_city::Crs;

    use super::*;

    const GRID: Grid = Grid {
        corner: [-3.0, 5.0],
        cell: 0.5,
        width: 2,
        height: 3,
    };

    fn error_of(grid: Grid, values: &[f32]) -> String {
        let origin = Origin::new(Crs::wgs84(), [4.36, 52.01]).unwrap();
        let raster = Raster::new(&origin, grid, Unit::Minutes, values);
        raster.unwrap_err().to_string()
    }

    #[test]
    fn the_north_west_corner_is_the_height_above_the_south_west_one() {
        assert_eq!(GRID.north_west(), [-3.0, 6.5]);
    }

    #[test]
    fn what_is_no_raster_says_so() {
        let ok = [0.0; 6];
        assert!(error_of(GRID, &ok[..5]).contains("there are 5"));
        assert!(error_of(Grid { width: 0, ..GRID }, &[]).contains("at least 1x1"));
        let huge = Grid {
            width: u32::MAX,
            height: u32::MAX,
            ..GRID
        };
        assert!(error_of(huge, &ok).contains("there are 6"));
        for cell in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(error_of(Grid { cell, ..GRID }, &ok).contains("has no size"));
        }
        for corner in [[f64::NAN, 0.0], [0.0, f64::INFINITY], [1e300, 0.0]] {
            assert!(error_of(Grid { corner, ..GRID }, &ok).contains("told apart"));
        }
        let mut values = ok;
        values[3] = f32::NEG_INFINITY;
        assert!(error_of(GRID, &values).contains("row 1, column 1 is infinite"));
    }
}
