//! A city as a file has it, on its way to local metres.

mod closed;
mod degrees;

use ombra_geometry::Point3;

use crate::building::{Building, Face, Faces, Part, Prism, Surface};
use crate::city::{City, Plane};
use crate::crs::Crs;
use crate::error::CityError;
use crate::facet::Facet;
use crate::finding::Notes;
use crate::heights::Names;
use crate::origin::Origin;
use crate::parts;
use crate::repair;

/// What lies farther from the origin than this, in metres, is left out: local metres are no longer
/// those of the ground there, nor has single precision a centimetre left.
pub(crate) const FARTHEST: f64 = 60_000.0;

/// A city in the coordinates of its map.
#[derive(Clone, Debug)]
pub struct Draft {
    /// What the coordinates mean.
    pub crs: Crs,
    /// The buildings so far.
    pub buildings: Vec<DraftBuilding>,
    /// Parts of buildings that a file has beside their outlines, as OpenStreetMap does: each stands
    /// in place of the outline that it lies in, or for itself if there is none.
    pub parts: Vec<DraftBuilding>,
    /// Triangles of the ground: coordinates of the map, and z in metres.
    pub terrain: Vec<[[f64; 3]; 3]>,
    /// What its buildings call their heights.
    pub names: Names,
    /// What was met so far.
    pub notes: Notes,
}

/// A building in the coordinates of its map.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DraftBuilding {
    /// Its name in the file, if it has one.
    pub id: Option<String>,
    /// Where it is in the file, for messages: `feature 12`.
    pub place: String,
    /// What it is made of.
    pub parts: Vec<DraftPart>,
    /// The z of the ground that it stands on, metres. Of faces it is the lowest of them.
    pub ground: f64,
    /// Metres above the sea of its ground, if the file tells so beside a flat map.
    pub ground_elevation: Option<f64>,
}

/// A piece of a building in the coordinates of its map.
#[derive(Clone, Debug, PartialEq)]
pub enum DraftPart {
    /// An outline with upright walls and a flat roof.
    Footprint {
        /// The outer ring, then its holes. They may or may not repeat their first corners, run
        /// either way, and be broken.
        rings: Vec<Vec<[f64; 2]>>,
        /// Where it begins: z in metres.
        base: f64,
        /// Where it ends: z in metres.
        top: f64,
    },
    /// Faces, of a solid or not.
    Faces(Vec<DraftFace>),
}

/// A face: coordinates of the map, and z in metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DraftFace {
    /// The outer ring, counter-clockwise as seen from outside, then its holes.
    pub rings: Vec<Vec<[f64; 3]>>,
    /// What it is of the building.
    pub surface: Surface,
}

impl Draft {
    /// Nothing yet.
    #[must_use]
    pub fn new(crs: Crs) -> Self {
        Self {
            crs,
            buildings: Vec::new(),
            parts: Vec::new(),
            terrain: Vec::new(),
            names: Names::default(),
            notes: Notes::default(),
        }
    }

    /// The city in local metres about its middle.
    ///
    /// Broken outlines are repaired where that is possible and left out where it is not; either is
    /// a finding.
    ///
    /// # Errors
    /// When there is nothing to be placed at all, and when the coordinates do not belong to the
    /// reference system.
    pub fn finish(mut self) -> Result<City, CityError> {
        // What is wrong with the whole comes before what is wrong with single buildings because of it.
        let wrong = [self.names.missing(), degrees::taken_for_metres(&self)];
        for message in wrong.into_iter().flatten() {
            self.notes.add_first("city", message);
        }
        let Some(centre) = self.centre() else {
            for draft in self.buildings.iter().chain(&self.parts) {
                (self.notes).add(&draft.place, "outline without corners on the map: left out");
            }
            let findings = self.notes.into_findings();
            return Err(CityError::NothingThere { findings });
        };
        let origin = Origin::new(self.crs.clone(), centre)?;
        let [buildings, parts] = [self.buildings, self.parts].map(|drafts| {
            let placed = drafts.into_iter().filter_map(|draft| {
                // The first name is for messages about the whole.
                let place = draft.place.clone();
                Some((place, building(draft, &origin, &mut self.notes)?))
            });
            placed.collect::<Vec<_>>()
        });
        let buildings = parts::in_place(buildings, parts, &mut self.notes);
        if buildings.len() > Facet::CONTEXT as usize {
            return Err(CityError::TooMany {
                what: "buildings",
                limit: u64::from(Facet::CONTEXT),
            });
        }
        let terrain = terrain(&self.terrain, &origin, &mut self.notes);
        let findings = self.notes.into_findings();
        if buildings.is_empty() && terrain.is_empty() {
            return Err(CityError::NothingThere { findings });
        }
        let ground = buildings.iter().map(|b| b.ground);
        let ground = ground.chain(terrain.iter().flatten().map(|p| p.z));
        Ok(City {
            ground: ground.reduce(f32::min).unwrap_or(0.0),
            origin,
            buildings,
            terrain,
            is_terrain_all: false,
            context: Vec::new(),
            findings,
        })
    }

    /// The middle one of all first corners, by each coordinate: a few that have strayed do not move
    /// it, as they would the middle of the box around all.
    fn centre(&self) -> Option<[f64; 2]> {
        let of_parts = (self
            .buildings
            .iter()
            .chain(&self.parts)
            .flat_map(|b| &b.parts))
        .filter_map(|part| match part {
            DraftPart::Footprint { rings, .. } => rings.first()?.first().copied(),
            DraftPart::Faces(faces) => {
                let [x, y, _] = *faces.first()?.rings.first()?.first()?;
                Some([x, y])
            }
        });
        let of_terrain = self.terrain.iter().map(|&[[x, y, _], ..]| [x, y]);
        let mut places: Vec<[f64; 2]> = of_parts
            .chain(of_terrain)
            .filter(|p| p.iter().all(|x| x.is_finite()))
            .collect();
        if places.is_empty() {
            return None;
        }
        let middle = places.len() / 2;
        Some([0, 1].map(|axis| {
            let order = |a: &[f64; 2], b: &[f64; 2]| a[axis].total_cmp(&b[axis]);
            places.select_nth_unstable_by(middle, order).1[axis]
        }))
    }
}

