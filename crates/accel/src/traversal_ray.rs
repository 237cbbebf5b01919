//! A ray made ready for one structure, and how far rounding can carry a hit.
//!
//! # Why boxes are padded as they are
//! A hit with parameter t counts if its point, p = o + t d as double precision has it, lies in its
//! primitive's box padded by `hit_pad`. A structure that tests boxes must not miss such a box.
//!
//! For a far ray it does not start from the ray's origin o, where padding by a part of the distance
//! would blow every box up beyond telling apart, but from n = o + s d, the point of the ray's line
//! nearest to the middle of the structure (for a near ray s is 0 and n is o). What it asks is then
//! asked of τ = t − s: `t_min` and `t_max` become `t_min − s` and `t_max − s`, and since rounding is
//! monotone, τ as it is rounded lies between the two as they are rounded if t lies between its own.
//!
//! Let f and g be the distances from o and from n to the farthest corner, c the largest coordinate
//! of the bounds, and ε that of double precision. To compute n rounds numbers of f + g and g + c at
//! most, by half of ε each; p rounds f and c; τ, in terms of the point, g. So p − (n + τ d) is below
//! ε (f + 2 g + c). To test planes in double precision rounds 4 times more, numbers of g or c.
//! `PAD_IN_DOUBLE` · (f + g + c) with 8 ε is twice as much as all that. What a test in single
//! precision rounds comes on top: see the BVH's `Slabs`.

use ombra_geometry::{Aabb, Axis, Point3, Ray, Vector3};

/// A structure further away than this many of its extents is tested in double precision, and boxes
/// from a point near to it.
const FAR: f64 = 16.0;

/// How far the point of a hit found in single precision can lie from the true triangle, relative to
/// the distance between the origin and the far side of the structure. In the watertight test, moving
/// and shearing a corner rounds 4 times, the ray's own origin and direction have been rounded
/// (counted as 4), and t is rounded at most 4 times, each time by half of `f32::EPSILON`; its
/// weights are as good as exact. That makes 6, and as much again to be sure.
const HIT_PAD: f64 = 12.0 * f32::EPSILON as f64;

/// Where `HIT_PAD` stops growing, relative to the extent of the structure: what a structure that
/// cuts space pads its boxes by when it is built is twice this. `HIT_PAD · (FAR + 1)` is below it.
/// From so far away that double precision rounds more than this, the pad grows again.
const HIT_PAD_LIMIT: f64 = 1.0 / 32768.0;

// A near ray never reaches the limit of its pad.
const _: () = assert!(HIT_PAD * (FAR + 1.0) <= HIT_PAD_LIMIT);

/// How far rounding in double precision carries a point, relative to the numbers that are rounded.
const PAD_IN_DOUBLE: f64 = 8.0 * f64::EPSILON;

/// The size and place of a structure: what bounds the rounding of queries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    bounds: Aabb<f64>,
    centre: Point3<f64>,
    extent: f64,
    /// The largest coordinate.
    coordinate: f64,
}

impl Reach {
    /// Of some finite bounds, or of nothing if they are empty.
    #[must_use]
    pub fn of(bounds: &Aabb) -> Self {
        let bounds = bounds.wide();
        let (extent, coordinate) = if bounds.is_empty() {
            (0.0, 0.0)
        } else {
            let corners = [bounds.min, bounds.max].map(|corner| corner.to_vector().max_norm());
            (bounds.extent().max_norm(), corners[0].max(corners[1]))
        };
        Self {
            bounds,
            centre: bounds.centre(),
            extent,
            coordinate,
        }
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

    /// No hit that counts lies further than this from its primitive's box, unless the ray comes from
    /// more than 10¹⁰ extents away: from there double precision cannot tell points apart so well.
    /// Structures that cut space do not cut so far a ray (see `cells.rs`), and those that test boxes
    /// pad them by more.
    #[must_use]
    pub fn hit_pad_limit(&self) -> f64 {
        HIT_PAD_LIMIT * self.extent
    }

    /// The largest edge of the bounds.
    pub(crate) const fn extent(&self) -> f64 {
        self.extent
    }

    /// The largest coordinate of the bounds.
    pub(crate) const fn coordinate(&self) -> f64 {
        self.coordinate
    }

    /// Whether the size is one for which products of singles neither over- nor underflow.
    pub(crate) fn is_single(&self) -> bool {
        (1e-7..=1e10).contains(&self.extent)
    }

    /// Whether a point is so far away that the structure is small from there.
    #[inline]
    fn is_far_from(&self, point: Point3<f64>) -> bool {
        largest(point - self.centre) > FAR * self.extent
    }
}

/// A valid ray, made ready for the traversal of one structure.
#[derive(Clone, Copy, Debug)]
pub struct TraversalRay {
    /// The ray.
    pub ray: Ray<f64>,
    /// A hit counts if its point lies within its primitive's box padded by this.
    pub hit_pad: f64,
    /// Where structures that test boxes start from: the ray's origin or, if that is far away, the
    /// point of the ray's line that is nearest to the middle of the structure.
    pub box_origin: Point3<f64>,
    /// The t of `box_origin`.
    pub box_start: f64,
    /// By how much a structure that tests boxes from `box_origin` in double precision pads them.
    pub box_pad: f64,
    /// By how much one that does so in single precision pads them.
    pub single_box_pad: f64,
    /// From the origin to the farthest corner of the structure.
    farthest: f64,
    /// Of the structure.
    extent: f64,
    is_far: bool,
}

impl TraversalRay {
    /// Makes a ray ready; `None` if it is not valid.
    #[must_use]
    #[inline]
    pub fn new(ray: &Ray<f64>, reach: &Reach) -> Option<Self> {
        if !ray.is_valid() {
            return None;
        }
        let farthest = farthest_corner(ray.origin, &reach.bounds);
        let is_far = reach.is_far_from(ray.origin);
        let (box_start, box_origin, from_there) = if is_far {
            nearest_to(ray, &reach.bounds)
        } else {
            (0.0, ray.origin, farthest)
        };
        let hit_pad = (HIT_PAD * farthest)
            .min(reach.hit_pad_limit())
            .max(PAD_IN_DOUBLE * farthest);
        let box_pad = hit_pad + PAD_IN_DOUBLE * (farthest + from_there + reach.coordinate);
        Some(Self {
            ray: *ray,
            hit_pad,
            box_origin,
            box_start,
            box_pad,
            single_box_pad: box_pad + HIT_PAD * (from_there + box_pad),
            farthest,
            extent: reach.extent,
            is_far,
        })
    }

