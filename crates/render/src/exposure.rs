//! From a launch index to camera rays, and from what they bring to a pixel.

use std::ops::Range;

use ombra_geometry::{Hit, Ray};
use ombra_pipeline::{Batch, Context, Exception, Pipeline};
use ombra_scene::camera::{CameraRays, CameraSample, Projection};
use ombra_scene::{Camera, Rgb};

use crate::film::{Crop, Pixel};
use crate::sampler::{Dimension, Numbers, Sample};
use crate::shots::Shots;
use crate::{SamplerKind, Settings};

/// One pass over a film: which samples of its pixels to take, and along which rays.
#[derive(Clone, Debug)]
pub(crate) struct Exposure<'a> {
    rays: CameraRays<'a>,
    picture: [u32; 2],
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
            rays: camera.rays(settings.aspect()),
            picture: [settings.width, settings.height],
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
        let place = self.pixel(launch_index);
        let numbers = self.numbers(place);
        let mut exposed = *pixel;
        for index in self.samples.clone() {
            let sample = numbers.sample(index);
            let measured = measure(&self.ray(place, &sample), &sample)?;
            exposed.add(measured);
        }
        *pixel = exposed;
        Ok(())
    }

    /// [`expose`](Self::expose) for all pixels of a batch: their camera rays are traced together, and
    /// `measure` is told what each meets. No, and nothing changed, if there is an exception.
    #[inline]
    pub(crate) fn expose_many<P: Pipeline>(
        &self,
        batch: &mut Batch<'_, P>,
        pixels: &mut [Pixel],
        mut measure: impl FnMut(
            &mut Context<'_, P>,
            &Ray,
            Option<&Hit>,
            &Sample,
        ) -> Result<Rgb, Exception>,
    ) -> bool {
        let shots = self.shots(batch);
        let mut exposed = pixels.to_vec();
        for (k, pixel) in exposed.iter_mut().enumerate() {
            if batch.is_stopped() {
                return false;
            }
            let mut cx = batch.context(k);
            for (ray, sample, hit) in shots.of_pixel(k) {
                let Ok(measured) = measure(&mut cx, ray, hit, sample) else {
                    return false;
                };
                pixel.add(measured);
            }
            batch.count(&cx);
        }
        pixels.copy_from_slice(&exposed);
        true
    }

    /// The camera rays of all pixels of a batch, and what they meet.
    pub(crate) fn shots<P: Pipeline>(&self, batch: &mut Batch<'_, P>) -> Shots {
        let each = self.samples.len();
        let count = batch.len() * each;
        let mut shots = Shots {
            rays: Vec::with_capacity(count),
            samples: Vec::with_capacity(count),
            hits: vec![None; count],
            each,
        };
        for k in 0..batch.len() {
            let place = self.pixel(batch.context(k).launch_index());
            let numbers = self.numbers(place);
            for index in self.samples.clone() {
                let sample = numbers.sample(index);
                shots.rays.push(self.ray(place, &sample));
                shots.samples.push(sample);
            }
        }
        batch.intersect_many(&shots.rays, &mut shots.hits);
        shots
    }

    /// Which samples of each pixel are taken.
    pub(crate) fn samples(&self) -> Range<u32> {
        self.samples.clone()
    }

    /// Whether all samples lie in the middle of their pixel.
    pub(crate) const fn is_centred(&self) -> bool {
        self.centred
    }

    /// The same with all rays through the middle of the lens.
    pub(crate) fn through_pinhole(self) -> Self {
        Self {
            has_lens: false,
            ..self
        }
    }

    /// The pixel of a launch index.
    #[inline]
    const fn pixel(&self, [x, y, _]: [u32; 3]) -> [u32; 2] {
        [self.crop.x0 + x, self.crop.y0 + y]
    }

    /// The numbers of a sample of a pixel.
    #[inline]
    pub(crate) fn sample(&self, pixel: [u32; 2], index: u32) -> Sample {
        self.numbers(pixel).sample(index)
    }

    /// Where in the picture a sample of a pixel is, in pixels from the upper left corner.
    #[inline]
    pub(crate) fn place(pixel: [u32; 2], sample: &Sample) -> [f64; 2] {
        in_picture(pixel, sample).map(f64::from)
    }

    #[inline]
    fn numbers(&self, pixel: [u32; 2]) -> Numbers {
        let numbers = Numbers::new(self.sampler, self.seed, pixel);
        if self.centred {
            numbers.centred()
        } else {
            numbers
        }
    }

    /// The ray of a sample of a pixel.
    #[inline]
    pub(crate) fn ray(&self, pixel: [u32; 2], sample: &Sample) -> Ray {
        self.ray_beside(pixel, sample, [0.0; 2])
    }

    /// The ray beside that of a sample of a pixel, so many pixels to the right and down.
    #[inline]
    pub(crate) fn ray_beside(&self, pixel: [u32; 2], sample: &Sample, [dx, dy]: [f32; 2]) -> Ray {
        let [x, y] = in_picture(pixel, sample);
        let [x, y] = [x + dx, y + dy];
        let lens = if self.has_lens {
            sample.pair(Dimension::Lens)
        } else {
            [0.5; 2]
        };
        let screen = [x / self.picture[0] as f32, y / self.picture[1] as f32];
        self.rays.ray(CameraSample { screen, lens })
    }
}

#[inline]
fn in_picture([x, y]: [u32; 2], sample: &Sample) -> [f32; 2] {
    let [dx, dy] = sample.pair(Dimension::Pixel);
    [x as f32 + dx, y as f32 + dy]
}
