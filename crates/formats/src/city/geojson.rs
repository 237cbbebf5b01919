//! GeoJSON (RFC 7946, and the `crs` member of its forerunner of 2008).

use std::borrow::Cow;
use std::fmt;

use ombra_city::{Crs, Draft, Notes};
use serde::de::{DeserializeSeed, IgnoredAny, MapAccess, Visitor};
use serde_json::{Map, Value};

use super::footprint::{Closing, Outline, add, name, name_among};
use super::json::{Each, parse, parse_into};
use super::{CityOptions, unplaceable, wrong};
use crate::error::{FormatError, shown};

pub(super) fn read(text: &[u8], kind: &str, options: &CityOptions) -> Result<Draft, FormatError> {
    // What the coordinates mean may be said after them: until then they are taken for WGS 84.
    let mut draft = Draft::new(options.crs.clone().unwrap_or_else(Crs::wgs84));
    let mut notes = std::mem::take(&mut draft.notes);
    let crs = each_feature(text, kind, &mut notes, |feature, notes| {
        std::mem::swap(&mut draft.notes, notes);
        of_geometry(&mut draft, &feature, options);
        std::mem::swap(&mut draft.notes, notes);
    })?;
    if options.crs.is_none()
        && let Some(crs) = crs_of(crs.as_ref(), &mut notes)?
    {
        draft.crs = crs;
    }
    draft.notes = notes;
    Ok(draft)
}

/// A geometry and what is said of it.
pub(super) struct Feature<'a> {
    /// Where in the file it is, as messages have it.
    pub(super) place: &'a str,
    pub(super) id: Option<String>,
    pub(super) properties: &'a Map<String, Value>,
    pub(super) geometry: &'a Value,
}

/// Hands on what has a geometry; of the rest it is noted that it is left out. Gives the `crs` member.
pub(super) fn each_feature(
    text: &[u8],
    kind: &str,
    notes: &mut Notes,
    mut each: impl FnMut(Feature<'_>, &mut Notes),
) -> Result<Option<Value>, FormatError> {
    if kind == "FeatureCollection" {
        let in_turn = Each(|index, element| {
            feature(&format!("feature {index}"), &element, notes, &mut each);
        });
        let collection = parse_into(text, Collection(in_turn))?;
        if !collection.has_features {
            return Err(wrong("FeatureCollection", "\"features\" is missing"));
        }
        return Ok(collection.crs);
    }
    let whole: Value = parse(text)?;
    if kind == "Feature" {
        feature("feature", &whole, notes, &mut each);
    } else {
        let alone = Feature {
            place: "geometry",
            id: None,
            properties: &Map::new(),
            geometry: &whole,
        };
        each(alone, notes);
    }
    Ok(whole.get("crs").cloned())
}

/// The reference system that the `crs` member of a file names.
pub(super) fn crs_of(crs: Option<&Value>, notes: &mut Notes) -> Result<Option<Crs>, FormatError> {
    let name = crs.and_then(|crs| crs_name(crs, notes));
    name.map(|name| Crs::parse(&name).map_err(unplaceable))
        .transpose()
}

/// The members of a collection that matter; its features go where the visitor puts them.
struct Collection<F>(Each<F>);

#[derive(Default)]
struct Members {
    has_features: bool,
    crs: Option<Value>,
}

impl<'de, F: FnMut(usize, Value)> DeserializeSeed<'de> for Collection<F> {
    type Value = Members;

    fn deserialize<D: serde::Deserializer<'de>>(self, reader: D) -> Result<Members, D::Error> {
        reader.deserialize_map(self)
    }
}

impl<'de, F: FnMut(usize, Value)> Visitor<'de> for Collection<F> {
    type Value = Members;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a FeatureCollection")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Members, A::Error> {
        let mut members = Members::default();
        let mut each = Some(self.0);
        while let Some(key) = map.next_key::<Cow<'de, str>>()? {
            match &*key {
                "features" => {
                    let each = (each.take())
                        .ok_or_else(|| serde::de::Error::duplicate_field("features"))?;
                    map.next_value_seed(each)?;
                    members.has_features = true;
                }
                "crs" => members.crs = Some(map.next_value()?),
                _ => {
                    map.next_value::<IgnoredAny>()?;
                }
            }
        }
        Ok(members)
    }
}

fn feature(
    place: &str,
    feature: &Value,
    notes: &mut Notes,
    each: &mut impl FnMut(Feature<'_>, &mut Notes),
) {
    let Some(members) = feature.as_object() else {
        notes.add(place, "no object: left out");
        return;
    };
    let nothing = Map::new();
    let properties = members.get("properties").and_then(Value::as_object);
    let properties = properties.unwrap_or(&nothing);
    match members.get("geometry") {
        None | Some(Value::Null) => notes.add(place, "no geometry: left out"),
        Some(geometry) => {
            let id = name(members.get("id"));
            let feature = Feature {
                place,
                id,
                properties,
                geometry,
            };
            each(feature, notes);
        }
    }
}

/// A building of all polygons in a geometry.
fn of_geometry(draft: &mut Draft, feature: &Feature<'_>, options: &CityOptions) {
    let mut outlines = Vec::new();
    polygons(
        feature.geometry,
        feature.place,
        &mut outlines,
        &mut draft.notes,
    );
    if !outlines.is_empty() {
        let id = (feature.id.clone()).or_else(|| name_among(feature.properties));
        let name = (id, feature.place.to_owned());
        add(
            draft,
            outlines,
            name,
            feature.properties,
            Closing::Asked,
            options,
        );
    }
}

/// The polygons in a geometry. Collections in collections end where the parser's patience did.
pub(super) fn polygons(
    geometry: &Value,
    place: &str,
    outlines: &mut Vec<Outline>,
    notes: &mut Notes,
) {
    let mut polygon = |rings: &Value, notes: &mut Notes| match Outline::read(rings) {
        Ok(outline) => outlines.push(outline),
        Err(what) => notes.add(place, format!("polygon {what}: left out")),
    };
    let coordinates = &geometry["coordinates"];
    match geometry["type"].as_str() {
        Some("Polygon") => polygon(coordinates, notes),
        Some("MultiPolygon") => match coordinates.as_array() {
            Some(all) => all.iter().for_each(|rings| polygon(rings, notes)),
            None => notes.add(place, "MultiPolygon without a list of polygons: left out"),
        },
        Some("GeometryCollection") => match geometry["geometries"].as_array() {
            Some(all) => {
                for geometry in all {
                    polygons(geometry, place, outlines, notes);
                }
            }
            None => notes.add(place, "GeometryCollection without a list: left out"),
        },
        Some(kind) => notes.add(place, format!("{} is no polygon: left out", shown(kind))),
        None => notes.add(place, "geometry without a type: left out"),
    }
}

/// The name that the `crs` member of older files gives.
fn crs_name(crs: &Value, notes: &mut Notes) -> Option<String> {
    if crs.is_null() {
        return None;
    }
    let found = crs["properties"]["name"].as_str().or_else(|| crs.as_str());
    if found.is_none() {
        notes.add(
            "crs",
            "names no system: longitude and latitude (WGS 84) are assumed",
        );
    }
    found.map(str::to_owned)
}
