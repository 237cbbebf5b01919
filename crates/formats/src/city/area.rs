//! Polygons that bound what is studied.

use std::path::Path;

use ombra_city::{Crs, Finding, Notes};

use super::footprint::{name, name_among};
use super::geojson::{crs_of, each_feature, polygons};
use super::json::{self, Kind};
use crate::error::{Fault, FormatError};
use crate::input::Input;
use crate::limits::Limits;

/// Polygons as a file has them.
#[derive(Clone, Debug)]
pub struct AreaFile {
    /// What the coordinates mean.
    pub crs: Crs,
    /// At least one.
    pub areas: Vec<NamedArea>,
    /// What in the file is no polygon, and was left out.
    pub findings: Vec<Finding>,
}

/// The polygons of one feature.
#[derive(Clone, Debug)]
pub struct NamedArea {
    /// Its attribute `name`, else its id, else another attribute that names things.
    pub name: Option<String>,
    /// Where in the file it is, for messages.
    pub place: String,
    /// Rings of each, the outer one first, in the coordinates of the map. At least one polygon.
    pub polygons: Vec<Vec<Vec<[f64; 2]>>>,
}

impl AreaFile {
    /// All polygons, whatever feature they are of.
    #[must_use]
    pub fn polygons(&self) -> Vec<Vec<Vec<[f64; 2]>>> {
        let all = self.areas.iter().flat_map(|area| &area.polygons);
        all.cloned().collect()
    }
}

/// Reads all `Polygon`s and `MultiPolygon`s of a GeoJSON file: longitude and latitude, unless its `crs` member names
/// another system.
///
/// # Errors
/// When the file cannot be opened, is not GeoJSON, or has no polygon.
pub fn read_area(path: impl AsRef<Path>, limits: &Limits) -> Result<AreaFile, FormatError> {
    read(&Input::on_disk(path.as_ref()), limits)
}

/// The same for a file in memory. Its name is for messages only.
///
/// # Errors
/// As those of [`read_area`].
pub fn read_area_bytes(
    name: impl AsRef<Path>,
    bytes: &[u8],
    limits: &Limits,
) -> Result<AreaFile, FormatError> {
    read(&Input::in_memory(name.as_ref(), bytes), limits)
}

fn read(input: &Input<'_>, limits: &Limits) -> Result<AreaFile, FormatError> {
    let read = || of_bytes(&input.source(limits)?.rest()?);
    read().map_err(|error: FormatError| error.in_file(input.name()))
}

fn of_bytes(bytes: &[u8]) -> Result<AreaFile, FormatError> {
    if bytes.is_empty() {
        return Err(FormatError::file(Fault::Empty));
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let Kind::GeoJson(kind) = json::kind(text)? else {
        let known = "GeoJSON with polygons";
        return Err(FormatError::file(Fault::UnknownContent { known }));
    };
    let (mut notes, mut areas) = (Notes::default(), Vec::new());
    let crs = each_feature(text, &kind, &mut notes, |feature, notes| {
        let mut outlines = Vec::new();
        polygons(feature.geometry, feature.place, &mut outlines, notes);
        if !outlines.is_empty() {
            let own = name(feature.properties.get("name"));
            areas.push(NamedArea {
                name: own
                    .or(feature.id)
                    .or_else(|| name_among(feature.properties)),
                place: feature.place.to_owned(),
                polygons: outlines.into_iter().map(|outline| outline.rings).collect(),
            });
        }
    })?;
    let crs = crs_of(crs.as_ref(), &mut notes)?.unwrap_or_else(Crs::wgs84);
    let findings = notes.into_findings();
    if areas.is_empty() {
        let first = findings
            .first()
            .map_or(String::new(), |finding| format!(": {finding}"));
        return Err(super::wrong(
            "study area",
            format!("no polygon{first}; a Polygon or MultiPolygon is needed"),
        ));
    }
    Ok(AreaFile {
        crs,
        areas,
        findings,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> String {
        of_bytes(text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn polygons_of_all_features_are_the_area() {
        let text = r#"{"type": "FeatureCollection",
            "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [
            {"type": "Feature", "geometry": {"type": "Polygon",
             "coordinates": [[[0,0],[9,0],[9,9],[0,0]], [[1,1],[2,1],[2,2],[1,1]]]}},
            {"type": "Feature", "geometry": {"type": "Point", "coordinates": [1, 2]}},
            {"type": "Feature", "geometry": null},
            {"type": "Feature", "geometry": {"type": "MultiPolygon",
             "coordinates": [[[[0,0],[9,0],[9,9]]], [[[20,0],[29,0],[29,9]]]]}}]}"#;
        let area = of_bytes(text.as_bytes()).unwrap();
        assert_eq!(area.crs.name(), "EPSG:28992");
        let rings: Vec<usize> = area.polygons().iter().map(Vec::len).collect();
        assert_eq!(rings, [2, 1, 1]);
        let of_each: Vec<usize> = area.areas.iter().map(|own| own.polygons.len()).collect();
        assert_eq!(of_each, [1, 2]);
        let findings: Vec<String> = area.findings.iter().map(ToString::to_string).collect();
        assert_eq!(
            findings,
            [
                "feature 1: Point is no polygon: left out",
                "feature 2: no geometry: left out"
            ]
        );
    }

    #[test]
    fn areas_have_names() {
        let feature = |more: &str| {
            format!(
                r#"{{"type": "Feature", {more}, "geometry": {{"type": "Polygon", "coordinates": [[[0,0],[1,0],[1,1]]]}}}}"#
            )
        };
        let features = [
            r#""id": 4, "properties": {"name": "Park", "objectid": 7}"#,
            r#""id": "b", "properties": {"name": null}"#,
            r#""properties": {"OBJECTID": 7}"#,
            r#""properties": null"#,
        ];
        let text = format!(
            r#"{{"type": "FeatureCollection", "features": [{}]}}"#,
            features.map(feature).join(",")
        );
        let file = of_bytes(text.as_bytes()).unwrap();
        let names = file.areas.iter().map(|area| area.name.as_deref());
        assert_eq!(
            names.collect::<Vec<_>>(),
            [Some("Park"), Some("b"), Some("7"), None]
        );
        assert_eq!(file.areas[3].place, "feature 3");
    }

    #[test]
    fn what_is_no_area_says_so() {
        assert!(error("").contains("empty"));
        assert!(error("x,y\n1,2\n").contains("GeoJSON with polygons"));
        assert!(error("{\"type\": \"CityJSON\"}").contains("GeoJSON with polygons"));
        assert!(
            error("{\"type\": \"Polygon\", \"coordinates\": [[[0,NaN").contains("NaN is not JSON")
        );
        let point = error("{\"type\": \"Point\", \"coordinates\": [1, 2]}");
        assert!(
            point.contains("no polygon: geometry: Point is no polygon"),
            "{point}"
        );
        let nothing = error("{\"type\": \"FeatureCollection\", \"features\": []}");
        assert!(nothing.contains("no polygon; a Polygon"), "{nothing}");
        let crs = error(
            "{\"type\": \"Polygon\", \"crs\": \"EPSG:1\", \"coordinates\": [[[0,0],[1,0],[1,1]]]}",
        );
        assert!(crs.contains("EPSG:1"), "{crs}");
    }
}
