//! A city in local metres, and what of it casts shadow.

use ombra_geometry::{Point3, Vector3};

use crate::building::{Building, Face, Faces, Part, Prism};
use crate::facet::Facet;
use crate::finding::Finding;
use crate::join::joined;
use crate::origin::Origin;
use crate::polygon::edges;
use crate::triangulate::pieces;

/// Faces whose corners lie farther from their plane than this, in metres, are bent.
const FLAT: f64 = 0.01;

/// Corners this close to the lowest, in metres, are as low.
pub(crate) const LOWEST: f32 = 1e-3;

/// A city in local metres.
#[derive(Clone, Debug)]
pub struct City {
    /// Where its metres begin.
    pub origin: Origin,
    /// Its buildings, in the order of the file; at least one, or there is terrain.
    pub buildings: Vec<Building>,
    /// The ground, where the file has it: triangles, counter-clockwise as seen from above.
    pub terrain: Vec<[Point3; 3]>,
    /// Whether there is no ground but terrain: places beside it and in its holes are on none. Otherwise they
    /// are on the flat ground.
    pub is_terrain_all: bool,
    /// What else casts shadow: triangles of added models, and what stands on the ground of a surface model.
    pub context: Vec<[Point3; 3]>,
    /// The z of flat ground, metres: the lowest that any building stands on. Walls of buildings
    /// without a terrain reach down to it, so that no light creeps below them.
    pub ground: f32,
    /// What is wrong in the file, and what was done about it.
    pub findings: Vec<Finding>,
}

impl City {
    /// All that casts shadow: walls, roofs, the floors of what hangs in the air, and terrain.
    ///
    /// The order is that of the buildings and their parts; then come terrain and context.
    #[must_use]
    pub fn facets(&self) -> Vec<Facet> {
        let mut facets = Vec::new();
        for (owner, building) in self.buildings.iter().enumerate() {
            self.push_building(&mut facets, building, owner as u32);
        }
        let triangle = |&[a, b, c]: &[Point3; 3], owner| Facet {
            corners: [a, b, c, c],
            is_two_sided: true,
            owner,
        };
        facets.extend((self.terrain.iter()).map(|corners| triangle(corners, Facet::TERRAIN)));
        facets.extend((self.context.iter()).map(|corners| triangle(corners, Facet::CONTEXT)));
        facets
    }

    pub(crate) fn push_building(&self, facets: &mut Vec<Facet>, building: &Building, owner: u32) {
        for part in &building.parts {
            match part {
                Part::Prism(prism) => self.push_prism(facets, prism, building, owner),
                Part::Faces(faces) => {
                    let low = part.range()[0];
                    let bottom = self.bottom(low, building);
                    push_faces(facets, faces, [low, bottom], owner);
                }
            }
        }
    }

    /// The z where a part begins: that of the flat ground for one that stands on the ground.
    pub(crate) fn bottom(&self, base: f32, building: &Building) -> f32 {
        if base <= building.ground && self.terrain.is_empty() {
            base.min(self.ground)
        } else {
            base
        }
    }

    fn push_prism(&self, facets: &mut Vec<Facet>, prism: &Prism, building: &Building, owner: u32) {
        let (low, top) = (self.bottom(prism.base, building), prism.top);
        let at = |[x, y]: [f32; 2], z| Point3::new(x, y, z);
        for ring in prism.outline.rings() {
            for (a, b) in edges(ring.iter().copied()).filter(|(a, b)| a != b) {
                facets.push(Facet {
                    corners: [at(a, low), at(b, low), at(b, top), at(a, top)],
                    is_two_sided: false,
                    owner,
                });
            }
        }
        let corners: Vec<[f32; 2]> = prism.outline.rings().flatten().copied().collect();
        let rings: Vec<Vec<[f64; 2]>> = (prism.outline.rings())
            .map(|ring| ring.iter().map(|p| p.map(f64::from)).collect())
            .collect();
        let is_raised = prism.base > building.ground;
        for piece in pieces(&rings, true) {
            let [a, b, c, d] = piece.map(|i| corners[i as usize]);
            facets.push(Facet {
                corners: [at(a, top), at(b, top), at(c, top), at(d, top)],
                is_two_sided: false,
                owner,
            });
            if is_raised {
                // Turned over; of a triangle the last corner still is the one that repeats.
                let turned = if c == d { [b, a, c, c] } else { [d, c, b, a] };
                facets.push(Facet {
                    corners: turned.map(|p| at(p, prism.base)),
                    is_two_sided: false,
                    owner,
                });
            }
        }
    }
}

