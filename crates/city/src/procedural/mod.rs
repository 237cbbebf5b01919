//! Cities out of nothing: one as large as Manhattan for measurements, and a small one to be looked at.
//!
//! Only sums, products, quotients and square roots of doubles are used, which are the same everywhere:
//! the same arguments give the same bytes on every machine.

mod demo;
mod grid;
mod heights;
mod lots;
mod random;
mod shapes;
mod solids;
#[cfg(test)]
mod tests;

use crate::building::Building;
use crate::city::City;
use crate::crs::Crs;
use crate::origin::Origin;
use grid::Grid;
use lots::{BlockPlan, Lot};
use random::Random;

pub use demo::demo_city;

/// Degrees east and north of the origin of both cities: the middle of Manhattan.
const ORIGIN: [f64; 2] = [-73.98, 40.75];

/// Metres from house front to house front across a street, and across an avenue.
const STREET: f64 = 18.0;
const AVENUE: f64 = 30.0;

/// The blocks of Manhattan, as long along the street as they are wide along the avenue. About 43
/// lots each.
const BLOCK: BlockPlan = BlockPlan {
    size: [270.0, 80.0],
    end: 30.0,
    width: 1.0,
};

/// A city in the manner of Manhattan: blocks of 270 by 80 m in a grid that is turned by 29°, on them
/// lots of 6 to 60 m that stand wall to wall along the streets, with yards behind. Buildings are
/// prisms, of which the higher ones carry towers; some are L-shaped, some towers have eight sides. A
/// tenth is up to 12 m high, half up to 23 m, nine tenths up to 61 m, all but a hundredth up to 142 m;
/// the highest has 250 m. The ground is flat.
///
/// 45,000 buildings take 7.8 by 7.4 km. Their number is met exactly; where it ends within a block,
/// the block stays open.
///
/// ```
/// let city = ombra_city::procedural_city(1, 500);
/// assert_eq!(city.buildings.len(), 500);
/// ```
#[must_use]
pub fn procedural_city(seed: u64, buildings: usize) -> City {
    let mut random = Random::new(seed);
    let lots = grid_of_lots(&mut random, buildings);
    let heights = heights::assigned(&lots, &mut random);
    let grid = Grid::around(&lots);
    let built = lots.iter().zip(heights).map(|(lot, height)| Building {
        parts: shapes::building(lot, height, &grid, &mut random),
        ..Building::default()
    });
    city(built.collect())
}

/// So many lots, block by block along the streets, in an area a little longer along them than
/// across.
fn grid_of_lots(random: &mut Random, count: usize) -> Vec<Lot> {
    const LOTS_A_BLOCK: f64 = 43.0;
    const LONGER: f64 = 1.2;
    let step = [BLOCK.size[0] + AVENUE, BLOCK.size[1] + STREET];
    let blocks = count as f64 / LOTS_A_BLOCK;
    let columns = (blocks * LONGER * step[1] / step[0]).sqrt().ceil().max(1.0);
    let mut lots = Vec::with_capacity(count + 100);
    let mut at = [0.0, 0.0];
    while lots.len() < count {
        let corner = [at[0] * step[0], at[1] * step[1]];
        BLOCK.cut(corner, random, &mut lots);
        at[0] += 1.0;
        if at[0] >= columns {
            at = [0.0, at[1] + 1.0];
        }
    }
    lots.truncate(count);
    lots
}

fn city(buildings: Vec<Building>) -> City {
    let origin = Origin::new(Crs::wgs84(), ORIGIN).expect("New York is on the map");
    City {
        origin,
        buildings,
        terrain: Vec::new(),
        is_terrain_all: false,
        context: Vec::new(),
        ground: 0.0,
        findings: Vec::new(),
    }
}
