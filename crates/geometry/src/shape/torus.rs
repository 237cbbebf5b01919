//! The torus: a quartic, solved between its turning points.

use std::f64::consts::PI;

use super::error::{ShapeError, direction, finite, positive};
use super::frame::{Frame, LocalRay, disk_reach, report};
use super::interval::Interval;
use super::turn::turn;
use super::{Surface, SurfacePoint, SurfaceSample};
use crate::polynomial::{bracketed_root, turning_points};
use crate::{Aabb, Crossings, Normal3, Point3, Ray, Vector3};

/// A ring: a tube bent around an axis.
///
/// u runs around the axis, v around the tube: from the outer side over the top (the side to which
/// the axis points) to the inner side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    pub(super) frame: Frame,
    /// From the centre to the middle of the tube.
    pub(super) major: f64,
    /// Of the tube.
    pub(super) minor: f64,
}

impl Torus {
    /// From its centre, its axis (of any length), the radius from the centre to the middle of the
    /// tube, and the radius of the tube.
    ///
    /// # Errors
    /// When a number is not finite, the axis is 0, a radius is not above 0, or the tube is so thick
    /// that it closes the hole (minor radius not below the major one).
    pub fn new(
        centre: Point3,
        axis: Normal3,
        major_radius: f32,
        minor_radius: f32,
    ) -> Result<Self, ShapeError> {
        finite("centre", centre.is_finite())?;
        let axis = direction("axis", axis.to_vector().wide())?;
        let major = positive("major radius", major_radius)?;
        let minor = positive("minor radius", minor_radius)?;
        if minor >= major {
            return Err(ShapeError::NotBelow {
                parameter: "minor radius",
                value: minor_radius,
                other: "major radius",
                limit: major_radius,
            });
        }
        let frame = Frame::along(centre.wide(), axis);
        Ok(Self {
            frame,
            major,
            minor,
        })
    }

    /// The signed distance from the surface, negative in the tube, and its change along `d`.
    fn distance(&self, p: Vector3<f64>, d: Vector3<f64>) -> (f64, f64) {
        let out = p.x.hypot(p.y);
        let from_ring = out - self.major;
        let from_middle = from_ring.hypot(p.z);
        let change = (from_ring * (p.x * d.x + p.y * d.y) / out + p.z * d.z) / from_middle;
        (from_middle - self.minor, change)
    }

    /// The part of a line that can be near the tube: in a ball, between two planes.
    fn reach(&self, local: &LocalRay) -> Interval {
        let radius = (self.major + self.minor) * (1.0 + 1e-9);
        let half = (radius * radius - local.origin.length_squared()).sqrt();
        let mut near = Interval::LINE;
        if !(half > 0.0) {
            near.clear();
            return near;
        }
        near.begin(-half, 0);
        near.end(half, 0);
        near.cut(self.minor - local.origin.z, local.direction.z, 0);
        near.cut(self.minor + local.origin.z, -local.direction.z, 0);
        near
    }

    /// The coefficients, constant first, of the polynomial that is 0 on the surface:
    /// (|p|² + R² − r²)² − 4 R² (x² + y²) along the ray.
    fn quartic(&self, local: &LocalRay) -> [f64; 5] {
        let (o, d) = (local.origin, local.direction);
        let b = o.dot(d);
        let k = o.length_squared() + (self.major - self.minor) * (self.major + self.minor);
        let f = 4.0 * self.major * self.major;
        [
            k * k - f * (o.x * o.x + o.y * o.y),
            4.0 * b * k - 2.0 * f * (o.x * d.x + o.y * d.y),
            4.0 * b * b + 2.0 * k - f * (d.x * d.x + d.y * d.y),
            4.0 * b,
            1.0,
        ]
    }

    /// Local coordinates from the angle around the axis and the angle around the tube: the point
    /// and the normal.
    fn at_angles(&self, around: f64, tube: f64) -> (Vector3<f64>, Vector3<f64>) {
        let ((sin_a, cos_a), (sin_t, cos_t)) = (around.sin_cos(), tube.sin_cos());
        let normal = Vector3::new(cos_t * cos_a, cos_t * sin_a, sin_t);
        let ring = Vector3::new(cos_a, sin_a, 0.0) * self.major;
        (ring + normal * self.minor, normal)
    }

    /// The unit normal where the surface is nearest to a point.
    fn outward(&self, local: Vector3<f64>) -> Vector3<f64> {
        let out = local.x.hypot(local.y);
        // On the axis any point of the ring is as near as any other.
        let (x, y) = if out > 0.0 {
            (local.x / out, local.y / out)
        } else {
            (1.0, 0.0)
        };
        let from_ring = out - self.major;
        let normal = Vector3::new(from_ring * x, from_ring * y, local.z);
        normal.normalized().unwrap_or(Vector3::new(x, y, 0.0))
    }

    fn uv(&self, local: Vector3<f64>) -> [f32; 2] {
        let out = local.x.hypot(local.y) - self.major;
        [turn(local.x, local.y), turn(out, local.z)]
    }
}

