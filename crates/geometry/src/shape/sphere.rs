//! The sphere: a quadratic, solved without cancellation.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use super::error::{ShapeError, finite, positive};
use super::frame::{collected, counts};
use super::turn::turn;
use super::{Surface, SurfacePoint, SurfaceSample};
use crate::{Aabb, Crossing, Crossings, Normal3, Point3, Ray, Vector3, sampling};

/// A sphere.
///
/// u runs around the z axis from +x, v from the pole at −z (0) to the one at +z (1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Its centre.
    pub centre: Point3,
    /// Its radius, above 0. A sphere of radius 0 or less is never hit.
    pub radius: f32,
}

impl Sphere {
    /// From centre and radius.
    #[must_use]
    pub const fn new(centre: Point3, radius: f32) -> Self {
        Self { centre, radius }
    }

    /// Whether it can be hit.
    ///
    /// # Errors
    /// When a number is not finite, or the radius is not above 0.
    pub fn validate(&self) -> Result<(), ShapeError> {
        finite("centre", self.centre.is_finite())?;
        positive("radius", self.radius).map(drop)
    }

    fn uv(direction: Vector3<f64>) -> [f32; 2] {
        let Vector3 { x, y, z } = direction;
        [turn(x, y), 2.0 * turn(-z, (x * x + y * y).sqrt())]
    }
}

impl Surface for Sphere {
    fn crossings(&self, ray: &Ray<f64>) -> Crossings {
        collected(self, ray)
    }

    /// The lecture's A t² + B t + C = 0, with two changes against cancellation (Haines et al.,
    /// "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019, ch. 7): the
    /// discriminant comes from the distance of the centre from the line, and of the two roots the
    /// one that would subtract equals comes from the other one by Vieta's formula.
    #[inline]
    fn visit_crossings(
        &self,
        ray: &Ray<f64>,
        visit: &mut impl FnMut(Crossing) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let radius = f64::from(self.radius);
        let to_centre = self.centre.wide() - ray.origin;
        let a = ray.direction.length_squared();
        let half_b = to_centre.dot(ray.direction);
        let from_line = to_centre - ray.direction * (half_b / a);
        let discriminant = a * (radius * radius - from_line.length_squared());
        // Most lines pass by, so whether ray and sphere are fit to be asked comes after. NaN does not
        // get through either.
        if !(discriminant >= 0.0 && radius > 0.0) {
            return ControlFlow::Continue(());
        }
        let c = to_centre.length_squared() - radius * radius;
        let q = half_b + discriminant.sqrt().copysign(half_b);
        // q is 0 only where the centre is nearest at t = 0 and the line touches there.
        let (t0, t1) = if q == 0.0 { (0.0, 0.0) } else { (c / q, q / a) };
        let (near, far) = if t0 <= t1 { (t0, t1) } else { (t1, t0) };
        let uv = |t| Self::uv((ray.at(t) - self.centre.wide()) / radius);
        if counts(ray, near) {
            let [u, v] = uv(near);
            visit(Crossing { t: near, u, v })?;
        }
        if far > near && counts(ray, far) {
            let [u, v] = uv(far);
            visit(Crossing { t: far, u, v })?;
        }
        ControlFlow::Continue(())
    }

    fn bounds(&self) -> Aabb {
        if self.validate().is_err() {
            return Aabb::EMPTY;
        }
        let centre = self.centre.wide();
        Aabb::enclosing(Aabb::around([centre]).padded(f64::from(self.radius)))
    }

    fn to_nearest(&self, point: Point3<f64>) -> Vector3<f64> {
        let from_centre = point - self.centre.wide();
        let outward = self.normal_at(point).to_vector();
        outward * (f64::from(self.radius) - from_centre.length())
    }

    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint {
        let normal = self.normal_at(point);
        SurfacePoint {
            normal,
            uv: Self::uv(normal.to_vector()),
        }
    }

    fn normal_at(&self, point: Point3<f64>) -> Normal3<f64> {
        let outward = (point - self.centre.wide()).normalized();
        outward.unwrap_or(Vector3::new(0.0, 0.0, 1.0)).to_normal()
    }

    #[inline]
    fn leads_out(&self, point: Point3<f64>, direction: Vector3<f64>) -> bool {
        (point - self.centre.wide()).dot(direction) > 0.0
    }

    fn area(&self) -> f64 {
        4.0 * PI * f64::from(self.radius) * f64::from(self.radius)
    }

    fn sample(&self, xi: [f32; 2]) -> Option<SurfaceSample> {
        self.validate().ok()?;
        let outward = sampling::uniform_sphere(xi);
        Some(SurfaceSample {
            point: self.centre.wide() + outward * f64::from(self.radius),
            normal: outward.to_normal(),
            pdf: 1.0 / self.area(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_degenerate_sphere_is_refused_and_never_hit() {
        let at = |centre, radius| Sphere::new(centre, radius);
        let nan = Point3::new(f32::NAN, 0.0, 0.0);
        for bad in [
            at(Point3::ORIGIN, 0.0),
            at(Point3::ORIGIN, -1.0),
            at(Point3::ORIGIN, f32::NAN),
            at(nan, 1.0),
        ] {
            assert!(bad.validate().is_err());
            let through = Ray::new(Point3::new(-2.0, 0.0, 0.0), Vector3::new(1.0, 0.0, 0.0));
            assert!(bad.crossings(&through).is_empty(), "{bad:?}");
            assert!(bad.bounds().is_empty() && bad.sample([0.5, 0.5]).is_none());
        }
    }

    #[test]
    fn what_leads_out_goes_along_the_normal() {
        let ball = Sphere::new(Point3::new(1.0, -2.0, 0.5), 0.75);
        for i in 0..64 {
            let xi = [i % 8, i / 8].map(|x| (x as f32 + 0.5) / 8.0);
            let at = ball.sample(xi).unwrap();
            for direction in [(1.0, 0.0, 0.0), (-0.3, 0.9, 2.0), (0.0, -1.0, 0.1)] {
                let direction = Vector3::new(direction.0, direction.1, direction.2);
                let along = ball.normal_at(at.point).dot(direction) > 0.0;
                assert_eq!(ball.leads_out(at.point, direction), along);
            }
        }
    }

    #[test]
    fn from_far_away_it_is_still_round() {
        let ball = Sphere::new(Point3::ORIGIN, 1.0);
        let at = |y: f64| Ray::new(Point3::new(-1e8, y, 0.0), Vector3::new(1.0, 0.0, 0.0));
        assert_eq!(ball.crossings(&at(1.0 - 1e-9)).len(), 2);
        assert!(ball.crossings(&at(1.0 + 1e-9)).is_empty());
    }
}
