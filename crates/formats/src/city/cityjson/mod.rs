//! CityJSON 1.0, 1.1 and 2.0 (<https://www.cityjson.org/specs/>), and CityJSONSeq
//! (<https://www.cityjson.org/cityjsonseq/>): a document followed by features that have vertices of
//! their own and its transform.

mod boundaries;
mod document;

use std::collections::HashMap;

use ombra_city::{Crs, Draft, DraftBuilding, DraftPart, heights};

use super::footprint::attribute;
use super::json::parse_each;
use super::{CityOptions, unplaceable, wrong};
use crate::error::{Fault, FormatError, shown};
use boundaries::{Geometry, Lod, Shape, faces, triangles};
use document::{CityObject, Document, Transform};

/// The objects that make up buildings as seen from outside.
const OF_BUILDINGS: [&str; 4] = [
    "Building",
    "BuildingPart",
    "BuildingInstallation",
    "BuildingConstructiveElement",
];

pub(super) fn read(text: &[u8], options: &CityOptions) -> Result<Draft, FormatError> {
    let mut found: Option<(Draft, Transform)> = None;
    let mut number = 0;
    parse_each(text, |document: Document| {
        let Some((draft, transform)) = &mut found else {
            let transform = document.transform()?;
            let mut draft = Draft::new(crs(&document, options)?);
            add(&mut draft, &document, &transform)?;
            found = Some((draft, transform));
            return Ok(());
        };
        number += 1;
        if document.kind == "CityJSONFeature" {
            return add(draft, &document, transform);
        }
        let name = document
            .id
            .map_or_else(|| number.to_string(), |id| shown(&id));
        let message = format!(
            "is a {}; after the first, each is a CityJSONFeature",
            shown(&document.kind)
        );
        Err(wrong(format!("document {name}"), message))
    })?;
    found
        .map(|(draft, _)| draft)
        .ok_or_else(|| FormatError::file(Fault::Empty))
}

fn crs(document: &Document, options: &CityOptions) -> Result<Crs, FormatError> {
    match (&options.crs, document.reference_system()) {
        (Some(crs), _) => Ok(crs.clone()),
        (None, Some(name)) => Crs::parse(name).map_err(unplaceable),
        (None, None) => {
            let message = "is missing; name the coordinate reference system of the file";
            Err(wrong("metadata.referenceSystem", message))
        }
    }
}

/// Adds the objects of a document.
fn add(draft: &mut Draft, document: &Document, transform: &Transform) -> Result<(), FormatError> {
    let vertices = document.placed(transform, draft.crs.metres_of_height());
    let mut reader = Reader {
        objects: document
            .city_objects
            .iter()
            .map(|(id, object)| (id.as_str(), object))
            .collect(),
        vertices: &vertices,
        draft,
        buildings: HashMap::new(),
    };
    for (id, object) in &document.city_objects {
        reader.object(id, object)?;
    }
    Ok(())
}

struct Reader<'a> {
    objects: HashMap<&'a str, &'a CityObject>,
    vertices: &'a [[f64; 3]],
    draft: &'a mut Draft,
    /// Where the building of this name is in the draft.
    buildings: HashMap<&'a str, usize>,
}

impl<'a> Reader<'a> {
    fn object(&mut self, id: &'a str, object: &'a CityObject) -> Result<(), FormatError> {
        let place = format!("CityObject {}", shown(id));
        let kind = object.kind.as_str();
        if OF_BUILDINGS.contains(&kind) {
            self.part_of_building(id, object, place)
        } else if kind == "TINRelief" {
            for geometry in object.geometry.iter().flatten() {
                match geometry.shape() {
                    Some(Shape::Surfaces) => {
                        let found = triangles(geometry, self.vertices, &place)?;
                        self.draft.terrain.extend(found);
                    }
                    _ => {
                        let message = format!("{} is no terrain: left out", shown(&geometry.kind));
                        self.draft.notes.add(&place, message);
                    }
                }
            }
            Ok(())
        } else {
            let message = format!("{} is no building: left out", shown(kind));
            self.draft.notes.add(&place, message);
            Ok(())
        }
    }

    fn part_of_building(
        &mut self,
        id: &'a str,
        object: &'a CityObject,
        place: String,
    ) -> Result<(), FormatError> {
        let Some(geometry) = object.best() else {
            // A building may well be nothing but the sum of its parts.
            if object.children.is_empty() {
                let message = if object.geometry.iter().flatten().next().is_some() {
                    "no faces of a level of detail from 1 to 3: left out"
                } else {
                    "no geometry: left out"
                };
                self.draft.notes.add(&place, message);
            }
            return Ok(());
        };
        let in_parts = (object.children.iter())
            .filter_map(|child| self.objects.get(child.as_str()))
            .filter(|child| child.kind == "BuildingPart")
            .filter_map(|child| child.best()?.lod())
            .max_by(Lod::total_cmp);
        if in_parts.is_some_and(|lod| geometry.lod().is_some_and(|own| own < lod)) {
            let message = "less detailed than its parts, which are used instead";
            self.draft.notes.add(&place, message);
            return Ok(());
        }
        let faces = faces(geometry, self.vertices, &place)?;
        let root = self.root(id, object);
        let index = match self.buildings.get(root) {
            Some(&index) => index,
            None => {
                let find =
                    |name: &str| attribute(self.objects.get(root)?.attributes.as_ref()?, name);
                let ground_elevation =
                    heights::ground_elevation(find, &place, &mut self.draft.notes);
                let index = self.draft.buildings.len();
                self.draft.buildings.push(DraftBuilding {
                    id: Some(root.to_owned()),
                    place,
                    ground_elevation,
                    ..DraftBuilding::default()
                });
                self.buildings.insert(root, index);
                index
            }
        };
        self.draft.buildings[index]
            .parts
            .push(DraftPart::Faces(faces));
        Ok(())
    }

    /// The building that a part belongs to, parts of parts followed up. A part whose building is
    /// not there, or that is its own ancestor, stands for itself.
    fn root(&self, id: &'a str, object: &'a CityObject) -> &'a str {
        const MOST: usize = 16;
        let (mut root, mut object) = (id, object);
        for _ in 0..MOST {
            let parent = object.parents.first();
            let Some((&name, &found)) = parent.and_then(|p| self.objects.get_key_value(p.as_str()))
            else {
                return root;
            };
            (root, object) = (name, found);
        }
        id
    }
}

impl CityObject {
    /// The geometry of the highest level of detail up to 3; of two, the solid one.
    fn best(&self) -> Option<&Geometry> {
        let rank = |geometry: &&Geometry| {
            let is_solid = !matches!(geometry.shape(), Some(Shape::Surfaces));
            (geometry.lod().unwrap_or_default(), is_solid)
        };
        (self.geometry.iter().flatten())
            .filter(|geometry| geometry.shape().is_some())
            .filter(|geometry| geometry.lod().is_some_and(|lod| (1.0..4.0).contains(&lod)))
            .max_by(|a, b| {
                let (a, b) = (rank(a), rank(b));
                a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
            })
    }
}
