//! Against rays, one a second, with every change of light found to a millisecond.

use ombra_accrual::{Exact, Occluders, Sampled, Samples};
use ombra_geometry::Point3;
use ombra_sun::{Instant, Sky, Span};

use crate::solids::{city, four_days, sheets, sky, spans};

/// Seconds of shadow by looking each second, and between seconds that differ by halving.
fn truth(rays: &Sampled, sky: &Sky, spans: &[Span], place: Point3) -> f64 {
    let dark = |instant: Instant| rays.is_in_shadow(sky, place, instant);
    let mut seconds = 0.0;
    for span in spans {
        let count = span.seconds().ceil() as usize;
        let at = |k: usize| span.start + span.seconds() * k as f64 / count as f64;
        let mut from = (at(0), dark(at(0)));
        for k in 1..=count {
            let to = (at(k), dark(at(k)));
            seconds += match (from.1, to.1) {
                (true, true) => to.0 - from.0,
                (false, false) => 0.0,
                (begins_dark, _) => {
                    let (mut low, mut high) = (from.0, to.0);
                    while high - low > 1e-3 {
                        let middle = low + 0.5 * (high - low);
                        if dark(middle) == begins_dark {
                            low = middle;
                        } else {
                            high = middle;
                        }
                    }
                    if begins_dark {
                        low - from.0
                    } else {
                        to.0 - high
                    }
                }
            };
            from = to;
        }
    }
    seconds
}

#[test]
fn a_day_is_exact_to_a_tenth_of_a_second() {
    let mut errors = Vec::new();
    for (seed, latitude) in [(11, 40.7), (12, -33.9), (13, 60.2)] {
        let (facets, places) = city(seed, 90);
        let (occluders, rays) = (Occluders::new(&facets), Sampled::new(&facets));
        let sky = sky(latitude);
        for day in four_days() {
            let spans = spans(&sky, &[day]);
            let sheets = sheets(&sky, &spans);
            let found = Exact::new(&occluders, &sheets).seconds(&places);
            for (&place, found) in places.iter().zip(found).step_by(6) {
                let error = (found - truth(&rays, &sky, &spans, place)).abs();
                assert!(error <= 1.0, "{latitude}, {day}, {place:?}: {error} s");
                errors.push(error);
            }
        }
    }
    errors.sort_by(f64::total_cmp);
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    let of_twenty = errors[errors.len() * 19 / 20];
    assert!(
        mean <= 0.05 && of_twenty <= 0.2,
        "mean {mean} s, p95 {of_twenty} s"
    );
}

#[test]
fn samples_come_nearer_the_more_there_are() {
    let (facets, places) = city(21, 90);
    let sky = sky(51.5);
    let spans = spans(&sky, &four_days());
    let exact = Exact::new(&Occluders::new(&facets), &sheets(&sky, &spans)).seconds(&places);
    let rays = Sampled::new(&facets);
    let mean_error = |step| {
        let found = rays.seconds(&Samples::new(&sky, &spans, step), &places);
        let errors = exact.iter().zip(found).map(|(a, b)| (a - b).abs());
        errors.sum::<f64>() / places.len() as f64
    };
    let errors = [900.0, 300.0, 60.0].map(mean_error);
    assert!(
        errors[0] > 2.0 * errors[1] && errors[1] > 2.0 * errors[2],
        "{errors:?}"
    );
    assert!(errors[2] < 90.0, "{errors:?}");
}
