//! Lines of equal time, tiles, frames of a day, models.

use std::path::Path;

use ombra::formats::read_image;
use serde_json::Value;

use crate::{fail, run, succeed};

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
    shadows(folder, &["--tiles", "tiles", "--max-zoom", "14"]);
    assert!(!folder.join("tiles/17").exists() && folder.join("tiles/14").is_dir());
    std::fs::write(folder.join("tiles/mine.txt"), "").unwrap();
    let again = [&CITY[..], &["--tiles", "tiles"]].concat();
    let error = fail(folder, &again, 1);
    assert!(error.contains("mine.txt"), "{error}");
}

/// Each cell of a frame is held against rays in the minutes before and after it, where these are of one mind.
#[test]
fn frames_agree_with_rays() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    shadows(
        folder,
        &["--frames", "day", "--every", "2h", "--hours", "09:30-16:00"],
    );
    let frames = read(folder, "day/frames.json");
    let shown: Vec<_> = frames["frames"]
        .as_array()
        .unwrap()
        .iter()
        .map(|frame| &frame["shows"])
        .collect();
    assert_eq!(shown, ["10:00", "12:00", "14:00", "16:00"]);
    for (index, hours) in ["09:59-10:01", "11:59-12:01", "13:59-14:01"]
        .iter()
        .enumerate()
    {
        let rays = [
            "--hours",
            hours,
            "--method",
            "sampled",
            "--step",
            "20s",
            "-o",
            "rays.geojson",
        ];
        shadows(folder, &rays);
        let cells = cells(folder, "rays.geojson");
        let width = cells
            .iter()
            .take_while(|(at, _)| (at[1] - cells[0].0[1]).abs() < 2e-5)
            .count();
        let path = folder.join(format!("day/{index:04}.png"));
        let picture = read_image(path, &ombra::formats::Limits::default()).unwrap();
        let pixel = |x: usize, y: usize| {
            let pixel = picture.pixels()[y * picture.width() as usize + x];
            pixel.to_srgb().map(|v| (v * 255.0).round() as u8)
        };
        // The frame of the map stands alone at the left; cells are enlarged by a whole number.
        let top = (0..).find(|&y| pixel(39, y) == [34, 33, 38]).unwrap() + 1;
        let zoom = 820_usize.div_ceil(width);
        let (mut dark, mut wrong) = (0, 0);
        for (cell, (_, minutes)) in cells.iter().enumerate() {
            let (column, row) = (cell % width, cell / width);
            let colour = pixel(40 + column * zoom + zoom / 2, top + row * zoom + zoom / 2);
            let expected = match minutes {
                None => [186, 179, 170],
                Some(minutes) if *minutes > 1.99 => [98, 98, 120],
                Some(minutes) if *minutes < 0.01 => [250, 244, 219],
                Some(_) => continue,
            };
            dark += usize::from(colour == [98, 98, 120]);
            wrong += usize::from(colour != expected);
        }
        assert!(dark > 500, "{dark} at {hours}");
        assert_eq!(wrong, 0, "of {} at {hours}", cells.len());
    }
    let gif = [
        "--frames",
        "day.gif",
        "--every",
        "3h",
        "--without",
        "pavilion",
    ];
    shadows(folder, &gif);
    assert!(
        std::fs::read(folder.join("day.gif"))
            .unwrap()
            .starts_with(b"GIF89a")
    );
}

#[test]
fn a_model_is_one_that_ombra_reads_and_the_same_for_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for on in ["ground", "roofs", "facades"] {
        let bytes = ["1", "2"].map(|threads| {
            shadows(
                folder,
                &["--on", on, "--glb", "city.glb", "--threads", threads],
            );
            std::fs::read(folder.join("city.glb")).unwrap()
        });
        assert!(bytes[0] == bytes[1], "{on}");
        let told: Value =
            serde_json::from_str(&succeed(folder, &["info", "city.glb", "--json"])).unwrap();
        assert!(told.to_string().contains("minutes on"), "{told}");
    }
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
    let output = run(folder, &[&CITY[..], &["--frames", "."]].concat());
    assert!(!output.status.success());
    assert_eq!(
        std::fs::read_dir(folder).unwrap().count(),
        0,
        "nothing is left behind"
    );
}
