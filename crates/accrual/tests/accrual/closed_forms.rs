//! Against what can be worked out by hand from where the sun is.

use jiff::civil::date;
use ombra_accrual::{Exact, Occluders};
use ombra_city::Facet;
use ombra_geometry::Point3;
use ombra_sun::{Sky, Span};

use crate::solids::{sheets, sky, spans};

/// Seconds in which something holds for the sun, to a millisecond: looked at every five seconds.
pub(crate) fn while_so(sky: &Sky, spans: &[Span], so: impl Fn([f64; 3]) -> bool) -> f64 {
    let holds = |instant| so(sky.direction(instant));
    let mut seconds = 0.0;
    for span in spans {
        let count = (span.seconds() / 5.0).ceil() as usize;
        let at = |k: usize| span.start + span.seconds() * k as f64 / count as f64;
        for k in 0..count {
            let (from, to) = (at(k), at(k + 1));
            let first = holds(from);
            if first == holds(to) {
                seconds += if first { to - from } else { 0.0 };
                continue;
            }
            let (mut low, mut high) = (from, to);
            while high - low > 1e-4 {
                let middle = low + 0.5 * (high - low);
                if holds(middle) == first {
                    low = middle
                } else {
                    high = middle
                }
            }
            seconds += if first { low - from } else { to - high };
        }
    }
    seconds
}

fn quad(corners: [[f32; 3]; 4]) -> Facet {
    Facet {
        corners: corners.map(Point3::from),
        is_two_sided: true,
        owner: 0,
    }
}

/// Both ways to the shadow of the place at the origin.
fn assert_closed(name: &str, facets: &[Facet], so: impl Fn([f64; 3]) -> bool) {
    let occluders = Occluders::new(facets);
    for latitude in [
        -64.0, -33.9, -10.0, 0.0, 10.0, 23.44, 40.7, 64.0, 70.0, 89.0,
    ] {
        let sky = sky(latitude);
        for day in [
            date(2026, 3, 20),
            date(2026, 6, 21),
            date(2026, 9, 22),
            date(2026, 12, 21),
        ] {
            let spans = spans(&sky, &[day]);
            let found = Exact::new(&occluders, &sheets(&sky, &spans)).seconds(&[Point3::ORIGIN]);
            let expected = while_so(&sky, &spans, &so);
            let error = (found[0] - expected).abs();
            assert!(
                error < 0.2,
                "{name}, {latitude}, {day}: {} and {expected}",
                found[0]
            );
        }
    }
}

/// A wall along x at a distance in y: between which x, up to which height.
fn wall(distance: f32, from: f32, to: f32, high: f32) -> Facet {
    quad([
        [from, distance, 0.0],
        [to, distance, 0.0],
        [to, distance, high],
        [from, distance, high],
    ])
}

fn before_wall(distance: f64, from: f64, to: f64, high: f64) -> impl Fn([f64; 3]) -> bool {
    move |[x, y, z]| {
        let t = distance / y;
        t > 0.0 && (from..=to).contains(&(x * t)) && z * t <= high
    }
}

#[test]
fn a_wall_to_the_south_and_one_to_the_north() {
    for distance in [-20.0, 20.0] {
        let facets = [wall(distance, -15.0, 15.0, 25.0)];
        assert_closed(
            "wall",
            &facets,
            before_wall(f64::from(distance), -15.0, 15.0, 25.0),
        );
    }
}

#[test]
fn a_very_long_wall() {
    let facets = [wall(-10.0, -1e5, 1e5, 8.0)];
    assert_closed("long wall", &facets, before_wall(-10.0, -1e5, 1e5, 8.0));
}

#[test]
fn two_walls_that_touch_are_as_one() {
    let facets = [wall(-20.0, -15.0, 3.3, 25.0), wall(-20.0, 3.3, 15.0, 25.0)];
    assert_closed("two walls", &facets, before_wall(-20.0, -15.0, 15.0, 25.0));
}

#[test]
fn a_pole() {
    let facets = [wall(-20.0, -0.05, 0.05, 100.0)];
    assert_closed("pole", &facets, before_wall(-20.0, -0.05, 0.05, 100.0));
}

#[test]
fn a_slab_overhead() {
    let slab = quad([
        [-4.0, -6.0, 5.0],
        [4.0, -6.0, 5.0],
        [4.0, 3.0, 5.0],
        [-4.0, 3.0, 5.0],
    ]);
    assert_closed("slab", &[slab], |[x, y, z]| {
        let t = 5.0 / z;
        (-4.0..=4.0).contains(&(x * t)) && (-6.0..=3.0).contains(&(y * t))
    });
}

#[test]
fn in_polar_night_there_is_neither_sun_nor_shadow() {
    let sky = sky(75.0);
    assert!(spans(&sky, &[date(2026, 12, 21)]).is_empty());
    let occluders = Occluders::new(&[wall(-10.0, -5.0, 5.0, 8.0)]);
    assert_eq!(
        Exact::new(&occluders, &[]).seconds(&[Point3::ORIGIN]),
        [0.0]
    );
}

#[test]
fn a_court_without_a_sky_lies_in_shadow_all_day() {
    let facets = [
        wall(-10.0, -10.0, 10.0, 20.0),
        wall(10.0, -10.0, 10.0, 20.0),
        quad([
            [-10.0, -10.0, 0.0],
            [-10.0, 10.0, 0.0],
            [-10.0, 10.0, 20.0],
            [-10.0, -10.0, 20.0],
        ]),
        quad([
            [10.0, -10.0, 0.0],
            [10.0, 10.0, 0.0],
            [10.0, 10.0, 20.0],
            [10.0, -10.0, 20.0],
        ]),
        quad([
            [-10.0, -10.0, 20.0],
            [10.0, -10.0, 20.0],
            [10.0, 10.0, 20.0],
            [-10.0, 10.0, 20.0],
        ]),
    ];
    assert_closed("court", &facets, |_| true);
}
