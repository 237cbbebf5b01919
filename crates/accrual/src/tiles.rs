//! Places in the order in which they are looked at: tiles of neighbours.

use std::collections::BTreeSet;

use ombra_city::{Change, City, Grid, Inside};
use ombra_geometry::{Aabb, Point3};
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
        let across = grid.width.div_ceil(SIDE * SQUARE);
        let down = grid.height.div_ceil(SIDE * SQUARE);
        let squares = (0..down).flat_map(|row| (0..across).map(move |column| (column, row)));
        Self::in_squares(city, grid, squares.collect(), kept)
    }

    /// The same of a city after a change, where that may put a place into a building or out of one.
    #[must_use]
    pub fn on_changed_ground(
        city: &City,
        grid: &Grid,
        change: &Change,
        kept: impl Fn([f64; 2]) -> bool + Sync,
    ) -> Self {
        let side = grid.cell * f64::from(SIDE * SQUARE);
        let [west, north] = grid.north_west();
        let square = |metres: f32, from: f64, cells: u32| {
            let last = f64::from(cells.div_ceil(SIDE * SQUARE) - 1);
            ((f64::from(metres) - from) / side).floor().clamp(0.0, last) as u32
        };
        let mut squares = BTreeSet::new();
        for [low, high] in change.bounds() {
            let [first, last] = [low, high].map(|at| square(at[0], west, grid.width));
            let [bottom, top] = [low, high].map(|at| square(-at[1], -north, grid.height));
            squares.extend((top..=bottom).flat_map(|row| (first..=last).map(move |c| (c, row))));
        }
        let is_within = |at: [f64; 2]| change.is_within(at.map(|x| x as f32));
        let kept = |at| is_within(at) && kept(at);
        Self::in_squares(city, grid, squares.into_iter().collect(), kept)
    }

    fn in_squares(
        city: &City,
        grid: &Grid,
        squares: Vec<(u32, u32)>,
        kept: impl Fn([f64; 2]) -> bool + Sync,
    ) -> Self {
        let (ground, inside) = (Ground::new(city), Inside::new(city));
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
            all.append(part);
        }
        all
    }

    /// Adds others behind these.
    pub(crate) fn append(&mut self, others: Self) {
        let before = self.places.len();
        self.places.extend(others.places);
        self.indices.extend(others.indices);
        let ends = others.ends.into_iter().map(|end| before + end);
        self.ends.extend(ends);
    }

    /// Some of the tiles, and of them the places that are to be `kept`.
    pub(crate) fn some(&self, which: &[usize], kept: impl Fn(Point3) -> bool) -> Self {
        let mut some = Self::default();
        for &tile in which {
            for index in self
                .range(tile..tile + 1)
                .filter(|&index| kept(self.places[index]))
            {
                some.places.push(self.places[index]);
                some.indices.push(self.indices[index]);
            }
            if some.places.len() > some.ends.last().copied().unwrap_or(0) {
                some.ends.push(some.places.len());
            }
        }
        some
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

    /// The same places under other indices: `names` has one for each index that there was.
    #[must_use]
    pub fn renamed(&self, names: &[u32]) -> Self {
        let named = self.indices.iter().map(|&index| names[index as usize]);
        Self {
            indices: named.collect(),
            ..self.clone()
        }
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
    let all = indices.iter().map(|&index| places[index as usize]);
    let sides = Aabb::around(all).extent().to_array();
    let axis = (1..3).fold(0, |axis, other| {
        if sides[other] > sides[axis] {
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
