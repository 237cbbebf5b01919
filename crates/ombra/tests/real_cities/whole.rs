//! What holds for every city.

use ombra::accrual::{Exact, Occluders};
use ombra::city::{City, procedural_city};

use crate::{Above, YEAR, outside, places};

const DAYS: &str = "2026-12-21";

/// Builds every fifth building of a city last.
fn assert_buildings_take_no_shadow_away(city: &City) {
    let (places, sheets) = (places(city, 400), Above::of(city).sheets(DAYS));
    let facets = city.facets();
    let mut first = facets.clone();
    first.retain(|facet| facet.owner % 5 != 0);
    assert!(first.len() < facets.len());
    let seconds = |facets: &[_]| Exact::new(&Occluders::new(facets), &sheets).seconds(&places);
    let mut more = 0;
    for ((before, after), place) in seconds(&first).iter().zip(seconds(&facets)).zip(&places) {
        // Stretches are joined across gaps of a millionth of an arc.
        assert!(
            after - before >= -1e-2,
            "{place:?}: {before} and then {after}"
        );
        more += usize::from(after - before > 60.0);
    }
    assert!(more > 40, "the buildings are seen: {more}");
}

#[test]
fn another_building_never_takes_shadow_away() {
    for name in [
        "geojson/lower_manhattan_nyc_opendata.geojson",
        "osm/chicago_loop.osm.pbf",
        "cityjson/delft.city.json",
        "cityjson/rotterdam_delfshaven.city.json",
    ] {
        if let Some(city) = outside(name) {
            assert_buildings_take_no_shadow_away(&city);
        }
    }
}

#[test]
fn the_months_are_the_year() {
    let city = procedural_city(1, 400);
    let above = Above::of(&city);
    let places = places(&city, 64);
    let occluders = Occluders::new(&city.facets());
    let seconds = |days: &str| Exact::new(&occluders, &above.sheets(days)).seconds(&places);
    let year = seconds(&YEAR.to_string());
    let mut sum = vec![0.0; places.len()];
    for month in 1..=12 {
        for (sum, own) in sum.iter_mut().zip(seconds(&format!("{YEAR}-{month:02}"))) {
            *sum += own;
        }
    }
    for ((year, sum), place) in year.iter().zip(&sum).zip(&places) {
        assert!(*year > 3600.0, "{place:?}: {year}");
        assert!(
            (sum - year).abs() <= 1e-6 * year,
            "{place:?}: {year} and by months {sum}"
        );
    }
}
