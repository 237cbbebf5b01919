//! A ray made ready for one structure, and how far rounding can carry a hit.

use ombra_geometry::{Aabb, Point3, Ray, Vector3};

/// A structure further away than this many of its extents is tested in double precision.
const FAR: f64 = 16.0;

/// How far the point of a hit found in single precision can lie from the true triangle, relative to
/// the distance between the origin and the far side of the structure. In the watertight test, moving
/// and shearing a corner rounds 4 times, the ray's own origin and direction have been rounded
/// (counted as 4), and t is rounded at most 4 times, each time by half of `f32::EPSILON`; its
/// weights are as good as exact. That makes 6, and as much again to be sure.
const HIT_PAD: f64 = 12.0 * f32::EPSILON as f64;

/// Where `HIT_PAD` stops growing, relative to the extent of the structure: what a structure that
/// cuts space pads its boxes by when it is built is twice this. `HIT_PAD · (FAR + 1)` is below it.
const HIT_PAD_LIMIT: f64 = 1.0 / 32768.0;

// A near ray never reaches the limit of its pad.
const _: () = assert!(HIT_PAD * (FAR + 1.0) <= HIT_PAD_LIMIT);

/// The size and place of a structure: what bounds the rounding of queries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    bounds: Aabb<f64>,
    extent: f64,
}

impl Reach {
    /// Of some finite bounds, or of nothing if they are empty.
    #[must_use]
    pub fn of(bounds: &Aabb) -> Self {
        let bounds = bounds.wide();
        let extent = if bounds.is_empty() {
            0.0
        } else {
            bounds.extent().max_norm()
        };
        Self { bounds, extent }
    }

    /// The bounds themselves.
    #[must_use]
    pub const fn bounds(&self) -> &Aabb<f64> {
        &self.bounds
    }

    /// By how much a structure that cuts space pads the boxes of its primitives when it is built,
    /// so that every hit that counts lies in a cell that lists its primitive. Such a structure
    /// computes in double precision, whose own rounding is far below the slack that this has.
    #[must_use]
    pub fn partition_pad(&self) -> f64 {
        2.0 * self.hit_pad_limit()
    }

    /// No hit that counts lies further than this from its primitive's box, whatever the ray.
    #[must_use]
    pub fn hit_pad_limit(&self) -> f64 {
        HIT_PAD_LIMIT * self.extent
    }

    /// Whether single precision will do for this ray: the structure is near, the origin is a
    /// single or near enough to one (that of an instance's ray may not be, if the instance lies far
    /// out in its own space), and neither the structure's size nor the ray's direction is where
    /// products of singles over- or underflow.
    fn single(&self, ray: &Ray<f64>, farthest: f64) -> bool {
        let away = (ray.origin - self.bounds.centre()).max_norm();
        let rounded = ray.origin.cast::<f32>().wide();
        away <= FAR * self.extent
            && (ray.origin - rounded).max_norm() <= 0.5 * f64::from(f32::EPSILON) * farthest
            && (1e-7..=1e10).contains(&self.extent)
            && (1e-10..=1e10).contains(&ray.direction.max_norm())
    }
}

/// A valid ray, made ready for the traversal of one structure.
#[derive(Clone, Copy, Debug)]
pub struct TraversalRay {
    /// The ray.
    pub ray: Ray<f64>,
    /// One over each component of the direction; ±∞ where that is 0.
    pub inverse_direction: Vector3<f64>,
    /// A hit counts if its point lies within its primitive's box padded by this.
    pub hit_pad: f64,
    /// By how much a structure that tests boxes in single precision pads them.
    pub box_pad: f64,
    /// From the origin to the farthest corner of the structure.
    farthest: f64,
    reach: Reach,
}

impl TraversalRay {
    /// Makes a ray ready; `None` if it is not valid.
    #[must_use]
    #[inline]
    pub fn new(ray: &Ray<f64>, reach: &Reach) -> Option<Self> {
        if !ray.is_valid() {
            return None;
        }
        let d = ray.direction;
        let farthest = farthest_corner(ray.origin, &reach.bounds);
        Some(Self {
            ray: *ray,
            inverse_direction: Vector3::new(1.0 / d.x, 1.0 / d.y, 1.0 / d.z),
            hit_pad: (HIT_PAD * farthest).min(reach.hit_pad_limit()),
            box_pad: 2.0 * HIT_PAD * farthest,
            farthest,
            reach: *reach,
        })
    }

    /// Whether tests of primitives may use single precision. Worked out here and not for every ray,
    /// since shapes and instances do not ask.
    #[must_use]
    #[inline]
    pub fn single(&self) -> bool {
        self.reach.single(&self.ray, self.farthest)
    }
}

/// The distance to the farthest corner of a box, in the maximum norm.
#[inline]
fn farthest_corner(from: Point3<f64>, bounds: &Aabb<f64>) -> f64 {
    (from - bounds.min)
        .max_norm()
        .max((from - bounds.max).max_norm())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_and_tiny_structures_are_tested_in_double_precision() {
        let unit = Aabb::around([Point3::ORIGIN, Point3::new(1.0, 1.0, 1.0)]);
        let ray = |x: f64| Ray::new(Point3::new(x, 0.0, 0.0), Vector3::new(-1.0, 0.0, 0.0));
        let single =
            |ray: &Ray<f64>, b: &Aabb| TraversalRay::new(ray, &Reach::of(b)).unwrap().single();
        assert!(single(&ray(2.0), &unit));
        assert!(!single(&ray(1e3), &unit));
        let tiny = Aabb::around([Point3::ORIGIN, Point3::new(1e-12, 0.0, 0.0)]);
        assert!(!single(&ray(0.0), &tiny));
    }
}
