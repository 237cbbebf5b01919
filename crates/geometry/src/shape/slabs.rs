//! A box along the axes of some frame: three slabs. What the two kinds of box share.
//!
//! Faces are numbered: twice the axis, plus one for the face on the far side of it.

use super::frame::unit;
use super::interval::Interval;
use crate::{Axis, Vector3, sampling};

/// The box `lo <= p <= hi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Slabs {
    pub(super) lo: Vector3<f64>,
    pub(super) hi: Vector3<f64>,
}

impl Slabs {
    /// The part of a line inside.
    #[inline]
    pub(super) fn clip(&self, origin: Vector3<f64>, direction: Vector3<f64>) -> Interval {
        let mut inside = Interval::LINE;
        for (i, axis) in Axis::ALL.into_iter().enumerate() {
            let speed = direction[axis];
            inside.cut(origin[axis] - self.lo[axis], -speed, 2 * i);
            inside.cut(self.hi[axis] - origin[axis], speed, 2 * i + 1);
        }
        inside
    }

    /// The face nearest to a point.
    pub(super) fn nearest_face(&self, point: Vector3<f64>) -> usize {
        let distance = |face: usize| {
            let axis = Axis::ALL[face / 2];
            (point[axis] - self.plane(face)).abs()
        };
        (0..6)
            .min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
            .unwrap_or(0)
    }

    /// From a point to the nearest point of the surface.
    pub(super) fn nearest(&self, point: Vector3<f64>) -> Vector3<f64> {
        let mut to = Vector3::new(0.0, 0.0, 0.0);
        for axis in Axis::ALL {
            // At most one of the two is not 0.
            to[axis] =
                (self.lo[axis] - point[axis]).max(0.0) + (self.hi[axis] - point[axis]).min(0.0);
        }
        if to.max_norm() == 0.0 {
            let face = self.nearest_face(point);
            let axis = Axis::ALL[face / 2];
            to[axis] = self.plane(face) - point[axis];
        }
        to
    }

    /// The outward normal of a face.
    pub(super) fn normal(face: usize) -> Vector3<f64> {
        let mut normal = Vector3::new(0.0, 0.0, 0.0);
        normal[Axis::ALL[face / 2]] = if face % 2 == 1 { 1.0 } else { -1.0 };
        normal
    }

    /// The surface parameters of a point on a face: along the two axes after the face's own.
    pub(super) fn uv(&self, face: usize, point: Vector3<f64>) -> [f32; 2] {
        let axis = Axis::ALL[face / 2];
        [axis.next(), axis.next().next()]
            .map(|a| unit((point[a] - self.lo[a]) / (self.hi[a] - self.lo[a])))
    }

    /// The area of the six faces.
    pub(super) fn area(&self) -> f64 {
        (0..6).map(|face| self.face_area(face)).sum()
    }

    /// A point on the surface and the face that it is on.
    pub(super) fn sample(&self, [x0, x1]: [f32; 2]) -> (Vector3<f64>, usize) {
        let areas = (0..6).map(|face| self.face_area(face));
        let (face, x0) = sampling::choose(f64::from(x0), areas);
        let axis = Axis::ALL[face / 2];
        let (s, t) = (axis.next(), axis.next().next());
        let mut point = Vector3::new(0.0, 0.0, 0.0);
        point[axis] = self.plane(face);
        point[s] = self.lo[s] + (self.hi[s] - self.lo[s]) * x0;
        point[t] = self.lo[t] + (self.hi[t] - self.lo[t]) * f64::from(x1);
        (point, face)
    }

    fn plane(&self, face: usize) -> f64 {
        let side = if face % 2 == 1 { self.hi } else { self.lo };
        side[Axis::ALL[face / 2]]
    }

    fn face_area(&self, face: usize) -> f64 {
        let axis = Axis::ALL[face / 2];
        let size = self.hi - self.lo;
        size[axis.next()] * size[axis.next().next()]
    }
}
