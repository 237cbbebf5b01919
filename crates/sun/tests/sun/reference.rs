//! Positions as others reckon them.

use jiff::tz::TimeZone;
use ombra_sun::{Place, Refraction, Sky};

use crate::{instant, sky};

/// The example of NREL's report: I. Reda, A. Andreas, TP-560-34302, table A5.1.
#[test]
fn the_report_of_nrel() {
    let place = Place::new(39.742476, -105.1786, 1830.14).unwrap();
    let air = Refraction::Standard {
        pressure_mbar: 820.0,
        temperature_celsius: 11.0,
    };
    let sky = Sky::new(place, air).unwrap().with_delta_t(67.0);
    let sun = sky.at(instant("2003-10-17T12:30:30-07:00"));
    assert!((90.0 - sun.altitude - 50.11162).abs() < 1e-5, "{sun:?}");
    assert!((sun.azimuth - 194.34024).abs() < 1e-5, "{sun:?}");
}

/// `pvlib.spa.solar_position` of pvlib 0.16.1, ΔT 69 s: latitude, longitude, height, instant,
/// azimuth, altitude without air, equation of time in minutes.
const PVLIB: [(f64, f64, f64, &str, f64, f64, f64); 8] = [
    (
        40.75,
        -73.98,
        10.0,
        "2026-06-21T12:00:00Z",
        80.96031666687588,
        26.49492791947406,
        -1.8140198830951704,
    ),
    (
        52.011,
        4.357,
        0.0,
        "2026-12-21T09:30:00Z",
        149.89569279098708,
        9.323335888211329,
        1.990388231293764,
    ),
    (
        -33.8688,
        151.2093,
        50.0,
        "2025-03-20T23:15:30Z",
        57.78368031652269,
        38.12908440870382,
        -7.217350716520741,
    ),
    (
        -0.1807,
        -78.4678,
        2850.0,
        "2026-03-20T17:20:00Z",
        54.3015464941364,
        89.61757822922905,
        -7.3676329890222405,
    ),
    (
        69.6492,
        18.9553,
        0.0,
        "2026-06-21T22:45:00Z",
        359.74872759532684,
        3.083724814781695,
        -1.9117116393899778,
    ),
    (
        1.87,
        -157.4,
        3.0,
        "2024-02-29T20:00:00Z",
        103.61324068731193,
        48.53073040625979,
        -12.326711415604223,
    ),
    (
        19.076,
        72.8777,
        14.0,
        "2026-05-16T07:00:00Z",
        87.55161157316593,
        88.85534826579209,
        3.651194602556643,
    ),
    (
        -90.0,
        0.0,
        2835.0,
        "2026-01-01T00:00:00Z",
        180.83253760617643,
        23.01496596211964,
        -3.326779608083598,
    ),
];

#[test]
fn positions_are_those_of_pvlib() {
    for (latitude, longitude, height, time, azimuth, altitude, _) in PVLIB {
        let place = Place::new(latitude, longitude, height).unwrap();
        let sky = Sky::new(place, Refraction::None)
            .unwrap()
            .with_delta_t(69.0);
        let sun = sky.at(instant(time));
        assert!((sun.altitude - altitude).abs() < 1e-6, "{time} {sun:?}");
        assert!((sun.azimuth - azimuth).abs() < 1e-6, "{time} {sun:?}");
        // The estimate of ΔT by date is within a second or two of it.
        let estimated = Sky::new(place, Refraction::None).unwrap().at(instant(time));
        assert!(
            (estimated.altitude - sun.altitude).abs() < 2e-5,
            "{time} {estimated:?}"
        );
    }
}

