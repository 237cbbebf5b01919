//! Lines of equal time, tiles, frames of a day, models.

use std::path::Path;

use serde_json::Value;

mod pictures;

use crate::{fail, succeed};

const CITY: [&str; 6] = ["shadows", "demo", "--date", "2026-12-21", "--cell", "4"];

fn shadows(folder: &Path, more: &[&str]) -> String {
    succeed(folder, &[&CITY[..], more, &["--quiet"]].concat())
}

fn refused(folder: &Path, more: &[&str]) -> String {
    fail(folder, &[&["shadows", "demo"][..], more].concat(), 2)
}

fn read(folder: &Path, name: &str) -> Value {
    serde_json::from_slice(&std::fs::read(folder.join(name)).unwrap()).unwrap()
}

/// Longitude and latitude of all cells in their order, and their minutes.
fn cells(folder: &Path, name: &str) -> Vec<([f64; 2], Option<f64>)> {
    let file = read(folder, name);
    let features = file["features"].as_array().unwrap().iter();
    let number = |value: &Value| value.as_f64().unwrap();
    features
        .map(|feature| {
            let at = &feature["geometry"]["coordinates"];
            let minutes = feature["properties"]["minutes"].as_f64();
            ([number(&at[0]), number(&at[1])], minutes)
        })
        .collect()
}

#[test]
fn lines_of_equal_time_run_between_cells_with_more_and_less() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let lines = ["--contours", "lines.geojson", "--levels", "2h,60,9999"];
    shadows(folder, &[&["-o", "cells.geojson"], &lines[..]].concat());
    let cells = cells(folder, "cells.geojson");
    let lines = read(folder, "lines.geojson");
    let lines = lines["features"].as_array().unwrap();
    let (mut levels, mut points) = (Vec::new(), 0);
    for line in lines {
        let level = line["properties"]["minutes"].as_f64().unwrap();
        levels.push(level);
        for point in line["geometry"]["coordinates"]
            .as_array()
            .unwrap()
            .iter()
            .step_by(9)
        {
            let at = [0, 1].map(|k| point[k].as_f64().unwrap());
            // Metres of a degree at 40.75° north.
            let away =
                |of: [f64; 2]| ((of[0] - at[0]) * 84_460.0).hypot((of[1] - at[1]) * 111_050.0);
            let near = cells.iter().filter(|(of, _)| away(*of) < 5.7);
            let near: Vec<f64> = near.filter_map(|(_, minutes)| *minutes).collect();
            let is_below = near.iter().any(|&minutes| minutes <= level);
            let is_above = near.iter().any(|&minutes| minutes >= level);
            assert!(is_below && is_above, "{at:?}: {level} and {near:?}");
            points += 1;
        }
    }
    assert!(points > 100);
    assert!(levels.is_sorted());
    levels.dedup();
    assert_eq!(levels, [60.0, 120.0], "nothing beyond the range");
}

#[test]
fn tiles_hold_the_minutes_where_published_data_have_them() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    shadows(
        folder,
        &[
            "-o",
            "cells.geojson",
            "--tiles",
            "tiles",
            "--max-zoom",
            "17",
        ],
    );
    let mut none = 0;
    for ([longitude, latitude], minutes) in cells(folder, "cells.geojson") {
        let count = f64::from(1 << 17);
        let ln = (latitude.to_radians().tan() + 1.0 / latitude.to_radians().cos()).ln();
        let tile = [
            (longitude + 180.0) / 360.0 * count,
            (1.0 - ln / std::f64::consts::PI) / 2.0 * count,
        ];
        let path = format!("tiles/17/{}/{}.bin", tile[0].floor(), tile[1].floor());
        let bytes = std::fs::read(folder.join(path)).unwrap();
        let [x, y] = tile.map(|k| (256.0 * k.fract()) as usize);
        let at = 2 * (256 * y + x);
        let found = i16::from_le_bytes([bytes[at], bytes[at + 1]]);
        none += usize::from(minutes.is_none());
        assert_eq!(found, minutes.map_or(-1, |minutes| minutes.round() as i16));
    }
    assert!(none > 100, "there are buildings");
    // Tiles of ours give way, and nothing else does.
    shadows(folder, &["--tiles", "tiles/", "--max-zoom", "14"]);
    assert!(!folder.join("tiles/17").exists() && folder.join("tiles/14").is_dir());
    std::fs::write(folder.join("tiles/mine.txt"), "").unwrap();
    let again = [&CITY[..], &["--tiles", "tiles"]].concat();
    let error = fail(folder, &again, 1);
    assert!(error.contains("mine.txt"), "{error}");
}

