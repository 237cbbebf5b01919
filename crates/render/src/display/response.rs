//! How a film answers to light.

use ombra_scene::Rgb;

/// How the light that arrives becomes the numbers of a picture, and those what is shown.
///
/// A number of the picture is fog + sensitivity · radiance. Files of floating-point numbers hold it
/// as it is; on a screen and in eight-bit files `white` is the brightest there is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// By how much light counts. Above 0.
    pub sensitivity: f32,
    /// What is there without any light: the fog of an unexposed film. 0 or more.
    pub fog: f32,
    /// The number that is shown as the brightest. Above 0.
    pub white: f32,
    /// How what is shown is encoded.
    pub transfer: Transfer,
}

/// How the numbers of a picture, divided by white, become those of an eight-bit file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transfer {
    /// By the curve of sRGB: on a screen the picture has as much light as the scene.
    #[default]
    Srgb,
    /// As they are, times 255: pictures that were made before screens were standardized.
    Linear,
}

impl Default for Response {
    /// The light itself: 1 is white.
    fn default() -> Self {
        Self {
            sensitivity: 1.0,
            fog: 0.0,
            white: 1.0,
            transfer: Transfer::default(),
        }
    }
}

impl Response {
    /// Whether all numbers are in their ranges.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        let above_zero = |x: f32| x > 0.0 && x.is_finite();
        above_zero(self.sensitivity)
            && above_zero(self.white)
            && (0.0..=f32::MAX).contains(&self.fog)
    }

    /// The number of the picture for some radiance.
    #[must_use]
    #[inline]
    pub fn exposed(&self, radiance: Rgb) -> Rgb {
        Rgb::grey(self.fog) + radiance * self.sensitivity
    }

    /// What a screen shows for some radiance, as linear light.
    #[must_use]
    pub fn shown(&self, radiance: Rgb) -> Rgb {
        let share = self.exposed(radiance) * (1.0 / self.white);
        match self.transfer {
            Transfer::Srgb => share,
            Transfer::Linear => Rgb::from_srgb(share.to_array()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_changes_nothing() {
        let light = Rgb::new(0.3, 2.0, 0.0);
        assert_eq!(Response::default().exposed(light), light);
        assert_eq!(Response::default().shown(light), light);
    }

    #[test]
    fn a_linear_picture_keeps_its_numbers_in_eight_bits() {
        let response = Response {
            sensitivity: 224.0,
            fog: 13.0,
            white: 255.0,
            transfer: Transfer::Linear,
        };
        let half = response.exposed(Rgb::grey(0.5));
        assert_eq!(half, Rgb::grey(125.0));
        let shown = response.shown(Rgb::grey(0.5)).to_srgb();
        assert!((shown[0] * 255.0 - 125.0).abs() < 1e-3, "{shown:?}");
    }
}
