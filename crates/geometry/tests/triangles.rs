//! The ray–triangle tests against each other and against a reference in double precision.

use ombra_geometry::triangle::TriangleTest;
use ombra_geometry::{EdgeRule, Point3, Ray, Vector3};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// The same cases in every run.
fn settings() -> ProptestConfig {
    ProptestConfig {
        cases: 20_000,
        max_global_rejects: 100_000,
        rng_seed: RngSeed::Fixed(0x0b5e_55ed),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

fn point(reach: f32) -> impl Strategy<Value = Point3> {
    [-reach..reach, -reach..reach, -reach..reach].prop_map(Point3::from)
}

/// A number that makes coincidences likely.
fn small_whole() -> impl Strategy<Value = Point3> {
    [-2_i8..=2, -2_i8..=2, -2_i8..=2].prop_map(|p| Point3::from(p.map(f32::from)))
}

fn corners() -> impl Strategy<Value = [Point3; 3]> {
    [point(1.0), point(1.0), point(1.0)]
}

/// t and the three barycentric weights by Cramer's rule, and the determinant, all in double.
fn reference(ray: &Ray<f64>, corners: [Point3; 3]) -> (f64, [f64; 3], f64) {
    let [a, b, c] = corners.map(|corner| corner.wide() - ray.origin);
    let d = ray.direction;
    let volumes = [d.dot(c.cross(b)), d.dot(a.cross(c)), d.dot(b.cross(a))];
    let det: f64 = volumes.iter().sum();
    let weights = volumes.map(|volume| volume / det);
    let at = a * weights[0] + b * weights[1] + c * weights[2];
    (at.dot(d) / d.length_squared(), weights, det)
}

proptest! {
    #![proptest_config(settings())]

    #[test]
    fn all_tests_find_what_the_reference_finds(
        corners in corners(),
        origin in point(4.0),
        target in point(1.0),
        length in -3.0_f32..3.0,
    ) {
        let direction: Vector3 = (target - origin) * 10_f32.powf(length);
        let ray: Ray<f64> = Ray { t_min: -1e30, ..Ray::new(origin, direction) }.into();
        prop_assume!(ray.is_valid());
        let (t, weights, det) = reference(&ray, corners);
        let area = det.abs() / direction.wide().length();
        for test in TriangleTest::ALL {
            for (single, epsilon) in [(true, 1e-5), (false, 1e-13)] {
                let found = test.prepare(&ray, single, EdgeRule::Closed).crossing(corners);
                // How far rounding can move weights: positions are of size 5, the triangle of `area`.
                let slack = epsilon / area;
                let least = weights.into_iter().fold(f64::INFINITY, f64::min);
                if least > slack {
                    prop_assert!(found.is_some(), "{test} misses: {weights:?}");
                } else if least < -slack {
                    prop_assert!(found.is_none(), "{test} invents: {weights:?}");
                }
                if let Some(found) = found {
                    let scale = direction.wide().length();
                    prop_assert!((found.t - t).abs() * scale <= 10.0 * slack, "{test}: t {}, not {t}", found.t);
                    prop_assert!((f64::from(found.u) - weights[1]).abs() <= slack + 1e-6);
                    prop_assert!((f64::from(found.v) - weights[2]).abs() <= slack + 1e-6);
                }
            }
        }
    }

    #[test]
    fn triangles_with_two_corners_in_one_place_are_never_hit(a in small_whole(), b in small_whole(), from in small_whole(), to in small_whole()) {
        let ray: Ray<f64> = Ray::new(from, to - from).into();
        prop_assume!(ray.is_valid());
        let nan = Point3::new(f32::NAN, 0.0, 0.0);
        for corners in [[a, a, a], [a, b, b], [a, b, a], [a, b, nan]] {
            for test in TriangleTest::ALL {
                for single in [true, false] {
                    let found = test.prepare(&ray, single, EdgeRule::Closed).crossing(corners);
                    prop_assert_eq!(found, None, "{} on {:?}", test, corners);
                }
            }
        }
    }

    #[test]
    fn needles_are_hit_at_most_where_they_are(a in small_whole(), b in small_whole(), from in small_whole(), to in small_whole()) {
        let ray: Ray<f64> = Ray::new(from, to - from).into();
        prop_assume!(ray.is_valid());
        let needle = [a, b, a.lerp(b, 0.5)];
        let along = ray.direction.dominant_axis();
        let exact = Vector3::<f64>::from([0.0; 3]) == {
            // Along an axis nothing is sheared, and nothing rounds.
            let mut across = ray.direction;
            across[along] = 0.0;
            across
        };
        for test in TriangleTest::ALL {
            if let Some(found) = test.prepare(&ray, true, EdgeRule::Closed).crossing(needle) {
                prop_assert!(!exact, "{test} hits {needle:?}");
                let off = (ray.at(found.t) - a.wide()).cross((b - a).wide()).length();
                prop_assert!(off < 1e-5, "{test} hits {needle:?} from {off}");
            }
        }
    }

    #[test]
    fn the_edge_of_two_triangles_is_crossed_once(
        quad in [small_whole(), small_whole(), small_whole(), small_whole()],
        from in small_whole(),
        sixteenths in 1_u8..16,
    ) {
        // a–b is the edge that the two share; c and d lie to either side as seen along the ray, or
        // on the same side: then both are crossed or neither.
        let [a, b, c, d] = quad;
        let target = a.lerp(b, f32::from(sixteenths) / 16.0);
        let ray: Ray<f64> = Ray { t_min: -1e3, ..Ray::new(from, target - from) }.into();
        prop_assume!(ray.is_valid());
        let side = |p: Point3| {
            let normal = (b - a).wide().cross(ray.direction);
            (p - a).wide().dot(normal)
        };
        prop_assume!(side(c) != 0.0 && side(d) != 0.0);
        let apart = (side(c) < 0.0) != (side(d) < 0.0);
        let test = TriangleTest::Watertight.prepare(&ray, true, EdgeRule::HalfOpen);
        let crossed = [[a, b, c], [b, a, d]].map(|corners| usize::from(test.crossing(corners).is_some()));
        let closed = TriangleTest::Watertight.prepare(&ray, true, EdgeRule::Closed);
        prop_assert!(!apart || closed.crossing([a, b, c]).is_some() || closed.crossing([b, a, d]).is_some());
        prop_assert_eq!(crossed[0] + crossed[1] == 1, apart, "{:?} crossed {:?}", ray, crossed);
    }

    #[test]
    fn size_does_not_matter(corners in corners(), origin in point(4.0), power in -60_i32..40) {
        // Everything times a power of two: all arithmetic stays the same.
        let size = 2_f32.powi(power);
        let scaled = |p: Point3| Point3::from(p.to_array().map(|x| x * size));
        let target = corners[0].lerp(corners[1], 0.4).lerp(corners[2], 0.3);
        let ray = |origin: Point3, target: Point3| Ray::<f64>::from(Ray::new(origin, target - origin));
        for test in TriangleTest::ALL {
            let here = test.prepare(&ray(origin, target), false, EdgeRule::Closed).crossing(corners);
            let there = ray(scaled(origin), scaled(target));
            let there = test.prepare(&there, false, EdgeRule::Closed).crossing(corners.map(scaled));
            prop_assert_eq!(here, there, "{}", test);
        }
    }
}

#[test]
fn coordinates_at_the_ends_of_the_number_range_give_no_crossing_at_infinity() {
    for size in [f32::MAX, f32::MIN_POSITIVE, 1e30, 1e-40, f32::INFINITY] {
        let corners = [
            Point3::new(-size, -size, -1.0),
            Point3::new(size, -size, -1.0),
            Point3::new(0.0, size, -1.0),
        ];
        for direction in [
            Vector3::new(0.0, 0.0, -1.0),
            Vector3::new(1e-20, size, -size),
        ] {
            let ray: Ray<f64> = Ray::new(Point3::ORIGIN, direction).into();
            if !ray.is_valid() {
                continue;
            }
            for test in TriangleTest::ALL {
                for single in [true, false] {
                    let found = test
                        .prepare(&ray, single, EdgeRule::Closed)
                        .crossing(corners);
                    assert!(
                        found.is_none_or(|c| c.t.is_finite() && !c.u.is_nan()),
                        "{found:?}"
                    );
                }
            }
        }
    }
}
