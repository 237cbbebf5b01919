//! What if: a city with buildings added, taken away, or made taller.

mod change;
mod error;
mod stretch;

use crate::building::{Building, Part};
use crate::city::City;
use crate::finding::Notes;
use crate::stand::stand;

pub use change::Change;
pub use error::EditError;

/// What is to be other in a city.
///
/// A building is named by its id in the file, or by its number, from 0 as they are read: `#12`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Edits {
    /// Buildings that come behind those of the city, in its local metres:
    /// [`Draft::finish_about`](crate::Draft::finish_about) its origin gives them.
    pub with: Vec<Building>,
    /// Those that go.
    pub without: Vec<String>,
    /// How tall others are from now on: metres from their ground to their top.
    pub heights: Vec<(String, f64)>,
}

impl Edits {
    /// Whether they change nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.with.is_empty() && self.without.is_empty() && self.heights.is_empty()
    }
}

impl City {
    /// The city as it would be. What is not named stays as it is, to the bit, in its order; so do origin and ground.
    ///
    /// A building that is given a height is stretched upward from its ground: podium and tower, eaves and ridge keep their
    /// proportion. What is added has an outline that stands where the city does: on the lowest terrain under its corners, or on
    /// the flat ground unless its file puts it higher. Faces stay at the heights of their file and reach down to the ground.
    ///
    /// # Errors
    /// When no building or several have a name, or it is named twice, and when a height is no height.
    pub fn edited(&self, edits: &Edits) -> Result<Edited, EditError> {
        let names = Names(&self.buildings);
        let mut fates = vec![Fate::Stays; self.buildings.len()];
        let gone = edits.without.iter().map(|name| (name, Fate::Goes));
        let heights = edits.heights.iter();
        let stretched = heights.map(|(name, metres)| (name, Fate::Is(*metres)));
        for (name, fate) in gone.chain(stretched) {
            let own = &mut fates[names.find(name)?];
            if *own != Fate::Stays {
                let name = name.clone();
                return Err(EditError::NamedTwice { name });
            }
            *own = fate;
        }
        let mut buildings = Vec::with_capacity(self.buildings.len() + edits.with.len());
        let mut kept = Vec::with_capacity(buildings.capacity());
        for (number, (building, fate)) in self.buildings.iter().zip(fates).enumerate() {
            match fate {
                Fate::Stays => {
                    buildings.push(building.clone());
                    kept.push(Some(number as u32));
                }
                Fate::Goes => {}
                Fate::Is(metres) => {
                    let stretched = stretch::to_height(building, metres);
                    let name = || name(building, number);
                    let stretched = stretched.ok_or_else(|| EditError::Height {
                        name: name(),
                        metres,
                    })?;
                    buildings.push(stretched);
                    kept.push(None);
                }
            }
        }
        let mut notes = Notes::default();
        for building in &edits.with {
            let mut building = building.clone();
            let place = format!("building {}", name(&building, buildings.len()));
            self.stand_as_own(&mut building, &place, &mut notes);
            buildings.push(building);
            kept.push(None);
        }
        let findings = self.findings.iter().cloned();
        let city = Self {
            origin: self.origin.clone(),
            buildings,
            terrain: self.terrain.clone(),
            context: self.context.clone(),
            findings: findings.chain(notes.into_findings()).collect(),
            ..*self
        };
        Ok(Edited { city, kept })
    }

    fn stand_as_own(&self, building: &mut Building, place: &str, notes: &mut Notes) {
        let ground = if self.terrain.is_empty() {
            self.ground.max(building.ground)
        } else {
            let at = |[x, y]: [f32; 2]| self.ground_at([x, y].map(f64::from));
            let [a, b] = building.bounds();
            let corners: Vec<[f32; 2]> = (building.parts.iter())
                .filter_map(|part| match part {
                    Part::Prism(prism) => Some(prism.outline.rings().flatten().copied()),
                    Part::Faces(_) => None,
                })
                .flatten()
                .chain([a, [b[0], a[1]], b, [a[0], b[1]]])
                .collect();
            let lowest = corners.into_iter().filter_map(at).reduce(f32::min);
            lowest.unwrap_or(building.ground)
        };
        if ground != building.ground {
            stand(building, ground, place, notes);
        }
    }
}

/// A city as it would be.
#[derive(Clone, Debug)]
pub struct Edited {
    /// All of it.
    pub city: City,
    /// For each of its buildings which one it was before, if it is as it was.
    pub kept: Vec<Option<u32>>,
}

/// What becomes of a building.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fate {
    Stays,
    Goes,
    Is(f64),
}

/// For messages.
fn name(building: &Building, number: usize) -> String {
    (building.id.clone()).unwrap_or_else(|| format!("#{number}"))
}

/// Finds buildings by what they are called.
struct Names<'a>(&'a [Building]);

