//! What is asked wrongly of a report, and what cannot be reported.

use serde_json::json;

use super::berlin;
use super::boxes::Town;
use crate::fail;

#[test]
fn what_a_rule_does_not_go_with_is_exit_code_2() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    berlin(folder);
    let (with, areas) = (["--with", "tower.geojson"], ["--resources", "park.geojson"]);
    let both = [with, areas].concat();
    for (rule, more, said) in [
        ("ceqr", &areas[..], "--with tower.geojson"),
        ("ceqr", &with, "--resources parks.geojson"),
        ("prop-k", &with, "--resources parks.geojson"),
        ("bre", &with, "--points windows.csv"),
        ("japan", &areas, "--with tower.geojson"),
        ("japan", &with, "--resources site.geojson"),
        (
            "japan",
            &[&both[..], &["--without", "#0"]].concat(),
            "leave --without",
        ),
        (
            "japan",
            &[&both[..], &["--limits", "2h,4h"]].concat(),
            "4h,2.5h",
        ),
        (
            "ceqr",
            &[&both[..], &["--plane", "4"]].concat(),
            "for --report japan",
        ),
        (
            "ceqr",
            &[&both[..], &["--method", "fast"]].concat(),
            "leave --method out",
        ),
        (
            "ceqr",
            &[&both[..], &["--hours", "9-15"]].concat(),
            "which hours count",
        ),
        (
            "ceqr",
            &[&both[..], &["--season", "winter"]].concat(),
            "which days count",
        ),
        (
            "prop-k",
            &[&both[..], &["--date", "2026-06"]].concat(),
            "--year says of which year",
        ),
        (
            "ceqr",
            &[&both[..], &["--min-altitude", "5"]].concat(),
            "--min-altitude out",
        ),
        ("ceqr", &[&both[..], &["--disc"]].concat(), "--disc out"),
        (
            "bre",
            &[&areas[..], &["--date", "2026-03-20..2026-03-22"]].concat(),
            "one day",
        ),
        ("rome", &both, "prop-k"),
    ] {
        let talk = fail(
            folder,
            &[&["shadows", "city.geojson", "--report", rule], more].concat(),
            2,
        );
        assert!(talk.contains(said), "{rule} {more:?}: {talk}");
    }
    for wrong in [
        &["--resources", "park.geojson"][..],
        &["--plane", "4"],
        &["--hokkaido"],
    ] {
        let talk = fail(
            folder,
            &[&["shadows", "city.geojson", "--date", "2026-03-21"], wrong].concat(),
            2,
        );
        assert!(talk.contains("--report"), "{talk}");
    }
    // Names of files without an ending are for reports.
    let talk = fail(
        folder,
        &["shadows", "city.geojson", "--date", "2026-03-21", "-o", "a"],
        2,
    );
    assert!(talk.contains(".tif"), "{talk}");
}

#[test]
fn what_cannot_be_reported_is_told_with_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    berlin(folder);
    let run = |rule: &str, areas: &str| {
        let all = [
            "shadows",
            "city.geojson",
            "--report",
            rule,
            "--with",
            "tower.geojson",
            "--resources",
            areas,
            "-o",
            "out",
        ];
        fail(folder, &all, 1)
    };
    let talk = run("japan", "areas.geojson");
    assert!(
        talk.contains("areas.geojson: 5 areas") && talk.contains("one is wanted"),
        "{talk}"
    );
    std::fs::write(
        folder.join("none.geojson"),
        json!({"type": "FeatureCollection", "features": []}).to_string(),
    )
    .unwrap();
    let talk = run("ceqr", "none.geojson");
    assert!(
        talk.contains("none.geojson") && talk.contains("no polygon"),
        "{talk}"
    );
    let away = Town {
        latitude: 48.0,
        longitude: 11.0,
    };
    away.write_areas(folder, "away.geojson", &[("Away", [0.0, 0.0, 10.0, 10.0])]);
    let talk = run("ceqr", "away.geojson");
    assert!(
        talk.contains("away.geojson: Away lies more than 5 km outside of the city"),
        "{talk}"
    );
    let talk = run("ceqr", "missing.geojson");
    assert!(talk.contains("missing.geojson"), "{talk}");
    assert!(!folder.join("out.csv").exists());
}
