//! What differs between a city before and after.

use std::collections::HashMap;

use crate::building::Building;
use crate::city::City;
use crate::facet::Facet;
use crate::inside::grid::Grid;

/// The polygons that are in one of two cities only, and the ground under their buildings.
#[derive(Clone, Debug, Default)]
pub struct Change {
    facets: Vec<Facet>,
    bounds: Vec<[[f32; 2]; 2]>,
    grid: Grid,
}

impl Change {
    /// Between two cities about the same origin on the same ground.
    #[must_use]
    pub fn between(before: &City, after: &City) -> Self {
        let (old, new) = (before.facets(), after.facets());
        // One counts up, the other down: what both have comes to nothing.
        let mut balance: HashMap<Key, i64> = HashMap::with_capacity(old.len());
        for facet in &old {
            *balance.entry(key(facet)).or_default() += 1;
        }
        for facet in &new {
            *balance.entry(key(facet)).or_default() -= 1;
        }
        let mut change = Self::default();
        for (city, facets) in [(before, old), (after, new)] {
            let mut owners = Vec::new();
            for facet in facets.iter().filter(|facet| balance[&key(facet)] != 0) {
                change.facets.push(*facet);
                if owners.last() != Some(&facet.owner) {
                    owners.push(facet.owner);
                }
            }
            let buildings = (owners.iter()).filter_map(|&owner| city.buildings.get(owner as usize));
            change.bounds.extend(buildings.map(Building::bounds));
        }
        change.grid = Grid::new(&change.bounds);
        change
    }

    /// The polygons that were taken away, then those that were added.
    #[must_use]
    pub fn facets(&self) -> &[Facet] {
        &self.facets
    }

    /// The boxes around their buildings on the ground, by their lowest and highest corners.
    #[must_use]
    pub fn bounds(&self) -> &[[[f32; 2]; 2]] {
        &self.bounds
    }

    /// Whether a place lies in one of these boxes: nowhere else can a place come to lie in a building, or out of one.
    #[must_use]
    pub fn is_within(&self, place: [f32; 2]) -> bool {
        (self.grid.near(place).iter()).any(|&index| {
            let [low, high] = self.bounds[index as usize];
            (0..2).all(|k| low[k] <= place[k] && place[k] <= high[k])
        })
    }
}

/// A polygon as it is, whoever owns it.
type Key = ([u32; 12], bool);

fn key(facet: &Facet) -> Key {
    let mut bits = [0; 12];
    let numbers = facet.corners.iter().flat_map(|p| p.to_array());
    for (bits, number) in bits.iter_mut().zip(numbers) {
        *bits = number.to_bits();
    }
    (bits, facet.is_two_sided)
}
