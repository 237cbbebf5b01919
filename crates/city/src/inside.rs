//! Which places lie in a building.

pub(crate) mod grid;

use ombra_geometry::Point3;

use crate::building::{Faces, Part, Surface};
use crate::city::{City, Plane};
use crate::polygon::{Polygon, is_inside};
use grid::Grid;

/// Tells whether a place lies in a building, and in which.
///
/// A building holds the places from its base up to, but not including, its roof. Of two that share
/// a wall one has the places on it.
#[derive(Clone, Debug)]
pub struct Inside {
    volumes: Vec<Volume>,
    grid: Grid,
}

/// The space of a part.
#[derive(Clone, Debug)]
struct Volume {
    owner: u32,
    /// Where it begins and ends: z.
    low: f32,
    high: f32,
    shape: Shape,
}

#[derive(Clone, Debug)]
enum Shape {
    /// All between low and high.
    Prism(Polygon),
    /// Below its roofs; of a closed one also above its floors, if it overhangs.
    Faces {
        faces: Vec<Lid>,
        is_closed: bool,
        ground: f32,
    },
}

/// A face that is not upright, as seen from above.
#[derive(Clone, Debug)]
struct Lid {
    rings: Vec<Vec<[f64; 2]>>,
    plane: Plane,
}

impl Inside {
    /// Makes ready to answer for a city.
    #[must_use]
    pub fn new(city: &City) -> Self {
        let mut volumes = Vec::new();
        let mut boxes = Vec::new();
        for (owner, building) in city.buildings.iter().enumerate() {
            for part in &building.parts {
                let [low, high] = part.range();
                let shape = match part {
                    Part::Prism(prism) => Shape::Prism(prism.outline.clone()),
                    Part::Faces(faces) => Shape::Faces {
                        faces: lids(faces),
                        is_closed: faces.is_closed,
                        ground: low,
                    },
                };
                boxes.push(part.bounds());
                volumes.push(Volume {
                    owner: owner as u32,
                    low: city.bottom(low, building),
                    high,
                    shape,
                });
            }
        }
        let grid = Grid::new(&boxes);
        Self { volumes, grid }
    }

    /// Whether a place (local metres) lies in any building.
    #[must_use]
    pub fn contains(&self, place: Point3) -> bool {
        self.building(place).is_some()
    }

    /// The first building that a place (local metres) lies in, by its place in
    /// [`City::buildings`].
    #[must_use]
    pub fn building(&self, place: Point3) -> Option<u32> {
        (self.grid.near([place.x, place.y]).iter())
            .map(|&index| &self.volumes[index as usize])
            .find(|volume| volume.contains(place))
            .map(|volume| volume.owner)
    }
}

impl Volume {
    fn contains(&self, place: Point3) -> bool {
        if !(self.low <= place.z && place.z < self.high) {
            return false;
        }
        match &self.shape {
            Shape::Prism(outline) => outline.contains([place.x, place.y]),
            Shape::Faces {
                faces,
                is_closed,
                ground,
            } => {
                // Below its floor, down to the flat ground, it goes on as at the floor.
                let z = f64::from(place.z.max(*ground));
                let above = lids_above(faces, [f64::from(place.x), f64::from(place.y)], z);
                if *is_closed {
                    above % 2 == 1
                } else {
                    above > 0
                }
            }
        }
    }
}

/// How many faces lie above a place: of a solid an odd number if the place is in it.
fn lids_above(faces: &[Lid], place: [f64; 2], z: f64) -> usize {
    let covers = |lid: &&Lid| {
        (lid.plane.z_at(place)).is_some_and(|top| top > z)
            && (lid.rings.iter()).fold(false, |inside, ring| {
                inside ^ is_inside(ring.iter().copied(), place)
            })
    };
    faces.iter().filter(covers).count()
}

