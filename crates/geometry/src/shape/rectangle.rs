//! The rectangle, and any other parallelogram.

use super::error::{ShapeError, direction, finite};
use super::frame::{Frame, nearest_of, report, unit};
use super::plane::distance_along;
use super::{Surface, SurfacePoint, SurfaceSample};
use crate::triangle::share;
use crate::{Aabb, Crossings, Point3, Ray, Vector3};

/// A rectangle or any other parallelogram, seen from both sides.
///
/// u runs along the first edge, v along the second. The normal is first × second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// At the corner, z the normal.
    pub(super) frame: Frame,
    pub(super) edges: [Vector3<f64>; 2],
    /// What has product 1 with its own edge and 0 with the other one.
    duals: [Vector3<f64>; 2],
    area: f64,
}

impl Rectangle {
    /// From a corner and the two edges that start there. They need not be perpendicular.
    ///
    /// # Errors
    /// When a number is not finite, an edge is 0 or the two are parallel.
    pub fn new(corner: Point3, first: Vector3, second: Vector3) -> Result<Self, ShapeError> {
        finite("corner", corner.is_finite())?;
        let edges = [first.wide(), second.wide()];
        let units = [
            direction("first edge", edges[0])?,
            direction("second edge", edges[1])?,
        ];
        let parameter = "two edges";
        let parallel = ShapeError::Parallel { parameter };
        let normal = units[0].cross(units[1]).normalized().ok_or(parallel)?;
        let cross = edges[0].cross(edges[1]);
        let area = cross.dot(normal);
        let duals = [edges[1].cross(normal) / area, normal.cross(edges[0]) / area];
        if !(area > 0.0 && duals.iter().all(|dual| dual.is_finite())) {
            return Err(parallel);
        }
        Ok(Self {
            frame: Frame::along(corner.wide(), normal),
            edges,
            duals,
            area,
        })
    }

    fn weights(&self, point: Point3<f64>) -> [f64; 2] {
        self.duals.map(|dual| (point - self.frame.origin).dot(dual))
    }
}

impl Surface for Rectangle {
    fn crossings(&self, ray: &Ray<f64>) -> Crossings {
        let mut found = Crossings::new();
        if !ray.is_valid() {
            return found;
        }
        let t = distance_along(ray, &self.frame);
        let weights = self.weights(ray.at(t));
        if weights.iter().all(|weight| (0.0..=1.0).contains(weight)) {
            report(&mut found, ray, t, || weights.map(unit));
        }
        found
    }

    fn bounds(&self) -> Aabb {
        let [first, second] = self.edges;
        let corner = self.frame.origin;
        Aabb::enclosing(Aabb::around([
            corner,
            corner + first,
            corner + second,
            corner + first + second,
        ]))
    }

    fn to_nearest(&self, point: Point3<f64>) -> Vector3<f64> {
        let weights = self.weights(point);
        let [first, second] = self.edges;
        let corner = self.frame.origin - point;
        if weights.iter().all(|weight| (0.0..=1.0).contains(weight)) {
            return self.frame.z * corner.dot(self.frame.z);
        }
        let edges = [
            (corner, first),
            (corner, second),
            (corner + first, second),
            (corner + second, first),
        ];
        nearest_of(edges.map(|(from, along)| from + along * share(from, along)))
    }

    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint {
        SurfacePoint {
            normal: self.frame.z.to_normal(),
            uv: self.weights(point).map(unit),
        }
    }

    fn area(&self) -> f64 {
        self.area
    }

    fn sample(&self, xi: [f32; 2]) -> Option<SurfaceSample> {
        let [a, b] = xi.map(f64::from);
        Some(SurfaceSample {
            point: self.frame.origin + self.edges[0] * a + self.edges[1] * b,
            normal: self.frame.z.to_normal(),
            pdf: 1.0 / self.area,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parallel_edges_span_nothing() {
        let refused = Rectangle::new(Point3::ORIGIN, Vector3::X, Vector3::new(-2.0, 0.0, 0.0));
        let parameter = "two edges";
        assert_eq!(refused, Err(ShapeError::Parallel { parameter }));
        assert!(Rectangle::new(Point3::ORIGIN, Vector3::ZERO, Vector3::Y).is_err());
    }

    #[test]
    fn edges_and_corners_belong_to_it() {
        let square = Rectangle::new(Point3::ORIGIN, Vector3::X, Vector3::Y).unwrap();
        for (x, y) in [(0.0, 0.0), (1.0, 1.0), (0.5, 0.0), (0.0, 0.5)] {
            let down = Ray::new(Point3::new(x, y, 1.0), Vector3::new(0.0, 0.0, -1.0));
            let hit = square.crossings(&down)[0];
            assert_eq!((f64::from(hit.u), f64::from(hit.v)), (x, y));
        }
    }

    #[test]
    fn a_tiny_one_is_as_good_as_a_large_one() {
        for size in [1e-30_f32, 1e-3, 1e15] {
            let square = Rectangle::new(
                Point3::ORIGIN,
                Vector3::new(size, 0.0, 0.0),
                Vector3::new(0.0, size, 0.0),
            )
            .unwrap();
            let half = f64::from(size) / 2.0;
            let down = Ray::new(Point3::new(half, half, 1.0), Vector3::new(0.0, 0.0, -1.0));
            assert_eq!(square.crossings(&down).len(), 1, "{size}");
        }
    }
}
