//! From a city to the map of its shadow.

use serde_json::Value;

mod asked;
mod places;
mod products;
mod reports;
mod resumed;
mod spells;
mod tutorial;
mod what_if;

use crate::{fail, outside_data, succeed};

fn json(folder: &std::path::Path, arguments: &[&str]) -> Value {
    let all = [&["shadows"], arguments, &["--json", "--quiet"]].concat();
    serde_json::from_str(&succeed(folder, &all)).unwrap()
}

#[test]
fn the_built_in_city_makes_three_maps() {
    let folder = tempfile::tempdir().unwrap();
    succeed(folder.path(), &["shadows", "demo", "--cell", "4"]);
    let mut files: Vec<_> = std::fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    files.sort();
    assert_eq!(
        files,
        ["demo-spring-fall.png", "demo-summer.png", "demo-winter.png"]
    );
}

#[test]
fn shadow_is_longer_in_winter_and_both_methods_agree() {
    let folder = tempfile::tempdir().unwrap();
    let share = |date: &str, method: &[&str]| {
        let all = [&["demo", "--date", date, "--cell", "5"], method].concat();
        let told = json(folder.path(), &all);
        told["minutes_mean"].as_f64().unwrap() / (60.0 * told["sun_hours"].as_f64().unwrap())
    };
    let (winter, summer) = (share("2026-12-21", &[]), share("2026-06-21", &[]));
    assert!(winter > 1.3 * summer, "{winter} and {summer}");
    let sampled = share("2026-12-21", &["--method", "sampled", "--step", "2min"]);
    assert!((winter - sampled).abs() < 0.002, "{winter} and {sampled}");
}

#[test]
fn the_sun_as_a_disc_is_covered_in_part() {
    let folder = tempfile::tempdir().unwrap();
    let told = |more: &[&str]| {
        let all = [&["demo", "--date", "2026-12-21", "--cell", "8"], more].concat();
        json(folder.path(), &all)
    };
    let mean = |told: &Value| told["minutes_mean"].as_f64().unwrap();
    let (point, disc) = (told(&[]), told(&["--disc", "-o", "disc.tif"]));
    assert_eq!(
        (&point["sun_points"], &disc["sun_points"]),
        (&1.into(), &7.into())
    );
    assert_eq!(point["sun_hours"], disc["sun_hours"]);
    // Edges of shadows grow soft, on both sides of where they were.
    let apart = (mean(&point) - mean(&disc)).abs();
    assert!(apart > 0.0 && apart < 1.0, "{apart}");
    let most = disc["minutes_most"].as_f64().unwrap();
    assert!(most <= 60.0 * disc["sun_hours"].as_f64().unwrap() + 1e-3);
    let sampled = told(&["--disc", "--method", "sampled", "--step", "2min"]);
    let apart = (mean(&sampled) - mean(&disc)).abs();
    assert!(apart < 0.5, "{apart}");
    let written = std::fs::read(folder.path().join("disc.tif")).unwrap();
    let said = b"the sun is a disc of 7 points";
    assert!(written.windows(said.len()).any(|bytes| bytes == said));
}

#[test]
fn some_days_stand_for_a_year_and_say_how_well() {
    let folder = tempfile::tempdir().unwrap();
    let told = |more: &[&str]| {
        let all = [&["demo", "--date", "2026", "--cell", "8"], more].concat();
        json(folder.path(), &all)
    };
    let (every, some) = (told(&[]), told(&["--method", "fast", "-o", "year.tif"]));
    let mean = |told: &Value| told["minutes_mean"].as_f64().unwrap();
    let up = 60.0 * every["sun_hours"].as_f64().unwrap();
    assert!((mean(&every) - mean(&some)).abs() < 0.001 * up);
    assert_eq!(every.get("some_days"), None);
    let found = &some["some_days"];
    let days = found["days"].as_u64().unwrap();
    assert!((5..180).contains(&days), "{days}");
    let compared = &found["compared"];
    assert!(compared["places"].as_u64().unwrap() > 100);
    let most = compared["most"].as_f64().unwrap();
    assert!(most > 0.0 && most <= 0.2, "{most}");
    let written = std::fs::read(folder.path().join("year.tif")).unwrap();
    let said = format!("{days} of 365 days stand for all, within 0.5 %");
    assert!(
        written
            .windows(said.len())
            .any(|bytes| bytes == said.as_bytes())
    );

    // Without a tolerance it is every day.
    let all = told(&["--method", "fast", "--tolerance", "0"]);
    assert_eq!(all["some_days"]["days"], 0);
    assert_eq!(all["minutes_mean"], every["minutes_mean"]);
    let wrong = [
        "shadows",
        "demo",
        "--date",
        "2026",
        "--method",
        "fast",
        "--tolerance",
        "half",
    ];
    let said = fail(folder.path(), &wrong, 2);
    assert!(said.contains("0 to 10 percent are wanted"), "{said}");
}

