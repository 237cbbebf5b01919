//! What is asked for, and what is refused.

use super::json;
use crate::{fail, succeed};

/// One house, 20 m wide.
const HOUSE: &str = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"height":30},
"geometry":{"type":"Polygon","coordinates":[[[13.4,52.5],[13.4003,52.5],[13.4003,52.50018],[13.4,52.50018],[13.4,52.5]]]}}]}"#;

#[test]
fn a_season_says_which_days_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let told = json(
        folder.path(),
        &[
            "demo", "--season", "winter", "--year", "2026", "--cell", "40", "--method", "fast",
        ],
    );
    assert_eq!(told["from"], "2026-12-21");
    assert_eq!(told["to"], "2027-03-19");
    assert_eq!(told["when"], "winter 2026 (2026-12-21 to 2027-03-19)");
}

#[test]
fn no_file_that_is_read_is_written() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("house.geojson"), HOUSE).unwrap();
    let same = [
        "shadows",
        "house.geojson",
        "--date",
        "2026-12-21",
        "-o",
        "./house.geojson",
    ];
    let said = fail(folder.path(), &same, 2);
    assert!(
        said.contains("./house.geojson: is a file that is read"),
        "{said}"
    );
    let tower = [
        "shadows",
        "demo",
        "--date",
        "2026-12-21",
        "--with",
        "house.geojson",
    ];
    let said = fail(
        folder.path(),
        &[&tower[..], &["-o", "house.geojson"]].concat(),
        2,
    );
    assert!(said.contains("is a file that is read"), "{said}");
    let kept = std::fs::read_to_string(folder.path().join("house.geojson")).unwrap();
    assert_eq!(kept, HOUSE);
}

#[test]
fn what_would_not_be_used_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let demo = ["shadows", "demo", "--date", "2026-12-21"];
    for (more, expected) in [
        (&["--step", "5min"][..], "--step is for --method sampled"),
        (&["--tolerance", "1"], "--tolerance is for --method fast"),
        (
            &["--margin", "5", "--on", "roofs", "-o", "a.geojson"],
            "--margin is for the map of the ground",
        ),
    ] {
        let said = fail(folder.path(), &[&demo, more].concat(), 2);
        assert!(said.contains(expected), "{said}");
    }
}

#[test]
fn a_sun_that_stands_too_low_is_told_from_one_that_does_not_rise() {
    let folder = tempfile::tempdir().unwrap();
    let high = [
        "shadows",
        "demo",
        "--date",
        "2026-12-21",
        "--min-altitude",
        "60",
    ];
    let said = fail(folder.path(), &high, 1);
    assert!(said.contains("stands 25.8° high at most"), "{said}");
    let arctic = HOUSE.replace("52.5", "78.5");
    std::fs::write(folder.path().join("arctic.geojson"), arctic).unwrap();
    let night = ["shadows", "arctic.geojson", "--date", "2026-12-21"];
    let said = fail(folder.path(), &night, 1);
    assert!(said.contains("the sun does not rise"), "{said}");
}

#[test]
fn a_margin_shows_the_shadow_of_what_stands_at_the_edge() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("house.geojson"), HOUSE).unwrap();
    let house = ["house.geojson", "--date", "2026-03-20", "--cell", "5"];
    let close = json(folder.path(), &house);
    let wide = json(folder.path(), &[&house[..], &["--margin", "50"]].concat());
    let count = |told: &serde_json::Value| told["places"].as_u64().unwrap();
    assert!(count(&wide) > count(&close) + 300, "{close} {wide}");
    succeed(
        folder.path(),
        &[
            &["shadows"],
            &house[..],
            &["--margin", "50", "--title", "One house", "--png", "map.png"],
        ]
        .concat(),
    );
    assert!(folder.path().join("map.png").exists());
}

/// Even those that need another option, which a report does not go with either.
#[test]
fn a_report_goes_with_no_option_of_other_outputs() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("house.geojson"), HOUSE).unwrap();
    let report = [
        "shadows",
        "demo",
        "--report",
        "bre",
        "--resources",
        "house.geojson",
    ];
    for more in [
        &["--spells", "a.parquet"][..],
        &["--attribute"],
        &["--by-building", "a.csv"],
        &["--levels", "60"],
        &["--every", "10min"],
        &["--max-zoom", "17"],
        &["--contours", "a.geojson"],
        &["--tiles", "a"],
        &["--frames", "a.gif"],
        &["--glb", "a.glb"],
    ] {
        let said = fail(folder.path(), &[&report, more].concat(), 2);
        let is_told = said.contains("cannot be used with") && said.contains(more[0]);
        assert!(is_told, "{more:?}: {said}");
    }
}
