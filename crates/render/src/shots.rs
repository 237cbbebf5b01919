//! Camera rays that were traced together.

use ombra_geometry::{Hit, Ray};

use crate::sampler::Sample;

/// The camera rays of some pixels, those of one next to each other, and what they meet.
#[derive(Debug)]
pub(crate) struct Shots {
    pub(crate) rays: Vec<Ray>,
    pub(crate) samples: Vec<Sample>,
    pub(crate) hits: Vec<Option<Hit>>,
    /// How many each pixel has.
    pub(crate) each: usize,
}

impl Shots {
    /// Those of one pixel.
    pub(crate) fn of_pixel(
        &self,
        pixel: usize,
    ) -> impl Iterator<Item = (&Ray, &Sample, Option<&Hit>)> {
        (pixel * self.each..(pixel + 1) * self.each)
            .map(|k| (&self.rays[k], &self.samples[k], self.hits[k].as_ref()))
    }
}
