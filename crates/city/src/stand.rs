//! Buildings on terrain.

use ombra_geometry::Point3;

use crate::building::{Building, Face, Part};
use crate::city::{City, LOWEST};
use crate::error::CityError;
use crate::extent::Extent;
use crate::finding::Notes;
use crate::height_field::{HeightField, Vertices, triangles};
use crate::origin::Origin;
use crate::polygon::{edges, is_inside};

/// Faces that begin farther from the terrain than this, in metres, are told of: the heights of the two files
/// may not be above the same zero.
const APART: f32 = 5.0;

/// An edge is looked at in so many places at most.
const MOST_LOOKS: f64 = 4096.0;

/// And the inside of an outline at so many pixels.
const MOST_INSIDE: f64 = 1e6;

impl City {
    /// Puts the city on terrain, in place of what it had, as far as `extent` needs it.
    ///
    /// What has an outline and a height stands on the lowest place of the terrain under it, whatever z its
    /// file gives the outline. Faces have heights above the sea and stay where they are; those that
    /// begin above the terrain reach down to it. Beside the terrain and in its holes there is no ground.
    ///
    /// # Errors
    /// When no height lies in the extent, or more than [`MOST_PIXELS`](crate::MOST_PIXELS) pixels do.
    pub fn stand_on(&mut self, terrain: &HeightField, extent: Extent) -> Result<(), CityError> {
        let vertices = Vertices::new(terrain, &self.origin, extent)?;
        let found = triangles(&vertices, &[]).ground;
        if found.is_empty() {
            return Err(elsewhere(terrain, &self.origin));
        }
        let mut notes = Notes::default();
        if !self.terrain.is_empty() {
            notes.add("terrain", "the file has its own: left out");
        }
        let lowest = found.iter().flatten().map(|p| p.z);
        self.ground = lowest.fold(f32::INFINITY, f32::min);
        let below = Below {
            field: terrain,
            origin: self.origin.on_map(terrain.crs().clone()),
        };
        for (index, building) in self.buildings.iter_mut().enumerate() {
            let name = || (building.id.as_ref()).map_or_else(|| index.to_string(), Clone::clone);
            let place = format!("building {}", name());
            let ground = below.lowest(building).unwrap_or_else(|| {
                let message =
                    "the terrain has no height under it: stands as low as the lowest place";
                notes.add(&place, message);
                self.ground
            });
            stand(building, ground, &place, &mut notes);
        }
        self.terrain = found;
        self.is_terrain_all = true;
        self.findings.extend(notes.into_findings());
        Ok(())
    }
}

/// The error for heights that lie where nobody asks for them.
pub(crate) fn elsewhere(field: &HeightField, origin: &Origin) -> CityError {
    let extent = field.extent(&origin.on_map(field.crs().clone()));
    let middle = [0, 1].map(|k| 0.5 * (extent.low[k] + extent.high[k]));
    CityError::HeightsElsewhere {
        distance_km: middle[0].hypot(middle[1]) / 1000.0,
        crs: field.crs().name().to_owned(),
    }
}

/// Puts a building on ground: outlines come along, faces reach down to it.
pub(crate) fn stand(building: &mut Building, ground: f32, place: &str, notes: &mut Notes) {
    let before = building.ground;
    let mut has_faces = false;
    for part in &mut building.parts {
        match part {
            Part::Prism(prism) => {
                prism.base += ground - before;
                prism.top += ground - before;
            }
            Part::Faces(faces) => {
                has_faces = true;
                let low = lowest(&faces.faces);
                // What hangs in the air goes on to.
                if low <= before + LOWEST && ground < low {
                    for p in faces
                        .faces
                        .iter_mut()
                        .flat_map(|face| face.rings.iter_mut().flatten())
                    {
                        if p.z <= low + LOWEST {
                            p.z = ground;
                        }
                    }
                }
            }
        }
    }
    if has_faces && (before - ground).abs() > APART {
        let message = format!(
            "begins {:.1} m off the terrain: are both heights above the same zero?",
            before - ground
        );
        notes.add_kind("off the terrain", place, message);
    }
    building.ground = if has_faces {
        before.min(ground)
    } else {
        ground
    };
}

fn lowest(faces: &[Face]) -> f32 {
    let corners = faces.iter().flat_map(Face::corners);
    corners.map(|p| p.z).fold(f32::INFINITY, f32::min)
}

/// Looks for the terrain under outlines.
struct Below<'a> {
    field: &'a HeightField,
    /// On the map of the field.
    origin: Origin,
}

