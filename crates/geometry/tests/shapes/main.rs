//! Every shape against a reference that was written down a second time, as an implicit function in
//! double precision: what it crosses, its normals, its bounds, its area and its samples.

mod density;
mod nearest;
mod random;
mod reference;

use ombra_geometry::shape::{Shape, Surface};
use ombra_geometry::{Crossings, Point3, Ray, Vector3};

use random::Random;
use reference::{Case, cases};

/// How many sets of shapes are made, and how many lines are drawn through each shape.
const SETS: u64 = 24;
const LINES: usize = 150;

/// The middle of a shape and how far it reaches; of an endless one, some part of it.
fn extent(case: &Case) -> (Point3<f64>, f64) {
    let bounds = case.shape.bounds();
    if bounds.is_finite() {
        let bounds = bounds.wide();
        (bounds.centre(), bounds.extent().length() / 2.0)
    } else {
        (Point3::new(0.0, 0.0, 0.0), 10.0)
    }
}

/// A line, as a ray without ends, and how far a crossing may be off by rounding.
struct Line {
    ray: Ray<f64>,
    tolerance: f64,
    special: bool,
}

/// A line towards the shape from any distance: to a special point, or anywhere near.
fn line(case: &Case, random: &mut Random) -> Line {
    let (centre, reach) = extent(case);
    let special = !case.special.is_empty() && random.unit() < 0.3;
    let target = if special {
        case.special[(random.unit() * case.special.len() as f64) as usize]
    } else {
        centre + random.vector(0.7) * reach
    };
    let distance = reach * random.magnitude(-1.0, 4.0);
    let direction = if random.unit() < 0.2 {
        random.axis().wide()
    } else {
        random.direction()
    };
    let direction = direction.normalized().unwrap();
    let from = target - direction * distance;
    let farthest = distance + reach + (centre - Point3::new(0.0, 0.0, 0.0)).length();
    Line {
        ray: Ray {
            t_min: f64::NEG_INFINITY,
            ..Ray::new(from, direction * random.magnitude(-3.0, 3.0))
        },
        tolerance: 1e-13 * farthest + 1e-9 * reach,
        special,
    }
}

/// Runs a check with many lines through every shape.
fn with_lines(check: impl Fn(&Case, &Line, &Crossings)) {
    for set in 0..SETS {
        for case in cases(set) {
            let random = &mut Random(set + 1000);
            for _ in 0..LINES {
                let line = line(&case, random);
                check(&case, &line, &case.shape.crossings(&line.ray));
            }
        }
    }
}

/// The direction in which the carrier grows, by central differences, unless surfaces meet here.
fn gradient(case: &Case, at: Point3<f64>) -> Option<Vector3<f64>> {
    let step = 1e-6 * extent(case).1;
    let along = |x: f64, y: f64, z: f64| {
        let by = Vector3::new(x, y, z) * step;
        ((case.carrier)(at + by) - (case.carrier)(at - by)) / (2.0 * step)
    };
    let gradient = Vector3::new(
        along(1.0, 0.0, 0.0),
        along(0.0, 1.0, 0.0),
        along(0.0, 0.0, 1.0),
    );
    ((gradient.length() - 1.0).abs() < 1e-4).then_some(gradient)
}

#[test]
fn crossings_lie_on_the_surface_in_order() {
    with_lines(|case, line, crossings| {
        for crossing in crossings {
            let at = line.ray.at(crossing.t);
            let (off, out) = ((case.carrier)(at), (case.domain)(at));
            assert!(
                off.abs() <= line.tolerance,
                "{} is off by {off}: {:?}",
                case.name,
                case.shape
            );
            assert!(
                out <= line.tolerance,
                "{} is hit {out} outside: {:?}",
                case.name,
                case.shape
            );
        }
        // Equal where a line cuts an edge so near that rounding leaves no difference.
        let ordered = crossings.windows(2).all(|pair| pair[0].t <= pair[1].t);
        assert!(ordered, "{}: {crossings:?}", case.name);
    });
}

#[test]
fn no_change_of_sign_along_a_line_is_missed() {
    const STEPS: u32 = 250;
    with_lines(|case, line, crossings| {
        let (centre, reach) = extent(case);
        let length = line.ray.direction.length();
        let middle = (centre - line.ray.origin).dot(line.ray.direction) / length / length;
        let at = |t: f64| (case.carrier)(line.ray.at(t));
        let t_of = |i: u32| middle + (f64::from(i) / f64::from(STEPS) - 0.5) * 2.2 * reach / length;
        for (mut lo, mut hi) in (0..STEPS).map(|i| (t_of(i), t_of(i + 1))) {
            if at(lo).abs() < line.tolerance || at(hi).abs() < line.tolerance {
                continue;
            }
            let sign = at(lo) < 0.0;
            if sign == (at(hi) < 0.0) {
                continue;
            }
            for _ in 0..60 {
                let t = f64::midpoint(lo, hi);
                *(if (at(t) < 0.0) == sign {
                    &mut lo
                } else {
                    &mut hi
                }) = t;
            }
            let found = crossings.iter().any(|c| {
                let moved = (c.t - lo).abs() * length;
                // A grazing line moves along the surface by far more than it moves off it.
                moved <= line.tolerance || at(c.t).abs() <= line.tolerance && moved < 0.05 * reach
            });
            let inside = (case.domain)(line.ray.at(lo)) < -line.tolerance;
            assert!(
                found || !inside,
                "{} misses t = {lo}: {:?}, {:?}",
                case.name,
                case.shape,
                line.ray
            );
        }
    });
}