#[test]
fn true_solar_time_is_mean_time_and_its_equation() {
    for (latitude, longitude, _, time, _, _, equation) in PVLIB {
        let sky = sky(latitude, longitude).with_delta_t(69.0);
        let at = instant(time);
        let expected = at.seconds() + longitude * 240.0 + equation * 60.0;
        let found = sky.solar_time(at);
        let off = (found - expected + 43_200.0).rem_euclid(86_400.0) - 43_200.0;
        assert!(off.abs() < 0.5, "{time}: {off} s");
        let back = sky.at_solar_time(found, at + 9000.0);
        assert!((back - at).abs() < 1e-3, "{time}: {}", back - at);
    }
}

/// The upper edge of the sun rises and sets, in an air that lifts it by 34', when its centre is at
/// -0.833°: what almanacs print, to the minute, and `astral` 3.2 gives to the second.
#[test]
fn almanacs_agree_to_the_minute() {
    for (latitude, longitude, rise, set) in [
        (
            40.7128,
            -74.0060,
            "2026-12-21T07:16:51-05:00",
            "2026-12-21T16:31:33-05:00",
        ),
        (
            51.5074,
            -0.1278,
            "2026-06-21T04:43:28+01:00",
            "2026-06-21T21:21:12+01:00",
        ),
        (
            35.6895,
            139.6917,
            "2026-06-21T04:25:52+09:00",
            "2026-06-21T19:00:05+09:00",
        ),
        (
            -33.8688,
            151.2093,
            "2026-12-21T05:40:53+11:00",
            "2026-12-21T20:05:11+11:00",
        ),
        (
            52.011,
            4.357,
            "2026-03-20T06:45:42+01:00",
            "2026-03-20T18:55:20+01:00",
        ),
        (
            -0.1807,
            -78.4678,
            "2026-03-20T06:18:09-05:00",
            "2026-03-20T18:24:19-05:00",
        ),
        (
            64.1466,
            -21.9426,
            "2026-12-21T11:23:12Z",
            "2026-12-21T15:28:33Z",
        ),
    ] {
        let sky = sky(latitude, longitude);
        for (time, sign) in [(rise, 1.0), (set, -1.0)] {
            let above = |seconds: f64| sky.at(instant(time) + seconds).altitude + 0.833;
            assert!(
                sign * above(-60.0) < 0.0 && sign * above(60.0) > 0.0,
                "{time}"
            );
        }
    }
}

/// <https://aa.usno.navy.mil/data/Earth_Seasons>, to the minute.
#[test]
fn equinoxes_and_solstices() {
    use ombra_sun::Turn;
    for (turn, year, published) in [
        (Turn::MarchEquinox, 2000, "2000-03-20T07:35:00Z"),
        (Turn::JuneSolstice, 2000, "2000-06-21T01:48:00Z"),
        (Turn::SeptemberEquinox, 2000, "2000-09-22T17:28:00Z"),
        (Turn::DecemberSolstice, 2000, "2000-12-21T13:37:00Z"),
        (Turn::MarchEquinox, 2024, "2024-03-20T03:06:00Z"),
        (Turn::JuneSolstice, 2024, "2024-06-20T20:51:00Z"),
        (Turn::SeptemberEquinox, 2024, "2024-09-22T12:44:00Z"),
        (Turn::DecemberSolstice, 2024, "2024-12-21T09:20:00Z"),
        (Turn::DecemberSolstice, 2026, "2026-12-21T20:50:00Z"),
    ] {
        let off = turn.instant(year) - instant(published);
        assert!(off.abs() < 60.0, "{turn:?} {year}: {off} s");
    }
    // Every turn of every year is in its month: the start of the search is near enough.
    for year in [1600, 1700, 1999, 2400, 2999] {
        for (turn, month) in [
            (Turn::MarchEquinox, 3),
            (Turn::JuneSolstice, 6),
            (Turn::SeptemberEquinox, 9),
            (Turn::DecemberSolstice, 12),
        ] {
            let day = turn.instant(year).zoned(&TimeZone::UTC).date();
            assert_eq!((day.year(), day.month()), (year, month), "{turn:?}");
            assert!((17..=25).contains(&day.day()), "{turn:?} {day}");
        }
    }
}