impl Below<'_> {
    /// The lowest place under a building; `None` where the terrain has no height.
    fn lowest(&self, building: &Building) -> Option<f32> {
        let pixel = |x: f32, y: f32| self.field.pixel(self.origin.to_map([x, y].map(f64::from)));
        let mut lowest = f64::INFINITY;
        for part in &building.parts {
            match part {
                Part::Prism(prism) => {
                    let rings = prism.outline.rings();
                    let rings: Vec<Vec<_>> = rings
                        .map(|ring| ring.iter().map(|&[x, y]| pixel(x, y)).collect())
                        .collect();
                    lowest = lowest.min(self.lowest_in(&rings));
                }
                Part::Faces(faces) => {
                    for face in &faces.faces {
                        let rings = face.rings.iter();
                        let rings: Vec<Vec<_>> = rings
                            .map(|ring| ring.iter().map(|p: &Point3| pixel(p.x, p.y)).collect())
                            .collect();
                        lowest = lowest.min(self.lowest_in(&rings));
                    }
                }
            }
        }
        lowest.is_finite().then_some(lowest as f32)
    }

    /// Under rings in pixels: along their edges at every half pixel, and at the pixels in them.
    fn lowest_in(&self, rings: &[Vec<[f64; 2]>]) -> f64 {
        let mut lowest = f64::INFINITY;
        let mut bounds = Extent::NOWHERE;
        for (a, b) in rings.iter().flat_map(|ring| edges(ring.iter().copied())) {
            bounds = bounds.with(a);
            let looks = (2.0 * (b[0] - a[0]).hypot(b[1] - a[1])).ceil();
            let looks = looks.clamp(1.0, MOST_LOOKS) as u32;
            for k in 0..looks {
                let t = f64::from(k) / f64::from(looks);
                let place = [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
                if let Some(z) = self.field.height_at_pixel(place) {
                    lowest = lowest.min(z);
                }
            }
        }
        let size = self.field.size();
        let from = [0, 1].map(|k| bounds.low[k].ceil().clamp(0.0, f64::from(size[k])) as u32);
        let to =
            [0, 1].map(|k| (bounds.high[k].floor() + 1.0).clamp(0.0, f64::from(size[k])) as u32);
        let [across, down] = [0, 1].map(|k| to[k].saturating_sub(from[k]));
        // Of an outline over very many pixels not each is looked at.
        let every = ((f64::from(across) * f64::from(down) / MOST_INSIDE)
            .sqrt()
            .ceil() as u32)
            .max(1);
        for row in (from[1]..to[1]).step_by(every as usize) {
            for column in (from[0]..to[0]).step_by(every as usize) {
                let z = f64::from(self.field.at([column, row]));
                if z < lowest {
                    let place = [column, row].map(f64::from);
                    let is_in = rings.iter().fold(false, |is_in, ring| {
                        is_in ^ is_inside(ring.iter().copied(), place)
                    });
                    if is_in {
                        lowest = z;
                    }
                }
            }
        }
        lowest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crs::Crs;
    use crate::draft::{Draft, DraftBuilding, DraftFace, DraftPart};

    /// A slope that rises by a tenth to the east, from 50 m, over 200 m by 200 m.
    fn slope() -> HeightField {
        let z = |k: u32| 50.0 + 0.1 * (k % 201) as f32;
        HeightField::new(
            Crs::from_epsg(32633).unwrap(),
            [201, 201],
            [1.0, 0.0, 500_000.0, 0.0, -1.0, 5_800_200.0],
            (0..201 * 201).map(z).collect(),
        )
        .unwrap()
    }

    fn square([x, y]: [f64; 2], size: f64) -> Vec<[f64; 2]> {
        let (x, y) = (500_000.0 + x, 5_800_000.0 + y);
        vec![[x, y], [x + size, y], [x + size, y + size], [x, y + size]]
    }

    fn city(buildings: Vec<Vec<DraftPart>>) -> City {
        let mut draft = Draft::new(Crs::from_epsg(32633).unwrap());
        draft.buildings = (buildings.into_iter())
            .map(|parts| DraftBuilding {
                place: "test".to_owned(),
                parts,
                ..DraftBuilding::default()
            })
            .collect();
        draft.finish().unwrap()
    }

    fn footprint(at: [f64; 2], size: f64, base: f64, top: f64) -> DraftPart {
        DraftPart::Footprint {
            rings: vec![square(at, size)],
            base,
            top,
        }
    }

    #[test]
    fn outlines_stand_on_the_lowest_place_under_them() {
        let mut city = city(vec![
            vec![footprint([100.0, 100.0], 20.0, 0.0, 12.0)],
            vec![
                footprint([20.5, 20.0], 10.0, 0.0, 5.0),
                footprint([30.5, 20.0], 10.0, 3.0, 9.0),
            ],
        ]);
        city.stand_on(&slope(), Extent::EVERYWHERE).unwrap();
        let ranges = |building: usize| -> Vec<[f32; 2]> {
            let parts = city.buildings[building].parts.iter();
            parts.map(Part::range).collect()
        };
        let near = |found: [f32; 2], expected: [f32; 2]| {
            let error = (0..2).map(|k| (found[k] - expected[k]).abs());
            assert!(
                error.fold(0.0, f32::max) < 1e-3,
                "{found:?}, not {expected:?}"
            );
        };
        near(ranges(0)[0], [60.0, 72.0]);
        near(ranges(1)[0], [52.05, 57.05]);
        // What hangs in the air is as high above the ground of the whole.
        near(ranges(1)[1], [55.05, 61.05]);
        assert!((city.ground - 50.0).abs() < 1e-3 && city.is_terrain_all);
        assert_eq!(city.terrain.len(), 4 * 4 * 2, "a slope is a plane");
        assert!(city.findings.is_empty(), "{:?}", city.findings);
    }

    #[test]
    fn a_pit_under_the_middle_counts() {
        let mut heights = vec![50.0; 41 * 41];
        heights[20 * 41 + 20] = 44.0;
        let map = [1.0, 0.0, 500_000.0, 0.0, -1.0, 5_800_040.0];
        let pit = HeightField::new(Crs::from_epsg(32633).unwrap(), [41, 41], map, heights).unwrap();
        let mut city = city(vec![vec![footprint([10.3, 10.3], 20.0, 0.0, 9.0)]]);
        city.stand_on(&pit, Extent::EVERYWHERE).unwrap();
        assert_eq!(city.buildings[0].parts[0].range(), [44.0, 53.0]);
    }

    #[test]
    fn faces_stay_and_reach_down() {
        let at = |x: f64, y: f64, z: f64| [500_050.0 + x, 5_800_050.0 + y, z];
        let [a, b, c, d] = [[0., 0.], [8., 0.], [8., 8.], [0., 8.]].map(|[x, y]| at(x, y, 55.6));
        let [e, f, g, h] = [a, b, c, d].map(|[x, y, _]| [x, y, 65.0]);
        let face = |ring: [[f64; 3]; 4]| DraftFace {
            rings: vec![ring.to_vec()],
            ..DraftFace::default()
        };
        let rings = [
            [e, f, g, h],
            [a, b, f, e],
            [b, c, g, f],
            [c, d, h, g],
            [d, a, e, h],
        ];
        let mut city = city(vec![vec![DraftPart::Faces(rings.map(face).to_vec())]]);
        city.stand_on(&slope(), Extent::EVERYWHERE).unwrap();
        let [low, high] = city.buildings[0].parts[0].range();
        assert!((low - 55.0).abs() < 1e-3 && high == 65.0, "{low} {high}");
        assert!(city.findings.is_empty());
        let mut high_up = HeightField::clone(&slope());
        high_up = HeightField::new(
            high_up.crs().clone(),
            high_up.size(),
            [1.0, 0.0, 500_000.0, 0.0, -1.0, 5_800_200.0],
            vec![90.0; 201 * 201],
        )
        .unwrap();
        city.stand_on(&high_up, Extent::EVERYWHERE).unwrap();
        assert_eq!(city.buildings[0].parts[0].range()[1], 65.0);
        let told: Vec<String> = city.findings.iter().map(ToString::to_string).collect();
        assert!(told[0].contains("its own"), "{told:?}");
        assert!(
            told[1].contains("begins -35.0 m off the terrain"),
            "{told:?}"
        );
    }

    #[test]
    fn terrain_in_another_reference_system_is_the_same_terrain() {
        let utm = slope();
        let mut city = city(vec![vec![footprint([100.0, 100.0], 20.0, 0.0, 12.0)]]);
        // The neighbouring zone sees the same ground far from its middle, and leaning.
        let other = Crs::from_epsg(32632).unwrap();
        let way = Origin::new(utm.crs().clone(), [500_100.0, 5_800_100.0]).unwrap();
        let [x, y] = way.on_map(other.clone()).to_map([0.0, 0.0]);
        let corner = [x - 200.0, y + 200.0];
        let back = way.on_map(other.clone());
        let heights = (0..401 * 401).map(|k: u32| {
            let pixel = [f64::from(k % 401), -f64::from(k / 401)];
            let local = back.to_local([corner[0] + pixel[0], corner[1] + pixel[1]]);
            utm.height(way.to_map(local)).map_or(f32::NAN, |z| z as f32)
        });
        let map = [1.0, 0.0, corner[0], 0.0, -1.0, corner[1]];
        let leaning = HeightField::new(other, [401, 401], map, heights.collect()).unwrap();
        city.stand_on(&leaning, Extent::EVERYWHERE).unwrap();
        let [low, _] = city.buildings[0].parts[0].range();
        assert!((low - 60.0).abs() < 5e-3, "{low}");
    }

    #[test]
    fn only_what_is_needed_becomes_triangles_and_what_is_elsewhere_is_told() {
        let mut city = city(vec![vec![footprint([100.0, 100.0], 10.0, 0.0, 12.0)]]);
        let near = Extent::NOWHERE
            .with([-5.0, -5.0])
            .with([5.0, 5.0])
            .widened(10.0);
        city.stand_on(&slope(), near).unwrap();
        let reach = city
            .terrain
            .iter()
            .flatten()
            .map(|p| p.x.abs().max(p.y.abs()));
        let reach = reach.fold(0.0, f32::max);
        assert!((15.0..20.0).contains(&reach), "{reach}");
        let far = Extent::NOWHERE.with([30e3, 0.0]).with([31e3, 10.0]);
        let told = city.stand_on(&slope(), far).unwrap_err().to_string();
        assert!(told.contains("no height lies within reach"), "{told}");
    }
}