#[test]
fn closed_shapes_are_crossed_an_even_number_of_times() {
    with_lines(|case, line, crossings| {
        // One that touches is the exception: then the line does not get inside to speak of.
        let touches = crossings.len() == 1;
        assert!(
            !case.closed || crossings.len() % 2 == 0 || (touches && line.special),
            "{}: {crossings:?} on {:?}, {:?}",
            case.name,
            line.ray,
            case.shape
        );
        for pair in crossings.chunks_exact(2).filter(|_| case.closed) {
            let between = line.ray.at(f64::midpoint(pair[0].t, pair[1].t));
            assert!(
                (case.carrier)(between) <= line.tolerance,
                "{} is not solid",
                case.name
            );
        }
    });
}

#[test]
fn a_shorter_ray_has_those_crossings_that_are_on_it() {
    with_lines(|case, line, crossings| {
        let Some(first) = crossings.first() else {
            return;
        };
        let last = crossings[crossings.len() - 1];
        for (t_min, t_max) in [
            (first.t, last.t),
            (first.t.next_up(), f64::INFINITY),
            (f64::NEG_INFINITY, last.t.next_down()),
            (last.t.next_up(), f64::INFINITY),
        ] {
            let ray = Ray {
                t_min,
                t_max,
                ..line.ray
            };
            let expected: Vec<_> = crossings
                .iter()
                .filter(|c| t_min <= c.t && c.t <= t_max)
                .copied()
                .collect();
            assert_eq!(
                case.shape.crossings(&ray).as_slice(),
                expected,
                "{}",
                case.name
            );
        }
    });
}

#[test]
fn normals_are_unit_and_follow_the_gradient() {
    with_lines(|case, line, crossings| {
        for crossing in crossings {
            let at = line.ray.at(crossing.t);
            let normal = case.shape.surface_at(at).normal;
            assert!((normal.length() - 1.0).abs() < 1e-9, "{}", case.name);
            if let Some(gradient) = gradient(case, at).filter(|_| !line.special) {
                let cosine = normal.dot(gradient);
                assert!(
                    cosine > 1.0 - 1e-4,
                    "{}: {normal:?}, not {gradient:?}",
                    case.name
                );
            }
        }
    });
}

#[test]
fn uv_is_in_the_unit_square_and_the_same_both_ways() {
    with_lines(|case, line, crossings| {
        for crossing in crossings {
            let at = line.ray.at(crossing.t);
            let uv = case.shape.surface_at(at).uv;
            for (there, here) in uv.into_iter().zip([crossing.u, crossing.v]) {
                let valid = |x: f32| (0.0..=1.0).contains(&x);
                assert!(
                    valid(there) && valid(here),
                    "{}: {there}, {here}",
                    case.name
                );
                if line.special || gradient(case, at).is_none() {
                    continue;
                }
                let off = (there - here).abs();
                assert!(off.min(1.0 - off) < 1e-3, "{}: {there}, {here}", case.name);
            }
        }
    });
}

#[test]
fn bounds_hold_every_crossing() {
    with_lines(|case, line, crossings| {
        let bounds = case.shape.bounds().wide().padded(line.tolerance);
        for crossing in crossings {
            assert!(bounds.contains(line.ray.at(crossing.t)), "{}", case.name);
        }
    });
}

#[test]
fn rays_without_a_meaning_cross_nothing() {
    let good = Ray::new(Point3::new(0.0, 0.0, 0.0), Vector3::new(1.0, 0.5, 0.25));
    let nan = f64::NAN;
    for case in cases(1) {
        for bad in [
            Ray {
                direction: Vector3::new(0.0, 0.0, 0.0),
                ..good
            },
            Ray {
                direction: Vector3::new(nan, 0.0, 1.0),
                ..good
            },
            Ray {
                direction: Vector3::new(f64::INFINITY, 0.0, 1.0),
                ..good
            },
            Ray {
                origin: Point3::new(0.0, nan, 0.0),
                ..good
            },
            Ray { t_min: nan, ..good },
            Ray {
                t_min: 1.0,
                t_max: 0.0,
                ..good
            },
        ] {
            assert!(
                case.shape.crossings(&bad).is_empty(),
                "{}: {bad:?}",
                case.name
            );
        }
    }
}

#[test]
fn the_length_of_a_direction_only_scales_t() {
    with_lines(|case, line, crossings| {
        for factor in [1e-30, 1e30] {
            let ray = Ray {
                direction: line.ray.direction * factor,
                ..line.ray
            };
            let scaled = case.shape.crossings(&ray);
            // Right at an edge either answer is right.
            assert!(
                scaled.len() == crossings.len() || line.special,
                "{}",
                case.name
            );
            for (a, b) in scaled.iter().zip(crossings).filter(|_| !line.special) {
                let off = (case.carrier)(ray.at(a.t)).abs();
                assert!(off <= line.tolerance, "{}: {a:?}, {b:?}", case.name);
            }
        }
    });
}

#[test]
fn every_shape_made_here_is_valid() {
    for case in cases(7) {
        assert_eq!(case.shape.validate(), Ok(()), "{}", case.name);
        let copy: Shape = case.shape.clone();
        assert_eq!(copy, case.shape);
    }
}
