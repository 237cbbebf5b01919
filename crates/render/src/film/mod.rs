//! What the camera exposes: sums of samples, pixel by pixel.

mod crop;
mod pixel;

use ombra_scene::Rgb;

use crate::display::{self, Quantity};

pub use crop::Crop;
pub(crate) use pixel::Pixel;

/// A picture, or a part of one, while it is rendered and after.
///
/// It is as large as the crop it was made for: pixel (0, 0) of the film is pixel (x0, y0) of the
/// whole picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    picture: [u32; 2],
    crop: Crop,
    spp: u32,
    quantity: Quantity,
    pixels: Vec<Pixel>,
}

impl Film {
    /// A blank film; `None` where memory does not suffice. The crop lies within the picture.
    pub(crate) fn new(picture: [u32; 2], crop: Crop, spp: u32, quantity: Quantity) -> Option<Self> {
        let count = usize::try_from(crop.pixels()).ok()?;
        let mut pixels = Vec::new();
        pixels.try_reserve_exact(count).ok()?;
        pixels.resize(count, Pixel::default());
        Some(Self {
            picture,
            crop,
            spp,
            quantity,
            pixels,
        })
    }

    /// Pixels in a row of the film.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.crop.width()
    }

    /// Rows of the film.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.crop.height()
    }

    /// Width and height of the whole picture, of which the film may be a part.
    #[must_use]
    pub const fn picture_size(&self) -> [u32; 2] {
        self.picture
    }

    /// Which part of the whole picture this is.
    #[must_use]
    pub const fn crop(&self) -> Crop {
        self.crop
    }

    /// What the pixels mean.
    #[must_use]
    pub const fn quantity(&self) -> Quantity {
        self.quantity
    }

    /// The mean of the samples in a pixel of the film; `None` where there is none yet, or no such
    /// pixel.
    #[must_use]
    pub fn average(&self, x: u32, y: u32) -> Option<Rgb> {
        self.pixel(x, y)?.average()
    }

    /// How many samples a pixel of the film has.
    #[must_use]
    pub fn samples(&self, x: u32, y: u32) -> u32 {
        self.pixel(x, y).map_or(0, Pixel::samples)
    }

    /// The share of all samples that is done: 1 when the picture is complete.
    #[must_use]
    pub fn done(&self) -> f64 {
        let done: u64 = self.pixels.iter().map(|p| u64::from(p.samples())).sum();
        done as f64 / (self.crop.pixels() as f64 * f64::from(self.spp))
    }

    /// The means of all pixels, row by row from the top; black where there is none yet.
    #[must_use]
    pub fn to_pixels(&self) -> Vec<Rgb> {
        let average = |pixel: &Pixel| pixel.average().unwrap_or(Rgb::BLACK);
        self.pixels.iter().map(average).collect()
    }

    /// What to show on a screen or write into an eight-bit file, row by row from the top, in linear
    /// light; see [`Quantity`].
    #[must_use]
    pub fn display(&self) -> Vec<Rgb> {
        display::to_display(self)
    }

    /// What to write into a file of floating-point numbers, row by row from the top; see
    /// [`Quantity`].
    #[must_use]
    pub fn raw(&self) -> Vec<Rgb> {
        display::to_raw(self)
    }

    pub(crate) fn pixels(&self) -> &[Pixel] {
        &self.pixels
    }

    pub(crate) fn pixels_mut(&mut self) -> &mut [Pixel] {
        &mut self.pixels
    }

    fn pixel(&self, x: u32, y: u32) -> Option<&Pixel> {
        let (width, height) = (self.width(), self.height());
        let index = y as usize * width as usize + x as usize;
        (x < width && y < height).then(|| &self.pixels[index])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::display::Response;

    #[test]
    fn a_pixel_without_samples_is_black_and_says_so() {
        let crop = Crop {
            x0: 1,
            y0: 0,
            x1: 3,
            y1: 1,
        };
        let mut film = Film::new([4, 4], crop, 2, Quantity::Light(Response::default())).unwrap();
        assert_eq!(film.done(), 0.0);
        film.pixels_mut()[1].add(Rgb::WHITE);
        assert_eq!(film.average(0, 0), None);
        assert_eq!(film.average(1, 0), Some(Rgb::WHITE));
        assert_eq!(film.average(2, 0), None, "there is no such pixel");
        assert_eq!((film.samples(0, 0), film.samples(1, 0)), (0, 1));
        assert_eq!(film.to_pixels(), [Rgb::BLACK, Rgb::WHITE]);
        assert_eq!(film.done(), 0.25);
    }
}
