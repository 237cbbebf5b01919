//! Points of GeoJSON.

use ombra_city::{Crs, Notes};
use serde_json::Value;

use super::{KNOWN, Point, PointFile, height_fault};
use crate::city::geojson::{Feature, crs_of, each_feature};
use crate::city::json::{self, Kind};
use crate::city::wrong;
use crate::error::{Fault, FormatError, shown};

pub(super) fn read(text: &[u8]) -> Result<PointFile, FormatError> {
    let Kind::GeoJson(kind) = json::kind(text)? else {
        return Err(FormatError::file(Fault::UnknownContent { known: KNOWN }));
    };
    let (mut notes, mut points, mut fault) = (Notes::default(), Vec::new(), None);
    let mut number = 0;
    let crs = each_feature(text, &kind, &mut notes, |feature, notes| {
        // What has no geometry is not handed on, but counted in the file.
        let named = feature.place.strip_prefix("feature ");
        number = named.and_then(|text| text.parse().ok()).unwrap_or(number);
        if fault.is_none() {
            fault = of_geometry(&feature, number, &mut points, notes).err();
        }
    })?;
    if let Some(fault) = fault {
        return Err(fault);
    }
    Ok(PointFile {
        crs: Some(crs_of(crs.as_ref(), &mut notes)?.unwrap_or_else(Crs::wgs84)),
        points,
        findings: notes.into_findings(),
        counts: "feature",
    })
}

fn of_geometry(
    feature: &Feature<'_>,
    number: u64,
    points: &mut Vec<Point>,
    notes: &mut Notes,
) -> Result<(), FormatError> {
    let mut add = |position: &Value| {
        let (at, height) =
            of_position(position).map_err(|message| wrong(feature.place, message))?;
        points.push(Point {
            number,
            at,
            height,
            id: feature.id.clone(),
            properties: feature.properties.clone(),
        });
        Ok(())
    };
    let coordinates = &feature.geometry["coordinates"];
    match feature.geometry["type"].as_str() {
        Some("Point") => add(coordinates)?,
        Some("MultiPoint") => match coordinates.as_array() {
            Some(all) => all.iter().try_for_each(add)?,
            None => {
                return Err(wrong(
                    feature.place,
                    "MultiPoint without a list of positions",
                ));
            }
        },
        Some(kind) => notes.add(
            feature.place,
            format!("{} is no point: left out", shown(kind)),
        ),
        None => notes.add(feature.place, "geometry without a type: left out"),
    }
    Ok(())
}

fn of_position(position: &Value) -> Result<([f64; 2], f64), String> {
    let numbers = position.as_array().map_or(&[][..], Vec::as_slice);
    let [x, y, rest @ ..] = numbers else {
        return Err("a point needs two numbers or three: [longitude, latitude, height]".to_owned());
    };
    let number = |value: &Value| {
        let number = value.as_f64().filter(|number| number.is_finite());
        number.ok_or_else(|| format!("{} is no number", shown(&value.to_string())))
    };
    let height = rest.first().map_or(Ok(0.0), number)?;
    match height_fault(height) {
        Some(fault) => Err(fault),
        None => Ok(([number(x)?, number(y)?], height)),
    }
}
