//! What is known of the sun without an almanac.

use ombra_sun::{Hours, Instant, Place, Refraction, Sky, Sun};

use crate::{date, instant, mean_time, sky, total, up};

const TILT: f64 = 23.436;

fn noon(sky: &Sky, day: &str) -> Sun {
    let guess = instant(&format!("{day}T12:00:00Z")) - sky.place().longitude * 240.0;
    sky.at(sky.at_solar_time(43_200.0, guess))
}

#[test]
fn noon_at_the_solstices() {
    for latitude in [-60.0, -30.0, 0.0, 30.0, 45.0, 60.0, 80.0_f64] {
        for (day, tilt) in [("2026-06-21", TILT), ("2026-12-21", -TILT)] {
            let sun = noon(&sky(latitude, 20.0), day);
            assert!(
                (sun.altitude - (90.0 - (latitude - tilt).abs())).abs() < 0.01,
                "{sun:?}"
            );
            let south = if latitude > tilt { 180.0 } else { 0.0 };
            let off = (sun.azimuth - south + 180.0_f64).rem_euclid(360.0) - 180.0;
            assert!(off.abs() < 0.02, "{latitude} {day}: {sun:?}");
        }
    }
}

#[test]
fn the_sun_stands_in_the_zenith_of_the_tropics() {
    assert!(noon(&sky(TILT, 20.0), "2026-06-21").altitude > 89.98);
    assert!(noon(&sky(-TILT, 20.0), "2026-12-21").altitude > 89.98);
    assert!(noon(&sky(0.0, -78.0), "2026-03-20").altitude > 89.8);
}

#[test]
fn days_are_twelve_hours_at_the_equinox_and_at_the_equator() {
    for latitude in [-50.0, -20.0, 0.0, 35.0, 52.0] {
        let length = total(&up(&sky(latitude, 4.0), "2026-03-20"));
        assert!((length - 43_200.0).abs() < 120.0, "{latitude}: {length}");
    }
    for day in ["2026-01-15", "2026-06-21", "2026-12-21"] {
        let length = total(&up(&sky(0.0, 30.0), day));
        assert!((length - 43_200.0).abs() < 60.0, "{day}: {length}");
    }
}

#[test]
fn a_summer_day_is_as_long_as_spherical_trigonometry_has_it() {
    for latitude in [-60.0, -33.0, 40.75, 52.0, 64.0_f64] {
        let tilt = TILT.to_radians();
        let half = (-latitude.to_radians().tan() * tilt.tan())
            .acos()
            .to_degrees();
        let length = total(&up(&sky(latitude, 0.0), "2026-06-21"));
        assert!((length - half * 480.0).abs() < 20.0, "{latitude}: {length}");
    }
}

#[test]
fn midnight_sun_and_polar_night() {
    for (latitude, bright, dark) in [
        (70.0, "2026-06-21", "2026-12-21"),
        (90.0, "2026-06-21", "2026-12-21"),
        (-75.0, "2026-12-21", "2026-06-21"),
        (-90.0, "2026-12-21", "2026-06-21"),
    ] {
        let sky = sky(latitude, 15.0);
        let spans = up(&sky, bright);
        assert_eq!((spans.len(), total(&spans)), (1, 86_400.0), "{latitude}");
        assert_eq!(up(&sky, dark), [], "{latitude}");
    }
}

/// Where the sun comes back or leaves for months, there are days with only one of the two.
#[test]
fn days_with_only_a_sunrise_or_only_a_sunset() {
    let sky = sky(78.2, 15.6);
    let zone = mean_time(15.6);
    let ends = |day| {
        let mut only = (false, false);
        let spans = Hours::default().spans(&sky, &zone, day);
        let midnight = day.to_zoned_datetime(zone.clone()).unwrap();
        let start = Instant::from(&midnight);
        if let [span] = spans[..] {
            only = (
                span.start > start && span.end == start + 86_400.0,
                span.start == start && span.end < start + 86_400.0,
            );
        }
        only
    };
    let days = date("2026-04-01")
        .series(jiff::Span::new().days(1))
        .take(180);
    let found: Vec<_> = days.map(ends).collect();
    assert!(found.iter().any(|only| only.0), "a day with only a sunrise");
    assert!(found.iter().any(|only| only.1), "a day with only a sunset");
}

#[test]
fn the_sun_of_the_south_goes_the_other_way() {
    let morning = sky(-33.87, 151.2).at(instant("2026-06-20T23:30:00Z"));
    let later = sky(-33.87, 151.2).at(instant("2026-06-21T03:30:00Z"));
    assert!(
        morning.azimuth < 90.0 && morning.azimuth > 0.0,
        "{morning:?}"
    );
    assert!(later.azimuth > 270.0, "{later:?}");
}

#[test]
fn air_lifts_the_sun_and_lengthens_the_day() {
    let place = Place::new(52.0, 4.0, 0.0).unwrap();
    let (bare, air) = (
        Sky::new(place, Refraction::None).unwrap(),
        Sky::new(place, Refraction::SEA).unwrap(),
    );
    let rise = up(&bare, "2026-03-20")[0].start;
    assert!(bare.at(rise).altitude.abs() < 1e-5);
    let lift = air.at(rise).altitude - bare.at(rise).altitude;
    assert!((0.4..0.6).contains(&lift), "{lift}");
    let longer = total(&up(&air, "2026-03-20")) - total(&up(&bare, "2026-03-20"));
    // Twice half a degree or so, at 240 s a degree over the cosine of the latitude.
    assert!((300.0..480.0).contains(&longer), "{longer}");
}

#[test]
fn directions_are_east_north_up() {
    let at = |azimuth, altitude| Sun { azimuth, altitude }.direction();
    for (found, expected) in [
        (at(0.0, 0.0), [0.0, 1.0, 0.0]),
        (at(90.0, 0.0), [1.0, 0.0, 0.0]),
        (at(270.0, 0.0), [-1.0, 0.0, 0.0]),
        (at(123.0, 90.0), [0.0, 0.0, 1.0]),
    ] {
        for (a, b) in found.into_iter().zip(expected) {
            assert!((a - b).abs() < 1e-15);
        }
    }
}