#[test]
fn products_of_a_change_are_of_its_net_or_of_all_three() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let change = [
        "--height",
        "church=120m",
        "--tiles",
        "tiles",
        "--contours",
        "lines.geojson",
    ];
    shadows(folder, &[&change[..], &["--levels=-30,60"]].concat());
    assert_eq!(
        read(folder, "tiles/tiles.json")["numbers"]["none"],
        i64::from(i16::MIN)
    );
    let lines = read(folder, "lines.geojson");
    let lines = lines["features"].as_array().unwrap().iter();
    let mut of: Vec<_> = lines
        .map(|line| line["properties"]["of"].as_str().unwrap())
        .collect();
    of.dedup();
    assert_eq!(of, ["before", "after", "net"]);
}

#[test]
fn what_there_is_none_of_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let day = ["--date", "2026-12-21"];
    let refused = |more: &[&str]| refused(folder, &[&day[..], more].concat());
    for (more, expected) in [
        (&["--contours", "a.geojson"][..], "--levels"),
        (&["--levels", "60"], "--contours"),
        (&["--contours", "a.tif", "--levels", "60"], ".geojson"),
        (&["--contours", "a.geojson", "--levels", "long"], "levels"),
        (&["--on", "roofs", "--tiles", "t"], "--tiles"),
        (&["--max-zoom", "17"], "--tiles"),
        (
            &["--tiles", "t", "--cell", "100", "--margin", "40000m"],
            "smaller zoom",
        ),
        (&["--frames", "a.mp4"], ".gif"),
        (&["--frames", "a.gif", "--every", "1s"], "1500"),
        (&["--frames", "a.gif", "--every", "24h"], "shorter"),
        (&["--frames", "a.gif", "--disc"], "--disc"),
        (&["--glb", "a.glb", "--without", "church"], "--without"),
        (&["--glb", "a.obj"], ".glb"),
        (&["--title", "A", "-o", "a.tif"], "--title"),
    ] {
        let error = refused(more);
        assert!(error.contains(expected), "{more:?}: {error}");
    }
    let error = fail(
        folder,
        &["shadows", "demo", "--season", "winter", "--frames", "a.gif"],
        2,
    );
    assert!(error.contains("one day"), "{error}");
    let missing = [&CITY[..], &["--tiles", "no/such"]].concat();
    assert!(fail(folder, &missing, 1).contains("does not exist"));
    for folders in ["--frames", "--tiles"] {
        // At once, with nothing measured: one line is all that is said.
        let error = fail(folder, &[&CITY[..], &[folders, "."]].concat(), 1);
        assert!(error.contains("name one, such as ./"), "{error}");
    }
    assert_eq!(
        std::fs::read_dir(folder).unwrap().count(),
        0,
        "nothing is left behind"
    );
}

/// A roof that is 90 m long and 0.3 m wide.
#[test]
fn a_face_that_no_texture_holds_is_refused_before_anything_is_measured() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let [west, south, east, north] = [13.4, 52.5, 13.401_326, 52.500_002_7];
    let ring = [
        [west, south],
        [east, south],
        [east, north],
        [west, north],
        [west, south],
    ];
    let wall = serde_json::json!({"type": "Feature", "properties": {"height": 3},
        "geometry": {"type": "Polygon", "coordinates": [ring]}});
    std::fs::write(folder.join("wall.geojson"), wall.to_string()).unwrap();
    let roof = [
        "shadows",
        "wall.geojson",
        "--date",
        "2026-12-21",
        "--on",
        "roofs",
        "--cell",
    ];
    let outputs = ["-o", "a.geojson", "--glb", "a.glb"];
    let error = fail(folder, &[&roof[..], &["0.01"], &outputs].concat(), 2);
    assert!(error.contains("more than a texture has (8192)"), "{error}");
    assert!(!folder.join("a.geojson").exists() && !folder.join("a.glb").exists());
    succeed(folder, &[&roof[..], &["0.1"], &outputs].concat());
}
