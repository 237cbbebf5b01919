//! Contour lines as GeoJSON (RFC 7946).

use std::path::Path;

use ombra_city::Origin;
use serde_json::{Map, Value, json};

use super::ContourLine;
use crate::error::FormatError;
use crate::whole::write_whole_with;

/// Writes contour lines of minutes as a GeoJSON `FeatureCollection`, in longitude and latitude, one `LineString` a line: its properties are
/// `minutes`, its level, and `of`, what it is a line of, where that is said. A ring ends where it begins.
///
/// `metadata` are names and values that say how the numbers came about; they stand in a member `ombra`. The file is put in its
/// place when it is whole, and its bytes depend on the arguments alone.
///
/// # Errors
/// When the folder does not exist or cannot be written into.
pub fn write_contours_geojson<'a>(
    path: impl AsRef<Path>,
    origin: &Origin,
    lines: impl IntoIterator<Item = (Option<&'a str>, &'a ContourLine)>,
    metadata: &[(String, String)],
) -> Result<(), FormatError> {
    let of = metadata.iter();
    let about: Map<String, Value> = of
        .map(|(name, value)| (name.clone(), json!(value)))
        .collect();
    let about = Value::Object(about);
    let features = lines
        .into_iter()
        .map(|(of, line)| feature(origin, of, line));
    write_whole_with(path, |file| {
        write!(
            file,
            "{{\"type\":\"FeatureCollection\",\"ombra\":{about},\"features\":["
        )?;
        for (index, feature) in features.enumerate() {
            let separator = if index > 0 { ",\n" } else { "\n" };
            write!(file, "{separator}{feature}")?;
        }
        file.write_all(b"\n]}\n")
    })
}

fn feature(origin: &Origin, of: Option<&str>, line: &ContourLine) -> Value {
    // To a tenth of a millimetre on the ground.
    let degrees = |x: f64| (x * 1e9).round() / 1e9;
    let on_map = |&point: &[f64; 2]| origin.to_geographic(point).map(degrees);
    let coordinates: Vec<[f64; 2]> = line.points.iter().map(on_map).collect();
    let mut properties = json!({ "minutes": f64::from(line.level) });
    if let Some(of) = of {
        properties["of"] = json!(of);
    }
    json!({
        "type": "Feature",
        "geometry": { "type": "LineString", "coordinates": coordinates },
        "properties": properties,
    })
}

#[cfg(test)]
mod tests {
    use ombra_city::Crs;

    use super::*;

    #[test]
    fn lines_are_in_degrees_and_rings_end_where_they_begin() {
        let origin = Origin::new(Crs::wgs84(), [4.36, 52.01]).unwrap();
        let ring = ContourLine {
            level: 90.0,
            points: vec![[0.0, 0.0], [10.0, 0.0], [0.0, 10.0], [0.0, 0.0]],
            is_closed: true,
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lines.geojson");
        let metadata = [("when".to_owned(), "2026".to_owned())];
        let read = |lines: &[(Option<&str>, &ContourLine)]| -> Value {
            write_contours_geojson(&path, &origin, lines.iter().copied(), &metadata).unwrap();
            serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap()
        };
        assert_eq!(read(&[])["features"], json!([]));
        let file = read(&[(Some("net"), &ring), (None, &ring)]);
        assert_eq!(file["ombra"]["when"], "2026");
        let [first, second] = [0, 1].map(|index| &file["features"][index]);
        assert_eq!(first["properties"], json!({"minutes": 90.0, "of": "net"}));
        assert_eq!(second["properties"], json!({"minutes": 90.0}));
        let at = &first["geometry"]["coordinates"];
        assert_eq!(at[0], json!([4.36, 52.01]));
        assert_eq!(at[0], at[3]);
        // A degree of longitude has 68,686 m there.
        let east = at[1][0].as_f64().unwrap() - 4.36;
        assert!((east * 68_686.0 - 10.0).abs() < 0.01, "{east}");
    }
}
