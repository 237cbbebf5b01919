//! A small city to be looked at.

use super::grid::Grid;
use super::lots::{BlockPlan, Lot, Rectangle};
use super::random::Random;
use super::shapes::{building, corners, octagon};
use super::{city, solids};
use crate::building::{Building, Part};
use crate::city::City;

/// What stands on each block, from the north-west to the south-east: r rows of houses, m buildings of
/// some storeys, t towers, c the church, s the square, p the park.
const PLAN: [&str; 5] = ["rrmmrr", "rppmmr", "mppmtm", "mmcstm", "rrmmmm"];

/// A block of it, metres.
const BLOCK: BlockPlan = BlockPlan {
    size: [96.0, 62.0],
    end: 16.0,
    width: 1.5,
};

/// Metres from block to block.
const STREET: f64 = 15.0;

/// A small city that looks like one: a park with a pavilion, a square with a column and a church,
/// rows of houses with pitched roofs, and a few towers. Some 300 buildings on 700 by 400 m, always the
/// same, on flat ground in the middle of New York.
///
/// ```
/// let city = ombra_city::demo_city();
/// assert!(city.buildings.iter().any(|building| building.id.as_deref() == Some("church")));
/// ```
#[must_use]
pub fn demo_city() -> City {
    let step = BLOCK.size.map(|size| size + STREET);
    let rows = PLAN.len() as f64;
    let middle = [3.0 * step[0], 0.5 * rows * step[1]].map(|x| x - 0.5 * STREET);
    let mut demo = Demo {
        grid: Grid::new(middle),
        random: Random::new(5),
        buildings: Vec::new(),
    };
    for (row, kinds) in PLAN.iter().rev().enumerate() {
        for (column, kind) in kinds.chars().enumerate() {
            let low = [column as f64 * step[0], row as f64 * step[1]];
            demo.block(kind, low);
        }
    }
    // Amid the four blocks of the park.
    let corner = [2.0 * step[0] - 12.0, 3.0 * step[1] - 12.0].map(|x| x - 0.5 * STREET);
    demo.pavilion(corner);
    city(demo.buildings)
}

struct Demo {
    grid: Grid,
    random: Random,
    buildings: Vec<Building>,
}

impl Demo {
    fn block(&mut self, kind: char, low: [f64; 2]) {
        let high = [0, 1].map(|k| low[k] + BLOCK.size[k]);
        let whole = Rectangle { low, high };
        match kind {
            'r' => self.houses(&whole),
            't' => self.towers(&whole),
            'c' => self.church(&whole),
            's' => {
                let column = octagon(&centred(whole.middle(), [2.4, 2.4]));
                let part = self.grid.prism(&column, 22.0);
                self.push(Some("column"), vec![part]);
            }
            'p' => {}
            _ => {
                let mut lots = Vec::new();
                BLOCK.cut(low, &mut self.random, &mut lots);
                for lot in &lots {
                    self.storeys(lot);
                }
            }
        }
    }

    fn push(&mut self, id: Option<&str>, parts: Vec<Part>) {
        self.buildings.push(Building {
            id: id.map(str::to_owned),
            parts,
            ..Building::default()
        });
    }

    /// Three to seven of them, of 3.2 m.
    fn storeys(&mut self, lot: &Lot) {
        let count = self.random.between(3.0, 8.0).floor() + if lot.on_avenue { 1.0 } else { 0.0 };
        let parts = building(lot, 3.2 * count, &self.grid, &mut self.random);
        self.push(None, parts);
    }

    /// Two rows, each wall to wall but for a gap in the middle, with gardens behind.
    fn houses(&mut self, block: &Rectangle) {
        const WIDTH: f64 = 8.0;
        const DEPTH: f64 = 11.0;
        const FRONT_GARDEN: f64 = 4.0;
        let fronts = [
            block.low[1] + FRONT_GARDEN,
            block.high[1] - FRONT_GARDEN - DEPTH,
        ];
        for y in fronts {
            let eaves = self.random.between(6.0, 8.0);
            for k in (0..12).filter(|k| *k != 6) {
                let low = [block.low[0] + WIDTH * f64::from(k), y];
                let on = Rectangle {
                    low,
                    high: [low[0] + WIDTH, y + DEPTH],
                };
                let eaves = eaves + 0.5 * (self.random.unit() * 3.0).floor();
                let part = solids::gabled(&self.grid, &on, [eaves, eaves + 4.0], 0);
                self.push(None, vec![part]);
            }
        }
    }

    /// Two, each on a podium.
    fn towers(&mut self, block: &Rectangle) {
        let [x, y] = block.middle();
        for dx in [-24.0, 24.0] {
            let podium = centred([x + dx, y], [42.0, 44.0]);
            let tower = centred([x + dx, y + 3.0], [25.0, 25.0]);
            let height = self.random.between(70.0, 130.0);
            let is_round = self.random.happens(0.3);
            let grid = &self.grid;
            let shaft = if is_round {
                grid.prism(&octagon(&tower), height)
            } else {
                grid.prism(&corners(&tower), height)
            };
            let parts = vec![grid.prism(&corners(&podium), 12.0), shaft];
            self.push(Some("tower"), parts);
        }
    }

    /// A nave, a transept, an apse and a spire.
    fn church(&mut self, block: &Rectangle) {
        let [x, y] = block.middle();
        let grid = &self.grid;
        let parts = vec![
            solids::gabled(grid, &centred([x, y], [44.0, 14.0]), [14.0, 23.0], 0),
            solids::gabled(grid, &centred([x + 8.0, y], [12.0, 30.0]), [14.0, 22.0], 1),
            grid.prism(&octagon(&centred([x + 22.0, y], [13.0, 13.0])), 12.0),
            solids::spire(grid, &centred([x - 25.0, y], [9.0, 9.0]), [32.0, 62.0]),
        ];
        self.push(Some("church"), parts);
    }

    fn pavilion(&mut self, low: [f64; 2]) {
        let on = Rectangle {
            low,
            high: low.map(|x| x + 12.0),
        };
        let part = self.grid.prism(&octagon(&on), 5.0);
        self.push(Some("pavilion"), vec![part]);
    }
}

fn centred(middle: [f64; 2], size: [f64; 2]) -> Rectangle {
    Rectangle {
        low: [0, 1].map(|k| middle[k] - 0.5 * size[k]),
        high: [0, 1].map(|k| middle[k] + 0.5 * size[k]),
    }
}
