//! Reports by a rule.

mod against_rays;
mod asked;
mod boxes;
mod shapes;
mod skies;
mod sun_against_rays;

use std::path::Path;

use serde_json::Value;

use boxes::{Block, Town};

use crate::{fail, outside_data, run, succeed};

/// What `--json` prints.
fn report(folder: &Path, arguments: &[&str]) -> Value {
    let all = [&["shadows"], arguments, &["--json", "--quiet"]].concat();
    serde_json::from_str(&succeed(folder, &all)).unwrap()
}

const BERLIN: Town = Town {
    latitude: 52.5,
    longitude: 13.4,
};

/// A house, a tower to the south of a park, and areas of all kinds.
fn berlin(folder: &Path) {
    BERLIN.write_blocks(
        folder,
        "city.geojson",
        &[Block([100.0, 0.0, 120.0, 20.0], 12.0)],
    );
    BERLIN.write_blocks(
        folder,
        "tower.geojson",
        &[Block([-10.0, -30.0, 10.0, -10.0], 60.0)],
    );
    let areas = [
        ("Park", [-20.0, 0.0, 20.0, 40.0]),
        ("Court", [105.0, 5.0, 115.0, 15.0]),
        ("Bed", [-50.0, 0.0, -49.9, 0.1]),
        ("Foot", [-8.0, -28.0, 8.0, -12.0]),
        ("Far", [-20.0, -200.0, 20.0, -160.0]),
    ];
    BERLIN.write_areas(folder, "areas.geojson", &areas);
    BERLIN.write_areas(folder, "park.geojson", &areas[..1]);
}

const CEQR: [&str; 8] = [
    "city.geojson",
    "--report",
    "ceqr",
    "--date",
    "2026-03-21",
    "--with",
    "tower.geojson",
    "--resources",
];

#[test]
fn areas_without_places_are_told_and_have_no_numbers() {
    let folder = tempfile::tempdir().unwrap();
    berlin(folder.path());
    let told = report(folder.path(), &[&CEQR[..], &["areas.geojson"]].concat());
    let results: Vec<&str> = told["rows"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row["result"].as_str().unwrap())
        .collect();
    assert_eq!(
        results,
        [
            "yes",
            "not measured",
            "not measured",
            "not measured",
            "none"
        ]
    );
    assert_eq!(told["rows"][1]["largest_m2"], Value::Null);
    let findings = told["findings"].to_string();
    for said in [
        "Court: lies wholly in buildings; it",
        "Bed: no place of the grid of 1 m lies in its 0.0 m²",
        "Foot: lies wholly in buildings once",
    ] {
        assert!(findings.contains(said), "{said}: {findings}");
    }
    assert_eq!(told["summary"].as_array().unwrap().len(), 2);
    for rule in ["prop-k", "bre"] {
        let mut all = vec![
            "city.geojson",
            "--report",
            rule,
            "--year",
            "2026",
            "--cell",
            "4",
        ];
        all.extend(["--with", "tower.geojson", "--resources", "areas.geojson"]);
        let told = report(folder.path(), &all);
        let results = told["rows"]
            .as_array()
            .unwrap()
            .iter()
            .map(|row| row["result"] == "not measured");
        assert_eq!(
            results.collect::<Vec<_>>(),
            [false, true, true, true, false],
            "{rule}"
        );
    }
}

#[test]
fn an_area_in_part_built_over_keeps_its_rest() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    berlin(folder);
    BERLIN.write_areas(
        folder,
        "square.geojson",
        &[("Square", [-20.0, -40.0, 20.0, 0.0])],
    );
    let told = report(folder, &[&CEQR[..], &["square.geojson"]].concat());
    let square = &told["resources"][0];
    assert!((square["area_m2"].as_f64().unwrap() - 1600.0).abs() < 0.1);
    assert!((square["open_m2"].as_f64().unwrap() - 1200.0).abs() < 1.0);
    assert!((square["built_over"].as_f64().unwrap() - 400.0).abs() < 1.0);
    assert!(
        told["findings"][0]
            .as_str()
            .unwrap()
            .contains("built over 25.0 %"),
        "{}",
        told["findings"]
    );
}

