//! Geometries: faces as lists of lists of vertices.

use std::fmt;

use ombra_city::{DraftFace, Surface};
use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::Value;

use super::super::wrong;
use crate::error::FormatError;

/// A level of detail, such as 2 or 2.2.
pub(super) type Lod = f64;

#[derive(Deserialize)]
pub(super) struct Geometry {
    #[serde(rename = "type")]
    pub(super) kind: String,
    /// A number in 1.0, a text since.
    #[serde(default)]
    lod: Value,
    #[serde(default)]
    boundaries: Nested,
    semantics: Option<Semantics>,
}

#[derive(Deserialize)]
struct Semantics {
    #[serde(default)]
    surfaces: Vec<SemanticSurface>,
    /// As deep as `boundaries` down to the faces; any list may be null.
    #[serde(default)]
    values: Nested,
}

#[derive(Deserialize)]
struct SemanticSurface {
    #[serde(rename = "type")]
    kind: String,
}

/// How deep the faces of a geometry lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// Faces.
    Surfaces,
    /// Shells of faces.
    Solid,
    /// Solids.
    Solids,
}

/// Lists of lists of indices.
#[derive(Debug, Default)]
enum Nested {
    #[default]
    Null,
    Index(u64),
    List(Vec<Nested>),
}

impl Nested {
    fn list(&self) -> &[Self] {
        match self {
            Self::List(list) => list,
            _ => &[],
        }
    }

    fn get(&self, index: usize) -> Option<&Self> {
        self.list().get(index)
    }
}

impl Geometry {
    /// `None` for what has no faces of its own.
    pub(super) fn shape(&self) -> Option<Shape> {
        match self.kind.as_str() {
            "MultiSurface" | "CompositeSurface" => Some(Shape::Surfaces),
            "Solid" => Some(Shape::Solid),
            "MultiSolid" | "CompositeSolid" => Some(Shape::Solids),
            _ => None,
        }
    }

    pub(super) fn lod(&self) -> Option<Lod> {
        match &self.lod {
            Value::String(text) => text.parse().ok(),
            other => other.as_f64(),
        }
    }

    fn surface(&self, value: Option<&Nested>) -> Surface {
        let Some(Nested::Index(index)) = value else {
            return Surface::Untold;
        };
        let index = usize::try_from(*index).ok();
        let surfaces = self.semantics.as_ref().map_or(&[][..], |s| &s.surfaces);
        match index.and_then(|i| surfaces.get(i)).map(|s| s.kind.as_str()) {
            Some("RoofSurface") => Surface::Roof,
            Some("WallSurface") => Surface::Wall,
            Some("GroundSurface") => Surface::Ground,
            _ => Surface::Untold,
        }
    }
}

/// The faces of a geometry. Of solids the outer shells count: what is hollow inside casts the same
/// shadow.
pub(super) fn faces(
    geometry: &Geometry,
    vertices: &[[f64; 3]],
    place: &str,
) -> Result<Vec<DraftFace>, FormatError> {
    let values = geometry.semantics.as_ref().map(|s| &s.values);
    let mut found = Vec::new();
    let mut push = |surfaces: &Nested, values: Option<&Nested>| {
        for (i, face) in surfaces.list().iter().enumerate() {
            found.push(DraftFace {
                rings: rings(face, vertices, place)?,
                surface: geometry.surface(values.and_then(|v| v.get(i))),
            });
        }
        Ok(())
    };
    let mut push_solid = |solid: &Nested, values: Option<&Nested>| match solid.get(0) {
        Some(shell) => push(shell, values.and_then(|v| v.get(0))),
        None => Ok(()),
    };
    match geometry.shape() {
        Some(Shape::Surfaces) => push(&geometry.boundaries, values)?,
        Some(Shape::Solid) => push_solid(&geometry.boundaries, values)?,
        Some(Shape::Solids) => {
            for (i, solid) in geometry.boundaries.list().iter().enumerate() {
                push_solid(solid, values.and_then(|v| v.get(i)))?;
            }
        }
        None => {}
    }
    Ok(found)
}

/// The triangles of a terrain. Faces of more corners are cut as fans.
pub(super) fn triangles(
    geometry: &Geometry,
    vertices: &[[f64; 3]],
    place: &str,
) -> Result<Vec<[[f64; 3]; 3]>, FormatError> {
    let mut found = Vec::new();
    for face in geometry.boundaries.list() {
        let rings = rings(face, vertices, place)?;
        if let Some([first, rest @ ..]) = rings.first().map(Vec::as_slice) {
            found.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
        }
    }
    Ok(found)
}

fn rings(
    face: &Nested,
    vertices: &[[f64; 3]],
    place: &str,
) -> Result<Vec<Vec<[f64; 3]>>, FormatError> {
    let vertex = |index: &Nested| {
        let Nested::Index(index) = index else {
            let message = "has boundaries that are not as deep as their type asks for";
            return Err(wrong(place, message));
        };
        let found = usize::try_from(*index).ok().and_then(|i| vertices.get(i));
        found.copied().ok_or_else(|| {
            let present = vertices.len();
            wrong(
                place,
                format!("uses vertex {index}, {present} present (from 0)"),
            )
        })
    };
    let ring = |ring: &Nested| ring.list().iter().map(vertex).collect();
    face.list().iter().map(ring).collect()
}

impl<'de> Deserialize<'de> for Nested {
    fn deserialize<D: Deserializer<'de>>(reader: D) -> Result<Self, D::Error> {
        struct Lists;

        impl<'de> Visitor<'de> for Lists {
            type Value = Nested;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an index from 0, or lists of such")
            }

            fn visit_unit<E>(self) -> Result<Nested, E> {
                Ok(Nested::Null)
            }

            fn visit_u64<E>(self, index: u64) -> Result<Nested, E> {
                Ok(Nested::Index(index))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Nested, A::Error> {
                let mut found = Vec::new();
                while let Some(element) = list.next_element()? {
                    found.push(element);
                }
                Ok(Nested::List(found))
            }
        }

        reader.deserialize_any(Lists)
    }
}
