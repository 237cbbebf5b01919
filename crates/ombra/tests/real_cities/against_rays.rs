//! Against rays toward the true sun, each second, with every change of light found to a millisecond.
//! `OMBRA_SHADOW_PLACES` sets at how many places of each city (24 if it is not set); the figures are printed.

use ombra::accrual::{Exact, Occluders, Sampled};
use ombra::city::{City, procedural_city};

use crate::{Above, outside, places};

/// Rays look so often, in seconds, and where a place is off by more than `DOUBT`, as often as `CLOSE`: a gap
/// between two buildings may let the sun through for less than a second.
const LOOK: f64 = 1.0;
const DOUBT: f64 = 0.1;
const CLOSE: f64 = 0.05;

const DAYS: [&str; 4] = ["2026-03-21", "2026-06-21", "2026-09-22", "2026-12-21"];

/// What `OMBRA_SHADOW_PLACES` says. A word that is no number must not pass for a full check.
fn places_asked_for() -> usize {
    let Some(asked) = std::env::var_os("OMBRA_SHADOW_PLACES") else {
        return 24;
    };
    match asked.to_str().and_then(|places| places.parse().ok()) {
        Some(places) if places > 0 => places,
        _ => panic!("OMBRA_SHADOW_PLACES is {asked:?}; it must be a whole number from 1"),
    }
}

/// A day at a place is wrong by 0.05 s in the mean, in 19 of 20 by 0.2 s, and by 1 s at most.
fn assert_is_exact(name: &str, city: &City) {
    let facets = city.facets();
    let (occluders, rays) = (Occluders::new(&facets), Sampled::new(&facets));
    let above = Above::of(city);
    let places = places(city, places_asked_for());
    let mut errors = Vec::new();
    let mut shaded = 0;
    for day in DAYS {
        let found = Exact::new(&occluders, &above.sheets(day)).seconds(&places);
        let spans = above.spans(day);
        let by_rays = |step, places: &[_]| rays.refined_seconds(&above.sky, &spans, step, places);
        for ((&place, found), mut truth) in places.iter().zip(found).zip(by_rays(LOOK, &places)) {
            if (found - truth).abs() > DOUBT {
                truth = by_rays(CLOSE, &[place])[0];
            }
            shaded += usize::from(truth > 60.0);
            errors.push(((found - truth).abs(), day, place, found, truth));
        }
    }
    errors.sort_by(|a, b| a.0.total_cmp(&b.0));
    let count = errors.len();
    let mean = errors.iter().map(|error| error.0).sum::<f64>() / count as f64;
    let (of_twenty, most) = (errors[(count * 19).div_ceil(20) - 1].0, errors[count - 1].0);
    let figures =
        format!("{name}: {count} days, mean {mean:.4} s, p95 {of_twenty:.4} s, max {most:.4} s");
    println!("{figures} ({} buildings)", city.buildings.len());
    let worst: Vec<String> = (errors.iter().rev().take(5))
        .map(|(error, day, place, found, truth)| {
            format!("{error:.4} s on {day} at {place:?}: {found} s, by rays {truth} s")
        })
        .collect();
    let is_exact = mean <= 0.05 && of_twenty <= 0.2 && most <= 1.0;
    assert!(is_exact, "{figures}\n{}", worst.join("\n"));
    assert!(
        2 * shaded > count,
        "{name}: only {shaded} of {count} have shadow"
    );
}

#[test]
fn a_procedural_city_is_exact() {
    assert_is_exact("procedural", &procedural_city(1, 3000));
}

#[test]
fn lower_manhattan_is_exact() {
    if let Some(city) = outside("geojson/lower_manhattan_nyc_opendata.geojson") {
        assert_is_exact("Lower Manhattan", &city);
    }
}

#[test]
fn chicago_is_exact() {
    if let Some(city) = outside("osm/chicago_loop.osm.pbf") {
        assert_is_exact("Chicago", &city);
    }
}

#[test]
fn delft_is_exact() {
    if let Some(city) = outside("cityjson/delft.city.json") {
        assert_is_exact("Delft", &city);
    }
}

#[test]
fn rotterdam_is_exact() {
    if let Some(city) = outside("cityjson/rotterdam_delfshaven.city.json") {
        assert_is_exact("Rotterdam", &city);
    }
}
