//! Sun in gardens and at windows, and shadow around a site, against rays to a few boxes.

use ombra::sun::Hours;
use serde_json::Value;

use super::boxes::{Block, Town, instants, is_dark, number, origin, places, sky};
use super::report;

const LONDON: Town = Town {
    latitude: 51.5,
    longitude: -0.12,
};
const TOKYO: Town = Town {
    latitude: 35.6895,
    longitude: 139.6917,
};

#[test]
fn two_hours_of_sun_are_what_rays_count() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let old = [Block([-30.0, -25.0, 30.0, -15.0], 9.0)];
    let new = [
        Block([-25.0, -60.0, 25.0, -40.0], 45.0),
        Block([32.0, -15.0, 40.0, 20.0], 30.0),
    ];
    LONDON.write_blocks(folder, "city.geojson", &old);
    LONDON.write_blocks(folder, "flats.geojson", &new);
    LONDON.write_areas(
        folder,
        "garden.geojson",
        &[("Garden", [-28.0, -12.0, 28.0, 16.0])],
    );
    let arguments = [
        "city.geojson",
        "--report",
        "bre",
        "--year",
        "2026",
        "--with",
        "flats.geojson",
        "--resources",
        "garden.geojson",
    ];
    let origin = origin(folder, "city.geojson");
    let (sky, places) = (sky(&origin), places(folder, "garden.geojson", &origin, 1.0));
    let (old, new) = (LONDON.local(&origin, &old), LONDON.local(&origin, &new));
    let both = [&old[..], &new].concat();
    let zone = jiff::tz::TimeZone::get("Europe/London").unwrap();
    for (altitude, more) in [(10.0, &[][..]), (0.0, &["--min-altitude", "0"])] {
        let told = report(folder, &[&arguments[..], more].concat());
        let row = &told["rows"][0];
        let up = Hours::default().with_min_altitude(altitude).unwrap();
        let span = up.spans(&sky, &zone, jiff::civil::date(2026, 3, 21))[0];
        let (step, looks) = instants(span.start, span.end, 20.0);
        let suns: Vec<[f64; 3]> = looks.iter().map(|&look| sky.direction(look)).collect();
        let share = |blocks: &[Block]| {
            let sun = |place: &[f64; 2]| {
                suns.iter()
                    .filter(|sun| !is_dark(blocks, *place, 0.0, **sun))
                    .count() as f64
                    * step
            };
            let enough = places.iter().filter(|place| sun(place) >= 7200.0).count();
            100.0 * enough as f64 / places.len() as f64
        };
        let (before, after) = (share(&old), share(&both));
        assert!(
            (number(row, "two_hours_before_percent") - before).abs() < 0.8,
            "{before}: {row}"
        );
        assert!(
            (number(row, "two_hours_after_percent") - after).abs() < 0.8,
            "{after}: {row}"
        );
        let passes = after >= 50.0 || after >= 0.8 * before;
        assert_eq!(row["result"], if passes { "pass" } else { "fail" }, "{row}");
        assert_eq!(row["half_after"], after >= 50.0);
        assert!((number(row, "ratio") - after / before).abs() < 0.02);
    }
}

#[test]
fn windows_have_the_level_that_their_sun_says() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    LONDON.write_blocks(
        folder,
        "city.geojson",
        &[Block([-10.0, 0.0, 10.0, 10.0], 12.0)],
    );
    LONDON.write_blocks(
        folder,
        "flats.geojson",
        &[Block([-40.0, -30.0, 40.0, -20.0], 30.0)],
    );
    // On the wall to the south and to the north, and inside.
    let points = [[0.0, -0.05], [0.0, 10.05], [0.0, 5.0]];
    let feature = |at: [f64; 2]| {
        let mut feature = LONDON.feature([at[0], at[1], at[0], at[1]], Value::Null);
        let corner = feature["geometry"]["coordinates"][0][0].clone();
        let with_height = [corner[0].clone(), corner[1].clone(), 1.5.into()];
        feature["geometry"] = serde_json::json!({"type": "Point", "coordinates": with_height});
        feature
    };
    LONDON.write(folder, "windows.geojson", &points.map(feature));
    let run = |more: &[&str]| {
        let all = [
            "city.geojson",
            "--report",
            "bre",
            "--year",
            "2026",
            "--points",
            "windows.geojson",
        ];
        report(folder, &[&all[..], more].concat())
    };
    let free = run(&["--min-altitude", "11"]);
    let level =
        |told: &Value, point: usize| told["rows"][point]["level"].as_str().map(str::to_owned);
    assert_eq!(level(&free, 0).as_deref(), Some("high"));
    assert_eq!(level(&free, 1).as_deref(), Some("below the minimum"));
    assert!(
        free["rows"][2]["result"]
            .as_str()
            .unwrap()
            .starts_with("not measured")
    );
    assert_eq!(free["rows"][0]["sun_before_h"], Value::Null);
    // The slab stands before all of the sun between 45.6° to either side, and is as high as 55°.
    let built = run(&["--min-altitude", "11", "--with", "flats.geojson"]);
    assert!(number(&built["rows"][0], "sun_before_h") > 8.0);
    let origin = origin(folder, "city.geojson");
    let sky = sky(&origin);
    let blocks = LONDON.local(
        &origin,
        &[
            Block([-40.0, -30.0, 40.0, -20.0], 30.0),
            Block([-10.0, 0.0, 10.0, 10.0], 12.0),
        ],
    );
    let zone = jiff::tz::TimeZone::get("Europe/London").unwrap();
    let up = Hours::default().with_min_altitude(11.0).unwrap();
    let span = up.spans(&sky, &zone, jiff::civil::date(2026, 3, 21))[0];
    let (step, looks) = instants(span.start, span.end, 5.0);
    let [x, y] = blocks[1]
        .0
        .get(..2)
        .map(|corner| [corner[0] + 10.0, corner[1] - 0.05])
        .unwrap();
    let sun = looks
        .iter()
        .filter(|&&look| !is_dark(&blocks, [x, y], 1.5, sky.direction(look)));
    let hours = sun.count() as f64 * step / 3600.0;
    assert!(
        (number(&built["rows"][0], "sun_h") - hours).abs() < 0.01,
        "{hours}: {}",
        built["rows"][0]
    );
}

