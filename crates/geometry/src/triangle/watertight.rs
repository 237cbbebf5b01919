//! The watertight test: no ray slips between two triangles that share an edge.
//!
//! Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
//!
//! The idea: shear space so that the ray becomes the z axis through the origin; then the question
//! is on which side of three edges the origin lies in the plane. A corner is sheared by itself, so
//! triangles that share it agree on where it is, and two triangles that share an edge compute its
//! side from the same two sheared corners with opposite sign: they cannot both say "outside".
//!
//! Where this departs from the paper:
//! 1. The winding is kept when axes are swapped, but nothing is culled by it.
//! 2. What is not a miss is decided again in double precision, where the sign of every edge
//!    function is the true one (see `edge_exact`). A sign that is not 0 was the true one already:
//!    rounding is monotone, so the difference of two rounded products never has the wrong sign, and
//!    no hit has been turned away. The paper does this only where an edge function is 0 in single
//!    precision; here every hit gets weights without cancellation, so that the t of a sliver, or of
//!    a triangle seen from its edge, is as good as any other.
//! 3. Under [`EdgeRule::HalfOpen`] an origin exactly on an edge belongs to the triangle for which
//!    the edge points down, or to the left if it is level: the rule of rasterizers. It decides as if
//!    the origin were moved a little, the same way for all triangles, and since all signs are true,
//!    a closed mesh is crossed an even number of times by a line, through vertices too.
//! 4. `t` is not compared in scaled form: one division a hit is not what costs.

use super::TriangleKernel;
use crate::{Axis, Crossing, EdgeRule, Point3, Ray, Real, Vector3};

/// What the watertight test works out once a ray.
#[derive(Clone, Copy, Debug)]
pub struct Watertight<T> {
    kx: Axis,
    ky: Axis,
    kz: Axis,
    shear: Vector3<T>,
}

/// What takes the places of x, y and z, by the axis that becomes z and by whether the ray goes down
/// it: two axes change places then, so that the winding is kept. A table, since the directions of
/// rays are hard to guess for a processor.
const AXES: [[[Axis; 3]; 3]; 2] = {
    use Axis::{X, Y, Z};
    [
        [[Y, Z, X], [Z, X, Y], [X, Y, Z]],
        [[Z, Y, X], [X, Z, Y], [Y, X, Z]],
    ]
};

impl<T: Real> TriangleKernel<T> for Watertight<T> {
    #[inline]
    fn new(ray: &Ray<T>) -> Self {
        let d = ray.direction.to_array();
        let kz = ray.direction.dominant_axis() as usize;
        let [kx, ky, kz] = AXES[usize::from(d[kz] < T::zero())][kz];
        let (x, y, z) = (d[kx as usize], d[ky as usize], d[kz as usize]);
        let shear = Vector3::new(x / z, y / z, T::one() / z);
        Self { kx, ky, kz, shear }
    }

    #[inline]
    fn crossing(&self, ray: &Ray<T>, corners: [Point3<T>; 3], rule: EdgeRule) -> Option<Crossing> {
        let corners = corners.map(|corner| self.sheared(corner - ray.origin));
        let [a, b, c] = corners;
        if on_both_sides([edge(c, b), edge(a, c), edge(b, a)]) {
            return None;
        }
        self.decide(corners, rule)
            .filter(|crossing| in_range(ray, crossing.t))
    }
}

impl<T: Real> Watertight<T> {
    /// The axes that take the places of x, y and z in the space where the ray is the z axis.
    #[must_use]
    #[inline]
    pub const fn axes(&self) -> [Axis; 3] {
        [self.kx, self.ky, self.kz]
    }

    /// How far x and y are sheared for each unit of z, and what t is for each unit of z.
    #[must_use]
    #[inline]
    pub const fn shear(&self) -> Vector3<T> {
        self.shear
    }

