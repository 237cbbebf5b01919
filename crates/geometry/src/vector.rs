//! Points, vectors and normals: three kinds, so that adding two points does not compile.

use std::ops::{Add, AddAssign, Div, Index, IndexMut, Mul, Neg, Sub, SubAssign};

/// The number type of a kernel: `f32` for speed, `f64` where single precision is not enough.
pub trait Real: num_traits::Float + num_traits::FloatConst + std::fmt::Debug + Send + Sync {
    /// Nearest value to an `f64`.
    fn of(value: f64) -> Self;
    /// The exact value as an `f64`.
    fn wide(self) -> f64;
    /// Whether a product of two, computed as an `f64`, is exact.
    const PRODUCTS_ARE_EXACT: bool;
}

impl Real for f32 {
    const PRODUCTS_ARE_EXACT: bool = true;
    #[inline]
    fn of(value: f64) -> Self {
        value as Self
    }
    #[inline]
    fn wide(self) -> f64 {
        f64::from(self)
    }
}

impl Real for f64 {
    const PRODUCTS_ARE_EXACT: bool = false;
    #[inline]
    fn of(value: f64) -> Self {
        value
    }
    #[inline]
    fn wide(self) -> f64 {
        self
    }
}

/// One of the three coordinate axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Axis {
    /// The first coordinate.
    X,
    /// The second coordinate.
    Y,
    /// The third coordinate.
    Z,
}

impl Axis {
    /// All three, in order.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// The axis after this one, cyclically: x, y, z, x.
    #[must_use]
    #[inline]
    pub const fn next(self) -> Self {
        match self {
            Self::X => Self::Y,
            Self::Y => Self::Z,
            Self::Z => Self::X,
        }
    }
}

/// A place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point3<T = f32> {
    /// First coordinate.
    pub x: T,
    /// Second coordinate.
    pub y: T,
    /// Third coordinate.
    pub z: T,
}

/// A difference of two places; a direction, of any length.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vector3<T = f32> {
    /// First component.
    pub x: T,
    /// Second component.
    pub y: T,
    /// Third component.
    pub z: T,
}

/// A direction perpendicular to a surface. It transforms by the inverse transpose, which is why it
/// is not a [`Vector3`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Normal3<T = f32> {
    /// First component.
    pub x: T,
    /// Second component.
    pub y: T,
    /// Third component.
    pub z: T,
}

/// What all three kinds share: construction, indexing, conversion between precisions.
macro_rules! triple {
    ($name:ident) => {
        impl<T> $name<T> {
            /// From three coordinates.
            #[must_use]
            #[inline]
            pub const fn new(x: T, y: T, z: T) -> Self {
                Self { x, y, z }
            }
        }

        impl<T: Copy> $name<T> {
            /// The coordinates in order.
            #[must_use]
            #[inline]
            pub const fn to_array(self) -> [T; 3] {
                [self.x, self.y, self.z]
            }
        }

        impl<T: Real> $name<T> {
            /// The same in double precision, exactly.
            #[must_use]
            #[inline]
            pub fn wide(self) -> $name<f64> {
                $name::new(self.x.wide(), self.y.wide(), self.z.wide())
            }

            /// The same in another precision, rounded to nearest.
            #[must_use]
            #[inline]
            pub fn cast<U: Real>(self) -> $name<U> {
                $name::new(
                    U::of(self.x.wide()),
                    U::of(self.y.wide()),
                    U::of(self.z.wide()),
                )
            }

            /// Whether no coordinate is infinite or NaN.
            #[must_use]
            #[inline]
            pub fn is_finite(self) -> bool {
                self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
            }
        }

        impl<T> From<[T; 3]> for $name<T> {
            #[inline]
            fn from([x, y, z]: [T; 3]) -> Self {
                Self { x, y, z }
            }
        }

        impl<T> Index<Axis> for $name<T> {
            type Output = T;
            #[inline]
            fn index(&self, axis: Axis) -> &T {
                match axis {
                    Axis::X => &self.x,
                    Axis::Y => &self.y,
                    Axis::Z => &self.z,
                }
            }
        }

        impl<T> IndexMut<Axis> for $name<T> {
            #[inline]
            fn index_mut(&mut self, axis: Axis) -> &mut T {
                match axis {
                    Axis::X => &mut self.x,
                    Axis::Y => &mut self.y,
                    Axis::Z => &mut self.z,
                }
            }
        }
    };
}

