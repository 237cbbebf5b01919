//! Affine transforms that know which space they come from and which they go to.

use std::marker::PhantomData;

use crate::{Aabb, Normal3, Point3, Ray, Real, Vector3};

/// The space of the scene.
#[derive(Clone, Copy, Debug)]
pub enum World {}
/// The space in which a geometry was described.
#[derive(Clone, Copy, Debug)]
pub enum Object {}
/// The space of a camera: x right, y up, looking along −z.
#[derive(Clone, Copy, Debug)]
pub enum Camera {}

/// An affine map from one space to another, with its inverse.
///
/// Name values `target_from_source`: `world_from_object: Transform<Object, World>`. Composition
/// compiles only where the inner spaces agree.
///
/// Numbers are double precision inside, so that an object placed at map coordinates keeps the
/// precision of its own.
///
/// [`translation`](Self::translation), [`scale`](Self::scale), [`rotation`](Self::rotation) and
/// [`then`](Self::then) take numbers as they come. From NaN, from infinite numbers, or from numbers
/// so large or small that they or their inverses overflow, they make a transform that is not finite;
/// an instance that is placed by one is never hit. Who takes numbers from outside passes the
/// [`rows`](Self::rows) of the result through [`from_rows`](Self::from_rows), which refuses them.
#[derive(Clone, Copy, Debug)]
pub struct Transform<From, To> {
    /// Rows of the 3 × 4 matrix: linear part, then translation.
    forward: [[f64; 4]; 3],
    backward: [[f64; 4]; 3],
    /// Most objects are described where they stand, and it is asked for every ray.
    is_identity: bool,
    spaces: PhantomData<fn(From) -> To>,
}

/// A matrix that is no transform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TransformError {
    /// Some element is NaN or infinite.
    NotFinite,
    /// It flattens space: there is no way back.
    Singular,
}

impl std::fmt::Display for TransformError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "the matrix has an element that is not a finite number",
            Self::Singular => "the matrix is singular: it flattens space",
        })
    }
}

impl std::error::Error for TransformError {}

impl<F, T> PartialEq for Transform<F, T> {
    fn eq(&self, other: &Self) -> bool {
        self.forward == other.forward
    }
}

impl<F, T> Default for Transform<F, T> {
    fn default() -> Self {
        Self::identity()
    }
}

impl<F, T> Transform<F, T> {
    /// Leaves everything where it is, and calls it by another space's name.
    #[must_use]
    pub fn identity() -> Self {
        Self::scale(Vector3::new(1.0, 1.0, 1.0))
    }

    /// From the rows of a 3 × 4 matrix: linear part, then translation.
    ///
    /// # Errors
    /// When an element is not finite, or the matrix has no inverse whose elements are.
    pub fn from_rows(rows: [[f64; 4]; 3]) -> Result<Self, TransformError> {
        if !rows.iter().flatten().all(|x| x.is_finite()) {
            return Err(TransformError::NotFinite);
        }
        let backward = inverse(&rows).ok_or(TransformError::Singular)?;
        Ok(Self::of(rows, backward))
    }

    /// Moves by `offset`.
    #[must_use]
    pub fn translation(offset: Vector3<f64>) -> Self {
        let by = |o: Vector3<f64>| {
            [
                [1.0, 0.0, 0.0, o.x],
                [0.0, 1.0, 0.0, o.y],
                [0.0, 0.0, 1.0, o.z],
            ]
        };
        Self::of(by(offset), by(-offset))
    }

    /// Stretches each axis by a factor. A factor of 0 has no inverse, and makes a transform that is
    /// not finite (see the type).
    #[must_use]
    pub fn scale(factors: Vector3<f64>) -> Self {
        let by = |x, y, z| [[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0]];
        Self::of(
            by(factors.x, factors.y, factors.z),
            by(1.0 / factors.x, 1.0 / factors.y, 1.0 / factors.z),
        )
    }

    /// Turns about an axis through the origin, counter-clockwise when the axis points at the
    /// viewer. A zero axis turns nothing.
    #[must_use]
    pub fn rotation(axis: Vector3<f64>, radians: f64) -> Self {
        let Some(a) = axis.normalized() else {
            return Self::identity();
        };
        let (sin, cos) = radians.sin_cos();
        let k = 1.0 - cos;
        let forward = [
            [
                a.x * a.x * k + cos,
                a.x * a.y * k - a.z * sin,
                a.x * a.z * k + a.y * sin,
                0.0,
            ],
            [
                a.y * a.x * k + a.z * sin,
                a.y * a.y * k + cos,
                a.y * a.z * k - a.x * sin,
                0.0,
            ],
            [
                a.z * a.x * k - a.y * sin,
                a.z * a.y * k + a.x * sin,
                a.z * a.z * k + cos,
                0.0,
            ],
        ];
        let backward = std::array::from_fn(|i| [forward[0][i], forward[1][i], forward[2][i], 0.0]);
        Self::of(forward, backward)
    }

