//! A picture to look colours up in.

use super::wrap::{Filter, Taps, Wrap};
use crate::Rgb;

/// A picture in linear light, row 0 at the top, with or without opacity.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Vec<Rgb>,
    alpha: Option<Vec<f32>>,
}

impl Image {
    /// From pixels in rows; `None` if there are not `width · height` of them, or none at all.
    #[must_use]
    pub fn new(width: u32, height: u32, pixels: Vec<Rgb>) -> Option<Self> {
        let count = u64::from(width) * u64::from(height);
        (count > 0 && count == pixels.len() as u64).then_some(Self {
            width,
            height,
            pixels,
            alpha: None,
        })
    }

    /// The same picture with opacity, 0 to 1, one value a pixel; `None` if there are not as many as
    /// pixels.
    #[must_use]
    pub fn with_alpha(self, alpha: Vec<f32>) -> Option<Self> {
        (alpha.len() == self.pixels.len()).then_some(Self {
            alpha: Some(alpha),
            ..self
        })
    }

    /// Pixels in a row.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// The pixels, row by row.
    #[must_use]
    pub fn pixels(&self) -> &[Rgb] {
        &self.pixels
    }

    /// The opacity of each pixel, row by row, if the picture has any.
    #[must_use]
    pub fn alpha(&self) -> Option<&[f32]> {
        self.alpha.as_deref()
    }

    /// The colour at `uv`, (0, 0) being the lower left corner and (1, 1) the upper right one,
    /// interpolated between the centres of pixels and repeated outside. NaN is taken as 0.
    #[must_use]
    pub fn bilinear(&self, uv: [f32; 2]) -> Rgb {
        self.colour_at(uv, [Wrap::Repeat; 2], Filter::Linear)
    }

    /// The colour at `uv` as [`bilinear`](Self::bilinear) has it, but with a choice of what is
    /// outside and of what is between pixels.
    #[must_use]
    #[inline]
    pub fn colour_at(&self, uv: [f32; 2], wrap: [Wrap; 2], filter: Filter) -> Rgb {
        self.blended(uv, wrap, filter, &self.pixels, Rgb::lerp)
    }

    /// The opacity at `uv`, in the same way; 1 if the picture has none.
    #[must_use]
    #[inline]
    pub fn alpha_at(&self, uv: [f32; 2], wrap: [Wrap; 2], filter: Filter) -> f32 {
        let lerp = |a: f32, b: f32, s: f32| a + (b - a) * s;
        match &self.alpha {
            Some(alpha) => self.blended(uv, wrap, filter, alpha, lerp),
            None => 1.0,
        }
    }

    /// The mean of all pixels.
    #[must_use]
    pub fn average(&self) -> Rgb {
        let sum = self.pixels.iter().fold([0.0_f64; 3], |sum, pixel| {
            let [r, g, b] = pixel.to_array().map(f64::from);
            [sum[0] + r, sum[1] + g, sum[2] + b]
        });
        sum.map(|s| (s / self.pixels.len() as f64) as f32).into()
    }

    fn blended<T: Copy>(
        &self,
        [u, v]: [f32; 2],
        [wrap_u, wrap_v]: [Wrap; 2],
        filter: Filter,
        values: &[T],
        lerp: impl Fn(T, T, f32) -> T,
    ) -> T {
        let x = Taps::of(wrap_u.inside(u), self.width, wrap_u, filter);
        let y = Taps::of(1.0 - wrap_v.inside(v), self.height, wrap_v, filter);
        let at = |x: u32, y: u32| values[y as usize * self.width as usize + x as usize];
        let row = |y: u32| lerp(at(x.first, y), at(x.second, y), x.share);
        lerp(row(y.first), row(y.second), y.share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_pixel_is_at_the_upper_left() {
        let pixels = vec![Rgb::WHITE, Rgb::BLACK, Rgb::BLACK, Rgb::BLACK];
        let image = Image::new(2, 2, pixels).unwrap();
        assert_eq!(image.bilinear([0.25, 0.75]), Rgb::WHITE);
        assert_eq!(image.bilinear([1.25, -0.25]), Rgb::WHITE);
        assert_eq!(image.average(), Rgb::grey(0.25));
    }

    #[test]
    fn a_picture_has_all_its_pixels() {
        assert_eq!(Image::new(0, 0, vec![]), None);
        assert_eq!(Image::new(2, 2, vec![Rgb::BLACK; 3]), None);
        let image = Image::new(2, 1, vec![Rgb::BLACK; 2]).unwrap();
        assert_eq!(image.with_alpha(vec![1.0]), None);
    }

    #[test]
    fn opacity_is_looked_up_like_colour() {
        let image = Image::new(2, 1, vec![Rgb::BLACK; 2]).unwrap();
        let at = |image: &Image, u| image.alpha_at([u, 0.5], [Wrap::Clamp; 2], Filter::Linear);
        assert_eq!(at(&image, 0.3), 1.0);
        let image = image.with_alpha(vec![0.0, 1.0]).unwrap();
        assert_eq!([0.1, 0.5, 0.9].map(|u| at(&image, u)), [0.0, 0.5, 1.0]);
    }
}