triple!(Point3);
triple!(Vector3);
triple!(Normal3);

/// What the two kinds of directions share.
macro_rules! direction {
    ($name:ident) => {
        impl<T: Real> $name<T> {
            /// The inner product with a vector.
            #[must_use]
            #[inline]
            pub fn dot(self, other: Vector3<T>) -> T {
                self.x * other.x + self.y * other.y + self.z * other.z
            }

            /// The Euclidean length.
            #[must_use]
            #[inline]
            pub fn length(self) -> T {
                (self.x * self.x + self.y * self.y + self.z * self.z).sqrt()
            }

            /// The same direction with length 1; `None` where there is no direction: length zero,
            /// infinite or NaN.
            #[must_use]
            #[inline]
            pub fn normalized(self) -> Option<Self> {
                let squared = self.x * self.x + self.y * self.y + self.z * self.z;
                if squared > T::of(1e-30) && squared < T::of(1e30) {
                    return Some(self / squared.sqrt());
                }
                // Dividing by the largest component first keeps the squares from over- and
                // underflowing, so that any finite non-zero direction has a unit one.
                let largest = self.x.abs().max(self.y.abs()).max(self.z.abs());
                if !(largest > T::zero() && self.is_finite()) {
                    return None;
                }
                let scaled = self / largest;
                Some(scaled / scaled.length())
            }
        }

        impl<T: Real> Neg for $name<T> {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self {
                Self::new(-self.x, -self.y, -self.z)
            }
        }

        impl<T: Real> Mul<T> for $name<T> {
            type Output = Self;
            #[inline]
            fn mul(self, factor: T) -> Self {
                Self::new(self.x * factor, self.y * factor, self.z * factor)
            }
        }

        impl<T: Real> Div<T> for $name<T> {
            type Output = Self;
            #[inline]
            fn div(self, divisor: T) -> Self {
                Self::new(self.x / divisor, self.y / divisor, self.z / divisor)
            }
        }

        impl<T: Real> Add for $name<T> {
            type Output = Self;
            #[inline]
            fn add(self, other: Self) -> Self {
                Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
            }
        }

        impl<T: Real> Sub for $name<T> {
            type Output = Self;
            #[inline]
            fn sub(self, other: Self) -> Self {
                Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
            }
        }

        impl<T: Real> AddAssign for $name<T> {
            #[inline]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
    };
}

direction!(Vector3);
direction!(Normal3);

impl Point3<f32> {
    /// The point (0, 0, 0).
    pub const ORIGIN: Self = Self::new(0.0, 0.0, 0.0);
}

impl<T: Real> Point3<T> {
    /// The vector from the origin to this point, for the rare formula that wants one.
    #[must_use]
    #[inline]
    pub const fn to_vector(self) -> Vector3<T> {
        Vector3::new(self.x, self.y, self.z)
    }

    /// The point a fraction `s` of the way to `other`: `self` at 0, `other` at 1.
    #[must_use]
    #[inline]
    pub fn lerp(self, other: Self, s: T) -> Self {
        self + (other - self) * s
    }

    /// The smaller of each coordinate; a NaN loses.
    #[must_use]
    #[inline]
    pub fn min(self, other: Self) -> Self {
        Self::new(
            self.x.min(other.x),
            self.y.min(other.y),
            self.z.min(other.z),
        )
    }

    /// The larger of each coordinate; a NaN loses.
    #[must_use]
    #[inline]
    pub fn max(self, other: Self) -> Self {
        Self::new(
            self.x.max(other.x),
            self.y.max(other.y),
            self.z.max(other.z),
        )
    }
}

impl<T: Real> Sub for Point3<T> {
    type Output = Vector3<T>;
    #[inline]
    fn sub(self, other: Self) -> Vector3<T> {
        Vector3::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<T: Real> Add<Vector3<T>> for Point3<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Vector3<T>) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<T: Real> AddAssign<Vector3<T>> for Point3<T> {
    #[inline]
    fn add_assign(&mut self, other: Vector3<T>) {
        *self = *self + other;
    }
}

impl<T: Real> Sub<Vector3<T>> for Point3<T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Vector3<T>) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<T: Real> SubAssign<Vector3<T>> for Point3<T> {
    #[inline]
    fn sub_assign(&mut self, other: Vector3<T>) {
        *self = *self - other;
    }
}

impl Vector3<f32> {
    /// The vector (0, 0, 0).
    pub const ZERO: Self = Self::new(0.0, 0.0, 0.0);
    /// One unit along x.
    pub const X: Self = Self::new(1.0, 0.0, 0.0);
    /// One unit along y.
    pub const Y: Self = Self::new(0.0, 1.0, 0.0);
    /// One unit along z.
    pub const Z: Self = Self::new(0.0, 0.0, 1.0);
}

impl<T: Real> Vector3<T> {
    /// The cross product, right-handed: x × y = z.
    #[must_use]
    #[inline]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// The squared Euclidean length.
    #[must_use]
    #[inline]
    pub fn length_squared(self) -> T {
        self.dot(self)
    }

    /// The largest absolute component: the length in the maximum norm.
    #[must_use]
    #[inline]
    pub fn max_norm(self) -> T {
        // Comparisons and not `max`, which takes more instructions to see to NaN.
        let larger = |a: T, b: T| if a > b { a } else { b };
        larger(self.x.abs(), larger(self.y.abs(), self.z.abs()))
    }

    /// The axis with the largest absolute component; the first of equals.
    #[must_use]
    #[inline]
    pub fn dominant_axis(self) -> Axis {
        let (x, y, z) = (self.x.abs(), self.y.abs(), self.z.abs());
        // Not `&&`: which it is, is hard to guess.
        let y_or_z = if y >= z { Axis::Y } else { Axis::Z };
        if (x >= y) & (x >= z) { Axis::X } else { y_or_z }
    }

    /// The mirror image of this direction of travel on a surface with unit normal `normal`.
    #[must_use]
    #[inline]
    pub fn reflect(self, normal: Normal3<T>) -> Self {
        let n = normal.to_vector();
        self - n * (n.dot(self) + n.dot(self))
    }

    /// Two unit vectors that make a right-handed orthonormal frame with this unit vector as the
    /// third: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
    #[must_use]
    #[inline]
    pub fn orthonormal_basis(self) -> (Self, Self) {
        let one = T::one();
        let sign = one.copysign(self.z);
        let a = -one / (sign + self.z);
        let b = self.x * self.y * a;
        (
            Self::new(one + sign * self.x * self.x * a, sign * b, -sign * self.x),
            Self::new(b, sign + self.y * self.y * a, -self.y),
        )
    }

    /// The same direction, called a normal.
    #[must_use]
    #[inline]
    pub const fn to_normal(self) -> Normal3<T> {
        Normal3::new(self.x, self.y, self.z)
    }
}

impl<T: Real> Normal3<T> {
    /// The same direction, called a vector.
    #[must_use]
    #[inline]
    pub const fn to_vector(self) -> Vector3<T> {
        Vector3::new(self.x, self.y, self.z)
    }

    /// This normal or its opposite, whichever points against `direction`.
    #[must_use]
    #[inline]
    pub fn facing(self, direction: Vector3<T>) -> Self {
        if self.dot(direction) > T::zero() {
            -self
        } else {
            self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normalizing_has_no_answer_where_there_is_no_direction() {
        for v in [
            Vector3::ZERO,
            Vector3::new(f32::NAN, 1.0, 0.0),
            Vector3::new(f32::INFINITY, 1.0, 0.0),
        ] {
            assert_eq!(v.normalized(), None, "{v:?}");
        }
    }

    #[test]
    fn normalizing_survives_the_ends_of_the_number_range() {
        for size in [f32::MAX, 1.0, f32::MIN_POSITIVE] {
            let unit = Vector3::new(size, -size, 0.0).normalized().unwrap();
            assert!((unit.length() - 1.0).abs() < 1e-6, "{size} gave {unit:?}");
        }
    }

    #[test]
    fn the_basis_is_orthonormal_and_right_handed() {
        for v in [
            Vector3::X,
            -Vector3::Z,
            Vector3::Z,
            Vector3::new(0.6, -0.48, 0.64),
        ] {
            let (s, t) = v.orthonormal_basis();
            assert!((s.cross(t) - v).length() < 1e-6, "{v:?}");
            assert!((s.length() - 1.0).abs() < 1e-6 && (t.length() - 1.0).abs() < 1e-6);
        }
    }
}
