//! The test of Möller and Trumbore: Cramer's rule with the common parts computed once.
//!
//! Möller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of Graphics Tools
//! 2(1), 1997.
//!
//! Where this departs from the paper:
//! 1. The determinant is compared with 0, not with an epsilon: an epsilon is a size below which
//!    triangles vanish.
//! 2. Neither side is culled.
//!
//! Rays exactly through an edge can slip between two triangles, since the two round differently.

use super::TriangleKernel;
use super::barycentric::Solution;
use crate::{Crossing, EdgeRule, Point3, Ray, Real};

/// The test of Möller and Trumbore. Nothing is worked out ahead of the triangle.
#[derive(Clone, Copy, Debug, Default)]
pub struct MollerTrumbore;

impl<T: Real> TriangleKernel<T> for MollerTrumbore {
    #[inline]
    fn new(_ray: &Ray<T>) -> Self {
        Self
    }

    #[inline]
    fn crossing(
        &self,
        ray: &Ray<T>,
        [a, b, c]: [Point3<T>; 3],
        rule: EdgeRule,
    ) -> Option<Crossing> {
        let (ab, ac) = (b - a, c - a);
        let p = ray.direction.cross(ac);
        let det = ab.dot(p);
        if det == T::zero() {
            return None;
        }
        let inverse = T::one() / det;
        let from_a = ray.origin - a;
        let u = from_a.dot(p) * inverse;
        if !(u >= T::zero() && u <= T::one()) {
            return None;
        }
        let q = from_a.cross(ab);
        let solution = Solution {
            u,
            v: ray.direction.dot(q) * inverse,
            t: ac.dot(q) * inverse,
        };
        solution.crossing(ray, [ab, ac], det > T::zero(), rule)
    }
}
