//! Places in the order in which they are looked at: tiles of neighbours.

use ombra_city::{City, Grid, Inside};
use ombra_geometry::Point3;
use rayon::prelude::*;

use crate::ground::Ground;
use crate::tile::PLACES;

/// Places in tiles of up to sixteen that lie near one another.
#[derive(Clone, Debug, Default)]
pub struct Tiles {
    places: Vec<Point3>,
    /// Which cell of a grid each place is.
    cells: Vec<u32>,
    /// Where each tile ends among the places.
    ends: Vec<usize>,
}

/// How many cells wide and high the tiles of a grid are.
const SIDE: u32 = 4;

/// How many tiles wide and high is what is near: tiles come in squares of so many, so that those that come one
/// after another see the same buildings.
const SQUARE: u32 = 8;

impl Tiles {
    /// The places of a grid that lie on the ground of a city, outside of its buildings.
    #[must_use]
    pub fn on_ground(city: &City, grid: &Grid) -> Self {
        let (ground, inside) = (Ground::new(city), Inside::new(city));
        let across = grid.width.div_ceil(SIDE * SQUARE);
        let down = grid.height.div_ceil(SIDE * SQUARE);
        let squares: Vec<(u32, u32)> = (0..down)
            .flat_map(|row| (0..across).map(move |column| (column, row)))
            .collect();
        let parts: Vec<Self> = squares
            .into_par_iter()
            .map(|(column, row)| {
                let mut part = Self::default();
                for tile in 0..SQUARE * SQUARE {
                    let column = (column * SQUARE + tile % SQUARE) * SIDE;
                    let row = (row * SQUARE + tile / SQUARE) * SIDE;
                    part.add(grid, column, row, &ground, &inside);
                }
                part
            })
            .collect();
        let mut all = Self::default();
        for part in parts {
            let before = all.places.len();
            all.places.extend(part.places);
            all.cells.extend(part.cells);
            all.ends
                .extend(part.ends.into_iter().map(|end| before + end));
        }
        all
    }

    fn add(&mut self, grid: &Grid, column: u32, row: u32, ground: &Ground, inside: &Inside) {
        let before = self.places.len();
        for row in row..(row + SIDE).min(grid.height) {
            for column in column..(column + SIDE).min(grid.width) {
                let place = ground.at(grid.centre(column, row));
                if let Some(place) = place.filter(|&place| !inside.contains(place)) {
                    self.places.push(place);
                    self.cells.push(row * grid.width + column);
                }
            }
        }
        if self.places.len() > before {
            self.ends.push(self.places.len());
        }
    }

    /// So many of the tiles, or all if there are fewer, spread evenly over them.
    #[must_use]
    pub fn spread(&self, count: usize) -> Self {
        let count = count.min(self.len());
        let mut some = Self::default();
        for k in 0..count {
            // The middle ones of as many parts.
            let tile = (2 * k + 1) * self.len() / (2 * count);
            let range = self.range(tile..tile + 1);
            some.places.extend(&self.places[range.clone()]);
            some.cells.extend(&self.cells[range]);
            some.ends.push(some.places.len());
        }
        some
    }

    /// All places, in local metres.
    #[must_use]
    pub fn places(&self) -> &[Point3] {
        &self.places
    }

    /// Which cell of the grid each place is, row by row from the north.
    #[must_use]
    pub fn cells(&self) -> &[u32] {
        &self.cells
    }

    /// How many tiles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Which places some tiles have.
    #[must_use]
    pub fn range(&self, tiles: std::ops::Range<usize>) -> std::ops::Range<usize> {
        let before = |tile: usize| if tile == 0 { 0 } else { self.ends[tile - 1] };
        before(tiles.start)..before(tiles.end)
    }

    /// The places of some tiles, a list each: none is longer than sixteen.
    pub(crate) fn lists(&self, tiles: std::ops::Range<usize>) -> Vec<&[Point3]> {
        let list = |tile| &self.places[self.range(tile..tile + 1)];
        let lists: Vec<&[Point3]> = tiles.map(list).collect();
        debug_assert!(lists.iter().all(|list| list.len() <= PLACES));
        lists
    }
}
