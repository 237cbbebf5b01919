//! Roofs, façades, points, study areas, and the files that places are written to.

use std::path::Path;

use serde_json::{Value, json};

use super::json;
use crate::{fail, outside_data, succeed};

const DAY: [&str; 2] = ["--date", "2026-12-21"];

/// A podium with a tower, and a house to the south that shades it; some metres about Delft.
fn city(folder: &Path) {
    let ring = |[west, south, east, north]: [f64; 4]| {
        let at = |x: f64, y: f64| [4.36 + x / 68_600.0, 52.01 + y / 111_250.0];
        [
            at(west, south),
            at(east, south),
            at(east, north),
            at(west, north),
            at(west, south),
        ]
    };
    let feature = |id: &str, corners, base: f64, height: f64| {
        json!({"type": "Feature", "id": id, "properties": {"height": height, "min_height": base},
            "geometry": {"type": "Polygon", "coordinates": [ring(corners)]}})
    };
    let features = [
        feature("podium", [0.0, 0.0, 40.0, 20.0], 0.0, 6.0),
        feature("tower", [0.0, 0.0, 20.0, 20.0], 6.0, 60.0),
        feature("house", [0.0, -40.0, 40.0, -20.0], 0.0, 12.0),
    ];
    let file = json!({"type": "FeatureCollection", "features": features});
    std::fs::write(folder.join("city.geojson"), file.to_string()).unwrap();
}

fn features(folder: &Path, name: &str) -> Vec<Value> {
    let file: Value = serde_json::from_slice(&std::fs::read(folder.join(name)).unwrap()).unwrap();
    assert_eq!(file["type"], "FeatureCollection");
    assert_eq!(file["ombra"]["unit"], "minutes in shadow");
    file["features"].as_array().unwrap().clone()
}

fn minutes(feature: &Value) -> f64 {
    feature["properties"]["minutes"].as_f64().unwrap()
}

#[test]
fn facades_and_roofs_are_places_of_their_buildings() {
    let folder = tempfile::tempdir().unwrap();
    city(folder.path());
    let ask = |on: &str, more: &[&str]| {
        let all = [
            &["city.geojson", DAY[0], DAY[1], "--on", on, "--cell", "4"],
            more,
        ]
        .concat();
        json(folder.path(), &all)
    };
    let told = ask("facades", &["-o", "a.geojson"]);
    assert_eq!(told["on"], "facade");
    assert_eq!(told["width"], Value::Null);
    let all = features(folder.path(), "a.geojson");
    assert_eq!(told["places"].as_u64().unwrap() as usize, all.len());
    let mean = |building: &str, azimuth: f64| {
        let looks = |feature: &&Value| {
            let of = &feature["properties"];
            let away =
                (of["azimuth"].as_f64().unwrap() - azimuth + 180.0).rem_euclid(360.0) - 180.0;
            of["building_id"] == building && away.abs() < 1.0
        };
        let own: Vec<f64> = all.iter().filter(looks).map(minutes).collect();
        assert!(!own.is_empty(), "{building} {azimuth}");
        own.iter().sum::<f64>() / own.len() as f64
    };
    let up = 60.0 * told["sun_hours"].as_f64().unwrap();
    // In winter the sun stays in the south: walls to the north never see it, free ones to the south always do.
    assert!((mean("tower", 0.0) - up).abs() < 1.0);
    assert!(mean("house", 180.0) < 1.0);
    assert!(mean("podium", 180.0) > 10.0, "behind the house");
    assert!(
        all.iter()
            .all(|feature| feature["properties"]["tilt"] == 90.0)
    );
    assert!(
        all.iter()
            .all(|feature| feature["properties"]["surface"] == "facade")
    );

    let told = ask("roofs", &["-o", "b.geojson"]);
    assert_eq!(told["hidden"], 5 * 5, "below the tower");
    let roofs = features(folder.path(), "b.geojson");
    assert_eq!(roofs.len(), 25 + 25 + 50);
    let tower = roofs
        .iter()
        .filter(|feature| feature["properties"]["building_id"] == "tower");
    assert!(tower.clone().all(|feature| minutes(feature) == 0.0));
    assert!(
        tower
            .clone()
            .all(|feature| feature["geometry"]["coordinates"][2] == 60.02)
    );
}

