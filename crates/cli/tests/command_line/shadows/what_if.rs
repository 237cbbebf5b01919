//! The shadow before and after a change of the city.

use std::path::Path;

use serde_json::{Value, json};

use super::json as told;
use crate::{fail, succeed};

/// A square block by its south-western corner, in degrees about a place in Berlin.
fn block([x, y]: [f64; 2], name: &str, height: f64) -> Value {
    let (x, y) = (13.4 + x, 52.5 + y);
    let (u, v) = (x + 3e-4, y + 2e-4);
    json!({"type": "Feature", "properties": {"Building_ID": name, "height": height},
        "geometry": {"type": "Polygon", "coordinates": [[[x, y], [u, y], [u, v], [x, v], [x, y]]]}})
}

fn write(folder: &Path, name: &str, features: &[Value]) {
    let file = json!({"type": "FeatureCollection", "features": features});
    std::fs::write(folder.join(name), file.to_string()).unwrap();
}

fn places(folder: &Path, name: &str) -> Vec<Value> {
    let file: Value = serde_json::from_slice(&std::fs::read(folder.join(name)).unwrap()).unwrap();
    let all = file["features"].as_array().unwrap().iter();
    all.map(|feature| feature["properties"].clone()).collect()
}

#[test]
fn before_and_after_are_what_two_runs_give() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let (a, b, c) = ([0.0, 0.0], [8e-4, 0.0], [4e-4, -4e-4]);
    let city = [
        block(a, "a", 20.0),
        block(b, "b", 30.0),
        block([0.0, 8e-4], "c", 9.0),
    ];
    write(folder, "city.geojson", &city);
    write(folder, "tower.geojson", &[block(c, "new", 80.0)]);
    let after = [
        block(a, "a", 45.0),
        block([0.0, 8e-4], "c", 9.0),
        block(c, "new", 80.0),
    ];
    write(folder, "after.geojson", &after);
    let mut points = "lon,lat,after\n".to_owned();
    for k in 0..300 {
        let (x, y) = (f64::from(k % 20) * 1e-4, f64::from(k / 20) * 1e-4);
        points += &format!("{},{},mine\n", 13.3995 + x, 52.4993 + y);
    }
    std::fs::write(folder.join("points.csv"), points).unwrap();
    let same = ["--date", "2026-03-21", "--points", "points.csv", "-o"];
    let run = |city: &str, output: &str, more: &[&str]| {
        told(folder, &[&[city], &same[..], &[output], more].concat());
        places(folder, output)
    };
    let change = [
        "--with",
        "tower.geojson",
        "--without",
        "b",
        "--height",
        "a=45m",
    ];
    let both = run("city.geojson", "both.geojson", &change);
    let before = run("city.geojson", "before.geojson", &[]);
    let anew = run("after.geojson", "anew.geojson", &[]);
    let mut kinds = [0; 5];
    for ((both, before), after) in both.iter().zip(&before).zip(&anew) {
        assert_eq!(both["before"], before["minutes"], "to the bit");
        assert_eq!(both["inside"], after["inside"]);
        assert_eq!(both["minutes"], both["after"]);
        let number = |value: &Value| value.as_f64();
        match (number(&both["after"]), number(&after["minutes"])) {
            // The other file has its origin elsewhere.
            (Some(found), Some(expected)) => assert!((found - expected).abs() < 0.05),
            (found, expected) => assert_eq!(found, expected),
        }
        let net = number(&both["net"]);
        match (number(&both["before"]), number(&both["after"])) {
            (Some(before), Some(after)) => {
                assert!((net.unwrap() - (after - before)).abs() < 1e-3);
                kinds[if after > before {
                    0
                } else {
                    usize::from(after < before)
                }] += 1;
            }
            (None, after) => {
                assert_eq!(net, None);
                kinds[2] += usize::from(after.is_some());
            }
            (Some(_), None) => {
                assert_eq!(net, None);
                kinds[3] += 1;
            }
        }
    }
    let [gain, lose, free, built, _] = kinds;
    assert!(gain > 20 && lose > 5 && free > 2 && built > 2, "{kinds:?}");
}

#[test]
fn a_taller_church_throws_more_shadow_and_little_is_measured_again() {
    let folder = tempfile::tempdir().unwrap();
    let all = [
        "demo",
        "--date",
        "2026-06-21",
        "--cell",
        "4",
        "--height",
        "church=140m",
        "--without",
        "pavilion,column",
        "-o",
        "net.tif",
        "--png",
        "net.png",
    ];
    let told = told(folder.path(), &all);
    let number = |name: &str| told[name].as_f64().unwrap();
    assert!(number("gain") > 100.0 && number("lose") > 10.0, "{told}");
    assert!(number("gain_most") > 10.0 && number("lose_most") > 10.0);
    assert!(number("measured_again") < 0.6 * number("measured"));
    assert!(number("set_free") > 0.0 && number("built_over") == 0.0);
    assert!((number("net_mean") - (number("after_mean") - number("before_mean"))).abs() < 1e-6);
    let tif = std::fs::read(folder.path().join("net.tif")).unwrap();
    let name = b"sample=\"2\" role=\"description\">net new shadow<";
    assert!(tif.windows(name.len()).any(|bytes| bytes == name));
    let png = std::fs::read(folder.path().join("net.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG"));
    let talk = succeed(
        folder.path(),
        &[
            "shadows",
            "demo",
            "--date",
            "2026-06-21",
            "--cell",
            "8",
            "--without",
            "#0",
            "--json",
        ],
    );
    assert!(talk.contains("\"buildings_after\""));
}

#[test]
fn what_cannot_be_changed_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let day = ["shadows", "demo", "--date", "2026-06-21", "--cell", "20"];
    for (more, said) in [
        (
            &["--without", "church", "--method", "fast"][..],
            "--method fast",
        ),
        (&["--without", "church", "--on", "roofs"], "--on roofs"),
        (
            &["--without", "church", "--resume", "-o", "a.tif"],
            "--resume",
        ),
        (&["--height", "church"], "way/123=120m"),
        (&["--height", "church=tall"], "metres above 0"),
    ] {
        let talk = fail(folder, &[&day, more].concat(), 2);
        assert!(talk.contains(said), "{more:?}: {talk}");
    }
    for (more, said) in [
        (&["--without", "chruch"][..], "did you mean \"church\"?"),
        (&["--height", "tower=9m"], "4 buildings are named \"tower\""),
        (
            &["--without", "church", "--height", "church=9m"],
            "named twice",
        ),
        (&["--height", "church=99999m"], "10000 m"),
        (&["--with", "no.geojson"], "no.geojson"),
    ] {
        let quiet = [&day, more, &["--quiet"]].concat();
        let talk = fail(folder, &quiet, 1);
        assert!(talk.contains(said), "{more:?}: {talk}");
    }
    let days = fail(folder, &["shadows", "demo", "--without", "church"], 2);
    assert!(days.contains("--date 2026-12-21"), "{days}");
    assert_eq!(std::fs::read_dir(folder).unwrap().count(), 0);
}
