//! The average ground around proposed buildings.

use std::slice;

use ombra::accrual::Ground;
use ombra::city::{Building, City, Part, united};
use ombra::geometry::Point3;

use super::super::map::is_wide;
use super::zones::along;

/// Metres between the places along an outline at which the ground is looked at.
const STEP: f64 = 1.0;

/// The mean height of the ground along the outlines of buildings: z in local metres. Of those whose outlines it has none under, what
/// they stand on.
pub(super) fn average_ground(city: &City, buildings: &[Building]) -> f64 {
    let ground = Ground::new(city);
    let (mut sum, mut length) = (0.0, 0.0);
    for building in buildings {
        for ring in footprint(building).iter().flatten() {
            // The ground may bend between two corners.
            let places = along(slice::from_ref(ring), STEP);
            let next = places.iter().skip(1).chain(places.first());
            for (a, b) in places.iter().zip(next) {
                let long = (a[0] - b[0]).hypot(a[1] - b[1]);
                let z = |&at: &[f64; 2]| ground.at(at).map_or(building.ground, |place| place.z);
                sum += long * 0.5 * f64::from(z(a) + z(b));
                length += long;
            }
        }
    }
    if length > 0.0 {
        sum / length
    } else {
        f64::from(city.ground)
    }
}

/// What a building covers of the ground: edges within it, such as ridges, are none of its outline.
fn footprint(building: &Building) -> Vec<Vec<Vec<[f64; 2]>>> {
    let mut polygons = Vec::new();
    for part in &building.parts {
        match part {
            Part::Prism(prism) => {
                let wide = |ring: &[[f32; 2]]| ring.iter().map(|at| at.map(f64::from)).collect();
                polygons.push(prism.outline.rings().map(wide).collect());
            }
            Part::Faces(faces) => {
                let flat = |ring: &Vec<Point3>| {
                    let places = ring.iter().map(|at| [at.x, at.y].map(f64::from));
                    places.collect::<Vec<_>>()
                };
                let seen = faces
                    .faces
                    .iter()
                    .map(|face| face.rings.iter().map(flat).collect());
                polygons.extend(seen.filter(|rings: &Vec<Vec<_>>| is_wide(&rings[0])));
            }
        }
    }
    united(&polygons)
}

#[cfg(test)]
mod tests {
    use ombra::city::{Crs, Face, Faces, Origin, Surface};

    use super::*;

    /// A house of 10 m on a slope that rises by 1 m in it; its ridge is not in the middle.
    #[test]
    fn edges_within_a_building_have_no_weight() {
        let at = |x: f32, y: f32, z: f32| Point3::new(x, y, z);
        let slope = |x: f32, y: f32| at(x, y, 0.1 * x);
        let corners = [
            slope(-50.0, -50.0),
            slope(50.0, -50.0),
            slope(50.0, 50.0),
            slope(-50.0, 50.0),
        ];
        let terrain = vec![
            [corners[0], corners[1], corners[2]],
            [corners[0], corners[2], corners[3]],
        ];
        let roof = |from: (f32, f32), to: (f32, f32)| Face {
            rings: vec![vec![
                at(from.0, 0.0, from.1),
                at(to.0, 0.0, to.1),
                at(to.0, 10.0, to.1),
                at(from.0, 10.0, from.1),
            ]],
            surface: Surface::Roof,
        };
        let house = Building {
            parts: vec![Part::Faces(Faces {
                faces: vec![roof((0.0, 6.0), (2.0, 8.0)), roof((2.0, 8.0), (10.0, 6.0))],
                is_closed: false,
            })],
            ..Building::default()
        };
        let city = City {
            origin: Origin::new(Crs::wgs84(), [139.7, 35.7]).unwrap(),
            buildings: Vec::new(),
            terrain,
            is_terrain_all: false,
            context: Vec::new(),
            ground: -7.0,
            findings: Vec::new(),
        };
        let average = average_ground(&city, slice::from_ref(&house));
        // Places lie 2 cm above terrain. With the ridge it were 0.4.
        assert!((average - 0.5).abs() < 0.03, "{average}");
        let rings = footprint(&house);
        assert_eq!((rings.len(), rings[0].len(), rings[0][0].len()), (1, 1, 4));
        assert_eq!(average_ground(&city, &[]), -7.0);
    }
}
