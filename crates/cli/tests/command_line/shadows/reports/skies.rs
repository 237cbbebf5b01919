//! Where the sun goes otherwise: beyond the polar circle, and in the south.

use std::path::Path;

use serde_json::Value;

use super::boxes::{Block, Town, instant, is_dark, number, origin, places, sky};
use super::report;
use crate::fail;

const SYDNEY: Town = Town {
    latitude: -33.8688,
    longitude: 151.2093,
};

const NORTH: Town = Town {
    latitude: 72.0,
    longitude: 25.0,
};

const CHANGE: [&str; 4] = ["--with", "tower.geojson", "--resources", "park.geojson"];

/// A house far away, a park, and a tower.
fn write(folder: &Path, town: Town, tower: Block) {
    let house = Block([100.0, 0.0, 120.0, 20.0], 12.0);
    town.write_blocks(folder, "city.geojson", &[house]);
    town.write_blocks(folder, "tower.geojson", &[tower]);
    town.write_areas(
        folder,
        "park.geojson",
        &[("Park", [-20.0, 0.0, 20.0, 40.0])],
    );
}

#[test]
fn days_without_sun_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    write(folder, NORTH, Block([-10.0, -30.0, 10.0, -10.0], 60.0));
    let of_year = ["city.geojson", "--report", "ceqr", "--year", "2026"];
    let told = report(folder, &[&of_year[..], &CHANGE].concat());
    let rows = told["rows"].as_array().unwrap();
    assert_eq!(rows[3]["result"], "no sun within the hours");
    assert_eq!(rows[3]["from"], Value::Null);
    assert_eq!(rows[2]["result"], "yes", "in June the sun is up all day");
    for rule in ["ceqr", "bre"] {
        let winter = [
            "shadows",
            "city.geojson",
            "--date",
            "2026-12-21",
            "--report",
            rule,
        ];
        let talk = fail(folder, &[&winter[..], &CHANGE].concat(), 1);
        assert!(talk.contains("the sun does not rise"), "{talk}");
    }
}

#[test]
fn a_year_with_a_polar_night_has_the_sun_of_its_other_days() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    write(folder, NORTH, Block([-10.0, -30.0, 10.0, -10.0], 60.0));
    let year = [
        "city.geojson",
        "--report",
        "prop-k",
        "--year",
        "2026",
        "--cell",
        "8",
    ];
    let told = report(folder, &[&year[..], &CHANGE].concat());
    let row = &told["rows"][0];
    assert_eq!(row["result"], "yes");
    let days = told["parks"][0]["days_that_change"].as_array().unwrap();
    let days: Vec<&str> = days
        .iter()
        .map(|day| day["day"].as_str().unwrap())
        .collect();
    // At 72 degrees the sun stays down from the middle of November to the end of January.
    let is_night = |day: &&&str| **day < "2026-01-25" || **day > "2026-11-17";
    assert_eq!(days.iter().find(is_night), None);
    assert!(days.contains(&"2026-06-21") && days.contains(&"2026-03-21"));
    assert_eq!(number(row, "days_with_new"), days.len() as f64);
    assert!(number(row, "net_new_percent") > 0.0 && number(row, "existing_percent") >= 0.0);
}

/// The sun stands in the north at noon.
#[test]
fn in_the_south_shadow_falls_to_the_south() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let days = [
        "city.geojson",
        "--report",
        "ceqr",
        "--date",
        "2026-06-21,2026-12-21",
        "--cell",
        "2",
    ];
    let run = |tower: Block| -> Value {
        write(folder, SYDNEY, tower);
        report(folder, &[&days[..], &CHANGE].concat())
    };
    let south = run(Block([-10.0, -30.0, 10.0, -10.0], 60.0));
    assert_eq!(south["rows"][0]["result"], "none", "in June");
    let tower = Block([-10.0, 50.0, 10.0, 70.0], 60.0);
    let told = run(tower);
    let place = told["place"].as_str().unwrap();
    assert!(
        place.contains("° south, 151.2") && place.ends_with("° east"),
        "{place}"
    );
    // Standard time in summer, too, which is in December.
    assert_eq!(told["clock"], "AEST");
    let row = &told["rows"][0];
    assert_eq!(row["result"], "yes", "{row}");
    let origin = origin(folder, "city.geojson");
    let (sky, tower) = (sky(&origin), SYDNEY.local(&origin, &[tower]));
    let places = places(folder, "park.geojson", &origin, 2.0);
    // A moment into the time for which most of it is dark.
    let sun = sky.direction(instant(&row["largest_at"]) + 1.0);
    let dark = places.iter().filter(|&&at| is_dark(&tower, at, 0.0, sun));
    let percent = 100.0 * dark.count() as f64 / places.len() as f64;
    assert!(percent > 20.0, "{percent}");
    assert!(
        (number(row, "largest_percent") - percent).abs() < 1.0,
        "{percent}: {row}"
    );
}
