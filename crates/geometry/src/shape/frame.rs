//! The frame in which a shape is simple, and rays in it.

use std::ops::ControlFlow;

use super::Surface;
use crate::{Crossing, Crossings, Normal3, Point3, Ray, Vector3};

/// A place and three axes of unit length, right-handed and perpendicular to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    pub(super) origin: Point3<f64>,
    pub(super) x: Vector3<f64>,
    pub(super) y: Vector3<f64>,
    pub(super) z: Vector3<f64>,
}

impl Frame {
    /// With `axis`, a unit vector, as its z.
    pub(super) fn along(origin: Point3<f64>, axis: Vector3<f64>) -> Self {
        let (x, y) = axis.orthonormal_basis();
        let z = axis;
        Self { origin, x, y, z }
    }

    /// A point of the world in this frame.
    #[inline]
    pub(super) fn local(&self, point: Point3<f64>) -> Vector3<f64> {
        self.local_vector(point - self.origin)
    }

    /// A vector of the world in this frame.
    #[inline]
    pub(super) fn local_vector(&self, v: Vector3<f64>) -> Vector3<f64> {
        Vector3::new(v.dot(self.x), v.dot(self.y), v.dot(self.z))
    }

    /// A point of this frame in the world.
    #[inline]
    pub(super) fn world(&self, local: Vector3<f64>) -> Point3<f64> {
        self.origin + self.world_vector(local)
    }

    /// A vector of this frame in the world.
    #[inline]
    pub(super) fn world_vector(&self, local: Vector3<f64>) -> Vector3<f64> {
        self.x * local.x + self.y * local.y + self.z * local.z
    }

    /// A unit vector of this frame as a normal in the world.
    #[inline]
    pub(super) fn world_normal(&self, local: Vector3<f64>) -> Normal3<f64> {
        self.world_vector(local).to_normal()
    }
}

/// A ray in the frame of a shape, `origin + s · direction`, with a unit direction, and moved along
/// itself so that s = 0 is where it is nearest to the origin of the frame. So numbers are as small as
/// the shape is, however far away the ray starts and however long its direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocalRay {
    pub(super) origin: Vector3<f64>,
    pub(super) direction: Vector3<f64>,
    /// How far the ray's own origin is behind s = 0.
    start: f64,
    /// Units of t to one unit of s.
    scale: f64,
}

impl LocalRay {
    /// The ray in a frame; `None` if it is not valid.
    #[inline]
    pub(super) fn in_frame(ray: &Ray<f64>, frame: &Frame) -> Option<Self> {
        let local = Self::about(ray, frame.origin)?;
        Some(Self {
            origin: frame.local_vector(local.origin),
            direction: frame.local_vector(local.direction),
            ..local
        })
    }

    /// The ray relative to a point, the axes being those of the world; `None` if it is not valid.
    #[inline]
    pub(super) fn about(ray: &Ray<f64>, centre: Point3<f64>) -> Option<Self> {
        if !ray.is_valid() {
            return None;
        }
        let largest = ray.direction.max_norm();
        let scaled = ray.direction / largest;
        let length = scaled.length();
        let direction = scaled / length;
        let to_centre = centre - ray.origin;
        let start = to_centre.dot(direction);
        Some(Self {
            origin: direction * start - to_centre,
            direction,
            start,
            scale: 1.0 / length / largest,
        })
    }

    /// Where a point at `s` is on the ray itself.
    #[inline]
    pub(super) fn t(&self, s: f64) -> f64 {
        (self.start + s) * self.scale
    }

    /// The point at `s`.
    #[inline]
    pub(super) fn at(&self, s: f64) -> Vector3<f64> {
        self.origin + self.direction * s
    }
}

/// Adds a crossing if it counts for the ray. `uv` is only asked for then.
#[inline]
pub(super) fn report(found: &mut Crossings, ray: &Ray<f64>, t: f64, uv: impl FnOnce() -> [f32; 2]) {
    if ray.t_min <= t && t <= ray.t_max && t.is_finite() {
        let [u, v] = uv();
        found.push(Crossing { t, u, v });
    }
}

/// Whether a crossing counts that was found without asking whether the ray is valid.
#[inline]
pub(super) fn counts(ray: &Ray<f64>, t: f64) -> bool {
    ray.t_min <= t && t <= ray.t_max && t.is_finite() && ray.is_valid()
}

/// What a shape shows of its crossings, as a list.
pub(super) fn collected(shape: &impl Surface, ray: &Ray<f64>) -> Crossings {
    let mut found = Crossings::new();
    // Nothing breaks off.
    let _ = shape.visit_crossings(ray, &mut |crossing| {
        found.push(crossing);
        ControlFlow::Continue(())
    });
    found
}

/// A number that is in `[0, 1]` but for rounding; 0 for the 0 / 0 at the centre of nothing.
#[inline]
pub(super) fn unit(x: f64) -> f32 {
    if x.is_nan() {
        0.0
    } else {
        x.clamp(0.0, 1.0) as f32
    }
}

/// The shortest of some ways, the first of equally short ones.
pub(super) fn nearest_of(ways: impl IntoIterator<Item = Vector3<f64>>) -> Vector3<f64> {
    let longest = Vector3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY);
    ways.into_iter().fold(longest, |nearest, way| {
        if way.length_squared() < nearest.length_squared() {
            way
        } else {
            nearest
        }
    })
}

/// What a disk of radius 1 with unit normal `axis` takes up along each axis of the world.
pub(super) fn disk_reach(axis: Vector3<f64>) -> Vector3<f64> {
    // Not √(1 − x²): near an axis that would round to 0 or to 1.
    Vector3::new(
        axis.y.hypot(axis.z),
        axis.z.hypot(axis.x),
        axis.x.hypot(axis.y),
    )
}