fn push_faces(facets: &mut Vec<Facet>, faces: &Faces, [low, bottom]: [f32; 2], owner: u32) {
    // What stands on the ground reaches down to where the flat ground is.
    let lowered = |p: Point3| {
        let z = if p.z <= low + LOWEST { bottom } else { p.z };
        if bottom < low {
            Point3::new(p.x, p.y, z)
        } else {
            p
        }
    };
    let mut cut = Vec::with_capacity(faces.faces.len());
    for face in &faces.faces {
        let rings = (face.rings.iter()).map(|ring| ring.iter().copied().map(lowered).collect());
        let face = Face {
            rings: rings.collect(),
            surface: face.surface,
        };
        let corners: Vec<Point3> = face.corners().collect();
        cut.extend(
            face_triangles(&face)
                .into_iter()
                .map(|piece| piece.map(|i| corners[i as usize])),
        );
    }
    facets.extend(joined(cut).into_iter().map(|corners| Facet {
        corners,
        is_two_sided: !faces.is_closed,
        owner,
    }));
}

/// A face cut into triangles, whose last corner repeats, seen along the axis that its plane faces most.
pub(crate) fn face_triangles(face: &Face) -> Vec<[u32; 4]> {
    let Some(plane) = Plane::of(&face.rings[0]) else {
        return Vec::new();
    };
    let rings: Vec<Vec<[f64; 2]>> = (face.rings.iter())
        .map(|ring| ring.iter().map(|&p| plane.seen(p)).collect())
        .collect();
    // Those in one plane are joined later, across faces as well.
    pieces(&rings, false)
}

/// Whether all corners lie in one plane, near enough.
pub(crate) fn is_flat(face: &Face) -> bool {
    Plane::of(&face.rings[0])
        .is_some_and(|plane| face.corners().all(|p| plane.distance(p).abs() <= FLAT))
}

/// The plane of a ring: its normal by Newell's method (Sutherland, Sproull, Schumacker 1974).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    normal: [f64; 3],
    offset: f64,
}

impl Plane {
    /// `None` for a ring without area.
    pub(crate) fn of(ring: &[Point3]) -> Option<Self> {
        let first = ring.first()?.wide();
        let mut normal = [0.0; 3];
        let mut mean = [0.0; 3];
        for (a, b) in edges(ring.iter().copied()) {
            let (a, b) = ((a.wide() - first).to_array(), (b.wide() - first).to_array());
            for i in 0..3 {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                normal[i] += (a[j] - b[j]) * (a[k] + b[k]);
                mean[i] += a[i] / ring.len() as f64;
            }
        }
        let length = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
        // Twice the area.
        if !(length > 2e-6) {
            return None;
        }
        let normal = normal.map(|n| n / length);
        let first = first.to_array();
        let offset = (0..3).map(|i| normal[i] * (first[i] + mean[i])).sum();
        Some(Self { normal, offset })
    }

    /// Of length 1.
    pub(crate) fn normal(&self) -> Vector3<f64> {
        self.normal.into()
    }

    /// Metres to the side that the normal points to.
    pub(crate) fn distance(&self, p: Point3) -> f64 {
        let p = p.wide().to_array();
        (0..3).map(|i| self.normal[i] * p[i]).sum::<f64>() - self.offset
    }

    /// The z of the plane above a place; `None` if it is upright.
    pub(crate) fn z_at(&self, [x, y]: [f64; 2]) -> Option<f64> {
        let [a, b, c] = self.normal;
        (c.abs() > 1e-6).then(|| (self.offset - a * x - b * y) / c)
    }

