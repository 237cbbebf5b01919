//! The document: what of it is read.

use std::fmt;

use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};

use super::super::wrong;
use super::boundaries::Geometry;
use crate::error::{FormatError, shown};

/// A CityJSON document, or a feature of a sequence, which has neither version nor transform.
#[derive(Deserialize)]
pub(super) struct Document {
    #[serde(rename = "type")]
    pub(super) kind: String,
    /// The name of a feature.
    pub(super) id: Option<String>,
    #[serde(default)]
    version: Value,
    transform: Option<Transform>,
    #[serde(default)]
    metadata: Value,
    /// In the order of the file.
    #[serde(rename = "CityObjects", deserialize_with = "entries")]
    pub(super) city_objects: Vec<(String, CityObject)>,
    vertices: Vec<[f64; 3]>,
}

#[derive(Clone, Copy, Deserialize)]
pub(super) struct Transform {
    scale: [f64; 3],
    translate: [f64; 3],
}

#[derive(Deserialize)]
pub(super) struct CityObject {
    #[serde(rename = "type")]
    pub(super) kind: String,
    pub(super) attributes: Option<Map<String, Value>>,
    pub(super) geometry: Option<Vec<Geometry>>,
    #[serde(default)]
    pub(super) parents: Vec<String>,
    #[serde(default)]
    pub(super) children: Vec<String>,
}

impl Document {
    /// What places the vertices on the map; only CityJSON 1.0 can do without.
    pub(super) fn transform(&self) -> Result<Transform, FormatError> {
        let version = self.version.as_str().unwrap_or_default();
        let major = version.split('.').next();
        if !matches!(major, Some("1" | "2")) {
            let message = format!(
                "{} found; 1.0, 1.1 or 2.0 is expected",
                shown(&self.version.to_string())
            );
            return Err(wrong("version", message));
        }
        match self.transform {
            Some(transform) => Ok(transform),
            None if version == "1.0" => Ok(Transform {
                scale: [1.0; 3],
                translate: [0.0; 3],
            }),
            None => {
                let message = format!(
                    "is missing; CityJSON {} needs its \"scale\" and \"translate\", without which \
                     vertices have no place",
                    shown(version)
                );
                Err(wrong("transform", message))
            }
        }
    }

    /// The vertices in the coordinates of the map, z in metres.
    pub(super) fn placed(&self, transform: &Transform, metres: f64) -> Vec<[f64; 3]> {
        let Transform { scale, translate } = transform;
        let placed = |v: &[f64; 3]| {
            let [x, y, z] = [0, 1, 2].map(|i| v[i] * scale[i] + translate[i]);
            [x, y, z * metres]
        };
        self.vertices.iter().map(placed).collect()
    }

    /// The name of the reference system.
    pub(super) fn reference_system(&self) -> Option<&str> {
        self.metadata["referenceSystem"].as_str()
    }
}

/// A map as its entries in their order.
fn entries<'de, D: Deserializer<'de>>(reader: D) -> Result<Vec<(String, CityObject)>, D::Error> {
    struct Entries;

    impl<'de> Visitor<'de> for Entries {
        type Value = Vec<(String, CityObject)>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("an object of city objects")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
            let mut found = Vec::new();
            while let Some(entry) = map.next_entry()? {
                found.push(entry);
            }
            Ok(found)
        }
    }

    reader.deserialize_map(Entries)
}
