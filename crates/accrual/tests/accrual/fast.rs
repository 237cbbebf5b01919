//! Some days for all: close to every day, at every place.

use jiff::ToSpan as _;
use jiff::civil::{Date, date};
use ombra_accrual::{Exact, Fast, Occluders, Tiles};
use ombra_city::{City, Grid, procedural_city};
use ombra_sun::{Hours, Place, Refraction, Sheet, Sky, Window};

/// The sheets of each day of a period.
fn days(city: &City, hours: &Hours, first: Date, count: usize) -> Vec<Vec<Sheet>> {
    let place = Place::new(city.origin.latitude(), city.origin.longitude(), 0.0).unwrap();
    let sky = Sky::new(place, Refraction::None).unwrap();
    let zone = place.time_zone().unwrap();
    let day = |date| {
        let spans = hours.spans(&sky, &zone, date);
        spans
            .into_iter()
            .flat_map(|span| Sheet::cover(&sky, span))
            .collect()
    };
    first.series(1.day()).take(count).map(day).collect()
}

fn tiles(city: &City, cell: f64) -> Tiles {
    Tiles::on_ground(city, &Grid::over(&city.facets(), cell).unwrap(), |_| true)
}

fn up(days: &[Vec<Sheet>]) -> f64 {
    days.iter()
        .flatten()
        .map(|sheet| sheet.span().seconds())
        .sum()
}

#[test]
fn every_place_is_within_the_tolerance_over_a_year_a_season_and_a_month() {
    let city = procedural_city(3, 120);
    let tiles = tiles(&city, 12.0);
    let occluders = Occluders::new(&city.facets());
    let day = Hours::default();
    let office = day
        .clone()
        .with_windows(&Window::list("09:00-15:30").unwrap(), &[])
        .unwrap();
    for (hours, first, count) in [
        (&day, date(2026, 1, 1), 365),
        (&office, date(2026, 1, 1), 365),
        (&day, date(2026, 6, 21), 93),
        (&day, date(2026, 5, 1), 92),
        (&day, date(2026, 12, 1), 31),
    ] {
        let days = days(&city, hours, first, count);
        let fast = Fast::new(&occluders, &days, &tiles, 0.005, || true).unwrap();
        let found = fast.seconds_of(&tiles, 0..tiles.len());
        let exact = Exact::new(&occluders, &days.concat()).seconds_of(&tiles, 0..tiles.len());
        let off = found
            .iter()
            .zip(&exact)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        assert!(
            off <= 0.005 * up(&days),
            "{first} {count}: {} of {}",
            off,
            up(&days)
        );
        // It is quicker for a reason, and says how far it is off.
        assert!(
            (5..=count / 3).contains(&fast.days()),
            "{} of {count}",
            fast.days()
        );
        assert!(
            fast.refined() * 3 < found.len(),
            "{} of {}",
            fast.refined(),
            found.len()
        );
        let error = fast.error();
        assert!(error.places > 100 && error.most <= 0.005 && error.mean < error.most);
        assert!(off > 0.0);
    }
}

#[test]
fn few_days_and_no_tolerance_are_exact() {
    let city = procedural_city(3, 20);
    let tiles = tiles(&city, 10.0);
    let occluders = Occluders::new(&city.facets());
    for (count, tolerance) in [
        (0, 0.005),
        (1, 0.005),
        (3, 0.005),
        (40, 0.0),
        (40, f64::NAN),
        (40, -1.0),
    ] {
        let days = days(&city, &Hours::default(), date(2026, 5, 1), count);
        let fast = Fast::new(&occluders, &days, &tiles, tolerance, || true).unwrap();
        let exact = Exact::new(&occluders, &days.concat()).seconds_of(&tiles, 0..tiles.len());
        assert_eq!(
            fast.seconds_of(&tiles, 0..tiles.len()),
            exact,
            "{count} {tolerance}"
        );
        assert_eq!(fast.days(), 0);
        assert_eq!(fast.refined(), tiles.places().len());
    }
    let none = Tiles::default();
    let days = days(&city, &Hours::default(), date(2026, 5, 1), 40);
    let fast = Fast::new(&occluders, &days, &none, 0.005, || true).unwrap();
    assert!(fast.seconds_of(&none, 0..0).is_empty());
}

#[test]
fn nobody_waits_for_what_is_not_wanted() {
    let city = procedural_city(3, 20);
    let days = days(&city, &Hours::default(), date(2026, 1, 1), 365);
    let occluders = Occluders::new(&city.facets());
    assert!(Fast::new(&occluders, &days, &tiles(&city, 10.0), 0.005, || false).is_none());
}

/// Polar night, midnight sun and what is between them.
#[test]
fn days_without_sun_stand_for_nothing() {
    let city = procedural_city(3, 20);
    let tiles = tiles(&city, 10.0);
    let occluders = Occluders::new(&city.facets());
    let sky = Sky::new(Place::new(75.0, 20.0, 0.0).unwrap(), Refraction::None).unwrap();
    let zone = jiff::tz::TimeZone::UTC;
    let days: Vec<Vec<Sheet>> = (date(2026, 1, 1).series(1.day()).take(365))
        .map(|date| Hours::default().spans(&sky, &zone, date))
        .map(|spans| {
            spans
                .into_iter()
                .flat_map(|span| Sheet::cover(&sky, span))
                .collect()
        })
        .collect();
    assert!(days.iter().any(Vec::is_empty));
    let fast = Fast::new(&occluders, &days, &tiles, 0.005, || true).unwrap();
    let found = fast.seconds_of(&tiles, 0..tiles.len());
    let exact = Exact::new(&occluders, &days.concat()).seconds_of(&tiles, 0..tiles.len());
    for (found, exact) in found.iter().zip(&exact) {
        assert!(
            (found - exact).abs() <= 0.005 * up(&days),
            "{found} {exact}"
        );
    }
}
