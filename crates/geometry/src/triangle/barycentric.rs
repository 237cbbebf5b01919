//! What the two tests that compute barycentric weights in space share: when weights are inside, and
//! who owns an edge.
//!
//! Both divide by a determinant, which is as small as the triangle is thin or seen from its edge, but
//! whose rounding is not. No bound on the error of t follows from the distance alone, as it does for
//! the watertight test. So these tests are run in double precision, where what is lost for a triangle
//! of single-precision corners stays below what a hit may be off by, slivers of 10⁻⁵ included.

use crate::{Crossing, EdgeRule, Ray, Real, Vector3};

/// A solution of `a + u (b − a) + v (c − a) = origin + t · direction`.
pub(super) struct Solution<T> {
    pub(super) t: T,
    pub(super) u: T,
    pub(super) v: T,
}

impl<T: Real> Solution<T> {
    /// As a crossing, if it lies in the triangle and counts for the ray. `edges` are b − a and
    /// c − a; `front` is whether the ray meets the side from which the corners run
    /// counter-clockwise. NaN in any number is "no".
    #[inline]
    pub(super) fn crossing(
        self,
        ray: &Ray<T>,
        edges: [Vector3<T>; 2],
        front: bool,
        rule: EdgeRule,
    ) -> Option<Crossing> {
        let Self { t, u, v } = self;
        let (zero, one) = (T::zero(), T::one());
        if !(u >= zero && v >= zero && u + v <= one) {
            return None;
        }
        if !(ray.t_min <= t && t <= ray.t_max && t < T::infinity()) {
            return None;
        }
        if rule == EdgeRule::HalfOpen {
            let [ab, ac] = edges;
            let owned = |edge| owns(edge, ray.direction, front);
            let given_away = (v == zero && !owned(ab))
                || (u == zero && !owned(-ac))
                || (u + v == one && !owned(ac - ab));
            if given_away {
                return None;
            }
        }
        Some(Crossing {
            t: t.wide(),
            u: u.wide() as f32,
            v: v.wide() as f32,
        })
    }
}

/// Whether a triangle owns an edge that the ray goes through, `edge` in the sense of its winding.
///
/// The rule is that of a ray moved by (1, ε, ε²) with ε towards 0: the edge then lies to one side
/// of it, which is the sign of the first component of edge × direction that is not 0. (Simulation of
/// simplicity: Edelsbrunner, Mücke, ACM Transactions on Graphics 9(1), 1990.)
fn owns<T: Real>(edge: Vector3<T>, direction: Vector3<T>, front: bool) -> bool {
    let side = edge.cross(direction);
    let first = [side.x, side.y, side.z]
        .into_iter()
        .find(|&s| s != T::zero());
    first.is_some_and(|s| (s > T::zero()) == front)
}