#[test]
fn points_keep_their_names_and_those_inside_are_marked() {
    let folder = tempfile::tempdir().unwrap();
    city(folder.path());
    let table = "id;lat;lon;z;use\n\
        yard;52.01;4.3594;;school\n\
        hall;52.00999;4.3602;2;\n\
        roof;52.00973;4.3602;12.5;007\n";
    // Two of them are south of the podium and in the house.
    let table = table.replace("52.00999", &(52.01 - 30.0 / 111_250.0).to_string());
    std::fs::write(folder.path().join("points.csv"), table).unwrap();
    let all = ["city.geojson", DAY[0], DAY[1], "--points", "points.csv"];
    let told = json(folder.path(), &[&all[..], &["-o", "a.geojson"]].concat());
    assert_eq!(
        (&told["places"], &told["hidden"], &told["on"]),
        (&json!(2), &json!(1), &json!("points"))
    );
    let found = features(folder.path(), "a.geojson");
    let ids: Vec<&str> = found
        .iter()
        .map(|feature| feature["id"].as_str().unwrap())
        .collect();
    assert_eq!(ids, ["yard", "hall", "roof"]);
    assert_eq!(found[0]["properties"]["use"], "school");
    assert_eq!(
        found[0]["geometry"]["coordinates"],
        json!([4.3594, 52.01, 0.0])
    );
    assert_eq!(found[0]["properties"]["inside"], false);
    assert_eq!(
        found[1]["properties"],
        json!({"use": null, "minutes": null, "inside": true, "building": 2, "building_id": "house"})
    );
    assert_eq!(found[2]["properties"]["use"], "007");
    assert!(found[2]["properties"]["minutes"].is_f64());

    // What came out goes in again.
    let again = [
        "city.geojson",
        DAY[0],
        DAY[1],
        "--points",
        "a.geojson",
        "-o",
        "b.geojson",
    ];
    json(folder.path(), &again);
    let same = features(folder.path(), "b.geojson");
    assert_eq!(same.len(), 3);
    for (a, b) in found.iter().zip(&same) {
        assert_eq!(a["properties"], b["properties"]);
    }
    json(folder.path(), &[&all[..], &["-o", "a.parquet"]].concat());
    let bytes = std::fs::read(folder.path().join("a.parquet")).unwrap();
    assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"));
}

#[test]
fn both_methods_agree_on_facades_and_threads_change_no_byte() {
    let folder = tempfile::tempdir().unwrap();
    city(folder.path());
    let ask = |more: &[&str]| {
        let all = [
            "city.geojson",
            DAY[0],
            DAY[1],
            "--on",
            "facades",
            "--cell",
            "3",
        ];
        json(folder.path(), &[&all[..], more].concat())["minutes_mean"]
            .as_f64()
            .unwrap()
    };
    let exact = ask(&[]);
    let sampled = ask(&["--method", "sampled", "--step", "30s"]);
    assert!((exact - sampled).abs() < 0.3, "{exact} and {sampled}");
    for name in ["a.parquet", "a.geojson"] {
        ask(&["-o", name, "--threads", "1"]);
        let one = std::fs::read(folder.path().join(name)).unwrap();
        ask(&["-o", name, "--threads", "3"]);
        assert_eq!(
            std::fs::read(folder.path().join(name)).unwrap(),
            one,
            "{name}"
        );
    }
}

#[test]
fn a_study_area_bounds_the_grid_and_what_stands_outside_throws_shadow_into_it() {
    let folder = tempfile::tempdir().unwrap();
    city(folder.path());
    let metres = |x: f64, y: f64| [4.36 + x / 68_600.0, 52.01 + y / 111_250.0];
    // The yard between the house and the podium, without its middle.
    let square = |west: f64, south: f64, east: f64, north: f64| {
        json!([
            metres(west, south),
            metres(east, south),
            metres(east, north),
            metres(west, north),
            metres(west, south)
        ])
    };
    let study = json!({"type": "Polygon",
        "coordinates": [square(1.0, -19.0, 39.0, -1.0), square(15.0, -15.0, 25.0, -5.0)]});
    std::fs::write(folder.path().join("yard.geojson"), study.to_string()).unwrap();
    let all = [
        "city.geojson",
        DAY[0],
        DAY[1],
        "--study",
        "yard.geojson",
        "--cell",
        "1",
    ];
    let told = json(folder.path(), &[&all[..], &["-o", "a.geojson"]].concat());
    let places = told["places"].as_f64().unwrap();
    assert!((places - (38.0 * 18.0 - 100.0)).abs() < 20.0, "{places}");
    assert!(
        told["minutes_mean"].as_f64().unwrap() > 60.0,
        "the house is outside: {told}"
    );
    assert_eq!(features(folder.path(), "a.geojson").len() as f64, places);
    let around = &told["surroundings"];
    assert!(
        (around["tallest"].as_f64().unwrap() - 60.0).abs() < 0.1,
        "{told}"
    );
    assert!(
        (around["margin"].as_f64().unwrap() - 1.0).abs() < 1.0,
        "{told}"
    );
    assert!(around["reach"].is_null(), "the sun rises: {told}");
    let high = json(
        folder.path(),
        &[&all[..], &["--min-altitude", "10"]].concat(),
    );
    let reach = high["surroundings"]["reach"].as_f64().unwrap();
    assert!(
        (reach - 60.0 / 10_f64.to_radians().tan()).abs() < 1.0,
        "{reach}"
    );
    succeed(
        folder.path(),
        &[&["shadows"], &all[..], &["-o", "a.tif", "--png", "a.png"]].concat(),
    );
}