    /// The way back.
    #[must_use]
    pub const fn inverse(&self) -> Transform<T, F> {
        Transform {
            forward: self.backward,
            backward: self.forward,
            is_identity: self.is_identity,
            spaces: PhantomData,
        }
    }

    /// First `self`, then `next`.
    #[must_use]
    pub fn then<Next>(&self, next: &Transform<T, Next>) -> Transform<F, Next> {
        Transform::of(
            product(&next.forward, &self.forward),
            product(&self.backward, &next.backward),
        )
    }

    /// Whether this moves nothing at all.
    #[must_use]
    pub const fn is_identity(&self) -> bool {
        self.is_identity
    }

    /// The rows of the 3 × 4 matrix.
    #[must_use]
    pub const fn rows(&self) -> &[[f64; 4]; 3] {
        &self.forward
    }

    /// Takes a point across.
    #[must_use]
    #[inline]
    pub fn point<R: Real>(&self, p: Point3<R>) -> Point3<R> {
        if self.is_identity {
            return p;
        }
        let p = p.wide();
        let row = |r: &[f64; 4]| R::of(r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3]);
        Point3::new(
            row(&self.forward[0]),
            row(&self.forward[1]),
            row(&self.forward[2]),
        )
    }

    /// Takes a vector across; translations leave it alone.
    #[must_use]
    #[inline]
    pub fn vector<R: Real>(&self, v: Vector3<R>) -> Vector3<R> {
        let v = v.wide();
        let row = |r: &[f64; 4]| R::of(r[0] * v.x + r[1] * v.y + r[2] * v.z);
        Vector3::new(
            row(&self.forward[0]),
            row(&self.forward[1]),
            row(&self.forward[2]),
        )
    }

    /// Takes a normal across, by the inverse transpose. The result is not normalised.
    #[must_use]
    #[inline]
    pub fn normal<R: Real>(&self, n: Normal3<R>) -> Normal3<R> {
        if self.is_identity {
            return n;
        }
        let n = n.wide();
        let m = &self.backward;
        let column = |i: usize| R::of(m[0][i] * n.x + m[1][i] * n.y + m[2][i] * n.z);
        Normal3::new(column(0), column(1), column(2))
    }

    /// Takes a ray across. The direction is not normalised again, so that `t` stays what it is.
    #[must_use]
    #[inline]
    pub fn ray<R: Real>(&self, ray: &Ray<R>) -> Ray<R> {
        Ray {
            origin: self.point(ray.origin),
            direction: self.vector(ray.direction),
            t_min: ray.t_min,
            t_max: ray.t_max,
        }
    }

    /// The box around a transformed box, rounded outward.
    #[must_use]
    pub fn aabb(&self, bounds: &Aabb) -> Aabb {
        if bounds.is_empty() {
            return Aabb::EMPTY;
        }
        if !bounds.is_finite() {
            return Aabb::UNBOUNDED;
        }
        Aabb::enclosing(Aabb::around(
            bounds.wide().corners().map(|corner| self.point(corner)),
        ))
    }

    fn of(forward: [[f64; 4]; 3], backward: [[f64; 4]; 3]) -> Self {
        let of_identity =
            |(i, row): (usize, &[f64; 4])| (0..4).all(|j| row[j] == if i == j { 1.0 } else { 0.0 });
        Self {
            forward,
            backward,
            is_identity: forward.iter().enumerate().all(of_identity),
            spaces: PhantomData,
        }
    }
}

/// `a` after `b`, both 3 × 4 with an implied last row (0 0 0 1).
fn product(a: &[[f64; 4]; 3], b: &[[f64; 4]; 3]) -> [[f64; 4]; 3] {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let last = if j == 3 { a[i][3] } else { 0.0 };
            a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j] + last
        })
    })
}

