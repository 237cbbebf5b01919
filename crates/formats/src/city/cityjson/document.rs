//! The document: what of it is read.

use std::fmt;

use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};

use super::super::wrong;
use super::boundaries::Geometry;
use crate::error::{FormatError, shown};

#[derive(Deserialize)]
pub(super) struct Document {
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

#[derive(Deserialize)]
struct Transform {
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
    /// The vertices in the coordinates of the map.
    pub(super) fn vertices(&self) -> Result<Vec<[f64; 3]>, FormatError> {
        let version = self.version.as_str().unwrap_or_default();
        let major = version.split('.').next();
        if !matches!(major, Some("1" | "2")) {
            let message = format!(
                "{} found; 1.0, 1.1 or 2.0 is expected",
                shown(&self.version.to_string())
            );
            return Err(wrong("version", message));
        }
        let Some(Transform { scale, translate }) = &self.transform else {
            if version == "1.0" {
                return Ok(self.vertices.clone());
            }
            let message = format!(
                "is missing; CityJSON {} needs its \"scale\" and \"translate\", without which \
                 vertices have no place",
                shown(version)
            );
            return Err(wrong("transform", message));
        };
        let placed = |v: &[f64; 3]| [0, 1, 2].map(|i| v[i] * scale[i] + translate[i]);
        Ok(self.vertices.iter().map(placed).collect())
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