#[test]
fn what_is_asked_wrongly_of_places_says_so() {
    let folder = tempfile::tempdir().unwrap();
    city(folder.path());
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("far.csv", "lon,lat\n4.36,52.01\n14.36,52.01\n");
    write("south.csv", "lon,lat\n4.36,95\n");
    write("word.csv", "lon,lat\n4.36,north\n");
    write(
        "point.json",
        "{\"type\": \"Point\", \"coordinates\": [4.36, 52.01]}",
    );
    write(
        "other.json",
        "{\"type\": \"Polygon\", \"coordinates\": [[[5,52],[5.1,52],[5,52.1]]]}",
    );
    write(
        "metres.json",
        "{\"type\": \"Polygon\", \"coordinates\": [[[84000,447000],[84100,447000],[84000,448000]]]}",
    );
    write("places.parquet", "PAR1\u{15}\u{0}\u{15}\u{1}");
    write("hall.csv", "lon,lat\n4.3602,52.00973\n");
    let before = std::fs::read_dir(folder.path()).unwrap().count();
    for (wrong, code, told) in [
        (
            &["--on", "facades", "--png", "a.png"][..],
            2,
            "places on roofs and facades",
        ),
        (&["--on", "roofs", "-o", "a.tif"], 2, ".parquet"),
        (&["--points", "far.csv", "--png", "a.png"], 2, "points"),
        (&["--points", "far.csv", "--on", "roofs"], 2, "--on"),
        (&["--points", "far.csv", "--cell", "2"], 2, "--cell"),
        (&["--study", "point.json", "--area", "1,2,3,4"], 2, "--area"),
        (&["--on", "walls"], 2, "facades"),
        (&["--resume"], 2, "-o or --png"),
        (
            &["--points", "far.csv"],
            1,
            "far.csv: line 3: 14.36, 52.01 (OGC:CRS84) is 6",
        ),
        (
            &["--points", "south.csv"],
            1,
            "south.csv: line 2: 4.36, 95 is no place of OGC:CRS84",
        ),
        (
            &["--points", "word.csv"],
            1,
            "word.csv:2: table: column lat: \"north\" is no number",
        ),
        (&["--points", "none.csv"], 1, "none.csv"),
        (
            &["--study", "point.json"],
            1,
            "point.json: study area: no polygon",
        ),
        (
            &["--study", "other.json"],
            1,
            "other.json: lies outside of the city",
        ),
        (
            &["--study", "metres.json"],
            1,
            "84000, 447000 is no place of OGC:CRS84",
        ),
        (&["--study", "far.csv"], 1, "GeoJSON with polygons"),
        (
            &["--points", "places.parquet"],
            1,
            "unknown kind of file; GeoJSON with points or CSV",
        ),
        (
            &["--study", "places.parquet"],
            1,
            "unknown kind of file; GeoJSON",
        ),
        (
            &["--area", "52.0099,4.3599,52.0101,4.3601"],
            1,
            "--area: lies outside of the city; its coordinates are taken for those of OGC:CRS84",
        ),
        (
            &["--points", "hall.csv"],
            1,
            "hall.csv: its point lies inside of a building",
        ),
        (
            &["--height-attribute", "hoogte"],
            1,
            "no building has an attribute \"hoogte\"; heights may be in \"height\", \"min_height\"",
        ),
    ] {
        let all = [&["shadows", "city.geojson", DAY[0], DAY[1]], wrong].concat();
        let talk = fail(folder.path(), &all, code);
        assert!(talk.contains(told), "{wrong:?}: {talk}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), before);
}

#[test]
fn facades_of_real_cities_are_measured() {
    let Some(data) = outside_data() else { return };
    let folder = tempfile::tempdir().unwrap();
    for (name, cell) in [
        ("city/cityjson/rotterdam_delfshaven.city.json", "4"),
        ("city/cityjson/delft.city.json", "4"),
        ("city/geojson/suzhou_buildings.geojson", "8"),
    ] {
        for on in ["facades", "roofs"] {
            let city = data.join(name);
            let all = [
                city.to_str().unwrap(),
                DAY[0],
                DAY[1],
                "--on",
                on,
                "--cell",
                cell,
                "-o",
                "a.parquet",
            ];
            let told = json(folder.path(), &all);
            assert!(told["places"].as_u64().unwrap() > 1000, "{name}: {told}");
            let share =
                told["minutes_mean"].as_f64().unwrap() / 60.0 / told["sun_hours"].as_f64().unwrap();
            let likely = if on == "roofs" { 0.0..0.5 } else { 0.4..0.95 };
            assert!(likely.contains(&share), "{name} {on}: {share}");
        }
    }
}
