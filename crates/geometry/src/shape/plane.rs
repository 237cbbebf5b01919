//! The plane, endless.

use std::ops::ControlFlow;

use super::error::{ShapeError, direction, finite};
use super::frame::{Frame, collected, counts, unit};
use super::{Surface, SurfacePoint, SurfaceSample};
use crate::{Aabb, Crossing, Crossings, Normal3, Point3, Ray, Vector3};

/// An endless plane.
///
/// u and v count the units of length from the point along two axes in the plane, each starting over
/// at every whole unit, so that a texture repeats. For the normal +z they run along +x and +y; for
/// others along [`Vector3::orthonormal_basis`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    frame: Frame,
}

impl Plane {
    /// Through a point, with a normal of any length.
    ///
    /// # Errors
    /// When a number is not finite or the normal is 0.
    pub fn new(point: Point3, normal: Normal3) -> Result<Self, ShapeError> {
        finite("point", point.is_finite())?;
        let normal = direction("normal", normal.to_vector().wide())?;
        Ok(Self {
            frame: Frame::along(point.wide(), normal),
        })
    }

    /// The point that it was given by.
    #[must_use]
    pub const fn point(&self) -> Point3<f64> {
        self.frame.origin
    }

    /// Its unit normal.
    #[must_use]
    pub const fn normal(&self) -> Normal3<f64> {
        self.frame.z.to_normal()
    }

    fn uv(local: Vector3<f64>) -> [f32; 2] {
        [local.x, local.y].map(|x| unit(x - x.floor()))
    }
}

impl Surface for Plane {
    fn crossings(&self, ray: &Ray<f64>) -> Crossings {
        collected(self, ray)
    }

    #[inline]
    fn visit_crossings(
        &self,
        ray: &Ray<f64>,
        visit: &mut impl FnMut(Crossing) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let t = distance_along(ray, &self.frame);
        if !counts(ray, t) {
            return ControlFlow::Continue(());
        }
        let [u, v] = Self::uv(self.frame.local(ray.at(t)));
        visit(Crossing { t, u, v })
    }

    fn bounds(&self) -> Aabb {
        Aabb::UNBOUNDED
    }

    fn to_nearest(&self, point: Point3<f64>) -> Vector3<f64> {
        self.frame.z * (self.frame.origin - point).dot(self.frame.z)
    }

    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint {
        SurfacePoint {
            normal: self.frame.z.to_normal(),
            uv: Self::uv(self.frame.local(point)),
        }
    }

    fn area(&self) -> f64 {
        f64::INFINITY
    }

    fn sample(&self, _xi: [f32; 2]) -> Option<SurfaceSample> {
        None
    }
}

/// Where a ray meets the plane through the origin of a frame, across its z; not finite where it runs
/// along the plane.
#[inline]
pub(super) fn distance_along(ray: &Ray<f64>, frame: &Frame) -> f64 {
    (frame.origin - ray.origin).dot(frame.z) / ray.direction.dot(frame.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_needs_a_normal() {
        let refused = Plane::new(Point3::ORIGIN, Normal3::new(0.0, 0.0, 0.0));
        let parameter = "normal";
        assert_eq!(refused, Err(ShapeError::NoDirection { parameter }));
        let refused = Plane::new(Point3::new(0.0, f32::NAN, 0.0), Normal3::new(0.0, 0.0, 1.0));
        assert!(refused.is_err());
    }

    #[test]
    fn a_ray_along_the_plane_does_not_cross_it() {
        let floor = Plane::new(Point3::ORIGIN, Normal3::new(0.0, 0.0, 2.0)).unwrap();
        for height in [0.0, 1.0] {
            let along = Ray::new(Point3::new(0.0, 0.0, height), Vector3::new(1.0, 0.0, 0.0));
            assert!(floor.crossings(&along).is_empty());
        }
    }

    #[test]
    fn uv_starts_over_at_every_unit() {
        let floor = Plane::new(Point3::ORIGIN, Normal3::new(0.0, 0.0, 1.0)).unwrap();
        let down = |x, y| Ray::new(Point3::new(x, y, 3.0), Vector3::new(0.0, 0.0, -1.0));
        let hit = floor.crossings(&down(2.25, -0.25))[0];
        assert_eq!((hit.t, hit.u, hit.v), (3.0, 0.25, 0.75));
    }
}