#[test]
fn times_do_not_follow_summer_time() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let town = Town {
        latitude: 40.75,
        longitude: -73.98,
    };
    town.write_blocks(
        folder,
        "city.geojson",
        &[Block([100.0, 0.0, 120.0, 20.0], 12.0)],
    );
    town.write_blocks(
        folder,
        "tower.geojson",
        &[Block([-10.0, -30.0, 10.0, -10.0], 60.0)],
    );
    town.write_areas(
        folder,
        "park.geojson",
        &[("Park", [-20.0, 0.0, 20.0, 40.0])],
    );
    // The days before, on and after which the clock is put forward and back.
    let days = "2026-03-07,2026-03-08,2026-03-09,2026-10-31,2026-11-01,2026-11-02";
    let all = [
        "city.geojson",
        "--report",
        "ceqr",
        "--date",
        days,
        "--with",
        "tower.geojson",
        "--resources",
        "park.geojson",
    ];
    let told = report(folder, &all);
    assert_eq!(
        (&told["clock"], &told["time_zone"]),
        (&"EST".into(), &"America/New_York".into())
    );
    let rows = told["rows"].as_array().unwrap();
    let minute = |row: &Value| {
        let text = row["from"].as_str().unwrap();
        assert!(text.ends_with("-05:00"), "{text}");
        text[11..13].parse::<f64>().unwrap() * 60.0 + text[14..16].parse::<f64>().unwrap()
    };
    for days in rows.chunks(3) {
        let [a, b, c] = [0, 1, 2].map(|k| minute(&days[k]));
        assert!((a - b).abs() <= 2.0 && (b - c).abs() <= 2.0, "{a} {b} {c}");
    }
    // Sunrise on 8 March 2026 is at 06:18 EST by almanacs.
    assert!(
        (minute(&rows[1]) - (6.0 * 60.0 + 18.0 + 90.0)).abs() <= 1.0,
        "{}",
        rows[1]
    );
    // In civil time the hour shows.
    let all = [
        "city.geojson",
        "--report",
        "prop-k",
        "--year",
        "2026",
        "--cell",
        "8",
        "--with",
        "tower.geojson",
        "--resources",
        "park.geojson",
    ];
    assert_eq!(report(folder, &all)["clock"], "EST and EDT");
}

#[test]
fn a_report_is_three_files_that_need_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    berlin(folder);
    let write = |output: &str, threads: &str| {
        let more = ["park.geojson", "-o", output, "--threads", threads];
        succeed(folder, &[&["shadows"], &CEQR[..], &more].concat())
    };
    write("a", "1");
    write("one.csv", "1");
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let first = ["a.csv", "a.json", "a.html"].map(read);
    write("a", "2");
    assert_eq!(
        ["a.csv", "a.json", "a.html"].map(read),
        first,
        "with any number of threads"
    );
    let [csv, json, html] = first;
    assert_eq!(read("one.csv"), csv);
    assert!(!folder.join("one.csv.csv").exists() && !folder.join("one.json").exists());
    assert_eq!(csv.lines().count(), 2);
    assert!(
        csv.starts_with("resource,day,from,to,result,enters,exits,"),
        "{csv}"
    );
    let json: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(
        json["command"],
        "ombra shadows city.geojson --report ceqr --date 2026-03-21 --with tower.geojson --resources park.geojson -o a"
    );
    assert_eq!(json["rows"][0]["resource"], "Park");
    for said in [
        "Technical Manual",
        "chapter 8",
        "<figure>",
        "Park",
        "EST",
        "ombra 0",
    ]
    .iter()
    .filter(|said| **said != "EST")
    {
        assert!(html.contains(said), "{said}");
    }
    let more = [
        "park.geojson",
        "-o",
        "titled.html",
        "--title",
        "Tower & Park",
    ];
    succeed(folder, &[&["shadows"], &CEQR[..], &more].concat());
    let titled = read("titled.html");
    assert!(titled.contains("<h1>Tower &amp; Park</h1>"));
    assert!(
        titled.contains(
            "<p>Incremental shadow (New York, CEQR) · city.geojson · with tower.geojson · "
        )
    );
    // The only address in it is the name of SVG.
    let addresses = html.matches("http").count();
    assert_eq!(
        addresses,
        html.matches("xmlns=\"http://www.w3.org/2000/svg\"").count()
    );
    for request in ["<link", "<script", "src=", "url(", "@import"] {
        assert!(!html.contains(request), "{request}");
    }
    // Nothing is written of a run that fails, and nothing is said of what is read.
    let more = ["park.geojson", "-o", "no/such"];
    let talk = fail(folder, &[&["shadows"], &CEQR[..], &more].concat(), 1);
    assert!(talk.contains("does not exist"), "{talk}");
    std::fs::copy(folder.join("park.geojson"), folder.join("park.json")).unwrap();
    let talk = fail(
        folder,
        &[&["shadows"], &CEQR[..], &["park.json", "-o", "park"]].concat(),
        2,
    );
    assert!(talk.contains("is a file that is read"), "{talk}");
}

#[test]
fn a_real_city_is_reported() {
    let Some(data) = outside_data() else { return };
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    // A tower beside City Hall Park.
    let town = Town {
        latitude: 40.7127,
        longitude: -74.0060,
    };
    town.write_blocks(
        folder,
        "tower.geojson",
        &[Block([-20.0, -160.0, 20.0, -120.0], 250.0)],
    );
    town.write_areas(
        folder,
        "park.geojson",
        &[("City Hall Park", [-70.0, -60.0, 60.0, 80.0])],
    );
    let city = data.join("city/geojson/lower_manhattan_nyc_opendata.geojson");
    let all = [
        "shadows",
        city.to_str().unwrap(),
        "--report",
        "ceqr",
        "--year",
        "2026",
        "--cell",
        "3",
        "--with",
        "tower.geojson",
        "--resources",
        "park.geojson",
        "-o",
        "out",
    ];
    let output = run(folder, &all);
    let talk = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{talk}");
    assert!(
        talk.contains("City Hall Park: incremental shadow on "),
        "{talk}"
    );
    assert!(std::fs::read(folder.join("out.html")).unwrap().len() > 20_000);
}
