//! What differs between a city before and after.

use super::Edited;
use crate::building::Building;
use crate::city::City;
use crate::facet::Facet;
use crate::inside::grid::Grid;

/// The polygons that are in one of two cities only, and the ground under their buildings.
#[derive(Clone, Debug, Default)]
pub struct Change {
    facets: Vec<Facet>,
    /// How many of them were taken away; these come first.
    removed: usize,
    bounds: Vec<[[f32; 2]; 2]>,
    grid: Grid,
}

impl Change {
    /// Between a city and what became of it.
    #[must_use]
    pub fn between(before: &City, after: &Edited) -> Self {
        let mut stays = vec![false; before.buildings.len()];
        for &number in after.kept.iter().flatten() {
            stays[number as usize] = true;
        }
        let own = stays.iter().enumerate().filter(|(_, stays)| !**stays);
        let own = own.map(|(number, _)| (before, number));
        let new = after
            .kept
            .iter()
            .enumerate()
            .filter(|(_, kept)| kept.is_none());
        let new = new.map(|(number, _)| (&after.city, number));
        let mut change = Self::default();
        for (city, number) in own {
            change.add(city, number);
        }
        change.removed = change.facets.len();
        for (city, number) in new {
            change.add(city, number);
        }
        change.grid = Grid::new(&change.bounds);
        change
    }

    fn add(&mut self, city: &City, number: usize) {
        let building: &Building = &city.buildings[number];
        city.push_building(&mut self.facets, building, number as u32);
        self.bounds.push(building.bounds());
    }

    /// The polygons that were taken away.
    #[must_use]
    pub fn removed(&self) -> &[Facet] {
        &self.facets[..self.removed]
    }

    /// Those that were added.
    #[must_use]
    pub fn added(&self) -> &[Facet] {
        &self.facets[self.removed..]
    }

    /// Both.
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
