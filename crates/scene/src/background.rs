//! What is seen where there is nothing.

use ombra_geometry::Vector3;

use crate::Rgb;

/// What rays that meet nothing bring.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Background {
    /// The same in every direction.
    Constant(Rgb),
    /// A sky: it changes with the height above the horizon alone.
    ///
    /// In a direction whose unit vector makes the cosine c with `up`, and with c taken as 0 below the
    /// horizon, it is zenith + (horizon − zenith) · (1 − c)ⁿ.
    Sky {
        /// Straight up.
        zenith: Rgb,
        /// At the horizon and below.
        horizon: Rgb,
        /// Which way is up, unit length.
        up: Vector3,
        /// The n of the formula, above 0: the larger, the closer the horizon's colour keeps to it.
        exponent: f32,
    },
}

impl Background {
    /// What is seen in a direction of any length but 0.
    #[must_use]
    #[inline]
    pub fn at(&self, direction: Vector3) -> Rgb {
        match self {
            Self::Constant(colour) => *colour,
            Self::Sky {
                zenith,
                horizon,
                up,
                exponent,
            } => {
                let height = direction.dot(*up) / direction.length();
                zenith.lerp(*horizon, power(1.0 - height.clamp(0.0, 1.0), *exponent))
            }
        }
    }
}

/// A power; of a small whole exponent in a few multiplications.
#[inline]
fn power(base: f32, exponent: f32) -> f32 {
    let whole = exponent as i32;
    if (0..=8).contains(&whole) && whole as f32 == exponent {
        base.powi(whole)
    } else {
        base.powf(exponent)
    }
}

impl Default for Background {
    /// The dark.
    fn default() -> Self {
        Self::Constant(Rgb::BLACK)
    }
}

impl From<Rgb> for Background {
    fn from(colour: Rgb) -> Self {
        Self::Constant(colour)
    }
}

/// What a ray is taken to bring that is followed no further, because light was bounced as often as
/// was asked for or because too little of it would arrive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cutoff {
    /// The background in its direction, as in the lecture.
    #[default]
    Background,
    /// Nothing.
    Black,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sky_goes_from_the_horizon_to_the_zenith() {
        let sky = Background::Sky {
            zenith: Rgb::new(0.0, 0.0, 1.0),
            horizon: Rgb::new(1.0, 0.5, 0.0),
            up: Vector3::Z,
            exponent: 4.0,
        };
        assert_eq!(sky.at(Vector3::Z * 3.0), Rgb::new(0.0, 0.0, 1.0));
        assert_eq!(sky.at(Vector3::X * 0.1), Rgb::new(1.0, 0.5, 0.0));
        assert_eq!(sky.at(-Vector3::Z), sky.at(Vector3::X), "below the horizon");
        // A cosine of 1/2: (1/2)⁴ of the horizon's colour.
        let slanted = sky.at(Vector3::new(3_f32.sqrt(), 0.0, 1.0));
        assert!((slanted.r - 0.0625).abs() < 1e-6, "{slanted:?}");
    }
}