#[test]
fn hours_around_a_site_are_what_rays_count() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    // What stands there already does not count.
    let old = [
        Block([-60.0, 30.0, 60.0, 42.0], 30.0),
        Block([-60.0, -42.0, 60.0, -30.0], 30.0),
    ];
    let new = [Block([-12.0, -6.0, 12.0, 6.0], 20.0)];
    TOKYO.write_blocks(folder, "city.geojson", &old);
    TOKYO.write_blocks(folder, "flats.geojson", &new);
    TOKYO.write_areas(
        folder,
        "site.geojson",
        &[("site", [-18.0, -12.0, 18.0, 12.0])],
    );
    let told = report(
        folder,
        &[
            "city.geojson",
            "--report",
            "japan",
            "--year",
            "2026",
            "--with",
            "flats.geojson",
            "--resources",
            "site.geojson",
            "--limits",
            "5h,3h",
        ],
    );
    assert_eq!(
        (&told["plane_m"], &told["clock"]),
        (&4.0.into(), &"JST".into())
    );
    let when = told["when"].as_str().unwrap();
    assert!(
        when.starts_with("2026-12-22, 08:00-16:00 true solar time"),
        "{when}"
    );
    let origin = origin(folder, "city.geojson");
    let (sky, new) = (sky(&origin), TOKYO.local(&origin, &new));
    // Four hours to either side of when the sun is due south.
    let noon: jiff::Timestamp = "2026-12-22T03:00:00Z".parse().unwrap();
    let noon = sky.at_solar_time(43_200.0, ombra::sun::Instant::from(noon));
    let (step, looks) = instants(noon + -4.0 * 3600.0, noon + 4.0 * 3600.0, 5.0);
    let suns: Vec<[f64; 3]> = looks.iter().map(|&look| sky.direction(look)).collect();
    let hours = |at: [f64; 2]| {
        let dark = suns
            .iter()
            .filter(|sun| is_dark(&new, at, 4.0, **sun))
            .count();
        dark as f64 * step / 3600.0
    };
    let limits = [5.0, 3.0];
    let Block([west, south, east, north], _) = new[0];
    let middle = [0.5 * (west + east), 0.5 * (south + north)];
    for ((row, limit), distance) in told["rows"]
        .as_array()
        .unwrap()
        .iter()
        .zip(limits)
        .zip([5.0, 10.0])
    {
        let most = number(row, "most_h");
        let there = [number(row, "east_m"), number(row, "north_m")];
        assert!(
            (hours(there) - most).abs() < 0.01,
            "{} at {row}",
            hours(there)
        );
        assert_eq!(row["result"], if most < limit { "pass" } else { "fail" });
        // Nowhere along the line to the north is there more.
        let along =
            (-60..60).map(|k| hours([middle[0] + 0.4 * f64::from(k), middle[1] + 12.0 + distance]));
        let longest = along.fold(0.0, f64::max);
        assert!(
            most > longest - 0.01 && most < longest + 0.02,
            "{longest}: {row}"
        );
    }
    let contours = told["contours"]["features"].as_array().unwrap();
    let mut looked_at = 0;
    for contour in contours {
        let level = number(&contour["properties"], "hours");
        for at in contour["geometry"]["coordinates"]
            .as_array()
            .unwrap()
            .iter()
            .step_by(7)
        {
            let at = origin.to_local([0, 1].map(|k| at[k].as_f64().unwrap()));
            // Near the walls hours jump. Elsewhere there are more and fewer of them a cell away.
            let beside = (at[0] - middle[0]).abs().max((at[1] - middle[1]).abs());
            if beside > 16.0 {
                let around = [[0.7, 0.7], [-0.7, 0.7], [-0.7, -0.7], [0.7, -0.7]];
                let around = around.map(|[x, y]| hours([at[0] + x, at[1] + y]));
                let least = around.into_iter().fold(f64::INFINITY, f64::min);
                let most = around.into_iter().fold(0.0, f64::max);
                assert!(
                    least - 0.01 < level && level < most + 0.01,
                    "{level} and {around:?}"
                );
                looked_at += 1;
            }
        }
    }
    assert!(looked_at > 20, "{looked_at}");
}
