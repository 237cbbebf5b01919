//! Three numbers in double precision, for programs that share nothing with ombra.

use std::ops::{Add, Mul, Neg, Sub};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vec3(pub(crate) [f64; 3]);

impl Vec3 {
    pub(crate) const fn new(x: f64, y: f64, z: f64) -> Self {
        Self([x, y, z])
    }

    pub(crate) fn from_singles(v: [f32; 3]) -> Self {
        Self(v.map(f64::from))
    }

    pub(crate) fn dot(self, o: Self) -> f64 {
        (0..3).map(|i| self.0[i] * o.0[i]).sum()
    }

    pub(crate) fn cross(self, o: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, o.0);
        Self([b * f - c * e, c * d - a * f, a * e - b * d])
    }

    pub(crate) fn unit(self) -> Self {
        self * (1.0 / self.dot(self).sqrt())
    }

    /// Component by component.
    pub(crate) fn times(self, o: Self) -> Self {
        Self([0, 1, 2].map(|i| self.0[i] * o.0[i]))
    }
}

impl Add for Vec3 {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self([0, 1, 2].map(|i| self.0[i] + o.0[i]))
    }
}

impl Sub for Vec3 {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}

impl Neg for Vec3 {
    type Output = Self;
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl Mul<f64> for Vec3 {
    type Output = Self;
    fn mul(self, by: f64) -> Self {
        Self(self.0.map(|x| x * by))
    }
}