    /// One over each component of the direction; ±∞ where that is 0.
    #[must_use]
    #[inline]
    pub fn inverse_direction(&self) -> Vector3<f64> {
        let d = self.ray.direction;
        Vector3::new(1.0 / d.x, 1.0 / d.y, 1.0 / d.z)
    }

    /// Whether tests of primitives may use single precision: the structure is near, the origin is a
    /// single or near enough to one (that of an instance's ray may not be, if the instance lies far
    /// out in its own space), and neither the structure's size nor the ray's direction is where
    /// products of singles over- or underflow.
    ///
    /// Worked out here and not for every ray, since shapes and instances do not ask.
    #[must_use]
    #[inline]
    pub fn single(&self) -> bool {
        let rounded = self.ray.origin.cast::<f32>().wide();
        let off = (self.ray.origin - rounded).max_norm();
        !self.is_far
            && off <= 0.5 * f64::from(f32::EPSILON) * self.farthest
            && (1e-7..=1e10).contains(&self.extent)
            && (1e-10..=1e10).contains(&self.ray.direction.max_norm())
    }

    /// The part of the ray up to `t_max` within a box that is padded by `box_pad`, its t counted
    /// from `box_start`; `None` if there is none. `inverse` is the
    /// [`inverse_direction`](Self::inverse_direction).
    #[inline]
    pub(crate) fn clip(
        &self,
        inverse: Vector3<f64>,
        bounds: &Aabb<f64>,
        t_max: f64,
    ) -> Option<[f64; 2]> {
        let (mut from, mut to) = (self.ray.t_min - self.box_start, t_max - self.box_start);
        for axis in Axis::ALL {
            let origin = self.box_origin[axis];
            let lower = bounds.min[axis] - self.box_pad - origin;
            let upper = bounds.max[axis] + self.box_pad - origin;
            let inverse = inverse[axis];
            if !inverse.is_infinite() {
                let (a, b) = (lower * inverse, upper * inverse);
                from = from.max(a.min(b));
                to = to.min(a.max(b));
            } else if lower > 0.0 || upper < 0.0 {
                return None;
            }
        }
        (from <= to).then_some([from, to])
    }
}

/// The point of the ray's line nearest to the middle of a box, after its t and before its distance
/// from the farthest corner. Any point would do, and where numbers overflow it is the origin.
fn nearest_to(ray: &Ray<f64>, bounds: &Aabb<f64>) -> (f64, Point3<f64>, f64) {
    // In units in which squares neither over- nor underflow.
    let unit = ray.direction.max_norm();
    let direction = ray.direction / unit;
    let along = (bounds.centre() - ray.origin).dot(direction) / direction.dot(direction);
    let t = along / unit;
    let point = ray.at(t);
    let distance = farthest_corner(point, bounds);
    if t.is_finite() && distance.is_finite() {
        (t, point, distance)
    } else {
        (0.0, ray.origin, farthest_corner(ray.origin, bounds))
    }
}

/// The distance to the farthest corner of a box, in the maximum norm.
#[inline]
fn farthest_corner(from: Point3<f64>, bounds: &Aabb<f64>) -> f64 {
    largest_of(largest(from - bounds.min), largest(from - bounds.max))
}

/// The largest component in size, of a vector without NaN.
#[inline]
fn largest(v: Vector3<f64>) -> f64 {
    largest_of(largest_of(v.x.abs(), v.y.abs()), v.z.abs())
}

/// The larger of two numbers that are not NaN: unlike `max`, one instruction.
#[inline]
fn largest_of(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
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