    /// The second half of the test, for a triangle that the first half did not turn away: its
    /// corners relative to the origin of the ray and sheared. Whether the crossing is in the ray's
    /// range is not asked.
    #[must_use]
    #[inline]
    pub fn decide(&self, corners: [Vector3<T>; 3], rule: EdgeRule) -> Option<Crossing> {
        let [a, b, c] = corners;
        let (a, b, c) = (a.wide(), b.wide(), c.wide());
        let edge = edge_exact::<T>;
        let (u, v, w) = (edge(c, b), edge(a, c), edge(b, a));
        if on_both_sides([u, v, w]) {
            return None;
        }
        let det = u + v + w;
        // Not `== 0`: a NaN corner ends here too.
        if !(det.abs() > 0.0) {
            return None;
        }
        if rule == EdgeRule::HalfOpen {
            let flip = det < 0.0;
            let owned = |side: f64, from, to| side != 0.0 || owns(from, to, flip);
            if !(owned(u, b, c) && owned(v, c, a) && owned(w, a, b)) {
                return None;
            }
        }
        // The weights first: their sum is 1, and products with them leave no number range.
        let inverse = 1.0 / det;
        let (u, v, w) = (u * inverse, v * inverse, w * inverse);
        let z = u * a.z + v * b.z + w * c.z;
        Some(Crossing {
            t: T::of(z * self.shear.z.wide()).wide(),
            u: v as f32,
            v: w as f32,
        })
    }

    /// A corner, relative to the origin of the ray, in the space where the ray is the z axis. Its z
    /// is left unscaled.
    #[inline]
    fn sheared(&self, corner: Vector3<T>) -> Vector3<T> {
        let z = corner[self.kz];
        Vector3::new(
            corner[self.kx] - self.shear.x * z,
            corner[self.ky] - self.shear.y * z,
            z,
        )
    }
}

/// Twice the signed area of the triangle (origin, q, p): which side of the edge the ray is on.
#[inline]
fn edge<T: Real>(p: Vector3<T>, q: Vector3<T>) -> T {
    p.x * q.y - p.y * q.x
}

/// The same with the true sign, as long as no product leaves the number range.
///
/// Products of two singles `T` are exact here. Products of two doubles are not: where they round to the
/// same number, the difference is that of their rounding errors. That a product's own error is a
/// number is Dekker's ("A floating-point technique for extending the available precision",
/// Numerische Mathematik 18, 1971); to ask a fused multiply-add for it is Kahan's.
#[inline]
fn edge_exact<T: Real>(p: Vector3<f64>, q: Vector3<f64>) -> f64 {
    let (left, right) = (p.x * q.y, p.y * q.x);
    let difference = left - right;
    if !T::PRODUCTS_ARE_EXACT && difference == 0.0 {
        p.x.mul_add(q.y, -left) - p.y.mul_add(q.x, -right)
    } else {
        difference
    }
}

/// Whether the origin is to the left of one edge and to the right of another.
#[inline]
fn on_both_sides<T: Real>([u, v, w]: [T; 3]) -> bool {
    let zero = T::zero();
    // Not `||`: which it is, is hard to guess.
    ((u < zero) | (v < zero) | (w < zero)) & ((u > zero) | (v > zero) | (w > zero))
}

/// Whether the crossing counts for the ray. One at infinity, where products overflow, does not.
#[inline]
fn in_range<T: Real>(ray: &Ray<T>, t: f64) -> bool {
    ray.t_min.wide() <= t && t <= ray.t_max.wide() && t < f64::INFINITY
}

/// Whether a triangle owns its edge `from` → `to`: it points down, or to the left if it is level.
/// Of two triangles on either side of an edge, one sees it pointing one way, one the other.
fn owns(from: Vector3<f64>, to: Vector3<f64>, flip: bool) -> bool {
    let (dx, dy) = (to.x - from.x, to.y - from.y);
    let down_or_left = dy < 0.0 || (dy == 0.0 && dx < 0.0);
    down_or_left != flip
}
