//! A picture to look colours up in.

use crate::Rgb;

/// A picture in linear light, row 0 at the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Vec<Rgb>,
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

    /// The colour at `uv`, (0, 0) being the lower left corner and (1, 1) the upper right one,
    /// interpolated between the centres of pixels and repeated outside. NaN is taken as 0.
    #[must_use]
    pub fn bilinear(&self, uv: [f32; 2]) -> Rgb {
        let [u, v] = uv.map(|x| {
            if x.is_finite() {
                x.rem_euclid(1.0)
            } else {
                0.0
            }
        });
        let x = u * self.width as f32 - 0.5;
        let y = (1.0 - v) * self.height as f32 - 0.5;
        let (fx, fy) = (x - x.floor(), y - y.floor());
        let (x, y) = (x.floor() as i64, y.floor() as i64);
        let top = self.repeated(x, y).lerp(self.repeated(x + 1, y), fx);
        let bottom = self
            .repeated(x, y + 1)
            .lerp(self.repeated(x + 1, y + 1), fx);
        top.lerp(bottom, fy)
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

    fn repeated(&self, x: i64, y: i64) -> Rgb {
        let x = x.rem_euclid(self.width.into()) as usize;
        let y = y.rem_euclid(self.height.into()) as usize;
        self.pixels[y * self.width as usize + x]
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
    }
}
