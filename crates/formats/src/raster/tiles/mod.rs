//! Tiles for maps on the web: pictures, and the numbers themselves.

mod mercator;
mod sample;
mod write;

use ombra_city::{Grid, Origin};

use crate::error::{Fault, FormatError};
use mercator::{LATITUDE, PIXEL, Tile, to_square};

/// The most tiles of a set: their numbers alone take 6.6 GB.
pub const MAX_TILES: u64 = 50_000;

/// The zoom at which numbers are published by others, and which all sets have unless told otherwise.
const COMMON: u8 = 17;

/// The largest zoom.
const LARGEST: u8 = 22;

/// Tiles of 256 x 256 pixels over a grid, in Web Mercator (EPSG:3857), at all zooms from the one at which a pixel is no wider than a
/// cell, and 17 at least, to the one at which a single tile shows all.
///
/// A pixel has the value of the cell in which its middle lies. Beside `{z}/{x}/{y}.png`, which is transparent where nothing was measured, lies
/// `{z}/{x}/{y}.bin`: 256 x 256 whole minutes of two bytes, signed, the lower byte first, row by row from the north-west, as in the
/// data published with "Shadow Accrual Maps" (Miranda and others, IEEE TVCG 25(3), 2019, at zoom 17); −1 says that nothing was measured. Of a net change, which may be
/// negative, −32768 says so.
#[derive(Clone, Debug, PartialEq)]
pub struct TileSet {
    /// Shares of the world from its north-west: the least and the most, the western ones perhaps beyond the antimeridian.
    bounds: [[f64; 2]; 2],
    /// The smallest and the largest.
    zooms: [u8; 2],
}

impl TileSet {
    /// Those over a grid; `max_zoom` instead of the usual largest zoom.
    ///
    /// # Errors
    /// When the grid reaches beyond 85° of latitude, where Web Mercator ends, or there were more than [`MAX_TILES`].
    pub fn new(origin: &Origin, grid: &Grid, max_zoom: Option<u8>) -> Result<Self, FormatError> {
        let wrong = |text: String| FormatError::file(Fault::Description(text));
        let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for at in edge(grid) {
            let [longitude, latitude] = origin.to_geographic(at);
            if !(latitude.abs() <= LATITUDE) {
                let text = "tiles of web maps end at 85° of latitude; the places reach beyond";
                return Err(wrong(text.to_owned()));
            }
            // Across the antimeridian in one piece.
            let east = (longitude - origin.longitude() + 540.0).rem_euclid(360.0) - 180.0;
            let square = to_square([origin.longitude() + east, latitude]);
            for k in 0..2 {
                bounds[0][k] = bounds[0][k].min(square[k]);
                bounds[1][k] = bounds[1][k].max(square[k]);
            }
        }
        let cells = PIXEL * origin.latitude().to_radians().cos() / grid.cell;
        let fine = cells
            .log2()
            .ceil()
            .clamp(f64::from(COMMON), f64::from(LARGEST)) as u8;
        let last = max_zoom.unwrap_or(fine).min(LARGEST);
        let mut set = Self {
            bounds,
            zooms: [last, last],
        };
        let mut count = set.count_at(last);
        while set.zooms[0] > 0 && set.count_at(set.zooms[0]) > 1 {
            set.zooms[0] -= 1;
            count += set.count_at(set.zooms[0]);
        }
        if count > MAX_TILES {
            return Err(wrong(format!(
                "{count} tiles down to zoom {last} are more than {MAX_TILES}: take a smaller area or a smaller zoom"
            )));
        }
        Ok(set)
    }

    /// The smallest zoom and the largest.
    #[must_use]
    pub const fn zooms(&self) -> [u8; 2] {
        self.zooms
    }

    /// How many tiles there are.
    #[must_use]
    pub fn count(&self) -> u64 {
        let [first, last] = self.zooms;
        (first..=last).map(|zoom| self.count_at(zoom)).sum()
    }

    fn count_at(&self, zoom: u8) -> u64 {
        let [from, to] = self.range(zoom);
        (to[0] - from[0] + 1) as u64 * (to[1] - from[1] + 1) as u64
    }

    /// The first and the last column and row, none of them twice: columns may go on beyond the antimeridian, once around at most.
    fn range(&self, zoom: u8) -> [[i64; 2]; 2] {
        let count = 1_i64 << zoom;
        let at = |share: f64| (share * count as f64).floor() as i64;
        let [from, to] = self.bounds.map(|corner| corner.map(at));
        let row = |row: i64| row.clamp(0, count - 1);
        [
            [from[0], row(from[1])],
            [to[0].min(from[0] + count - 1), row(to[1])],
        ]
    }

    fn tiles(&self, zoom: u8) -> Vec<Tile> {
        let [from, to] = self.range(zoom);
        let columns = from[0]..=to[0];
        let count = 1_i64 << zoom;
        columns
            .flat_map(|x| (from[1]..=to[1]).map(move |y| [x.rem_euclid(count), y]))
            .map(|at| Tile {
                zoom,
                at: at.map(|k| k as u32),
            })
            .collect()
    }
}

/// Places along the edge of a grid: where it reaches farthest on a map need not be a corner.
fn edge(grid: &Grid) -> impl Iterator<Item = [f64; 2]> {
    const STEPS: u32 = 16;
    let [west, south] = grid.corner;
    let size = [grid.width, grid.height].map(|count| f64::from(count) * grid.cell);
    let shares = (0..=STEPS).map(|step| f64::from(step) / f64::from(STEPS));
    shares.flat_map(move |share| {
        [[share, 0.0], [share, 1.0], [0.0, share], [1.0, share]]
            .map(|[x, y]| [west + x * size[0], south + y * size[1]])
    })
}

#[cfg(test)]
mod tests;
