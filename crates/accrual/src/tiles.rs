//! Places in the order in which they are looked at: tiles of neighbours.

use ombra_city::{City, Grid, Inside};
use ombra_geometry::Point3;
use rayon::prelude::*;

use crate::ground::Ground;
use crate::tile::{PLACES, is_somewhere};

/// Places in tiles of up to sixteen that lie near one another.
#[derive(Clone, Debug, Default)]
pub struct Tiles {
    places: Vec<Point3>,
    /// Which cell of a grid, or which place of a list, each of them is.
    indices: Vec<u32>,
    /// Where each tile ends among the places.
    ends: Vec<usize>,
}

/// How many cells wide and high the tiles of a grid are.
const SIDE: u32 = 4;

/// How many tiles wide and high is what is near: tiles come in squares of so many, so that those that come one
/// after another see the same buildings.
const SQUARE: u32 = 8;

impl Tiles {
    /// The places of a grid that lie on the ground of a city, outside of its buildings, and are to be `kept`: it is
    /// asked with local metres east and north.
    #[must_use]
    pub fn on_ground(city: &City, grid: &Grid, kept: impl Fn([f64; 2]) -> bool + Sync) -> Self {
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
                    let column = (column * SQUARE + every_other_bit(tile)) * SIDE;
                    let row = (row * SQUARE + every_other_bit(tile >> 1)) * SIDE;
                    part.add(grid, column, row, |at| {
                        let place = kept(at).then(|| ground.at(at))??;
                        (!inside.contains(place)).then_some(place)
                    });
                }
                part
            })
            .collect();
        let mut all = Self::default();
        for part in parts {
            let before = all.places.len();
            all.places.extend(part.places);
            all.indices.extend(part.indices);
            all.ends
                .extend(part.ends.into_iter().map(|end| before + end));
        }
        all
    }

    /// A list of places, in tiles that are full but for the last one. Which are near one another is found
    /// out: the list is halved, again and again, across the longest side of the box around it.
    #[must_use]
    pub fn near(places: &[Point3]) -> Self {
        // A place that is nowhere comes last, so that it parts no others.
        let (mut indices, nowhere): (Vec<u32>, Vec<u32>) =
            (0..places.len() as u32).partition(|&index| is_somewhere(&places[index as usize]));
        halve(places, &mut indices);
        indices.extend(nowhere);
        let ends = (0..places.len()).step_by(PLACES);
        Self {
            places: indices
                .iter()
                .map(|&index| places[index as usize])
                .collect(),
            ends: ends
                .map(|start| (start + PLACES).min(places.len()))
                .collect(),
            indices,
        }
    }

    fn add(
        &mut self,
        grid: &Grid,
        column: u32,
        row: u32,
        place: impl Fn([f64; 2]) -> Option<Point3>,
    ) {
        let before = self.places.len();
        for row in row..(row + SIDE).min(grid.height) {
            for column in column..(column + SIDE).min(grid.width) {
                if let Some(place) = place(grid.centre(column, row)) {
                    self.places.push(place);
                    self.indices.push(row * grid.width + column);
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
            some.indices.extend(&self.indices[range]);
            some.ends.push(some.places.len());
        }
        some
    }

    /// All places, in local metres.
    #[must_use]
    pub fn places(&self) -> &[Point3] {
        &self.places
    }

    /// Which cell of the grid each place is, row by row from the north; or which place of the list.
    #[must_use]
    pub fn indices(&self) -> &[u32] {
        &self.indices
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

    /// How many tiles lie wholly among the first so many places.
    #[must_use]
    pub fn before(&self, places: usize) -> usize {
        self.ends.partition_point(|&end| end <= places)
    }

    /// The places of some tiles, a list each: none is longer than sixteen.
    pub(crate) fn lists(&self, tiles: std::ops::Range<usize>) -> Vec<&[Point3]> {
        let list = |tile| &self.places[self.range(tile..tile + 1)];
        let lists: Vec<&[Point3]> = tiles.map(list).collect();
        debug_assert!(lists.iter().all(|list| list.len() <= PLACES));
        lists
    }
}

/// Bits 0, 2 and 4: in this order, that of Morton, any four, sixteen or sixty-four that begin at a multiple lie in a square.
fn every_other_bit(tile: u32) -> u32 {
    tile & 1 | tile >> 1 & 2 | tile >> 2 & 4
}

/// Lists longer than this are halved by two threads.
const ALONE: usize = 1 << 14;

/// Puts places into an order in which those in a tile lie near one another, and tiles near those that come before.
fn halve(places: &[Point3], indices: &mut [u32]) {
    if indices.len() <= PLACES {
        return;
    }
    let at = |index: u32| places[index as usize].to_array();
    let nothing = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    let [least, most] = indices.iter().fold(nothing, |[least, most], &index| {
        let at = at(index);
        [
            [0, 1, 2].map(|k| f32::min(least[k], at[k])),
            [0, 1, 2].map(|k| f32::max(most[k], at[k])),
        ]
    });
    let side = |axis: usize| most[axis] - least[axis];
    let axis = (1..3).fold(0, |axis, other| {
        if side(other) > side(axis) {
            other
        } else {
            axis
        }
    });
    // In whole tiles.
    let middle = (indices.len() / 2).next_multiple_of(PLACES);
    let key = |index: u32| (at(index)[axis], index);
    indices.select_nth_unstable_by(middle, |&a, &b| {
        let ((x, a), (y, b)) = (key(a), key(b));
        x.total_cmp(&y).then(a.cmp(&b))
    });
    let (one, other) = indices.split_at_mut(middle);
    if one.len() > ALONE {
        rayon::join(|| halve(places, one), || halve(places, other));
    } else {
        halve(places, one);
        halve(places, other);
    }
}
