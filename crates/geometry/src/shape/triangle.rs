//! One triangle as a shape of its own.

use super::error::{ShapeError, finite};
use super::frame::unit;
use super::{Surface, SurfacePoint, SurfaceSample};
use crate::triangle::{TriangleKernel, Watertight, nearest};
use crate::{Aabb, Crossings, EdgeRule, Point3, Ray, Vector3, sampling};

/// A triangle on its own, seen from both sides. Many that share corners are a
/// [`TriangleMesh`](crate::TriangleMesh).
///
/// u and v are the barycentric weights of the second and third corner. The normal points to where
/// the corners run counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Its corners. A triangle whose corners lie on a line, or are not finite, is never hit.
    pub corners: [Point3; 3],
}

impl Triangle {
    /// From three corners.
    #[must_use]
    pub const fn new(a: Point3, b: Point3, c: Point3) -> Self {
        Self { corners: [a, b, c] }
    }

    /// Whether it can be hit.
    ///
    /// # Errors
    /// When a corner is not finite, or the corners lie on a line.
    pub fn validate(&self) -> Result<(), ShapeError> {
        for (corner, parameter) in
            self.corners
                .iter()
                .zip(["first corner", "second corner", "third corner"])
        {
            finite(parameter, corner.is_finite())?;
        }
        let parameter = "edges of the triangle";
        let [ab, ac] = self.edges();
        ab.cross(ac)
            .normalized()
            .map(drop)
            .ok_or(ShapeError::Parallel { parameter })
    }

    fn edges(&self) -> [Vector3<f64>; 2] {
        let [a, b, c] = self.corners.map(Point3::wide);
        [b - a, c - a]
    }
}

impl Surface for Triangle {
    fn crossings(&self, ray: &Ray<f64>) -> Crossings {
        if !ray.is_valid() {
            return Crossings::new();
        }
        let corners = self.corners.map(Point3::wide);
        Watertight::new(ray)
            .crossing(ray, corners, EdgeRule::Closed)
            // Rounding can give a needle some area; on its own it has none.
            .filter(|_| self.validate().is_ok())
            .into_iter()
            .collect()
    }

    fn bounds(&self) -> Aabb {
        if self.corners.iter().all(|corner| corner.is_finite()) {
            Aabb::around(self.corners)
        } else {
            Aabb::EMPTY
        }
    }

    fn to_nearest(&self, point: Point3<f64>) -> Vector3<f64> {
        nearest(point, self.corners.map(Point3::wide)).offset
    }

    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint {
        let [ab, ac] = self.edges();
        let cross = ab.cross(ac);
        let from_a = point - self.corners[0].wide();
        let weigh = |area: Vector3<f64>| unit(area.dot(cross) / cross.length_squared());
        SurfacePoint {
            normal: cross
                .normalized()
                .unwrap_or(Vector3::new(0.0, 0.0, 1.0))
                .to_normal(),
            uv: [weigh(from_a.cross(ac)), weigh(ab.cross(from_a))],
        }
    }

    fn area(&self) -> f64 {
        let [ab, ac] = self.edges();
        ab.cross(ac).length() / 2.0
    }

    fn sample(&self, xi: [f32; 2]) -> Option<SurfaceSample> {
        self.validate().ok()?;
        let [ab, ac] = self.edges();
        let [u, v] = sampling::uniform_triangle(xi);
        Some(SurfaceSample {
            point: self.corners[0].wide() + ab * u + ac * v,
            normal: ab.cross(ac).normalized()?.to_normal(),
            pdf: 1.0 / self.area(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_without_area_is_refused_and_never_hit() {
        let p = Point3::new(0.0, 0.0, -1.0);
        let needle = Triangle::new(p, p + Vector3::X, p + Vector3::X * 2.0);
        let nan = Triangle::new(p, p, Point3::new(f32::NAN, 0.0, 0.0));
        for bad in [Triangle::new(p, p, p), needle, nan] {
            assert!(bad.validate().is_err(), "{bad:?}");
            assert_eq!(bad.sample([0.5, 0.5]), None);
            let through = Ray::new(Point3::new(0.0, 0.0, 0.0), Vector3::new(0.0, 0.0, -1.0));
            assert!(bad.crossings(&through).is_empty(), "{bad:?}");
        }
        assert!(nan.bounds().is_empty());
    }

    #[test]
    fn its_corners_and_edges_belong_to_it() {
        let t = Triangle::new(
            Point3::ORIGIN,
            Point3::ORIGIN + Vector3::X,
            Point3::new(0.0, 1.0, 0.0),
        );
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.5), (0.25, 0.0)] {
            let down = Ray::new(Point3::new(x, y, 1.0), Vector3::new(0.0, 0.0, -1.0));
            let hit = t.crossings(&down)[0];
            assert_eq!((f64::from(hit.u), f64::from(hit.v)), (x, y));
            assert_eq!(t.surface_at(down.at(hit.t)).uv, [hit.u, hit.v]);
        }
    }
}
