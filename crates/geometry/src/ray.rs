//! The ray: four fields, for ever.

use crate::{Point3, Real, Vector3};

/// The part of a line that a query asks about: `origin + t · direction` for t in `[t_min, t_max]`.
///
/// The direction need not be normalised: `t` counts in units of its length, and a `Hit`'s `t` is in
/// the same units. Whatever else a ray seems to need belongs in the payload of its program.
///
/// A ray is *valid* when its origin and direction are finite, its direction is not zero and
/// `t_min <= t_max` (`t_max` may be infinite). A query with an invalid ray is a miss, never a panic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray<T = f32> {
    /// Where t = 0.
    pub origin: Point3<T>,
    /// Where to, and how far one unit of t goes.
    pub direction: Vector3<T>,
    /// Crossings nearer than this do not count. At least 0 in ordinary use.
    pub t_min: T,
    /// Crossings farther than this do not count.
    pub t_max: T,
}

impl<T: Real> Ray<T> {
    /// A ray over t in `[0, ∞]`.
    #[must_use]
    #[inline]
    pub fn new(origin: Point3<T>, direction: Vector3<T>) -> Self {
        Self {
            origin,
            direction,
            t_min: T::zero(),
            t_max: T::infinity(),
        }
    }

    /// The segment between two points, t in `[0, 1]`.
    #[must_use]
    #[inline]
    pub fn between(from: Point3<T>, to: Point3<T>) -> Self {
        Self {
            t_max: T::one(),
            ..Self::new(from, to - from)
        }
    }

    /// The point at parameter `t`.
    #[must_use]
    #[inline]
    pub fn at(&self, t: T) -> Point3<T> {
        self.origin + self.direction * t
    }

    /// Whether a query with this ray can have an answer; see the type.
    #[must_use]
    #[inline]
    pub fn is_valid(&self) -> bool {
        let (o, d, zero) = (self.origin, self.direction, T::zero());
        // Finite numbers times 0 are 0, others are NaN. Every ray is asked, some more than once.
        let nothing =
            (o.x * zero + o.y * zero + o.z * zero) + (d.x * zero + d.y * zero + d.z * zero);
        let somewhere = (d.x != zero) | (d.y != zero) | (d.z != zero);
        (nothing == zero) & somewhere & (self.t_min <= self.t_max)
    }
}

impl From<Ray<f32>> for Ray<f64> {
    /// The same ray in double precision, exactly.
    #[inline]
    fn from(ray: Ray<f32>) -> Self {
        Self {
            origin: ray.origin.wide(),
            direction: ray.direction.wide(),
            t_min: ray.t_min.wide(),
            t_max: ray.t_max.wide(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_without_an_answer_are_invalid() {
        let good = Ray::new(Point3::ORIGIN, Vector3::X);
        assert!(good.is_valid());
        for bad in [
            Ray {
                direction: Vector3::ZERO,
                ..good
            },
            Ray {
                direction: Vector3::new(f32::NAN, 0.0, 1.0),
                ..good
            },
            Ray {
                direction: Vector3::new(f32::INFINITY, 0.0, 1.0),
                ..good
            },
            Ray {
                origin: Point3::new(0.0, f32::NAN, 0.0),
                ..good
            },
            Ray {
                t_min: f32::NAN,
                ..good
            },
            Ray {
                t_max: f32::NAN,
                ..good
            },
            Ray {
                t_min: 2.0,
                t_max: 1.0,
                ..good
            },
        ] {
            assert!(!bad.is_valid(), "{bad:?}");
        }
    }
}
