//! What a city holds, in numbers.

use crate::FileInfo;
use crate::city::CityInfo;

use super::super::osm::tests::{OSM, pbf};
use super::outside_data;
use super::read::{CITYJSON, CITYJSONSEQ, GEOJSON, LIST};

fn inspect(name: &str, content: &[u8]) -> Result<CityInfo, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, content).unwrap();
    match crate::inspect(&path) {
        Ok(FileInfo::City(info)) => Ok(info),
        Ok(other) => panic!("a city, and not {other:?}"),
        Err(error) => Err(error.to_string()),
    }
}

#[test]
fn every_format_is_known_by_its_content() {
    let packed = pbf(OSM, true);
    for (content, format, buildings) in [
        (GEOJSON.as_bytes(), "GeoJSON", 2),
        (LIST.as_bytes(), "list of polygons", 2),
        (CITYJSON.as_bytes(), "CityJSON", 1),
        (CITYJSONSEQ.as_bytes(), "CityJSONSeq", 2),
        (OSM.as_bytes(), "OpenStreetMap XML", 2),
        (&packed, "OpenStreetMap PBF", 2),
    ] {
        let info = inspect("city", content).unwrap();
        assert_eq!((info.format, info.buildings), (format, buildings));
    }
}

#[test]
fn numbers_are_those_of_the_city() {
    let info = inspect("city.geojson", GEOJSON.as_bytes()).unwrap();
    assert_eq!((info.parts, info.terrain, info.facets), (3, 0, 14));
    assert_eq!(info.crs, "OGC:CRS84");
    let heights = info.heights.unwrap();
    assert_eq!(
        [heights.min, heights.median, heights.max],
        [9.0, 10.0, 10.0]
    );
    assert!((info.extent[0] - 556.6).abs() < 1.0 && (info.extent[1] - 110.6).abs() < 0.5);
    let text = serde_json::to_value(FileInfo::City(info)).unwrap();
    assert_eq!(text["kind"], "city");
    assert_eq!(text["findings"][0]["place"], "feature 1");
    assert_eq!(text["findings"][0]["count"], 1);
}

#[test]
fn a_fault_of_a_city_is_told_with_its_file() {
    let error = inspect("a.geojson", b"{\"type\":\"Feature\",").unwrap_err();
    assert!(error.contains("a.geojson: byte 18: JSON: EOF"), "{error}");
    let lost = CITYJSON.replace("EPSG/0/7415", "EPSG/0/1");
    let error = crate::city::read_city_bytes("c", lost.as_bytes(), &Default::default());
    let error = error.unwrap_err();
    assert!(matches!(
        error.fault(),
        crate::Fault::City(ombra_city::CityError::UnknownCrs { .. })
    ));
}

#[test]
fn delft() {
    let Some(path) = outside_data("city/cityjson/delft.city.json") else {
        return;
    };
    let Ok(FileInfo::City(info)) = crate::inspect(path) else {
        panic!("a city");
    };
    assert_eq!((info.buildings, info.facets), (160, 3155));
    assert_eq!(info.crs, "EPSG:7415");
}
