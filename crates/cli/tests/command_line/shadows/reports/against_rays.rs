//! New shadow of a day and of a year against rays to a few boxes, found out here by slabs, every few seconds.

use ombra::sun::Hours;
use serde_json::Value;

use super::boxes::{Block, Town, instant, instants, is_dark, number, origin, places, sky};
use super::{CEQR, report};

const NEW_YORK: Town = Town {
    latitude: 40.75,
    longitude: -73.98,
};
const SAN_FRANCISCO: Town = Town {
    latitude: 37.775,
    longitude: -122.418,
};

#[test]
fn incremental_shadow_is_what_rays_see() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let old = [Block([-60.0, 10.0, -40.0, 40.0], 30.0)];
    let new = [Block([-10.0, -60.0, 15.0, -35.0], 90.0)];
    NEW_YORK.write_blocks(folder, "city.geojson", &old);
    NEW_YORK.write_blocks(folder, "tower.geojson", &new);
    NEW_YORK.write_areas(
        folder,
        "parks.geojson",
        &[("Park", [-35.0, 0.0, 45.0, 60.0])],
    );
    let told = report(
        folder,
        &[
            "city.geojson",
            "--report",
            "ceqr",
            "--year",
            "2026",
            "--cell",
            "4",
            "--with",
            "tower.geojson",
            "--resources",
            "parks.geojson",
        ],
    );
    let origin = origin(folder, "city.geojson");
    let (sky, places) = (sky(&origin), places(folder, "parks.geojson", &origin, 4.0));
    let (old, new) = (NEW_YORK.local(&origin, &old), NEW_YORK.local(&origin, &new));
    let both = [&old[..], &new].concat();
    let rows = told["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 4);
    let each = 80.0 * 60.0 / places.len() as f64;
    let mut reached = 0;
    for row in rows {
        let (from, to) = (instant(&row["from"]), instant(&row["to"]));
        let (step, looks) = instants(from, to, 10.0);
        let count = |&at: &ombra::sun::Instant| {
            let sun = sky.direction(at);
            let is_new = |place: &&[f64; 2]| {
                !is_dark(&old, **place, 0.0, sun) && is_dark(&both, **place, 0.0, sun)
            };
            places.iter().filter(is_new).count()
        };
        let counts: Vec<usize> = looks.iter().map(count).collect();
        let most = *counts.iter().max().unwrap();
        if most == 0 {
            assert_eq!(row["result"], "none", "{row}");
            assert_eq!(row["largest_m2"], Value::Null);
            continue;
        }
        reached += 1;
        assert_eq!(row["result"], "yes", "{row}");
        let first = counts.iter().position(|&count| count > 0).unwrap();
        let last = counts.iter().rposition(|&count| count > 0).unwrap();
        assert!(
            (instant(&row["enters"]) - looks[first]).abs() <= step + 1.0,
            "{row}"
        );
        assert!(
            (instant(&row["exits"]) - looks[last]).abs() <= step + 1.0,
            "{row}"
        );
        let any = counts.iter().filter(|&&count| count > 0).count() as f64 * step / 60.0;
        assert!(
            (number(row, "duration_minutes") - any).abs() < 1.5,
            "{any}: {row}"
        );
        let largest = most as f64 * each;
        let apart = number(row, "largest_m2") - largest;
        // Between two looks it may be a place more.
        assert!(
            (-0.2..2.0 * each + 0.2).contains(&apart),
            "{largest}: {row}"
        );
        let at = sky.direction(instant(&row["largest_at"]) + 1.0);
        let then = places
            .iter()
            .filter(|place| is_dark(&new, **place, 0.0, at))
            .count();
        assert!(then + 1 >= most, "{then} of {most}");
        let integrated = counts.iter().sum::<usize>() as f64 * step / 3600.0 * each;
        let apart = number(row, "integrated_m2_h") / integrated - 1.0;
        assert!(apart.abs() < 2e-3, "{integrated}: {row}");
        let feet = number(row, "integrated_ft2_h") / number(row, "integrated_m2_h");
        assert!((feet - 10.7639).abs() < 0.01, "{feet}");
    }
    assert!(
        (2..4).contains(&reached),
        "{reached}: the June sun stands too high"
    );
}

