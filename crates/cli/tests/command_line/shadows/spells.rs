//! Stretches of shadow in a file, what is asked of it, and who shades whom.

use std::path::Path;

use serde_json::{Value, json};

use super::json as told;
use crate::{fail, succeed};

/// What a query prints.
fn query(folder: &Path, arguments: &[&str]) -> Value {
    let all = [&["shadows", "query"], arguments, &["--json", "--quiet"]].concat();
    serde_json::from_str(&succeed(folder, &all)).unwrap()
}

fn number(value: &Value, name: &str) -> f64 {
    value[name]
        .as_f64()
        .unwrap_or_else(|| panic!("{name} of {value}"))
}

/// The rows of a table by the names of its columns.
fn table(path: &Path) -> Vec<Value> {
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text
        .lines()
        .map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let row = |cells: Vec<String>| -> Value {
        names
            .iter()
            .cloned()
            .zip(cells.into_iter().map(Value::from))
            .collect::<serde_json::Map<_, _>>()
            .into()
    };
    lines.map(row).collect()
}

fn cell(row: &Value, name: &str) -> f64 {
    row[name].as_str().unwrap().parse().unwrap()
}

#[test]
fn a_file_answers_what_a_run_answers() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let demo = ["demo", "--cell", "8"];
    let days = ["--date", "2026-03-20..2026-03-22"];
    let all = told(
        folder,
        &[&demo[..], &days, &["--spells", "a.parquet"]].concat(),
    );
    let mean = |value: &Value| number(value, "minutes_mean");
    let asked = query(folder, &["a.parquet"]);
    assert_eq!(asked["places"], all["places"]);
    assert!(
        (mean(&asked) - mean(&all)).abs() < 1e-3,
        "{} {}",
        mean(&asked),
        mean(&all)
    );
    assert!((number(&asked, "sun_hours") - number(&all, "sun_hours")).abs() < 1e-5);
    // The same questions to the city itself.
    for more in [
        &["--hours", "11:00-13:30"][..],
        &["--solar-time", "08:00-10:00,14:00-16:00"],
        &["--date", "2026-03-21", "--after-sunrise", "90min"],
        &["--weekdays", "sat", "--min-altitude", "20"],
    ] {
        let own = [
            &demo[..],
            if more.contains(&"--date") { &[] } else { &days },
            more,
        ]
        .concat();
        let (own, asked) = (
            told(folder, &own),
            query(folder, &[&["a.parquet"], more].concat()),
        );
        assert!(
            (mean(&own) - mean(&asked)).abs() < 1e-3,
            "{more:?}: {own} {asked}"
        );
        assert!((number(&own, "sun_hours") - number(&asked, "sun_hours")).abs() < 1e-5);
    }
    // Weights: hours that count twice and a day that does not count.
    let weighed = query(
        folder,
        &[
            "a.parquet",
            "--weight",
            "11:00-13:30=3",
            "--weight",
            "2026-03-22=0",
        ],
    );
    let two = ["a.parquet", "--date", "2026-03-20..2026-03-21"];
    let (two, noon) = (
        query(folder, &two),
        query(folder, &[&two[..], &["--hours", "11:00-13:30"]].concat()),
    );
    let expected = mean(&two) + 2.0 * mean(&noon);
    assert!(
        (mean(&weighed) - expected).abs() < 1e-3,
        "{weighed} {expected}"
    );
}

#[test]
fn places_have_their_first_and_last_sun() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    // A wall of 100 m by 1 m, 20 m high, along a meridian, and a point 10 m to the east of it: in the morning it has sun.
    let (x, y) = (11.0, 48.0);
    let (east, north) = (1.0 / 74_600.0, 1.0 / 111_200.0);
    let (w, e, s, n) = (
        x - 11.0 * east,
        x - 10.0 * east,
        y - 50.0 * north,
        y + 50.0 * north,
    );
    let ring = [[w, s], [e, s], [e, n], [w, n], [w, s]];
    let wall = json!({"type": "Feature", "properties": {"height": 20.0, "id": "wall"}, "geometry": {"type": "Polygon", "coordinates": [ring]}});
    std::fs::write(folder.join("wall.geojson"), wall.to_string()).unwrap();
    std::fs::write(folder.join("point.csv"), format!("lon,lat\n{x},{y}\n")).unwrap();
    let day = ["--date", "2026-03-20", "--points", "point.csv"];
    let run = told(
        folder,
        &[&["wall.geojson"], &day[..], &["--spells", "wall.parquet"]].concat(),
    );
    query(folder, &["wall.parquet", "-o", "wall.csv"]);
    let rows = table(&folder.join("wall.csv"));
    let [row] = &rows[..] else { panic!("{rows:?}") };
    let (shadow, sun) = (cell(row, "shadow_minutes"), cell(row, "sun_minutes"));
    assert!((shadow - number(&run, "minutes_mean")).abs() < 0.01);
    assert!((shadow + sun - 60.0 * number(&run, "sun_hours")).abs() < 0.01);
    // Sun from sunrise to a time after noon, without a break.
    assert_eq!(row["spells"], "1");
    assert!((cell(row, "longest_sun_minutes") - sun).abs() < 0.01);
    let time = |name: &str| row[name].as_str().unwrap().to_owned();
    assert!(time("first_sun").starts_with("2026-03-20T06:"), "{row}");
    assert!(time("first_sun").ends_with("+01:00"), "{row}");
    assert!(
        time("last_sun").starts_with("2026-03-20T14:")
            || time("last_sun").starts_with("2026-03-20T13:"),
        "{row}"
    );
    // In the afternoon there is no sun but what little comes first.
    query(
        folder,
        &["wall.parquet", "--hours", "15:00-17:00", "-o", "late.csv"],
    );
    let rows = table(&folder.join("late.csv"));
    assert_eq!(
        (cell(&rows[0], "sun_minutes"), &rows[0]["first_sun"]),
        (0.0, &json!(""))
    );
    assert!((cell(&rows[0], "shadow_minutes") - 120.0).abs() < 1e-6);
}

