//! Areas of shapes that overlap, cross themselves, or enclose nothing.

use std::path::Path;

use serde_json::{Value, json};

use super::boxes::number;
use super::{BERLIN, berlin, report};

/// One feature of several rings, each a polygon.
fn shape(folder: &Path, rings: &[&[[f64; 2]]]) -> Value {
    let polygon = |ring: &&[[f64; 2]]| {
        let ring: Vec<[f64; 2]> = ring.iter().map(|&at| BERLIN.at(at)).collect();
        vec![ring]
    };
    let polygons: Vec<_> = rings.iter().map(polygon).collect();
    let feature = json!({"type": "Feature", "properties": {"name": "Park"},
        "geometry": {"type": "MultiPolygon", "coordinates": polygons}});
    BERLIN.write(folder, "shape.geojson", &[feature]);
    let rule = ["city.geojson", "--report", "ceqr", "--date", "2026-03-21"];
    let more = ["--with", "tower.geojson", "--resources", "shape.geojson"];
    report(folder, &[&rule[..], &more].concat())
}

fn rectangle([west, south, east, north]: [f64; 4]) -> Vec<[f64; 2]> {
    vec![
        [west, south],
        [east, south],
        [east, north],
        [west, north],
        [west, south],
    ]
}

#[test]
fn what_two_polygons_share_counts_once() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    berlin(folder);
    let whole = shape(folder, &[&rectangle([-20.0, 0.0, 20.0, 40.0])]);
    let [west, east] = [[-20.0, 0.0, 10.0, 40.0], [-10.0, 0.0, 20.0, 40.0]].map(rectangle);
    let told = shape(folder, &[&west, &east]);
    assert!((number(&told["resources"][0], "area_m2") - 1600.0).abs() < 0.5);
    assert_eq!(
        told["resources"][0]["cells"],
        whole["resources"][0]["cells"]
    );
    for key in ["largest_m2", "largest_percent", "integrated_m2_h"] {
        let [one, both] = [&whole, &told].map(|told| number(&told["rows"][0], key));
        assert!(
            one > 0.0 && (one - both).abs() < 1e-3 * one,
            "{key}: {one} and {both}"
        );
    }
}

#[test]
fn a_bow_tie_has_the_area_of_both_its_halves() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    berlin(folder);
    let bow = [
        [-20.0, 0.0],
        [20.0, 40.0],
        [20.0, 0.0],
        [-20.0, 40.0],
        [-20.0, 0.0],
    ];
    let told = shape(folder, &[&bow]);
    let resource = &told["resources"][0];
    assert!(
        (number(resource, "area_m2") - 800.0).abs() < 0.5,
        "{resource}"
    );
    // Each of the cells is one of a square metre.
    assert!(
        (number(resource, "cells") - 800.0).abs() < 45.0,
        "{resource}"
    );
    assert!(number(&told["rows"][0], "largest_m2") > 0.0);
}

#[test]
fn what_encloses_nothing_is_told_and_not_measured() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    berlin(folder);
    let told = shape(folder, &[&[[0.0, 0.0], [9.0, 9.0], [0.0, 0.0], [0.0, 0.0]]]);
    assert_eq!(told["rows"][0]["result"], "not measured");
    let findings = told["findings"].to_string();
    assert!(findings.contains("Park: encloses nothing"), "{findings}");
    assert!(!findings.contains("smaller cells"), "{findings}");
}
