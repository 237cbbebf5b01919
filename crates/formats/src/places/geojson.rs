//! GeoJSON (RFC 7946).

use std::io::{self, Write};
use std::path::Path;

use serde_json::{Map, Value, json};

use super::{CHANGE_COLUMNS, PLACE_COLUMNS, PlaceRow, PlaceShare, SHARES, angles, rounded};
use crate::error::FormatError;
use crate::whole::write_whole_with;

/// Writes places as a GeoJSON `FeatureCollection`, one feature a line.
///
/// `metadata` are names and values that say how the numbers came about; they stand in a member `ombra`. The file is
/// put in its place when it is whole, and its bytes depend on the arguments alone.
///
/// # Errors
/// When the folder does not exist or cannot be written into.
pub fn write_places_geojson<'a>(
    path: impl AsRef<Path>,
    rows: impl IntoIterator<Item = PlaceRow<'a>>,
    metadata: &[(String, String)],
) -> Result<(), FormatError> {
    let of = metadata
        .iter()
        .map(|(name, value)| (name.clone(), json!(value)));
    let about: Map<String, Value> = of.collect();
    write_whole_with(path, |file| {
        let about = Value::Object(about);
        writeln!(
            file,
            "{{\"type\":\"FeatureCollection\",\"ombra\":{about},\"features\":["
        )?;
        for (index, row) in rows.into_iter().enumerate() {
            if index > 0 {
                file.write_all(b",\n")?;
            }
            feature(file, &row)?;
        }
        file.write_all(b"\n]}\n")
    })
}

fn feature(file: &mut dyn Write, row: &PlaceRow<'_>) -> io::Result<()> {
    let mut properties = row.properties.cloned().unwrap_or_default();
    // As of an earlier run, whose places are measured again.
    properties.retain(|name, _| !PLACE_COLUMNS.contains(&&**name));
    if row.change.is_some() {
        properties.retain(|name, _| !CHANGE_COLUMNS.contains(&&**name));
    }
    if row.by.is_some() {
        properties.remove(SHARES);
    }
    let mut put = |name: &str, value: Value| properties.insert(name.to_owned(), value);
    put("minutes", row.minutes.map_or(Value::Null, minutes));
    put("inside", row.inside.into());
    if let Some(change) = row.change {
        let all = [change.before, change.after, change.net];
        for (name, value) in CHANGE_COLUMNS.into_iter().zip(all) {
            put(name, value.map_or(Value::Null, minutes));
        }
    }
    if let Some(by) = row.by {
        put(SHARES, by.iter().map(share).collect());
    }
    if let Some((number, id)) = row.building {
        put("building", number.into());
        put("building_id", id.into());
    }
    if let Some((surface, normal)) = row.surface {
        let (azimuth, tilt) = angles(normal);
        put("surface", surface.into());
        put("azimuth", azimuth.into());
        put("tilt", tilt.into());
    }
    let mut feature = Map::new();
    feature.insert("type".to_owned(), "Feature".into());
    if let Some(id) = row.id {
        feature.insert("id".to_owned(), id.into());
    }
    let position = rounded(row.position);
    feature.insert(
        "geometry".to_owned(),
        json!({"type": "Point", "coordinates": position}),
    );
    feature.insert("properties".to_owned(), properties.into());
    serde_json::to_writer(file, &feature).map_err(Into::into)
}

fn share(share: &PlaceShare<'_>) -> Value {
    json!({
        "building": share.building,
        "building_id": share.building_id,
        "minutes": minutes(share.minutes),
        "alone": minutes(share.alone),
    })
}

/// The shortest number that is the same in single precision: not 12.300000190734863.
fn minutes(minutes: f32) -> Value {
    let shortest = minutes.to_string().parse::<f64>().ok();
    shortest.and_then(serde_json::Number::from_f64).into()
}
