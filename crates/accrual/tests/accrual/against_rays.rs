//! Against rays, one a second, with every change of light found to a millisecond.

use ombra_accrual::{Exact, Occluders, Sampled, Samples};
use ombra_geometry::Point3;
use ombra_sun::{Place, Refraction, Sky};

use crate::solids::{city, four_days, sheets, sky, spans};

#[test]
fn a_day_is_exact_to_a_tenth_of_a_second() {
    let mut errors = Vec::new();
    for (seed, latitude, refraction) in [
        (11, 40.7, Refraction::None),
        (12, -33.9, Refraction::SEA),
        (13, 60.2, Refraction::None),
    ] {
        let (facets, places) = city(seed, 90);
        let (occluders, rays) = (Occluders::new(&facets), Sampled::new(&facets));
        let sky = Sky::new(Place::new(latitude, 0.0, 0.0).unwrap(), refraction).unwrap();
        for day in four_days() {
            let spans = spans(&sky, &[day]);
            let sheets = sheets(&sky, &spans);
            let some: Vec<Point3> = places.iter().copied().step_by(6).collect();
            let found = Exact::new(&occluders, &sheets).seconds(&some);
            let truth = rays.refined_seconds(&sky, &spans, 1.0, &some);
            for ((&place, found), truth) in some.iter().zip(found).zip(truth) {
                let error = (found - truth).abs();
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