    /// Without the coordinate that the normal has most of; what runs counter-clockwise as seen
    /// against the normal still does.
    fn seen(&self, p: Point3) -> [f64; 2] {
        let p = p.wide();
        let [a, b, c] = self.normal.map(f64::abs);
        let (axis, u, v) = if c >= a && c >= b {
            (2, p.x, p.y)
        } else if b >= a {
            (1, p.z, p.x)
        } else {
            (0, p.y, p.z)
        };
        if self.normal[axis] > 0.0 {
            [u, v]
        } else {
            [v, u]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crs::Crs;
    use crate::draft::{Draft, DraftBuilding, DraftFace, DraftPart};

    /// Metres about a place in UTM, near enough.
    fn city(parts: Vec<DraftPart>) -> City {
        let mut draft = Draft::new(Crs::from_epsg(32633).unwrap());
        draft.buildings.push(DraftBuilding {
            place: "test".to_owned(),
            parts,
            ..DraftBuilding::default()
        });
        draft.finish().unwrap()
    }

    fn square(at: f64, size: f64) -> Vec<[f64; 2]> {
        let [x, y] = [500_000.0 + at, 5_800_000.0 + at];
        vec![
            [x, y],
            [x + size, y],
            [x + size, y + size],
            [x, y + size],
            [x, y],
        ]
    }

    fn footprint(rings: Vec<Vec<[f64; 2]>>, base: f64, top: f64) -> DraftPart {
        DraftPart::Footprint { rings, base, top }
    }

    /// The volume that facets enclose: they must be closed and face outwards for it to come out.
    fn volume(facets: &[Facet]) -> f64 {
        let lowest = facets
            .iter()
            .flat_map(|f| f.corners)
            .min_by(|a, b| a.z.total_cmp(&b.z));
        let apex = lowest.unwrap().wide();
        let sixth = |[a, b, c]: [Point3; 3]| {
            let [a, b, c] = [a, b, c].map(|p| p.wide() - apex);
            let cross = b.cross(c);
            (a.x * cross.x + a.y * cross.y + a.z * cross.z) / 6.0
        };
        let of_facet = |f: &Facet| {
            let [a, b, c, d] = f.corners;
            sixth([a, b, c])
                + if f.is_triangle() {
                    0.0
                } else {
                    sixth([a, c, d])
                }
        };
        facets.iter().map(of_facet).sum()
    }

    #[test]
    fn a_block_on_the_ground_has_walls_and_a_roof() {
        let city = city(vec![footprint(vec![square(0.0, 10.0)], 0.0, 5.0)]);
        let facets = city.facets();
        assert_eq!(facets.len(), 5);
        assert!(facets.iter().all(|f| !f.is_two_sided && f.owner == 0));
        assert!(city.findings.is_empty());
    }

    #[test]
    fn a_block_in_the_air_is_closed_and_faces_outwards() {
        let ring = square(0.0, 10.0);
        let city = city(vec![footprint(vec![ring, square(3.0, 4.0)], 2.0, 5.0)]);
        let facets = city.facets();
        // Metres of UTM are short by 0.0004 there.
        let expected = 84.0 * 3.0;
        assert!(
            (volume(&facets) / expected - 1.0).abs() < 2e-3,
            "{}",
            volume(&facets)
        );
        assert_eq!(facets.len(), 8 + 2 * 4);
    }

    #[test]
    fn faces_of_a_solid_are_one_sided_and_turned_outwards() {
        let at = |x: f64, y: f64, z: f64| [500_000.0 + x, 5_800_000.0 + y, z];
        let [a, b, c, d] = [
            at(0., 0., 0.),
            at(8., 0., 0.),
            at(8., 8., 0.),
            at(0., 8., 0.),
        ];
        let [e, f, g, h] = [a, b, c, d].map(|[x, y, _]| [x, y, 3.0]);
        let mut rings = vec![
            vec![d, c, b, a],
            vec![e, f, g, h],
            vec![a, b, f, e],
            vec![b, c, g, f],
            vec![c, d, h, g],
            vec![d, a, e, h],
        ];
        let part = |rings: &[Vec<[f64; 3]>]| {
            let face = |ring: &Vec<[f64; 3]>| DraftFace {
                rings: vec![ring.clone()],
                ..DraftFace::default()
            };
            DraftPart::Faces(rings.iter().map(face).collect())
        };
        let solid = city(vec![part(&rings)]).facets();
        assert_eq!(solid.len(), 6);
        assert!(solid.iter().all(|f| !f.is_two_sided));
        for ring in &mut rings {
            ring.reverse();
        }
        let turned = city(vec![part(&rings)]).facets();
        assert!((volume(&turned) / 192.0 - 1.0).abs() < 2e-3);
        let without_floor = city(vec![part(&rings[1..])]);
        assert!(without_floor.facets().iter().all(|f| !f.is_two_sided));
        assert!((volume(&without_floor.facets()) / 192.0 - 1.0).abs() < 2e-3);
        let without_wall = city(vec![part(&rings[..5])]);
        assert!(without_wall.facets().iter().all(|f| f.is_two_sided));
        assert_eq!(without_wall.findings.len(), 1);
    }

    #[test]
    fn walls_reach_down_to_the_flat_ground() {
        let mut draft = Draft::new(Crs::from_epsg(32633).unwrap());
        for (i, ground) in [2.0, 7.0].into_iter().enumerate() {
            draft.buildings.push(DraftBuilding {
                place: "test".to_owned(),
                parts: vec![footprint(
                    vec![square(i as f64 * 50.0, 10.0)],
                    ground,
                    ground + 5.0,
                )],
                ground,
                ..DraftBuilding::default()
            });
        }
        let city = draft.finish().unwrap();
        assert_eq!(city.ground, 2.0);
        let facets = city.facets();
        for owner in 0..2 {
            let of = facets.iter().filter(|f| f.owner == owner);
            let low = of
                .flat_map(|f| f.corners)
                .map(|p| p.z)
                .fold(f32::MAX, f32::min);
            assert_eq!(low, 2.0);
        }
    }

    #[test]
    fn nothing_says_why() {
        let draft = Draft::new(Crs::wgs84());
        assert_eq!(
            draft.finish().unwrap_err().to_string(),
            "no building that could be placed"
        );
    }
}
