//! The test as it is taught: three equations, three unknowns, Cramer's rule.
//!
//! A point of the ray that is a point of the triangle's plane solves
//! `a + u (b − a) + v (c − a) = e + t d`. By Cramer's rule each unknown is a quotient of two 3 × 3
//! determinants: below the one of the columns, above the same with the unknown's own column replaced
//! by the right-hand side.
//!
//! Nothing is compared with an epsilon: a triangle of any size is crossed, and only a determinant
//! of exactly 0 (a ray in the plane, a triangle without area) is "no crossing". Rays exactly through
//! an edge can slip between two triangles, since the two round differently.

use super::TriangleKernel;
use super::barycentric::Solution;
use crate::{Crossing, EdgeRule, Point3, Ray, Real, Vector3};

/// The test by Cramer's rule. Nothing is worked out ahead of the triangle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cramer;

impl<T: Real> TriangleKernel<T> for Cramer {
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
        let (ab, ac, back) = (b - a, c - a, -ray.direction);
        let right = ray.origin - a;
        let below = determinant(ab, ac, back);
        if below == T::zero() {
            return None;
        }
        let solution = Solution {
            u: determinant(right, ac, back) / below,
            v: determinant(ab, right, back) / below,
            t: determinant(ab, ac, right) / below,
        };
        solution.crossing(ray, [ab, ac], below > T::zero(), rule)
    }
}

/// The determinant of a 3 × 3 matrix by its columns.
#[inline]
fn determinant<T: Real>(first: Vector3<T>, second: Vector3<T>, third: Vector3<T>) -> T {
    first.dot(second.cross(third))
}