#[test]
fn who_shades_whom_adds_up() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let run = told(
        folder,
        &[
            "demo",
            "--cell",
            "8",
            "--date",
            "2026-12-21",
            "--attribute",
            "-o",
            "by.geojson",
            "--by-building",
            "by.csv",
            "--spells",
            "by.parquet",
        ],
    );
    let file: Value =
        serde_json::from_slice(&std::fs::read(folder.join("by.geojson")).unwrap()).unwrap();
    let (mut sum, mut alone) = (0.0, 0.0);
    for feature in file["features"].as_array().unwrap() {
        let place = &feature["properties"];
        let by = place["by"].as_array().unwrap();
        let own: f64 = by.iter().map(|share| number(share, "minutes")).sum();
        if place["inside"] == true {
            assert!(by.is_empty());
            continue;
        }
        assert!((own - number(place, "minutes")).abs() < 1e-2, "{place}");
        for share in by {
            assert!(number(share, "alone") <= number(share, "minutes") + 1e-4);
            alone += number(share, "alone");
        }
        sum += own;
    }
    let rows = run["by_building"].as_array().unwrap();
    let of = |name: &str| rows.iter().map(|row| number(row, name)).sum::<f64>();
    assert!((of("place_minutes") - sum).abs() < 1e-3 * sum);
    assert!((of("alone") - alone).abs() < 1e-3 * alone);
    assert!((of("alone") + of("shared") - of("place_minutes")).abs() < 1e-6 * sum);
    let most = |rows: &[Value]| number(&rows[0], "place_minutes");
    assert!(
        rows.iter()
            .all(|row| number(row, "place_minutes") <= most(rows))
    );
    // The table and the file of spells say the same.
    let written = table(&folder.join("by.csv"));
    assert_eq!(written.len(), rows.len());
    assert!((cell(&written[0], "place_minutes") - most(rows)).abs() < 1e-2);
    let asked = query(folder, &["by.parquet", "--by-building", "again.csv"]);
    let again = asked["by_building"].as_array().unwrap();
    assert!(
        (most(again) - most(rows)).abs() < 1e-4 * most(rows),
        "{}",
        most(again)
    );
    // And the shadow of one building alone is what it takes.
    let first = format!("#{}", rows[0]["building"]);
    let own = query(
        folder,
        &["by.parquet", "--building", &first, "-o", "own.tif"],
    );
    let mean = most(rows) / run["places"].as_f64().unwrap();
    assert!((number(&own, "minutes_mean") - mean).abs() < 1e-3 * mean);
}

#[test]
fn the_same_bytes_with_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let bytes = |threads: &str| {
        let all = [
            "shadows",
            "demo",
            "--cell",
            "2",
            "--date",
            "2026-06-21",
            "--quiet",
            "--spells",
            "a.parquet",
            "--threads",
        ];
        succeed(folder, &[&all[..], &[threads]].concat());
        std::fs::read(folder.join("a.parquet")).unwrap()
    };
    assert!(bytes("1") == bytes("3"));
}

