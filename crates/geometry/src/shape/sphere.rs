//! The sphere: a quadratic, solved without cancellation.

use std::f64::consts::PI;

use super::{Surface, SurfacePoint, SurfaceSample};
use crate::{Aabb, Crossing, Crossings, Point3, Ray, Vector3};

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

    fn uv(direction: Vector3<f64>) -> [f32; 2] {
        let around = direction.y.atan2(direction.x) / (2.0 * PI);
        let around = if around < 0.0 { around + 1.0 } else { around };
        let up = direction.z.clamp(-1.0, 1.0).asin() / PI + 0.5;
        [around as f32, up as f32]
    }
}

impl Surface for Sphere {
    /// The lecture's A t² + B t + C = 0, with two changes against cancellation (Haines et al.,
    /// "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019, ch. 7): the
    /// discriminant comes from the distance of the centre from the line, and of the two roots the
    /// one that would subtract equals comes from the other one by Vieta's formula.
    fn crossings(&self, ray: &Ray<f64>) -> Crossings {
        let mut found = Crossings::new();
        let radius = f64::from(self.radius);
        if !ray.is_valid() || !(radius > 0.0) {
            return found;
        }
        let to_centre = self.centre.wide() - ray.origin;
        let a = ray.direction.length_squared();
        let half_b = to_centre.dot(ray.direction);
        let from_line = to_centre - ray.direction * (half_b / a);
        let discriminant = a * (radius * radius - from_line.length_squared());
        if !(discriminant >= 0.0) {
            return found;
        }
        let c = to_centre.length_squared() - radius * radius;
        let q = half_b + discriminant.sqrt().copysign(half_b);
        // q is 0 only where the centre is nearest at t = 0 and the line touches there.
        let (t0, t1) = if q == 0.0 { (0.0, 0.0) } else { (c / q, q / a) };
        let (near, far) = if t0 <= t1 { (t0, t1) } else { (t1, t0) };
        for t in if near == far {
            [Some(near), None]
        } else {
            [Some(near), Some(far)]
        }
        .into_iter()
        .flatten()
        {
            if ray.t_min <= t && t <= ray.t_max {
                let outward = (ray.at(t) - self.centre.wide()) / radius;
                let [u, v] = Self::uv(outward);
                found.push(Crossing { t, u, v });
            }
        }
        found
    }

    fn bounds(&self) -> Aabb {
        if !(self.radius > 0.0) {
            return Aabb::EMPTY;
        }
        let centre = self.centre.wide();
        Aabb::enclosing(Aabb::around([centre]).padded(f64::from(self.radius)))
    }

    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint {
        let outward = (point - self.centre.wide())
            .normalized()
            .unwrap_or(Vector3::new(0.0, 0.0, 1.0));
        SurfacePoint {
            normal: outward.to_normal(),
            uv: Self::uv(outward),
        }
    }

    fn area(&self) -> f64 {
        4.0 * PI * f64::from(self.radius) * f64::from(self.radius)
    }

    fn sample(&self, [x0, x1]: [f32; 2]) -> Option<SurfaceSample> {
        if !(self.radius > 0.0) {
            return None;
        }
        // Archimedes: the height of a uniform point on a sphere is uniform.
        let z = 1.0 - 2.0 * f64::from(x0);
        let ring = (1.0 - z * z).max(0.0).sqrt();
        let (sin, cos) = (2.0 * PI * f64::from(x1)).sin_cos();
        let outward = Vector3::new(ring * cos, ring * sin, z);
        Some(SurfaceSample {
            point: self.centre.wide() + outward * f64::from(self.radius),
            normal: outward.to_normal(),
            pdf: 1.0 / self.area(),
        })
    }
}