impl Surface for Torus {
    /// Between two neighbouring turning points a polynomial has one root or none, and the signs at
    /// both tell which: no root is missed or invented, and the line leaves the tube as often as it
    /// enters it (Yuksel, "High-Performance Polynomial Root Finding for Graphics", HPG 2022). Only
    /// the turning points come from the coefficients. The signs and the roots themselves come from
    /// the distance to the surface, which does not cancel.
    fn crossings(&self, ray: &Ray<f64>) -> Crossings {
        let mut found = Crossings::new();
        let Some(local) = LocalRay::in_frame(ray, &self.frame) else {
            return found;
        };
        let near = self.reach(&local);
        if !(near.enter < near.leave) {
            return found;
        }
        let along = |s: f64| self.distance(local.at(s), local.direction);
        let tolerance = f64::EPSILON * (self.major + self.minor);
        let turns = turning_points(&self.quartic(&local), near.enter, near.leave);
        let (mut last, mut was_inside) = (near.enter, false);
        for next in turns.into_iter().chain([near.leave]) {
            // The last one is outside by construction.
            let is_inside = next < near.leave && along(next).0 < 0.0;
            if is_inside != was_inside {
                let s = bracketed_root(last, next, was_inside, tolerance, along);
                report(&mut found, ray, local.t(s), || self.uv(local.at(s)));
            }
            (last, was_inside) = (next, is_inside);
        }
        found
    }

    fn bounds(&self) -> Aabb {
        let tube = Vector3::new(self.minor, self.minor, self.minor);
        let reach = disk_reach(self.frame.z) * self.major + tube;
        let centre = self.frame.origin;
        Aabb::enclosing(Aabb::around([centre - reach, centre + reach]))
    }

    fn to_nearest(&self, point: Point3<f64>) -> Vector3<f64> {
        let local = self.frame.local(point);
        let from_ring = local.x.hypot(local.y) - self.major;
        let out = self.minor - from_ring.hypot(local.z);
        self.frame.world_vector(self.outward(local) * out)
    }

    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint {
        let local = self.frame.local(point);
        SurfacePoint {
            normal: self.frame.world_normal(self.outward(local)),
            uv: self.uv(local),
        }
    }

    fn area(&self) -> f64 {
        4.0 * PI * PI * self.major * self.minor
    }

    /// Around the tube the density is proportional to the distance from the axis, R + r cos; its
    /// integral has no inverse in closed form and is inverted by the same root finder.
    fn sample(&self, [x0, x1]: [f32; 2]) -> Option<SurfaceSample> {
        let ratio = self.minor / self.major;
        let share = 2.0 * PI * f64::from(x0);
        let integral = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            (angle + ratio * sin - share, 1.0 + ratio * cos)
        };
        let tube = bracketed_root(0.0, 2.0 * PI, true, 1e-15, integral);
        let (point, normal) = self.at_angles(2.0 * PI * f64::from(x1), tube);
        Some(SurfaceSample {
            point: self.frame.world(point),
            normal: self.frame.world_normal(normal),
            pdf: 1.0 / self.area(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat() -> Torus {
        Torus::new(Point3::ORIGIN, Normal3::new(0.0, 0.0, 1.0), 2.0, 0.5).unwrap()
    }

    fn ts(origin: [f64; 3], direction: [f64; 3]) -> Vec<f64> {
        let ray = Ray::new(Point3::from(origin), Vector3::from(direction));
        flat().crossings(&ray).iter().map(|c| c.t).collect()
    }

    #[test]
    fn a_ring_needs_an_axis_and_a_hole() {
        let up = Normal3::new(0.0, 0.0, 1.0);
        let make = |axis, major, minor| Torus::new(Point3::ORIGIN, axis, major, minor);
        assert!(make(Normal3::new(0.0, 0.0, 0.0), 2.0, 1.0).is_err());
        assert!(make(up, 0.0, -1.0).is_err());
        assert!(make(up, 1.0, f32::NAN).is_err());
        let refused = make(up, 1.0, 1.0).unwrap_err();
        assert_eq!(
            refused.to_string(),
            "the minor radius is 1; it must be below the major radius, which is 1"
        );
    }

    #[test]
    fn a_line_through_the_middle_crosses_four_times() {
        let found = ts([-5.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
        assert_eq!(found.len(), 4);
        for (t, expected) in found.into_iter().zip([2.5, 3.5, 6.5, 7.5]) {
            assert!((t - expected).abs() < 1e-14, "{t}");
        }
    }

    #[test]
    fn the_hole_is_a_hole() {
        assert!(ts([0.0, 0.0, 5.0], [0.0, 0.0, -1.0]).is_empty());
        assert!(ts([1.0, 0.0, 5.0], [0.0, 0.0, -1.0]).is_empty());
        assert_eq!(ts([2.0, 0.0, 5.0], [0.0, 0.0, -1.0]), [4.5, 5.5]);
    }

    #[test]
    fn lying_on_the_top_touches_at_most() {
        let touching = ts([-5.0, 0.0, 0.5], [1.0, 0.0, 0.0]);
        assert!(touching.len() <= 2, "{touching:?}");
        assert!(ts([-5.0, 0.0, 0.500001], [1.0, 0.0, 0.0]).is_empty());
    }
}
