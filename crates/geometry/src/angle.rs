//! Angles that cannot be confused between degrees and radians.

use std::ops::{Add, Mul, Neg, Sub};

/// An angle. Holds radians; built from either unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Angle {
    radians: f32,
}

impl Angle {
    /// From radians.
    #[must_use]
    pub const fn from_radians(radians: f32) -> Self {
        Self { radians }
    }

    /// From degrees.
    #[must_use]
    pub const fn from_degrees(degrees: f32) -> Self {
        Self::from_radians(degrees.to_radians())
    }

    /// In radians.
    #[must_use]
    pub const fn radians(self) -> f32 {
        self.radians
    }

    /// In degrees.
    #[must_use]
    pub const fn degrees(self) -> f32 {
        self.radians.to_degrees()
    }

    /// The sine.
    #[must_use]
    pub fn sin(self) -> f32 {
        self.radians.sin()
    }

    /// The cosine.
    #[must_use]
    pub fn cos(self) -> f32 {
        self.radians.cos()
    }

    /// The tangent.
    #[must_use]
    pub fn tan(self) -> f32 {
        self.radians.tan()
    }
}

impl Add for Angle {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::from_radians(self.radians + other.radians)
    }
}

impl Sub for Angle {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::from_radians(self.radians - other.radians)
    }
}

impl Neg for Angle {
    type Output = Self;
    fn neg(self) -> Self {
        Self::from_radians(-self.radians)
    }
}

impl Mul<f32> for Angle {
    type Output = Self;
    fn mul(self, factor: f32) -> Self {
        Self::from_radians(self.radians * factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_and_radians_agree() {
        assert_eq!(Angle::from_degrees(180.0).radians(), std::f32::consts::PI);
        assert_eq!(Angle::from_radians(0.0).degrees(), 0.0);
    }
}
