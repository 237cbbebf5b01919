//! The axis-aligned box as a shape.

use super::error::{ShapeError, finite};
use super::frame::report;
use super::slabs::Slabs;
use super::{Surface, SurfacePoint, SurfaceSample};
use crate::{Aabb, Crossings, Point3, Ray, Vector3};

/// A box along the axes. (The box *around* something is an [`Aabb`].)
///
/// On the faces across x, (u, v) run along (y, z); on those across y, along (z, x); on those across
/// z, along (x, y).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    pub(super) slabs: Slabs,
}

impl Cuboid {
    /// From two opposite corners, any two.
    ///
    /// # Errors
    /// When a number is not finite, or the box has no volume.
    pub fn new(corner: Point3, opposite: Point3) -> Result<Self, ShapeError> {
        finite("corner", corner.is_finite())?;
        finite("opposite corner", opposite.is_finite())?;
        let around = Aabb::around([corner, opposite]).wide();
        let size = around.extent();
        if !(size.x > 0.0 && size.y > 0.0 && size.z > 0.0) {
            return Err(ShapeError::NoVolume);
        }
        let (lo, hi) = (around.min.to_vector(), around.max.to_vector());
        let slabs = Slabs { lo, hi };
        Ok(Self { slabs })
    }
}

impl Surface for Cuboid {
    #[inline]
    fn crossings(&self, ray: &Ray<f64>) -> Crossings {
        let mut found = Crossings::new();
        if !ray.is_valid() {
            return found;
        }
        let inside = self.slabs.clip(ray.origin.to_vector(), ray.direction);
        for (t, face) in inside.ends() {
            report(&mut found, ray, t, || {
                self.slabs.uv(face, ray.at(t).to_vector())
            });
        }
        found
    }

    fn bounds(&self) -> Aabb {
        let point = |v: Vector3<f64>| Point3::from(v.to_array());
        Aabb::enclosing(Aabb {
            min: point(self.slabs.lo),
            max: point(self.slabs.hi),
        })
    }

    fn to_nearest(&self, point: Point3<f64>) -> Vector3<f64> {
        self.slabs.nearest(point.to_vector())
    }

    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint {
        let face = self.slabs.nearest_face(point.to_vector());
        SurfacePoint {
            normal: Slabs::normal(face).to_normal(),
            uv: self.slabs.uv(face, point.to_vector()),
        }
    }

    fn area(&self) -> f64 {
        self.slabs.area()
    }

    fn sample(&self, xi: [f32; 2]) -> Option<SurfaceSample> {
        let (point, face) = self.slabs.sample(xi);
        Some(SurfaceSample {
            point: Point3::from(point.to_array()),
            normal: Slabs::normal(face).to_normal(),
            pdf: 1.0 / self.area(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit_cube() -> Cuboid {
        Cuboid::new(Point3::new(1.0, 0.0, 1.0), Point3::new(0.0, 1.0, 0.0)).unwrap()
    }

    #[test]
    fn a_box_without_volume_is_refused() {
        let flat = Cuboid::new(Point3::ORIGIN, Point3::new(1.0, 0.0, 1.0));
        assert_eq!(flat, Err(ShapeError::NoVolume));
        assert!(Cuboid::new(Point3::ORIGIN, Point3::new(f32::INFINITY, 1.0, 1.0)).is_err());
    }

    #[test]
    fn a_ray_along_an_edge_or_through_corners_crosses_twice() {
        let cube = unit_cube();
        let along = Ray::new(Point3::new(-1.0, 0.0, 0.0), Vector3::new(1.0, 0.0, 0.0));
        let corners = Ray::new(Point3::new(-1.0, -1.0, -1.0), Vector3::new(1.0, 1.0, 1.0));
        for ray in [along, corners] {
            let ts: Vec<_> = cube.crossings(&ray).iter().map(|c| c.t).collect();
            assert_eq!(ts, [1.0, 2.0]);
        }
    }

    #[test]
    fn from_inside_only_the_way_out_counts() {
        let out = Ray::new(Point3::new(0.5, 0.5, 0.5), Vector3::new(0.0, -2.0, 0.0));
        let crossings = unit_cube().crossings(&out);
        assert_eq!(crossings.len(), 1);
        assert_eq!(crossings[0].t, 0.25);
    }
}
