//! The commands of docs/tutorial-ceqr.md, with its files, on the city that it is about.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::json;
use crate::{outside_data, succeed};

/// The share of a park, in percent, that may lie in new shadow at any moment, by the page's rule.
const MOST_PERCENT: f64 = 5.0;
/// For how many minutes all of its sun may be gone.
const MOST_MINUTES: f64 = 10.0;

/// The building that is to be taller.
const BUILDING: &str = "1001245";

/// The files of the page and the city in a folder of their own, if the city is there.
fn folder() -> Option<tempfile::TempDir> {
    let city = "city/geojson/lower_manhattan_nyc_opendata.geojson";
    let city = fs::read(outside_data()?.join(city)).unwrap();
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("manhattan.geojson"), city).unwrap();
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/tutorial-ceqr");
    for file in ["parks.geojson", "churchyard.geojson", "tower.geojson"] {
        fs::copy(page.join(file), folder.path().join(file)).unwrap();
    }
    Some(folder)
}

/// The table of a change.
fn report(folder: &Path, change: &[&str]) -> Value {
    let rule = [
        "manhattan.geojson",
        "--year",
        "2026",
        "--report",
        "ceqr",
        "--resources",
        "parks.geojson",
    ];
    json(folder, &[&rule, change].concat())
}

/// The most of a column over all rows of a resource; what has no number is 0.
fn most(report: &Value, resource: &str, column: &str) -> f64 {
    let rows = report["rows"].as_array().unwrap().iter();
    let of = rows.filter(|row| row["resource"] == resource);
    of.map(|row| row[column].as_f64().unwrap_or(0.0))
        .fold(0.0, f64::max)
}

/// Whether a change keeps the page's rule.
fn passes(report: &Value) -> bool {
    let rows = report["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 12, "three parks, four days");
    rows.iter().all(|row| {
        let of = |column: &str| row[column].as_f64().unwrap_or(0.0);
        of("largest_percent") <= MOST_PERCENT && of("sun_eliminated_minutes") <= MOST_MINUTES
    })
}

#[test]
fn the_block_of_the_tutorial_fails_and_its_slab_passes() {
    let Some(folder) = folder() else { return };
    let folder = folder.path();
    let block = |metres: u32| report(folder, &["--height", &format!("{BUILDING}={metres}m")]);
    let first = block(260);
    assert!(!passes(&first));
    let share = |park| most(&first, park, "largest_percent");
    assert!((share("City Hall Park") - 22.0).abs() < 1.0);
    assert!((share("St. Paul's churchyard") - 48.5).abs() < 1.0);
    assert_eq!(share("Zuccotti Park"), 0.0);
    let gone = most(&first, "City Hall Park", "sun_eliminated_minutes");
    assert!((gone - 21.3).abs() < 1.0, "{gone}");
    // The heights between which the page's rule decides.
    assert!(!passes(&block(135)));
    assert!(passes(&block(130)));
    let slab = || report(folder, &["--without", BUILDING, "--with", "tower.geojson"]);
    let lower = slab();
    assert!(passes(&lower));
    assert!(most(&lower, "St. Paul's churchyard", "largest_percent") > 0.0);
    let tower = folder.join("tower.geojson");
    let text = fs::read_to_string(&tower).unwrap();
    assert_eq!(
        text.matches("185").count(),
        1,
        "the page says what to change"
    );
    fs::write(&tower, text.replace("185", "190")).unwrap();
    assert!(!passes(&slab()));
}

#[test]
fn the_tutorial_finds_whose_shadow_it_is() {
    let Some(folder) = folder() else { return };
    let folder = folder.path();
    // Place-minutes that the building takes alone, of one city.
    let alone = |change: &[&str]| {
        let arguments = [
            "shadows",
            "manhattan.geojson",
            "--study",
            "churchyard.geojson",
            "--date",
            "2026-05-06",
            "--after-sunrise",
            "90min",
            "--before-sunset",
            "90min",
            "--by-building",
            "who.csv",
            "--spells",
            "spells.parquet",
        ];
        succeed(folder, &[&arguments[..], change].concat());
        let who = fs::read_to_string(folder.join("who.csv")).unwrap();
        let columns: Vec<_> = who.lines().next().unwrap().split(',').collect();
        let column = |name| columns.iter().position(|&column| column == name).unwrap();
        let rows = who.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let mut ours = rows.filter(|row| row[column("building_id")] == BUILDING);
        ours.next().unwrap()[column("alone")]
            .parse::<f64>()
            .unwrap()
    };
    // What the building takes alone grows by the shadow that is new: two ways to the same number.
    let grows = -alone(&[]) + alone(&["--height", "1001245=260m"]);
    let block = report(folder, &["--height", "1001245=260m"]);
    let rows = block["rows"].as_array().unwrap();
    let day = rows
        .iter()
        .find(|row| row["resource"] == "St. Paul's churchyard" && row["day"] == "2026-05-06");
    let new = day.unwrap()["integrated_m2_h"].as_f64().unwrap();
    assert!(
        (grows / 60.0 / new - 1.0).abs() < 0.005,
        "{grows} and {new}"
    );
    // The spells are those of the taller city, whose worst hour is from nine to ten.
    let hour = |hours: &str| {
        let asked = [
            "query",
            "spells.parquet",
            "--building",
            BUILDING,
            "--time-zone",
            "EST",
            "--hours",
            hours,
        ];
        json(folder, &asked)["minutes_mean"].as_f64().unwrap()
    };
    let worst = hour("09:00-10:00");
    assert!((worst - 21.0).abs() < 1.0, "{worst}");
    assert!(worst > hour("08:00-09:00") && worst > hour("10:00-11:00"));
}
