//! The disk.

use std::f64::consts::PI;

use super::error::{ShapeError, direction, finite, positive};
use super::frame::{Frame, disk_reach, report, unit};
use super::plane::distance_along;
use super::turn::turn;
use super::{Surface, SurfacePoint, SurfaceSample};
use crate::{Aabb, Crossings, Normal3, Point3, Ray, Vector3, sampling};

/// A flat, round disk, seen from both sides.
///
/// u runs around the centre, v from the centre (0) to the rim (1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disk {
    pub(super) frame: Frame,
    pub(super) radius: f64,
}

impl Disk {
    /// From centre, normal (of any length) and radius.
    ///
    /// # Errors
    /// When a number is not finite, the normal is 0 or the radius is not above 0.
    pub fn new(centre: Point3, normal: Normal3, radius: f32) -> Result<Self, ShapeError> {
        finite("centre", centre.is_finite())?;
        let normal = direction("normal", normal.to_vector().wide())?;
        Ok(Self {
            frame: Frame::along(centre.wide(), normal),
            radius: positive("radius", radius)?,
        })
    }

    fn uv(&self, local: Vector3<f64>) -> [f32; 2] {
        let out = local.x.hypot(local.y) / self.radius;
        [turn(local.x, local.y), unit(out)]
    }
}

impl Surface for Disk {
    fn crossings(&self, ray: &Ray<f64>) -> Crossings {
        let mut found = Crossings::new();
        if !ray.is_valid() {
            return found;
        }
        let t = distance_along(ray, &self.frame);
        let local = self.frame.local(ray.at(t));
        if local.x * local.x + local.y * local.y <= self.radius * self.radius {
            report(&mut found, ray, t, || self.uv(local));
        }
        found
    }

    fn bounds(&self) -> Aabb {
        let reach = disk_reach(self.frame.z) * self.radius;
        let centre = self.frame.origin;
        Aabb::enclosing(Aabb::around([centre - reach, centre + reach]))
    }

    fn to_nearest(&self, point: Point3<f64>) -> Vector3<f64> {
        let local = self.frame.local(point);
        let out = local.x.hypot(local.y);
        // Within the rim it is straight down.
        let inward = if out > self.radius {
            self.radius / out - 1.0
        } else {
            0.0
        };
        let to = Vector3::new(local.x * inward, local.y * inward, -local.z);
        self.frame.world_vector(to)
    }

    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint {
        SurfacePoint {
            normal: self.frame.z.to_normal(),
            uv: self.uv(self.frame.local(point)),
        }
    }

    fn area(&self) -> f64 {
        PI * self.radius * self.radius
    }

    fn sample(&self, xi: [f32; 2]) -> Option<SurfaceSample> {
        let [x, y] = sampling::uniform_disk(xi);
        Some(SurfaceSample {
            point: self.frame.world(Vector3::new(x, y, 0.0) * self.radius),
            normal: self.frame.z.to_normal(),
            pdf: 1.0 / self.area(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disk_needs_a_normal_and_a_radius() {
        let up = Normal3::new(0.0, 0.0, 1.0);
        assert!(Disk::new(Point3::ORIGIN, Normal3::new(0.0, 0.0, 0.0), 1.0).is_err());
        for radius in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert!(Disk::new(Point3::ORIGIN, up, radius).is_err(), "{radius}");
        }
    }

    #[test]
    fn the_rim_belongs_to_the_disk_and_the_edge_is_not_seen() {
        let disk = Disk::new(Point3::ORIGIN, Normal3::new(0.0, 0.0, 1.0), 1.0).unwrap();
        let rim = Ray::new(Point3::new(1.0, 0.0, 2.0), Vector3::new(0.0, 0.0, -1.0));
        assert_eq!(disk.crossings(&rim)[0].t, 2.0);
        let edge_on = Ray::new(Point3::new(-5.0, 0.0, 0.0), Vector3::new(1.0, 0.0, 0.0));
        assert!(disk.crossings(&edge_on).is_empty());
    }
}
