//! Colour: three numbers that add up like light.

use std::ops::{Add, AddAssign, Div, Mul, MulAssign};

/// Linear light in the sRGB primaries: 1 is white, more is brighter than white.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rgb {
    /// Red.
    pub r: f32,
    /// Green.
    pub g: f32,
    /// Blue.
    pub b: f32,
}

impl Rgb {
    /// No light.
    pub const BLACK: Self = Self::grey(0.0);
    /// As bright as the picture gets before it clips.
    pub const WHITE: Self = Self::grey(1.0);

    /// From linear components.
    #[must_use]
    #[inline]
    pub const fn new(r: f32, g: f32, b: f32) -> Self {
        Self { r, g, b }
    }

    /// All three the same.
    #[must_use]
    #[inline]
    pub const fn grey(value: f32) -> Self {
        Self::new(value, value, value)
    }

    /// From components encoded for a screen (sRGB, IEC 61966-2-1), each in `[0, 1]`.
    #[must_use]
    pub fn from_srgb(encoded: [f32; 3]) -> Self {
        let [r, g, b] = encoded.map(|e| {
            if e <= 0.040_45 {
                e / 12.92
            } else {
                ((e + 0.055) / 1.055).powf(2.4)
            }
        });
        Self::new(r, g, b)
    }

    /// The components encoded for a screen (sRGB, IEC 61966-2-1), clipped to `[0, 1]`; NaN is 0.
    #[must_use]
    pub fn to_srgb(self) -> [f32; 3] {
        self.to_array().map(|linear| {
            let linear = if linear.is_nan() {
                0.0
            } else {
                linear.clamp(0.0, 1.0)
            };
            if linear <= 0.003_130_8 {
                linear * 12.92
            } else {
                1.055 * linear.powf(1.0 / 2.4) - 0.055
            }
        })
    }

    /// Red, green, blue.
    #[must_use]
    #[inline]
    pub const fn to_array(self) -> [f32; 3] {
        [self.r, self.g, self.b]
    }

    /// Whether there is no light in it.
    #[must_use]
    #[inline]
    pub fn is_black(self) -> bool {
        self == Self::BLACK
    }

    /// The largest component.
    #[must_use]
    #[inline]
    pub fn max_component(self) -> f32 {
        self.r.max(self.g).max(self.b)
    }

    /// A fraction `s` of the way to another colour.
    #[must_use]
    #[inline]
    pub fn lerp(self, other: Self, s: f32) -> Self {
        self * (1.0 - s) + other * s
    }
}

impl From<[f32; 3]> for Rgb {
    fn from([r, g, b]: [f32; 3]) -> Self {
        Self { r, g, b }
    }
}

impl Add for Rgb {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.r + other.r, self.g + other.g, self.b + other.b)
    }
}

impl AddAssign for Rgb {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul for Rgb {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self::new(self.r * other.r, self.g * other.g, self.b * other.b)
    }
}

impl MulAssign for Rgb {
    #[inline]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl Mul<f32> for Rgb {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f32) -> Self {
        Self::new(self.r * factor, self.g * factor, self.b * factor)
    }
}

impl Div<f32> for Rgb {
    type Output = Self;
    #[inline]
    fn div(self, divisor: f32) -> Self {
        Self::new(self.r / divisor, self.g / divisor, self.b / divisor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn screen_encoding_goes_there_and_back() {
        for value in [0.0, 0.001, 0.02, 0.5, 1.0] {
            let back = Rgb::from_srgb(Rgb::grey(value).to_srgb());
            assert!(
                (back.r - value).abs() < 1e-6,
                "{value} came back as {}",
                back.r
            );
        }
    }

    #[test]
    fn what_is_no_colour_is_black_or_white_on_a_screen() {
        let odd = Rgb::new(f32::NAN, f32::INFINITY, -1.0);
        assert_eq!(
            odd.to_srgb().map(|x| (x * 255.0).round()),
            [0.0, 255.0, 0.0]
        );
    }
}
