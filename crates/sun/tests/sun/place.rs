//! Places, their zones and their air.

use jiff::Timestamp;
use ombra_sun::{Instant, Place, Refraction, Sky, SunError};

use crate::instant;

#[test]
fn zones_are_found_from_the_place() {
    for (latitude, longitude, name) in [
        (40.75, -73.98, "America/New_York"),
        (52.011, 4.357, "Europe/Amsterdam"),
        (-33.87, 151.2, "Australia/Sydney"),
        (1.87, -157.4, "Pacific/Kiritimati"),
        (27.72, 85.32, "Asia/Kathmandu"),
    ] {
        let place = Place::new(latitude, longitude, 0.0).unwrap();
        assert_eq!(place.time_zone_name().unwrap(), name);
        assert_eq!(place.time_zone().unwrap().iana_name(), Some(name));
    }
}

/// Every place has a zone that jiff knows, the seas and the poles too.
#[test]
fn zones_cover_the_globe() {
    for latitude in (-90..=90).step_by(6) {
        for longitude in (-180..=180).step_by(6) {
            let place = Place::new(latitude.into(), longitude.into(), 0.0).unwrap();
            place.time_zone().unwrap();
        }
    }
}

#[test]
fn what_is_not_on_the_globe_is_refused() {
    for (latitude, longitude, height) in [
        (90.1, 0.0, 0.0),
        (f64::NAN, 0.0, 0.0),
        (0.0, 180.5, 0.0),
        (0.0, f64::NEG_INFINITY, 0.0),
        (0.0, 0.0, 1e6),
        (0.0, 0.0, f64::NAN),
    ] {
        assert!(Place::new(latitude, longitude, height).is_err());
        let place = Place {
            latitude,
            longitude,
            height,
        };
        assert!(Sky::new(place, Refraction::None).is_err());
    }
    let error = Place::new(91.0, 0.0, 0.0).unwrap_err();
    assert_eq!(error, SunError::Latitude(91.0));
    assert_eq!(
        error.to_string(),
        "latitude 91 is not from -90 to 90 degrees (north is positive)"
    );
}

#[test]
fn air_that_cannot_be_is_refused() {
    let place = Place::new(0.0, 0.0, 0.0).unwrap();
    for (pressure_mbar, temperature_celsius) in [
        (0.0, 10.0),
        (-5.0, 10.0),
        (1e5, 10.0),
        (f64::NAN, 10.0),
        (1000.0, -300.0),
        (1000.0, f64::NAN),
    ] {
        let air = Refraction::Standard {
            pressure_mbar,
            temperature_celsius,
        };
        assert!(Sky::new(place, air).is_err(), "{air:?}");
    }
}

#[test]
fn any_instant_has_a_sun() {
    let sky = Sky::new(Place::new(45.0, 180.0, 0.0).unwrap(), Refraction::SEA).unwrap();
    for seconds in [0.0, -1e30, 1e30, f64::MAX, -6e10, 1.2e11] {
        let sun = sky.at(Instant::from_seconds(seconds));
        assert!(sun.altitude.is_finite() && sun.azimuth.is_finite());
    }
}

#[test]
fn instants_and_timestamps() {
    let at = instant("2026-12-21T12:00:00.5Z");
    assert_eq!(at.seconds().fract(), 0.5);
    assert_eq!(Instant::from(at.timestamp()), at);
    assert_eq!(
        Instant::from_seconds(-0.25).timestamp().subsec_nanosecond(),
        -250_000_000
    );
    assert_eq!(Instant::from_seconds(1e300).timestamp(), Timestamp::MAX);
    assert!(at < at + 0.001 && (at + 60.0) - at == 60.0);
    assert_eq!(Instant::from_seconds(-0.0), Instant::from_seconds(0.0));
}
