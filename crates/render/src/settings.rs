//! What picture to make.

use crate::display::Response;
use crate::{Crop, IntegratorKind, RenderError, SamplerKind};

/// The longest side of a picture, in pixels: beyond, single precision runs out of places in a pixel.
pub const MAX_SIDE: u32 = 1 << 16;

/// The most pixels of a film: larger pictures are rendered in parts, see [`Settings::crop`].
///
/// A film takes 32 bytes a pixel, so at most 8 GiB. [`Film::raw`](crate::Film::raw) and
/// [`Film::display`](crate::Film::display) take 12 bytes a pixel more, the heat map of
/// [`IntegratorKind::Cost`] 16.
pub const MAX_PIXELS: u64 = 1 << 28;

/// The most samples a pixel.
pub const MAX_SPP: u32 = 1 << 24;

/// The most bounces: each takes its part of a thread's stack.
pub const MAX_DEPTH: u32 = 128;

/// What picture to make. The same settings give the same picture, to the last bit.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Pixels in a row of the whole picture, 1 to [`MAX_SIDE`].
    pub width: u32,
    /// Rows of the whole picture, 1 to [`MAX_SIDE`].
    pub height: u32,
    /// Samples a pixel, 1 to [`MAX_SPP`]. A single one goes through the middle of the pixel and of
    /// the lens; more are spread over the area of the pixel, all counting alike (a box filter).
    pub spp: u32,
    /// How often light may bounce, 0 to [`MAX_DEPTH`]: with 0 only what camera rays meet is shaded.
    /// What is seen beyond the last bounce is the scene's to say, see
    /// [`Cutoff`](ombra_scene::Cutoff).
    pub max_depth: u32,
    /// What share of a ray's light must arrive at its pixel for the ray to be worth tracing, 0 or more;
    /// what is seen in place of the others is the scene's to say, as beyond the last bounce. Lights of
    /// which all together a smaller share would arrive are not asked. Where
    /// surfaces are both mirrors and glass, rays double with every bounce at 0.
    pub least_importance: f32,
    /// Chooses the random numbers.
    pub seed: u64,
    /// Which part of the picture to render: the film becomes as large as that, and its pixels are
    /// the ones that the whole picture has there.
    pub crop: Option<Crop>,
    /// What to measure along camera rays.
    pub integrator: IntegratorKind,
    /// How samples are spread.
    pub sampler: SamplerKind,
    /// How the film answers to light. Pictures of anything else have none of it.
    pub response: Response,
}

impl Default for Settings {
    /// 960 × 540, one sample a pixel, 8 bounces.
    fn default() -> Self {
        Self {
            width: 960,
            height: 540,
            spp: 1,
            max_depth: 8,
            least_importance: 1e-3,
            seed: 0,
            crop: None,
            integrator: IntegratorKind::default(),
            sampler: SamplerKind::default(),
            response: Response::default(),
        }
    }
}

impl Settings {
    /// The width of the whole picture over its height.
    #[must_use]
    pub fn aspect(&self) -> f32 {
        self.width as f32 / self.height as f32
    }

    /// What part of the picture is rendered: the crop, or all of it.
    #[must_use]
    pub fn extent(&self) -> Crop {
        self.crop.unwrap_or(Crop::all(self.width, self.height))
    }

    /// Checks that there is such a picture.
    ///
    /// # Errors
    /// The first field that is out of its range.
    pub fn validate(&self) -> Result<(), RenderError> {
        let Self {
            width,
            height,
            spp,
            max_depth,
            least_importance,
            response,
            ..
        } = *self;
        let extent = self.extent();
        if width == 0 || height == 0 {
            Err(RenderError::EmptyPicture { width, height })
        } else if width > MAX_SIDE || height > MAX_SIDE {
            Err(RenderError::PictureTooLarge { width, height })
        } else if !extent.is_within(width, height) {
            Err(RenderError::CropOutside {
                crop: extent,
                width,
                height,
            })
        } else if extent.pixels() > MAX_PIXELS {
            Err(RenderError::FilmTooLarge {
                pixels: extent.pixels(),
            })
        } else if !(1..=MAX_SPP).contains(&spp) {
            Err(RenderError::SamplesOutOfRange { spp })
        } else if max_depth > MAX_DEPTH {
            Err(RenderError::DepthOutOfRange { max_depth })
        } else if !(0.0..=f32::MAX).contains(&least_importance) {
            Err(RenderError::ImportanceOutOfRange { least_importance })
        } else if !response.is_valid() {
            Err(RenderError::NoResponse { response })
        } else {
            Ok(())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_is_valid() {
        assert_eq!(Settings::default().validate(), Ok(()));
    }

    #[test]
    fn what_makes_no_picture_is_named() {
        let good = Settings::default();
        let crop = |x0, y0, x1, y1| Settings {
            crop: Some(Crop { x0, y0, x1, y1 }),
            ..good.clone()
        };
        let bad = [
            Settings {
                width: 0,
                ..good.clone()
            },
            Settings {
                height: MAX_SIDE + 1,
                ..good.clone()
            },
            Settings {
                width: MAX_SIDE,
                height: MAX_SIDE,
                ..good.clone()
            },
            Settings {
                spp: 0,
                ..good.clone()
            },
            Settings {
                max_depth: u32::MAX,
                ..good.clone()
            },
            Settings {
                least_importance: f32::NAN,
                ..good.clone()
            },
            Settings {
                response: Response {
                    white: 0.0,
                    ..Response::default()
                },
                ..good.clone()
            },
            crop(5, 5, 5, 9),
            crop(9, 0, 5, 9),
            crop(0, 0, 961, 1),
            crop(u32::MAX - 1, 0, u32::MAX, 1),
        ];
        for settings in bad {
            assert!(settings.validate().is_err(), "{settings:?}");
        }
        assert_eq!(crop(959, 539, 960, 540).validate(), Ok(()));
    }

    #[test]
    fn a_film_is_limited_and_not_the_picture_that_it_is_a_part_of() {
        let side = |height| Settings {
            width: 1 << 14,
            height,
            ..Settings::default()
        };
        assert_eq!(side(1 << 14).validate(), Ok(()));
        let pixels = MAX_PIXELS + (1 << 14);
        let too_large = side((1 << 14) + 1);
        assert_eq!(
            too_large.validate(),
            Err(RenderError::FilmTooLarge { pixels })
        );
        let part = Settings {
            crop: Some(Crop::all(1 << 14, 1 << 14)),
            ..too_large
        };
        assert_eq!(part.validate(), Ok(()));
    }
}
