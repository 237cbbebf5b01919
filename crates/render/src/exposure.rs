//! From a launch index to camera rays, and from what they bring to a pixel.

use std::ops::Range;

use ombra_geometry::Ray;
use ombra_pipeline::Exception;
use ombra_scene::camera::{CameraSample, Projection};
use ombra_scene::{Camera, Rgb};

use crate::film::{Crop, Pixel};
use crate::sampler::{Dimension, Numbers, Sample};
use crate::{SamplerKind, Settings};

/// One pass over a film: which samples of its pixels to take, and along which rays.
#[derive(Clone, Debug)]
pub(crate) struct Exposure<'a> {
    camera: &'a Camera,
    picture: [u32; 2],
    aspect: f32,
    crop: Crop,
    sampler: SamplerKind,
    seed: u64,
    /// Of one sample a pixel, which goes through its middle.
    centred: bool,
    has_lens: bool,
    samples: Range<u32>,
}

impl<'a> Exposure<'a> {
    /// The samples of a pass; `settings` are valid.
    pub(crate) fn new(camera: &'a Camera, settings: &Settings, samples: Range<u32>) -> Self {
        Self {
            camera,
            picture: [settings.width, settings.height],
            aspect: settings.aspect(),
            crop: settings.extent(),
            sampler: settings.sampler,
            seed: settings.seed,
            centred: settings.spp == 1,
            has_lens: matches!(camera.projection, Projection::ThinLens(_)),
            samples,
        }
    }

    /// Adds to a pixel what `measure` says of each camera ray, or nothing if there is an exception:
    /// a pixel that is given up half way does not hold a part of a pass.
    #[inline]
    pub(crate) fn expose(
        &self,
        launch_index: [u32; 3],
        pixel: &mut Pixel,
        mut measure: impl FnMut(&Ray, &Sample) -> Result<Rgb, Exception>,
    ) -> Result<(), Exception> {
        let [x, y, _] = launch_index;
        let place = [self.crop.x0 + x, self.crop.y0 + y];
        let numbers = Numbers::new(self.sampler, self.seed, place);
        let numbers = if self.centred {
            numbers.centred()
        } else {
            numbers
        };
        let mut exposed = *pixel;
        for index in self.samples.clone() {
            let sample = numbers.sample(index);
            let measured = measure(&self.ray(place, &sample), &sample)?;
            exposed.add(measured);
        }
        *pixel = exposed;
        Ok(())
    }

    #[inline]
    fn ray(&self, [x, y]: [u32; 2], sample: &Sample) -> Ray {
        let within = sample.pair(Dimension::Pixel);
        let lens = if self.has_lens {
            sample.pair(Dimension::Lens)
        } else {
            [0.5; 2]
        };
        let screen = [
            (x as f32 + within[0]) / self.picture[0] as f32,
            (y as f32 + within[1]) / self.picture[1] as f32,
        ];
        self.camera.ray(self.aspect, CameraSample { screen, lens })
    }
}