#[test]
fn months_add_up_to_the_quarter_and_threads_change_no_byte() {
    let folder = tempfile::tempdir().unwrap();
    let mean = |date: &str| {
        let told = json(folder.path(), &["demo", "--date", date, "--cell", "20"]);
        told["minutes_mean"].as_f64().unwrap()
    };
    let months: f64 = ["2026-01", "2026-02", "2026-03"]
        .into_iter()
        .map(mean)
        .sum();
    assert!((months - mean("2026-01-01..2026-03-31")).abs() < 0.01);
    let write = |threads: &str, name: &str| {
        let all = [
            "demo",
            "--date",
            "2026-03-21",
            "--cell",
            "4",
            "--threads",
            threads,
            "--png",
            name,
        ];
        json(folder.path(), &all);
        std::fs::read(folder.path().join(name)).unwrap()
    };
    assert_eq!(write("1", "a.png"), write("3", "b.png"));
}

#[test]
fn what_is_asked_wrongly_is_exit_code_2() {
    let folder = tempfile::tempdir().unwrap();
    let day = ["--date", "2026-12-21"];
    for (wrong, told) in [
        (&["--date", "2026-13-01"][..], "2026-13-01"),
        (&["--date", "2026-02-29"], "2026-02-29"),
        (&["--season", "monsoon"], "winter"),
        (&["--from", "2026-01-01"], "--to"),
        (&["--date", "2026", "--months", "smarch"], "smarch"),
        (&[day[0], day[1], "--hours", "15:00-09"], "15:00-09"),
        (&[day[0], day[1], "--cell", "0"], "metres"),
        (&[day[0], day[1], "--cell", "0.001"], "0.01"),
        (&[day[0], day[1], "--area", "1,2,3"], "west"),
        (&[day[0], day[1], "--time-zone", "Mars"], "Europe/Berlin"),
        (&[day[0], day[1], "--year", "99"], "99"),
        (&[day[0], day[1], "--step", "0s"], "second"),
        (
            &[
                "--date",
                "2000-01-01..2090-01-01",
                "--method",
                "sampled",
                "--step",
                "1s",
            ],
            "longer steps",
        ),
        (
            &["--date", "2000-01-01..2029-12-31", "--disc"],
            "--disc: 10958 days are more than 5228",
        ),
        (
            &[
                "--date",
                "2020-01-01..2029-12-31",
                "--disc",
                "--method",
                "sampled",
            ],
            "longer steps",
        ),
        (&["--json"], "--date"),
        (&[day[0], day[1], "--crs", "EPSG:1"], "EPSG:1"),
        (&[day[0], day[1], "-o", "a.jpeg"], ".tif"),
        (&[day[0], day[1], "--png", "a.tif"], ".png"),
        (&[day[0], day[1], "--min-altitude", "91"], "91"),
    ] {
        let talk = fail(folder.path(), &[&["shadows", "demo"], wrong].concat(), 2);
        assert!(talk.contains(told), "{wrong:?}: {talk}");
    }
    let talk = fail(folder.path(), &["shadows", "city.geojson"], 2);
    assert!(talk.contains("--date 2026-12-21"), "{talk}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn what_fails_is_exit_code_1() {
    let folder = tempfile::tempdir().unwrap();
    let talk = fail(
        folder.path(),
        &["shadows", "none.geojson", "--date", "2026"],
        1,
    );
    assert!(talk.contains("none.geojson"), "{talk}");
    let night = [
        "shadows",
        "demo",
        "--date",
        "2026-12-21",
        "--hours",
        "01:00-02:00",
    ];
    let talk = fail(folder.path(), &night, 1);
    assert!(
        talk.contains("nothing is left of the 9.1 h of sun"),
        "{talk}"
    );
}

#[test]
fn a_real_city_is_measured() {
    let Some(data) = outside_data() else { return };
    let folder = tempfile::tempdir().unwrap();
    let city = data.join("city/geojson/lower_manhattan_nyc_opendata.geojson");
    let city = city.to_str().unwrap();
    let told = json(
        folder.path(),
        &[
            city,
            "--date",
            "2026-12-21",
            "--cell",
            "10",
            "-o",
            "a.tif",
            "--png",
            "a.png",
        ],
    );
    assert_eq!(told["buildings"], 650);
    assert_eq!(told["time_zone"], "America/New_York");
    // From sunrise to sunset, of the middle of the sun and without air.
    assert!(
        (told["sun_hours"].as_f64().unwrap() - 9.08).abs() < 0.05,
        "{told}"
    );
    assert!(folder.path().join("a.tif").is_file() && folder.path().join("a.png").is_file());
}