/// The faces that matter. Where a soup of faces says which are roofs, the others do not.
fn lids(faces: &Faces) -> Vec<Lid> {
    let has_roofs = faces.faces.iter().any(|f| f.surface == Surface::Roof);
    let only_roofs = has_roofs && !faces.is_closed;
    (faces.faces.iter())
        .filter(|face| !only_roofs || face.surface == Surface::Roof)
        .filter_map(|face| {
            let plane = Plane::of(&face.rings[0])?;
            plane.z_at([0.0, 0.0])?;
            let seen = |p: &Point3| [f64::from(p.x), f64::from(p.y)];
            let rings = (face.rings.iter())
                .map(|ring| ring.iter().map(seen).collect())
                .collect();
            Some(Lid { rings, plane })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crs::Crs;
    use crate::draft::{Draft, DraftBuilding, DraftFace, DraftPart};

    fn city(parts: Vec<DraftPart>) -> City {
        let mut draft = Draft::new(Crs::from_epsg(32633).unwrap());
        for part in parts {
            draft.buildings.push(DraftBuilding {
                place: "test".to_owned(),
                parts: vec![part],
                ..DraftBuilding::default()
            });
        }
        draft.finish().unwrap()
    }

    fn at(x: f64, y: f64) -> [f64; 2] {
        [500_000.0 + x, 5_800_000.0 + y]
    }

    fn asks(city: &City, [x, y]: [f64; 2], z: f32) -> Option<u32> {
        let [x, y] = city.origin.to_local(at(x, y));
        Inside::new(city).building(Point3::new(x as f32, y as f32, z))
    }

    #[test]
    fn a_tower_on_a_podium_and_a_courtyard() {
        let square =
            |low: f64, high: f64| vec![at(low, low), at(high, low), at(high, high), at(low, high)];
        let footprint = |rings, base, top| DraftPart::Footprint { rings, base, top };
        let city = city(vec![
            footprint(vec![square(0.0, 30.0), square(20.0, 25.0)], 0.0, 6.0),
            footprint(vec![square(5.0, 15.0)], 6.0, 60.0),
        ]);
        assert_eq!(asks(&city, [1.0, 1.0], 0.0), Some(0));
        assert_eq!(asks(&city, [1.0, 1.0], 6.0), None);
        assert_eq!(asks(&city, [10.0, 10.0], 6.0), Some(1));
        assert_eq!(asks(&city, [22.0, 22.0], 1.0), None);
        assert_eq!(asks(&city, [31.0, 1.0], 1.0), None);
        assert_eq!(asks(&city, [1.0, 1.0], -0.1), None);
        assert_eq!(asks(&city, [f64::NAN, 1.0], 1.0), None);
    }

    #[test]
    fn a_gable_is_as_high_as_its_roof_is_there() {
        let p = |x: f64, y: f64, z: f64| [500_000.0 + x, 5_800_000.0 + y, z];
        let [a, b, c, d] = [p(0., 0., 0.), p(8., 0., 0.), p(8., 8., 0.), p(0., 8., 0.)];
        let [e, f, g, h] = [a, b, c, d].map(|[x, y, _]| [x, y, 3.0]);
        let (r, s) = (p(0.0, 4.0, 6.0), p(8.0, 4.0, 6.0));
        let faces = |with_floor: bool| {
            let mut all = vec![
                (vec![e, f, s, r], Surface::Roof),
                (vec![g, h, r, s], Surface::Roof),
                (vec![a, b, f, e], Surface::Wall),
                (vec![b, c, g, s, f], Surface::Wall),
                (vec![c, d, h, g], Surface::Wall),
                (vec![d, a, e, r, h], Surface::Wall),
            ];
            if with_floor {
                all.push((vec![d, c, b, a], Surface::Ground));
            }
            let face = |(ring, surface)| DraftFace {
                rings: vec![ring],
                surface,
            };
            DraftPart::Faces(all.into_iter().map(face).collect())
        };
        for with_floor in [true, false] {
            let city = city(vec![faces(with_floor)]);
            let Part::Faces(part) = &city.buildings[0].parts[0] else {
                panic!("faces stay faces");
            };
            assert!(part.is_closed, "with or without a floor");
            assert_eq!(asks(&city, [4.0, 4.0], 5.9), Some(0));
            assert_eq!(asks(&city, [4.0, 1.0], 3.6), Some(0));
            assert_eq!(asks(&city, [4.0, 1.0], 3.9), None);
            assert_eq!(asks(&city, [4.0, 1.0], 0.0), Some(0));
            assert_eq!(asks(&city, [9.0, 1.0], 0.0), None);
        }
    }
}