fn building(draft: DraftBuilding, origin: &Origin, notes: &mut Notes) -> Option<Building> {
    let mut ground = draft.ground as f32;
    let mut parts = Vec::with_capacity(draft.parts.len());
    for part in draft.parts {
        match part {
            DraftPart::Footprint { rings, base, top } => {
                if rings
                    .first()
                    .and_then(|ring| ring.first())
                    .is_some_and(|&p| is_far(p, origin))
                {
                    let message =
                        format!("lies over {} km off the others: left out", FARTHEST / 1e3);
                    notes.add(&draft.place, message);
                    continue;
                }
                let rings = rings.iter().map(|ring| local_ring(ring, origin)).collect();
                let (base, top) = (base as f32, top as f32);
                if !(base.is_finite() && top.is_finite() && top > base) {
                    notes.add(&draft.place, "top is not above the base: left out");
                    continue;
                }
                let found = repair::polygons(rings, &draft.place, notes);
                parts.extend(
                    found
                        .into_iter()
                        .map(|outline| Part::Prism(Prism { outline, base, top })),
                );
            }
            DraftPart::Faces(faces) => {
                let Some(faces) = local_faces(faces, origin, &draft.place, notes) else {
                    continue;
                };
                let part = Part::Faces(faces);
                let low = part.range()[0];
                ground = if parts.is_empty() {
                    low
                } else {
                    ground.min(low)
                };
                parts.push(part);
            }
        }
    }
    (!parts.is_empty()).then_some(Building {
        id: draft.id,
        parts,
        ground,
        ground_elevation: draft.ground_elevation.map(|z| z as f32),
    })
}

/// Whether a place is on the map and too far off.
fn is_far(map: [f64; 2], origin: &Origin) -> bool {
    origin
        .to_local(map)
        .iter()
        .any(|x| x.abs() > FARTHEST && x.is_finite())
}

/// In single precision, widened again, so that what is checked is what is kept. NaN for places that
/// are too far off or not on the map.
fn local_ring(ring: &[[f64; 2]], origin: &Origin) -> Vec<[f64; 2]> {
    ring.iter()
        .map(|&p| local(p, origin).map(f64::from))
        .collect()
}

fn local(map: [f64; 2], origin: &Origin) -> [f32; 2] {
    let [x, y] = origin.to_local(map);
    if x.abs().max(y.abs()) <= FARTHEST {
        [x as f32, y as f32]
    } else {
        [f32::NAN; 2]
    }
}

fn local_point([x, y, z]: [f64; 3], origin: &Origin) -> Point3 {
    let [x, y] = local([x, y], origin);
    Point3::new(x, y, z as f32)
}

fn local_faces(
    drafts: Vec<DraftFace>,
    origin: &Origin,
    place: &str,
    notes: &mut Notes,
) -> Option<Faces> {
    let mut faces = Vec::with_capacity(drafts.len());
    for draft in drafts {
        let rings = (draft.rings.iter()).map(|ring| {
            let mut ring: Vec<Point3> = ring.iter().map(|&p| local_point(p, origin)).collect();
            ring.dedup();
            while ring.len() > 1 && ring.first() == ring.last() {
                ring.pop();
            }
            ring
        });
        let mut rings: Vec<Vec<Point3>> = rings.collect();
        if !rings.iter().flatten().all(|p| p.is_finite()) {
            notes.add(place, "face has corners that are not on the map: left out");
            continue;
        }
        if rings.iter().map(Vec::len).sum::<usize>() > repair::MOST_CORNERS {
            let most = repair::MOST_CORNERS;
            notes.add(place, format!("face has over {most} corners: left out"));
            continue;
        }
        rings.retain(|ring| !ring.is_empty());
        let surface = draft.surface;
        faces.push(Face { rings, surface });
    }
    // Slivers without area close gaps between others: they count before they go.
    let is_closed = closed::close(&mut faces);
    faces.retain_mut(|face| {
        let has_area = face
            .rings
            .first()
            .is_some_and(|outer| Plane::of(outer).is_some());
        if !has_area {
            notes.add(place, "face without area: left out");
        }
        face.rings.retain(|ring| ring.len() >= 3);
        has_area
    });
    if faces.is_empty() {
        notes.add(place, "no face: left out");
        return None;
    }
    if !is_closed {
        notes.add(
            place,
            "faces enclose no solid: both of their sides cast shadow",
        );
    }
    Some(Faces { faces, is_closed })
}

fn terrain(drafts: &[[[f64; 3]; 3]], origin: &Origin, notes: &mut Notes) -> Vec<[Point3; 3]> {
    let mut triangles = Vec::with_capacity(drafts.len());
    for &draft in drafts {
        let [a, b, c] = draft.map(|p| local_point(p, origin));
        if ![a, b, c].iter().all(|p| p.is_finite()) {
            notes.add(
                "terrain",
                "triangle has corners that are not on the map: left out",
            );
            continue;
        }
        let up = (b.wide() - a.wide()).cross(c.wide() - a.wide()).z;
        if up > 0.0 {
            triangles.push([a, b, c]);
        } else if up < 0.0 {
            triangles.push([a, c, b]);
        } else {
            notes.add("terrain", "triangle without area on the map: left out");
        }
    }
    triangles
}
