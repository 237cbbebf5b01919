//! The axis-aligned bounding box.

use crate::{Axis, Point3, Real, Vector3};

/// An axis-aligned box: every point with `min <= p <= max` in each coordinate.
///
/// A box with `min > max` in some coordinate holds nothing; [`Aabb::EMPTY`] is the one that
/// [`union`](Self::union) starts from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb<T = f32> {
    /// The corner with the smallest coordinates.
    pub min: Point3<T>,
    /// The corner with the largest coordinates.
    pub max: Point3<T>,
}

impl Aabb<f32> {
    /// Holds nothing; its union with a box is that box.
    pub const EMPTY: Self = Self {
        min: Point3::new(f32::INFINITY, f32::INFINITY, f32::INFINITY),
        max: Point3::new(f32::NEG_INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY),
    };

    /// Holds everything: the bounds of an endless plane.
    pub const UNBOUNDED: Self = Self {
        min: Self::EMPTY.max,
        max: Self::EMPTY.min,
    };

    /// The smallest single-precision box that holds a double-precision one: rounded outward.
    #[must_use]
    pub fn enclosing(exact: Aabb<f64>) -> Self {
        let down = |x: f64| {
            let nearest = x as f32;
            if f64::from(nearest) > x {
                nearest.next_down()
            } else {
                nearest
            }
        };
        let up = |x: f64| -down(-x);
        Self {
            min: Point3::new(down(exact.min.x), down(exact.min.y), down(exact.min.z)),
            max: Point3::new(up(exact.max.x), up(exact.max.y), up(exact.max.z)),
        }
    }
}

impl<T: Real> Aabb<T> {
    /// The smallest box around some points; empty if there are none. NaN coordinates are passed over.
    #[must_use]
    pub fn around(points: impl IntoIterator<Item = Point3<T>>) -> Self {
        let inf = T::infinity();
        let empty = Self {
            min: Point3::new(inf, inf, inf),
            max: Point3::new(-inf, -inf, -inf),
        };
        points.into_iter().fold(empty, |bounds, p| Self {
            min: bounds.min.min(p),
            max: bounds.max.max(p),
        })
    }

    /// The smallest box that holds both.
    #[must_use]
    #[inline]
    pub fn union(self, other: Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// What lies in both; empty where they are apart.
    #[must_use]
    #[inline]
    pub fn intersection(self, other: Self) -> Self {
        Self {
            min: self.min.max(other.min),
            max: self.max.min(other.max),
        }
    }

    /// Whether the box holds no point. A box with a NaN counts as empty.
    #[must_use]
    #[inline]
    pub fn is_empty(&self) -> bool {
        !(self.min.x <= self.max.x && self.min.y <= self.max.y && self.min.z <= self.max.z)
    }

    /// Whether all six numbers are finite.
    #[must_use]
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }

    /// Whether a point lies in the box or on its surface.
    #[must_use]
    #[inline]
    pub fn contains(&self, p: Point3<T>) -> bool {
        let above = self.min.x <= p.x && self.min.y <= p.y && self.min.z <= p.z;
        above && p.x <= self.max.x && p.y <= self.max.y && p.z <= self.max.z
    }

    /// Whether another box lies within this one.
    #[must_use]
    #[inline]
    pub fn encloses(&self, other: &Self) -> bool {
        other.is_empty() || (self.contains(other.min) && self.contains(other.max))
    }

    /// Half way between the corners.
    #[must_use]
    #[inline]
    pub fn centre(&self) -> Point3<T> {
        let half = T::of(0.5);
        Point3::new(
            self.min.x * half + self.max.x * half,
            self.min.y * half + self.max.y * half,
            self.min.z * half + self.max.z * half,
        )
    }

    /// The edge lengths. Negative where the box is empty.
    #[must_use]
    #[inline]
    pub fn extent(&self) -> Vector3<T> {
        self.max - self.min
    }

    /// Half the surface area, which is what the surface area heuristic needs; 0 if empty.
    #[must_use]
    #[inline]
    pub fn half_area(&self) -> T {
        if self.is_empty() {
            return T::zero();
        }
        let e = self.extent();
        e.x * e.y + e.y * e.z + e.z * e.x
    }

    /// The box with every face moved outward by `distance`.
    #[must_use]
    #[inline]
    pub fn padded(&self, distance: T) -> Self {
        let by = Vector3::new(distance, distance, distance);
        Self {
            min: self.min - by,
            max: self.max + by,
        }
    }

    /// The eight corners; bit k of the index chooses `max` on axis k.
    #[must_use]
    pub fn corners(&self) -> [Point3<T>; 8] {
        std::array::from_fn(|i| {
            let pick = |bit: usize, a: Axis| {
                if i >> bit & 1 == 1 {
                    self.max[a]
                } else {
                    self.min[a]
                }
            };
            Point3::new(pick(0, Axis::X), pick(1, Axis::Y), pick(2, Axis::Z))
        })
    }

    /// The same box in double precision, exactly.
    #[must_use]
    #[inline]
    pub fn wide(&self) -> Aabb<f64> {
        Aabb {
            min: self.min.wide(),
            max: self.max.wide(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_is_the_neutral_element_of_union() {
        let b = Aabb::around([Point3::new(1.0, 2.0, 3.0), Point3::new(-1.0, 5.0, 0.0)]);
        assert_eq!(Aabb::EMPTY.union(b), b);
        assert!(Aabb::EMPTY.is_empty() && !b.is_empty());
        assert_eq!(Aabb::EMPTY.half_area(), 0.0);
    }

    #[test]
    fn a_point_has_a_box_without_area_that_holds_it() {
        let p = Point3::new(1e7_f32, -3.0, 0.25);
        let b = Aabb::around([p]);
        assert!(b.contains(p) && !b.is_empty());
        assert_eq!(b.half_area(), 0.0);
    }

    #[test]
    fn nan_makes_nothing_larger() {
        let b = Aabb::around([Point3::new(f32::NAN, 0.0, 0.0), Point3::ORIGIN]);
        assert_eq!(b, Aabb::around([Point3::ORIGIN]));
        assert!(
            Aabb {
                min: Point3::new(f32::NAN, 0.0, 0.0),
                ..b
            }
            .is_empty()
        );
    }

    #[test]
    fn rounding_outward_encloses() {
        let exact = Aabb {
            min: Point3::new(0.1_f64, -1e-50, 16_777_217.0),
            max: Point3::new(0.1_f64, 1e-50, 16_777_217.0),
        };
        assert!(Aabb::enclosing(exact).wide().encloses(&exact));
    }
}