#[test]
fn after_a_change_it_is_of_the_changed_city() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let change = ["--without", "pavilion", "--height", "church=60m"];
    let same = [
        &["demo", "--cell", "8", "--date", "2026-12-21"],
        &change[..],
    ]
    .concat();
    let plain = told(folder, &[&same[..], &["-o", "change.geojson"]].concat());
    told(
        folder,
        &[&same[..], &["--spells", "a.parquet", "-o", "after.geojson"]].concat(),
    );
    let minutes = |name: &str| -> Vec<Value> {
        let file: Value =
            serde_json::from_slice(&std::fs::read(folder.join(name)).unwrap()).unwrap();
        let all = file["features"].as_array().unwrap().iter();
        all.map(|feature| feature["properties"]["minutes"].clone())
            .collect()
    };
    assert!(number(&plain, "net_mean").abs() > 0.1);
    let (change, after) = (minutes("change.geojson"), minutes("after.geojson"));
    assert_eq!(change.len(), after.len());
    for (change, after) in change.iter().zip(&after) {
        match (change.as_f64(), after.as_f64()) {
            (Some(change), Some(after)) => assert!((change - after).abs() < 1e-2),
            other => assert_eq!(other, (None, None)),
        }
    }
}

#[test]
fn days_far_apart_are_asked_for_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let days = ["--date", "1990-06-21,2026-12-20..2026-12-21"];
    let run = told(
        folder,
        &[
            &["demo", "--cell", "16"],
            &days[..],
            &["--spells", "a.parquet"],
        ]
        .concat(),
    );
    let asked = query(folder, &["a.parquet"]);
    assert_eq!(asked["when"], "1990-06-21,2026-12-20 to 2026-12-21");
    assert!((number(&run, "minutes_mean") - number(&asked, "minutes_mean")).abs() < 1e-3);
    assert!((number(&run, "sun_hours") - number(&asked, "sun_hours")).abs() < 1e-5);
    // A weight that is of none of it changes nothing, and is told.
    let idle = [
        "shadows",
        "query",
        "a.parquet",
        "--weight",
        "2027=5",
        "--json",
    ];
    let output = crate::run(folder, &idle);
    assert!(String::from_utf8_lossy(&output.stderr).contains("2027=5"));
    let idle: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(idle["minutes_mean"], asked["minutes_mean"]);
    assert_eq!(idle["weights"], json!(["2027=5"]));
}

#[test]
fn what_cannot_be_asked_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let demo = [
        "shadows",
        "demo",
        "--cell",
        "16",
        "--date",
        "2026-12-21",
        "--spells",
        "a.parquet",
    ];
    for (more, said) in [
        (&["--method", "fast"][..], "--method fast"),
        (&["--disc"], "--disc"),
        (&["--resume"], "--resume"),
    ] {
        assert!(
            fail(folder, &[&demo[..], more].concat(), 2).contains(said),
            "{more:?}"
        );
    }
    assert!(
        fail(
            folder,
            &["shadows", "demo", "--date", "2026", "--spells", "a.csv"],
            2
        )
        .contains(".parquet")
    );
    succeed(folder, &demo);
    let asked =
        |code: i32, more: &[&str]| fail(folder, &[&["shadows", "query"], more].concat(), code);
    assert!(asked(2, &[]).contains("<SPELLS>"));
    assert!(asked(1, &["none.parquet"]).contains("none.parquet"));
    assert!(asked(1, &["a.parquet", "--date", "2026-06-21"]).contains("2026-12-21"));
    assert!(asked(1, &["a.parquet", "--building", "nobody"]).contains("no such building"));
    assert!(asked(2, &["a.parquet", "--weight", "12:00-13:00"]).contains("=2"));
    assert!(asked(2, &["a.parquet", "--weight", "someday=2"]).contains("someday"));
    assert!(asked(2, &["a.parquet", "-o", "b.png"]).contains(".csv"));
    assert!(asked(2, &["a.parquet", "--time-zone", "Foo/Bar"]).contains("Europe/Berlin"));
    assert!(asked(2, &["a.parquet", "--year", "2019"]).contains("--year"));
    assert!(asked(2, &["a.parquet", "-o", "q.csv", "--by-building", "q.csv"]).contains("twice"));
    assert!(asked(2, &["a.parquet", "-o", "q.csv", "--hours", "9"]).contains("09:00-15:30"));
    // Four buildings of the city that is built in have this name.
    let several = asked(1, &["a.parquet", "--building", "tower"]);
    assert!(
        several.contains("4 buildings") && several.contains("#125"),
        "{several}"
    );
    for (more, said) in [
        (&["--attribute"][..], "--json"),
        (&["--spells", "x.parquet", "-o", "./x.parquet"], "twice"),
    ] {
        let all = [&["shadows", "demo", "--date", "2026-12-21"], more].concat();
        assert!(fail(folder, &all, 2).contains(said), "{more:?}");
    }
    std::fs::write(folder.join("b.parquet"), b"PAR1 and no more").unwrap();
    assert!(asked(1, &["b.parquet"]).contains("b.parquet"));
}
