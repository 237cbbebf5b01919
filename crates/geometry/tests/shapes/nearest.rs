//! The nearest point of a shape lies on it, and nothing of it is nearer.

use ombra_geometry::shape::{Shape, Sphere, Surface as _};
use ombra_geometry::{Point3, Ray, Vector3};

use crate::random::Random;
use crate::reference::{Case, cases};
use crate::{SETS, extent};

/// Anywhere: within, beside, far away, on the surface, and where the nearest point jumps.
fn points(case: &Case, random: &mut Random) -> Vec<Point3<f64>> {
    let (centre, reach) = extent(case);
    let mut points = vec![centre];
    points.extend(&case.special);
    for _ in 0..12 {
        points.push(centre + random.vector(0.7) * reach);
        points.push(centre + random.direction() * (reach * random.magnitude(-1.0, 4.0)));
        points.extend(case.shape.sample(random.xi()).map(|sample| sample.point));
    }
    points
}

#[test]
fn the_nearest_point_lies_on_the_surface_and_nothing_is_nearer() {
    for set in 0..SETS {
        for case in cases(set) {
            let random = &mut Random(set + 2000);
            let (centre, reach) = extent(&case);
            for point in points(&case, random) {
                let about = || format!("{}: {point:?}: {:?}", case.name, case.shape);
                let to = case.shape.to_nearest(point);
                let distance = to.length();
                let origin = Point3::new(0.0, 0.0, 0.0);
                let farthest = distance + reach + (centre - origin).length();
                let tolerance = 1e-13 * farthest + 1e-9 * reach;
                let at = point + to;
                let off = (case.carrier)(at).abs();
                let out = (case.domain)(at);
                assert!(off <= tolerance, "off by {off}: {}", about());
                assert!(out <= tolerance, "{out} outside: {}", about());
                for _ in 0..20 {
                    if let Some(sample) = case.shape.sample(random.xi()) {
                        let other = (sample.point - point).length();
                        assert!(distance <= other + tolerance, "{other}: {}", about());
                    }
                    let ray = Ray::new(point, random.direction());
                    for crossing in case.shape.crossings(&ray) {
                        assert!(distance <= crossing.t + tolerance, "{}", about());
                    }
                }
            }
        }
    }
}

#[test]
fn within_a_sphere_the_way_leads_out() {
    let ball = Shape::from(Sphere::new(Point3::ORIGIN, 2.0));
    let to = ball.to_nearest(Point3::new(0.5, 0.0, 0.0));
    assert_eq!(to, Vector3::new(1.5, 0.0, 0.0));
    assert_eq!(ball.to_nearest(Point3::new(0.0, 0.0, 0.0)).length(), 2.0);
}
