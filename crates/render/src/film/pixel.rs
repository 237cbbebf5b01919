//! One pixel while it is exposed.

use ombra_scene::Rgb;

/// The sum of the samples of one pixel.
///
/// Samples come in the order of their indices, one after the other, whatever the number of threads
/// and however the work is cut into passes; so the sum is the same to the last bit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Pixel {
    sum: [f64; 3],
    samples: u32,
}

impl Pixel {
    /// Adds a sample; a component that is no number counts as 0.
    #[inline]
    pub(crate) fn add(&mut self, sample: Rgb) {
        for (sum, component) in self.sum.iter_mut().zip(sample.to_array()) {
            if !component.is_nan() {
                *sum += f64::from(component);
            }
        }
        self.samples += 1;
    }

    /// How many samples were added.
    pub(crate) const fn samples(&self) -> u32 {
        self.samples
    }

    /// The mean of the samples; `None` if there are none.
    pub(crate) fn average(&self) -> Option<Rgb> {
        let count = f64::from(self.samples);
        (self.samples > 0).then(|| self.sum.map(|sum| (sum / count) as f32).into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_average_of_nothing_is_nothing() {
        assert_eq!(Pixel::default().average(), None);
    }

    #[test]
    fn one_sample_without_a_number_does_not_spoil_the_pixel() {
        let mut pixel = Pixel::default();
        pixel.add(Rgb::new(f32::NAN, 1.0, 2.0));
        pixel.add(Rgb::new(1.0, 1.0, 0.0));
        assert_eq!(pixel.average(), Some(Rgb::new(0.5, 1.0, 1.0)));
    }

    #[test]
    fn many_small_samples_are_not_swallowed() {
        let mut pixel = Pixel::default();
        pixel.add(Rgb::grey(1e6));
        for _ in 1..1000 {
            pixel.add(Rgb::grey(0.01));
        }
        let average = pixel.average().unwrap().r;
        assert!((average - 1000.01).abs() < 1e-3, "{average}");
    }
}
