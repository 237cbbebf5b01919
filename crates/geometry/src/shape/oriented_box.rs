//! The box turned any way.

use super::error::{ShapeError, direction, finite, positive};
use super::frame::{Frame, LocalRay, report};
use super::slabs::Slabs;
use super::{Surface, SurfacePoint, SurfaceSample};
use crate::{Aabb, Crossings, Point3, Ray, Vector3};

/// A box turned any way. u and v are those of a [`Cuboid`](super::Cuboid) along its own axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientedBox {
    pub(super) frame: Frame,
    pub(super) slabs: Slabs,
}

impl OrientedBox {
    /// From its centre, the directions of its own x and y axis (of any length; of y, the part
    /// perpendicular to x counts) and its size along its three axes.
    ///
    /// # Errors
    /// When a number is not finite, an axis is 0, the two are parallel or a size is not above 0.
    pub fn new(
        centre: Point3,
        x_axis: Vector3,
        y_axis: Vector3,
        size: Vector3,
    ) -> Result<Self, ShapeError> {
        finite("centre", centre.is_finite())?;
        let x = direction("x axis", x_axis.wide())?;
        let y = direction("y axis", y_axis.wide())?;
        let parameter = "x and y axis";
        let z = x
            .cross(y)
            .normalized()
            .ok_or(ShapeError::Parallel { parameter })?;
        let y = z.cross(x);
        let half = Vector3::new(
            positive("size along x", size.x)?,
            positive("size along y", size.y)?,
            positive("size along z", size.z)?,
        ) / 2.0;
        Ok(Self {
            frame: Frame {
                origin: centre.wide(),
                x,
                y,
                z,
            },
            slabs: Slabs {
                lo: -half,
                hi: half,
            },
        })
    }
}

impl Surface for OrientedBox {
    fn crossings(&self, ray: &Ray<f64>) -> Crossings {
        let mut found = Crossings::new();
        let Some(local) = LocalRay::in_frame(ray, &self.frame) else {
            return found;
        };
        for (s, face) in self.slabs.clip(local.origin, local.direction).ends() {
            report(&mut found, ray, local.t(s), || {
                self.slabs.uv(face, local.at(s))
            });
        }
        found
    }

    fn bounds(&self) -> Aabb {
        let Frame { origin, x, y, z } = self.frame;
        let half = self.slabs.hi;
        let reach = |x: f64, y: f64, z: f64| x.abs() * half.x + y.abs() * half.y + z.abs() * half.z;
        let reach = Vector3::new(
            reach(x.x, y.x, z.x),
            reach(x.y, y.y, z.y),
            reach(x.z, y.z, z.z),
        );
        Aabb::enclosing(Aabb::around([origin - reach, origin + reach]))
    }

    fn to_nearest(&self, point: Point3<f64>) -> Vector3<f64> {
        let local = self.frame.local(point);
        self.frame.world_vector(self.slabs.nearest(local))
    }

    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint {
        let local = self.frame.local(point);
        let face = self.slabs.nearest_face(local);
        SurfacePoint {
            normal: self.frame.world_normal(Slabs::normal(face)),
            uv: self.slabs.uv(face, local),
        }
    }

    fn area(&self) -> f64 {
        self.slabs.area()
    }

    fn sample(&self, xi: [f32; 2]) -> Option<SurfaceSample> {
        let (point, face) = self.slabs.sample(xi);
        Some(SurfaceSample {
            point: self.frame.world(point),
            normal: self.frame.world_normal(Slabs::normal(face)),
            pdf: 1.0 / self.area(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_must_span_and_sizes_be_above_zero() {
        let one = Vector3::new(1.0, 1.0, 1.0);
        let make = |x, y, size| OrientedBox::new(Point3::ORIGIN, x, y, size);
        assert!(make(Vector3::X, Vector3::X, one).is_err());
        assert!(make(Vector3::ZERO, Vector3::Y, one).is_err());
        let refused = make(Vector3::X, Vector3::Y, Vector3::new(1.0, 0.0, 1.0));
        let (parameter, value) = ("size along y", 0.0);
        assert_eq!(refused, Err(ShapeError::NotPositive { parameter, value }));
    }

    #[test]
    fn a_turned_cube_is_met_at_its_corner() {
        let (x, y) = (Vector3::new(1.0, 1.0, 0.0), Vector3::new(-1.0, 1.0, 0.0));
        let turned = OrientedBox::new(Point3::ORIGIN, x, y, Vector3::new(2.0, 2.0, 2.0)).unwrap();
        let ray = Ray::new(Point3::new(-3.0, 0.0, 0.0), Vector3::new(1.0, 0.0, 0.0));
        let crossings = turned.crossings(&ray);
        assert_eq!(crossings.len(), 2);
        assert!((crossings[0].t - (3.0 - 2.0_f64.sqrt())).abs() < 1e-12);
    }
}
