//! Points of the sun's disc are where they should be, and their sheets keep the laws.

use jiff::ToSpan;
use ombra_sun::{Disc, Hours, Place, Refraction, Sheet, Sky};

use crate::sheets::lawful;
use crate::{Random, date, instant, mean_time, sky, up};

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Degrees; the arc cosine would not do for small ones.
fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let chord: [f64; 3] = std::array::from_fn(|i| a[i] - b[i]);
    (2.0 * (0.5 * dot(chord, chord).sqrt()).asin()).to_degrees()
}

/// The Astronomical Almanac: the semidiameter is 16' 15.9" at the perihelion of January and 15' 43.9" at the aphelion of July.
#[test]
fn the_disc_is_larger_in_january() {
    let sky = sky(48.0, 11.0);
    let disc = Disc::with_rings(2);
    for (noon, minutes) in [
        ("2026-01-03T11:00:00Z", 16.0 + 15.9 / 60.0),
        ("2026-07-06T11:00:00Z", 15.0 + 43.9 / 60.0),
    ] {
        let at = instant(noon);
        let middle = sky.direction(at);
        for (point, sky) in disc.points().iter().zip(disc.skies(&sky)) {
            let expected = point[0].hypot(point[1]) * minutes / 60.0;
            let found = angle(middle, sky.direction(at));
            assert!((found - expected).abs() < 3e-5, "{found} {expected}");
        }
    }
}

#[test]
fn points_stay_in_their_places_as_the_sky_turns() {
    let sky = sky(48.0, 11.0);
    let disc = Disc::with_rings(2);
    let pole = [
        0.0,
        48.0_f64.to_radians().cos(),
        48.0_f64.to_radians().sin(),
    ];
    let radius = 959.63 / 3600.0;
    for hour in 6..16 {
        let at = instant(&format!("2026-06-21T{hour:02}:00:00Z"));
        let middle = sky.direction(at);
        for (point, sky) in disc.points().iter().zip(disc.skies(&sky)) {
            let seen = sky.direction(at);
            let north = (dot(seen, pole).asin() - dot(middle, pole).asin()).to_degrees();
            assert!((north - point[1] * radius / 1.0163).abs() < 1e-3, "{north}");
            // The sun moves westward: what is east of it is where it was.
            let step = 240.0 * point[0] * radius / 1.0163 / dot(middle, pole).asin().cos();
            let before = sky_of(48.0).direction(at - step);
            let along = angle(before, seen);
            assert!((along - north.abs()).abs() < 2e-3, "{along} {north}");
        }
    }
}

fn sky_of(latitude: f64) -> Sky {
    sky(latitude, 11.0)
}

#[test]
fn no_point_is_below_the_horizon_and_the_hours_are_those_of_the_middle() {
    let sky = sky(60.0, 0.0);
    let spans = up(&sky, "2026-12-21");
    let mut below = 0;
    for point in Disc::with_rings(2).skies(&sky) {
        assert_eq!(up(&point, "2026-12-21"), spans);
        let rising = point.direction(spans[0].start);
        assert!(rising[2] >= 0.0 && (dot(rising, rising) - 1.0).abs() < 1e-12);
        below += usize::from(rising[2] == 0.0);
    }
    assert!((9..=10).contains(&below), "{below}");
}

#[test]
fn air_lifts_the_whole_disc() {
    let place = Place::new(40.0, 0.0, 0.0).unwrap();
    let skies = [Refraction::None, Refraction::SEA].map(|air| Sky::new(place, air).unwrap());
    let at = instant("2026-03-20T06:30:00Z");
    let height = |sky: &Sky| sky.direction(at)[2].asin().to_degrees();
    let lift = height(&skies[1]) - height(&skies[0]);
    assert!(lift > 0.1);
    let disc = Disc::with_rings(2);
    for (bare, lifted) in disc.skies(&skies[0]).iter().zip(disc.skies(&skies[1])) {
        assert!((height(&lifted) - height(bare) - lift).abs() < 1e-9);
    }
}

#[test]
fn sheets_of_points_are_lawful() {
    let mut random = Random(7);
    let disc = Disc::with_rings(2);
    for round in 0..160_usize {
        let latitude = match round % 4 {
            0 => random.within(-25.0, 25.0),
            1 => random.within(60.0, 90.0),
            2 => random.within(-90.0, -60.0),
            _ => random.within(-66.0, 66.0),
        };
        let place = Place::new(latitude, random.within(-180.0, 180.0), 0.0).unwrap();
        let air = [Refraction::None, Refraction::SEA][round / 4 % 2];
        let sky = Sky::new(place, air).unwrap();
        let day = date("2024-01-01") + (random.within(0.0, 730.0) as i64).days();
        let points = disc.skies(&sky);
        for span in Hours::default().spans(&sky, &mean_time(place.longitude), day) {
            for point in [1, 6, 7, 12, 18].map(|k| &points[(k + round) % points.len()]) {
                let sheets = Sheet::cover(point, span);
                lawful(point, span, &sheets);
                // Along the horizon, too, arcs are where the point is.
                for arc in sheets.iter().flat_map(Sheet::arcs) {
                    for share in [0.25, 0.5, 0.75] {
                        let at = arc.start + share * (arc.end - arc.start);
                        let truth = point.direction(ombra_sun::Instant::from_seconds(at));
                        let q = arc.direction(share);
                        let off = angle(q.map(|x| x / dot(q, q).sqrt()), truth);
                        assert!(off < 5e-4, "{off} {latitude} {day} {arc:?}");
                    }
                }
            }
        }
    }
}