impl Names<'_> {
    fn find(&self, name: &str) -> Result<usize, EditError> {
        let all = self.0.iter().enumerate();
        let named = all.filter(|(_, building)| building.id.as_deref() == Some(name));
        let named: Vec<usize> = named.map(|(number, _)| number).collect();
        let by_number = || name.strip_prefix('#')?.parse::<usize>().ok();
        match named[..] {
            [number] => Ok(number),
            [] => (by_number().filter(|&number| number < self.0.len()))
                .ok_or_else(|| EditError::no_building(name, self.0)),
            _ => Err(EditError::SeveralBuildings {
                name: name.to_owned(),
                numbers: named,
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::procedural::{demo_city, procedural_city};
    use crate::{Crs, Draft, DraftBuilding, DraftPart, Inside};
    use ombra_geometry::Point3;

    fn without(names: &[&str]) -> Edits {
        Edits {
            without: names.iter().map(|&name| name.to_owned()).collect(),
            ..Edits::default()
        }
    }

    fn height(name: &str, metres: f64) -> Edits {
        Edits {
            heights: vec![(name.to_owned(), metres)],
            ..Edits::default()
        }
    }

    #[test]
    fn what_is_not_named_stays_as_it_is() {
        let city = procedural_city(1, 40);
        let taken = city.edited(&without(&["#7", "#0"])).unwrap().city;
        let mut expected = city.buildings.clone();
        expected.remove(7);
        expected.remove(0);
        assert_eq!(taken.buildings, expected);
        assert_eq!(taken.ground, city.ground);
        let same = city.edited(&Edits::default()).unwrap().city;
        assert_eq!(same.buildings, city.buildings);
    }

    #[test]
    fn a_height_stretches_all_of_a_building() {
        let city = demo_city();
        let number = |name: &str| {
            let all = &mut city.buildings.iter();
            all.position(|b| b.id.as_deref() == Some(name)).unwrap()
        };
        let church = number("church");
        let taller = city.edited(&height("church", 93.0)).unwrap().city;
        let parts = city.buildings[church].parts.iter();
        for (before, after) in parts.zip(&taller.buildings[church].parts) {
            let expected = before.range()[1] * 93.0 / 62.0;
            assert!((after.range()[1] - expected).abs() < 1e-4);
            assert_eq!(after.range()[0], before.range()[0]);
            assert_eq!(after.bounds(), before.bounds());
        }
        let top = |city: &City| {
            let parts = city.buildings[church].parts.iter();
            parts.map(|part| part.range()[1]).fold(0.0, f32::max)
        };
        assert_eq!(top(&taller), 93.0, "to the bit");
        let column = number("column");
        let lower = city.edited(&height("column", 3.0)).unwrap().city;
        assert_eq!(lower.buildings[column].parts[0].range(), [0.0, 3.0]);
    }

    #[test]
    fn what_is_added_stands_on_the_ground_of_the_city() {
        let mut city = demo_city();
        city.ground = 30.0;
        let mut draft = Draft::new(Crs::wgs84());
        let [x, y] = city.origin.to_map([500.0, 300.0]);
        let ring = vec![[x, y], [x + 1e-4, y], [x + 1e-4, y + 1e-4], [x, y + 1e-4]];
        draft.buildings.push(DraftBuilding {
            parts: vec![DraftPart::Footprint {
                rings: vec![ring],
                base: 0.0,
                top: 100.0,
            }],
            ..DraftBuilding::default()
        });
        let added = draft.finish_about(&city.origin).unwrap();
        let edits = Edits {
            with: added.buildings,
            ..Edits::default()
        };
        let after = city.edited(&edits).unwrap().city;
        let own = after.buildings.last().unwrap();
        assert_eq!((own.ground, own.parts[0].range()), (30.0, [30.0, 130.0]));
        let inside = Inside::new(&after);
        let last = after.buildings.len() as u32 - 1;
        assert_eq!(inside.building(Point3::new(504.0, 304.0, 40.0)), Some(last));
        // Where the city has terrain of its own, on that.
        let at = |x: f32, y: f32| Point3::new(x, y, 0.01 * x);
        let [a, b, c] = [at(-900.0, -900.0), at(3000.0, -900.0), at(-900.0, 3000.0)];
        city.terrain = vec![[a, b, c]];
        let after = city.edited(&edits).unwrap().city;
        let [low, high] = after.buildings.last().unwrap().parts[0].range();
        assert!((low - 5.0).abs() < 1e-3 && (high - low - 100.0).abs() < 1e-4);
    }

    #[test]
    fn names_that_lead_nowhere_are_told_with_those_that_are_near() {
        let city = demo_city();
        let told = |edits: &Edits| city.edited(edits).unwrap_err().to_string();
        let far = told(&without(&["chruch"]));
        assert!(far.contains("no building is named \"chruch\""), "{far}");
        assert!(far.contains("\"church\""), "{far}");
        let two = told(&height("tower", 9.0));
        assert!(two.contains("4 buildings are named \"tower\": #"), "{two}");
        let number = told(&without(&["#9999"]));
        assert!(number.contains("#0 to #"), "{number}");
        let twice = Edits {
            without: vec!["church".to_owned()],
            ..height("church", 30.0)
        };
        assert!(told(&twice).contains("named twice"));
        let flat = told(&height("church", 0.0));
        assert!(flat.contains("0 m"), "{flat}");
    }

    #[test]
    fn a_change_is_what_differs_and_where() {
        let city = procedural_city(2, 30);
        let same = Change::between(&city, &city.edited(&Edits::default()).unwrap());
        assert!(same.facets().is_empty() && same.bounds().is_empty());
        let gone = Change::between(&city, &city.edited(&without(&["#3"])).unwrap());
        let own = |city: &City, number| {
            let all = city.facets().into_iter();
            all.filter(|facet| facet.owner == number)
                .collect::<Vec<_>>()
        };
        assert_eq!(gone.removed(), own(&city, 3));
        assert!(gone.added().is_empty());
        let [low, high] = city.buildings[3].bounds();
        let middle = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
        assert!(gone.is_within(middle) && !gone.is_within([low[0] - 1.0, low[1]]));
        let lower = city.edited(&height("#5", 2.0)).unwrap();
        let change = Change::between(&city, &lower);
        assert_eq!(change.removed(), own(&city, 5));
        assert_eq!(change.added(), own(&lower.city, 5));
        assert_eq!(
            change.facets().len(),
            change.removed().len() + change.added().len()
        );
    }
}
