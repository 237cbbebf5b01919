//! Broken files are answered as their list asks.

use ombra_city::City;
use ombra_city::heights::Heights;

use super::super::{CityOptions, read_city};
use super::{findings, outside_data, read, tops};

/// `None` where the file is not there.
fn bad(name: &str, options: &CityOptions) -> Option<Result<City, String>> {
    let path = outside_data(&format!("bad/{name}"))?;
    Some(read_city(path, options).map_err(|error| {
        let text = error.to_string();
        assert!(text.contains(name) && !text.contains('\n'), "{text}");
        text
    }))
}

#[test]
fn files_that_cannot_be_read_say_where_and_why() {
    for (name, told) in [
        (
            "negative_height.geojson",
            "byte 745: JSON: expected value (line 1, column 746): NaN is not JSON",
        ),
        ("truncated.geojson", "byte 700: JSON: EOF"),
        ("no_transform.city.json", "transform: is missing"),
        (
            "vertex_oob.city.json",
            "CityObject b1: uses vertex 700, 8 present",
        ),
        (
            "null_geometry.geojson",
            "no building that could be placed: feature 0: no geometry: left out; \
             feature 1: no usable height: left out (--default-height gives one); feature 2: Point is no polygon: left out; \
             feature 3: outline without corners on the map: left out",
        ),
        (
            "missing_nodes.osm",
            "no building that could be placed: \
             relation 5: is a member of itself: not followed; \
             relation 5: has no closed outline: left out; \
             way 10: 2 nodes are not in the file: left out",
        ),
        ("truncated.osm.pbf", "blob 2: unexpected end of file: "),
    ] {
        if let Some(read) = bad(name, &CityOptions::default()) {
            let error = read.unwrap_err();
            assert!(error.contains(told), "{error}");
        }
    }
}

#[test]
fn heights_that_cannot_be_are_told_and_left_out() {
    let Some(path) = outside_data("bad/negative_height.geojson") else {
        return;
    };
    let text = std::fs::read_to_string(path).unwrap().replace("NaN", "20");
    let city = read(&text).unwrap();
    assert_eq!(tops(&city), [20.0]);
    assert_eq!(
        findings(&city),
        [
            "feature 0: height is negative (-30 m)",
            "feature 0: no usable height: left out (--default-height gives one) (3 times)",
            "feature 1: height is zero (0 m)",
            "feature 2: height is taller than anything built (1000000000 m)",
        ]
    );
}

#[test]
fn heights_in_words_are_read_or_told_one_by_one() {
    let Some(city) = bad("height_as_string.geojson", &CityOptions::default()) else {
        return;
    };
    let city = city.unwrap();
    assert_eq!(tops(&city), [12.0, 12.0, 12.192, 12.192, 12.5]);
    assert_eq!(
        findings(&city),
        [
            "feature 4: height \"12,5\" has a decimal comma: read as 12.5",
            "feature 5: height \"\" is empty",
            "feature 5: no usable height: left out (--default-height gives one) (5 times)",
            "feature 6: height \"tall\" is not a height",
            "feature 8: height is a list, and no number or text",
            "feature 9: height is true or false, and no number or text",
        ]
    );
}

#[test]
fn with_a_height_for_all_a_feature_without_one_is_a_building() {
    let heights = Heights {
        default: Some(9.0),
        ..Heights::default()
    };
    let options = CityOptions {
        heights,
        ..CityOptions::default()
    };
    if let Some(city) = bad("null_geometry.geojson", &options) {
        let city = city.unwrap();
        assert_eq!(tops(&city), [9.0]);
        assert_eq!(city.findings.len(), 4, "{:?}", findings(&city));
    }
}

#[test]
fn broken_rings_are_repaired_or_left_out() {
    if let Some(city) = bad("self_intersecting.geojson", &CityOptions::default()) {
        let city = city.unwrap();
        assert_eq!(
            findings(&city),
            ["feature 0: outline crosses itself: repaired"]
        );
        assert_eq!(city.buildings[0].parts.len(), 2, "two triangles");
    }
    if let Some(city) = bad("unclosed_ring.geojson", &CityOptions::default()) {
        let city = city.unwrap();
        assert_eq!(city.buildings.len(), 1);
        assert_eq!(
            findings(&city),
            [
                "feature 0: ring is not closed: closed",
                "feature 1: ring of the outline has 2 points, at least 3 are needed: left out",
            ]
        );
    }
}