/// At an equinox the tip of a shadow goes along a straight line: so far to the north of what throws it as the tangent of the latitude
/// is times its height, which is 86.2 m here; a day later it is 84.9 m.
#[test]
fn at_the_equinox_a_shadow_reaches_as_far_as_the_latitude_says() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    NEW_YORK.write_blocks(
        folder,
        "city.geojson",
        &[Block([300.0, -30.0, 310.0, -20.0], 3.0)],
    );
    NEW_YORK.write_blocks(
        folder,
        "tower.geojson",
        &[Block([-10.0, -20.0, 10.0, 0.0], 100.0)],
    );
    let strips = [
        ("reached", [-60.0, 78.0, 60.0, 83.5]),
        ("beyond", [-60.0, 87.5, 60.0, 95.0]),
    ];
    NEW_YORK.write_areas(folder, "strips.geojson", &strips);
    let told = report(folder, &[&CEQR[..], &["strips.geojson"]].concat());
    let rows = told["rows"].as_array().unwrap();
    assert_eq!(
        (&rows[0]["result"], &rows[1]["result"]),
        (&"yes".into(), &"none".into())
    );
    assert_eq!(
        told["summary"][1],
        "beyond: no incremental shadow on the day of the analysis."
    );
}

#[test]
fn the_shadow_of_a_year_is_what_rays_add_up_to() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let old = [Block([-50.0, -20.0, -30.0, 20.0], 15.0)];
    let new = [Block([0.0, -45.0, 20.0, -25.0], 40.0)];
    SAN_FRANCISCO.write_blocks(folder, "city.geojson", &old);
    SAN_FRANCISCO.write_blocks(folder, "tower.geojson", &new);
    SAN_FRANCISCO.write_areas(
        folder,
        "park.geojson",
        &[("Square", [-25.0, -20.0, 25.0, 20.0])],
    );
    let told = report(
        folder,
        &[
            "city.geojson",
            "--report",
            "prop-k",
            "--year",
            "2026",
            "--cell",
            "5",
            "--with",
            "tower.geojson",
            "--resources",
            "park.geojson",
        ],
    );
    let row = &told["rows"][0];
    let origin = origin(folder, "city.geojson");
    let (sky, places) = (sky(&origin), places(folder, "park.geojson", &origin, 5.0));
    let (old, new) = (
        SAN_FRANCISCO.local(&origin, &old),
        SAN_FRANCISCO.local(&origin, &new),
    );
    let both = [&old[..], &new].concat();
    // By NOAA's short formulas, written apart from this, it is 3,720.8 hours in San Francisco.
    let hours = number(row, "available_ft2_h") / number(row, "area_ft2");
    assert!((hours - 3720.8).abs() < 0.5, "{hours}");
    assert!((number(row, "area_m2") - 2000.0).abs() < 0.5);
    let zone = jiff::tz::TimeZone::get("America/Los_Angeles").unwrap();
    let margins = Hours::default().with_margins(3600.0, 3600.0).unwrap();
    let margins = margins.with_sunrise(-50.0 / 60.0).unwrap();
    let (mut existing, mut net, mut days, mut most) = (0.0, 0.0, 0, (0.0, String::new()));
    for date in jiff::civil::date(2026, 1, 1)
        .series(jiff::ToSpan::days(1))
        .take(365)
    {
        let mut of_day = 0.0;
        for span in margins.spans(&sky, &zone, date) {
            let (step, looks) = instants(span.start, span.end, 240.0);
            for look in looks {
                let sun = sky.direction(look);
                for &place in &places {
                    let was = is_dark(&old, place, 0.0, sun);
                    existing += if was { step } else { 0.0 };
                    of_day += if !was && is_dark(&both, place, 0.0, sun) {
                        step
                    } else {
                        0.0
                    };
                }
            }
        }
        net += of_day;
        days += usize::from(of_day > 0.0);
        if of_day > most.0 {
            most = (of_day, date.to_string());
        }
    }
    let load = |seconds: f64| seconds / 3600.0 * number(row, "area_ft2") / places.len() as f64;
    let near = |key: &str, seconds: f64| {
        let apart = number(row, key) / load(seconds) - 1.0;
        assert!(apart.abs() < 4e-3, "{key}: {apart}, {row}");
    };
    near("existing_ft2_h", existing);
    near("net_new_ft2_h", net);
    let share = 100.0 * number(row, "net_new_ft2_h") / number(row, "available_ft2_h");
    assert!((number(row, "net_new_percent") - share).abs() < 1e-3);
    assert!(
        (number(row, "days_with_new") - days as f64).abs() <= 2.0,
        "{days}: {row}"
    );
    let park = told["parks"][0]["days_that_change"].as_array().unwrap();
    let sum: f64 = park.iter().map(|day| number(day, "net_ft2_h")).sum();
    assert!((sum / number(row, "net_new_ft2_h") - 1.0).abs() < 1e-3);
    assert!(
        (number(row, "largest_ft2_h") / load(most.0) - 1.0).abs() < 0.02,
        "{most:?}: {row}"
    );
}