/// The inverse by cofactors; `None` where there is none that is finite.
fn inverse(m: &[[f64; 4]; 3]) -> Option<[[f64; 4]; 3]> {
    // In units of a power of two near to the largest element, so that nothing rounds differently
    // and a determinant, the product of three elements, neither over- nor underflows.
    let row = |i: usize| Vector3::new(m[i][0], m[i][1], m[i][2]);
    let largest = [row(0), row(1), row(2)]
        .map(Vector3::max_norm)
        .into_iter()
        .fold(0.0, f64::max);
    let unit = power_of_two_below(largest)?;
    let (r0, r1, r2) = (row(0) / unit, row(1) / unit, row(2) / unit);
    let columns = [r1.cross(r2), r2.cross(r0), r0.cross(r1)];
    let det = r0.dot(columns[0]);
    let offset = Vector3::new(m[0][3], m[1][3], m[2][3]);
    let back: [[f64; 4]; 3] = std::array::from_fn(|i| {
        let component = |v: Vector3<f64>| v.to_array()[i] / det / unit;
        let linear = Vector3::new(
            component(columns[0]),
            component(columns[1]),
            component(columns[2]),
        );
        [linear.x, linear.y, linear.z, -linear.dot(offset)]
    });
    back.iter().flatten().all(|x| x.is_finite()).then_some(back)
}

/// The largest power of two that is not above a positive number; `None` for 0 and for numbers below
/// the normal ones, which have no finite inverse.
fn power_of_two_below(x: f64) -> Option<f64> {
    const EXPONENT: u64 = 0x7ff << 52;
    let power = f64::from_bits(x.to_bits() & EXPONENT);
    (power > 0.0).then_some(power)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn some() -> Transform<Object, World> {
        Transform::<Object, Object>::rotation(Vector3::new(1.0, 2.0, 3.0), 0.7)
            .then(&Transform::<Object, Object>::scale(Vector3::new(
                2.0, 0.5, 3.0,
            )))
            .then(&Transform::translation(Vector3::new(1e6, -2.0, 5.0)))
    }

    #[test]
    fn there_and_back_again() {
        let world_from_object = some();
        let p = Point3::new(0.25_f32, -7.0, 3.5);
        let back = world_from_object
            .inverse()
            .point(world_from_object.point(p.wide()));
        assert!((back - p.wide()).length() < 1e-8, "{back:?}");
    }

    #[test]
    fn normals_stay_perpendicular() {
        let t = some();
        let (a, b) = (
            Vector3::new(1.0_f64, 0.3, 0.0),
            Vector3::new(0.0, 1.0, -2.0),
        );
        let n = t.normal(a.cross(b).to_normal());
        for edge in [a, b] {
            let edge = t.vector(edge);
            assert!(n.dot(edge).abs() < 1e-5 * n.length() * edge.length());
        }
    }

    #[test]
    fn a_flattening_matrix_is_refused() {
        let rows = [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0],
        ];
        let refused = Transform::<Object, World>::from_rows(rows);
        assert_eq!(refused, Err(TransformError::Singular));
        let rows = [[f64::NAN; 4]; 3];
        let refused = Transform::<Object, World>::from_rows(rows);
        assert_eq!(refused, Err(TransformError::NotFinite));
    }

    #[test]
    fn a_scale_of_any_size_is_no_flattening() {
        for size in [1e-300, 1e-120, 1e-30, 1.0, 1e120, 1e300] {
            let scale = Transform::<Object, World>::scale(Vector3::new(size, -size, size));
            let again = Transform::from_rows(*scale.rows()).unwrap();
            let p = Point3::new(1.0_f64, 2.0, 3.0);
            for transform in [scale, again] {
                let back = transform.inverse().point(transform.point(p));
                assert!((back - p).max_norm() < 1e-14, "{size}: {back:?}");
            }
        }
    }

    #[test]
    fn what_overflowed_on_the_way_is_refused_by_its_rows() {
        let scale = |by| Transform::<Object, Object>::scale(Vector3::new(by, by, by));
        let far = Transform::<Object, Object>::translation(Vector3::new(1e300, 0.0, 0.0));
        for broken in [
            scale(0.0),
            scale(f64::NAN),
            scale(1e-200).then(&scale(1e-200)),
            scale(1e200).then(&scale(1e200)),
            far.then(&scale(1e200)),
            Transform::rotation(Vector3::new(1.0, 0.0, 0.0), f64::INFINITY),
        ] {
            let refused = Transform::<Object, Object>::from_rows(*broken.rows());
            assert!(refused.is_err(), "{broken:?}");
        }
    }

    #[test]
    fn the_box_of_a_turned_box_holds_its_corners() {
        let t = some();
        let b = Aabb::around([Point3::new(-1.0_f32, 0.0, 2.0), Point3::new(3.0, 4.0, 5.0)]);
        let turned = t.aabb(&b).wide();
        for corner in b.wide().corners() {
            assert!(turned.contains(t.point(corner)));
        }
    }
}
