//! Pixels to draw on.

use ombra_scene::Rgb;

use crate::image::ImageBuffer;

/// Red, green and blue as screens have them (sRGB).
pub(super) type Colour = [u8; 3];

/// A picture that is being drawn. What lies outside of it is not drawn.
pub(super) struct Canvas {
    width: u32,
    height: u32,
    pixels: Vec<Colour>,
}

impl Canvas {
    pub(super) fn new(width: u32, height: u32, paper: Colour) -> Self {
        Self {
            width,
            height,
            pixels: vec![paper; width as usize * height as usize],
        }
    }

    pub(super) fn set(&mut self, x: i64, y: i64, colour: Colour) {
        if let Some(pixel) = self.pixel(x, y) {
            *pixel = colour;
        }
    }

    /// Lets `cover` (0 to 1) of what is there disappear under a colour.
    pub(super) fn blend(&mut self, x: i64, y: i64, colour: Colour, cover: f32) {
        if let Some(pixel) = self.pixel(x, y) {
            for (under, over) in pixel.iter_mut().zip(colour) {
                let (u, o) = (f32::from(*under), f32::from(over));
                *under = (u + (o - u) * cover).round() as u8;
            }
        }
    }

    pub(super) fn rectangle(&mut self, x: i64, y: i64, width: u32, height: u32, colour: Colour) {
        for row in 0..i64::from(height) {
            for column in 0..i64::from(width) {
                self.set(x + column, y + row, colour);
            }
        }
    }

    /// The frame of a rectangle, `line` pixels thick and outside of it.
    pub(super) fn frame(
        &mut self,
        [x, y]: [i64; 2],
        [width, height]: [u32; 2],
        line: u32,
        colour: Colour,
    ) {
        let t = i64::from(line);
        let (right, bottom) = (x + i64::from(width), y + i64::from(height));
        self.rectangle(x - t, y - t, width + 2 * line, line, colour);
        self.rectangle(x - t, bottom, width + 2 * line, line, colour);
        self.rectangle(x - t, y, line, height, colour);
        self.rectangle(right, y, line, height, colour);
    }

    /// A triangle with smooth edges.
    pub(super) fn triangle(&mut self, corners: [[f32; 2]; 3], colour: Colour) {
        /// Samples on the side of a pixel.
        const FINE: i64 = 4;
        let xs = corners.map(|c| c[0]);
        let ys = corners.map(|c| c[1]);
        let low = |v: [f32; 3]| v.into_iter().fold(f32::INFINITY, f32::min).floor() as i64;
        let high = |v: [f32; 3]| v.into_iter().fold(f32::NEG_INFINITY, f32::max).ceil() as i64;
        for y in low(ys)..high(ys) {
            for x in low(xs)..high(xs) {
                let sample = |i: i64| {
                    let at = |p: i64, i: i64| p as f32 + (i as f32 + 0.5) / FINE as f32;
                    [at(x, i % FINE), at(y, i / FINE)]
                };
                let inside = (0..FINE * FINE).filter(|&i| is_inside(corners, sample(i)));
                let cover = inside.count() as f32 / (FINE * FINE) as f32;
                if cover > 0.0 {
                    self.blend(x, y, colour, cover);
                }
            }
        }
    }

    pub(super) fn into_image(self) -> ImageBuffer {
        // One power a shade and not three a pixel.
        let linear: Vec<f32> = (0..=255)
            .map(|shade| Rgb::from_srgb([shade as f32 / 255.0; 3]).r)
            .collect();
        let light = |c: Colour| {
            let [r, g, b] = c.map(|shade| linear[usize::from(shade)]);
            Rgb::new(r, g, b)
        };
        let pixels = self.pixels.into_iter().map(light).collect();
        ImageBuffer::new(self.width, self.height, pixels)
            .expect("as many pixels as the canvas has, and it has margins")
    }

    fn pixel(&mut self, x: i64, y: i64) -> Option<&mut Colour> {
        let inside = |v: i64, size: u32| u32::try_from(v).ok().filter(|&v| v < size);
        let (x, y) = (inside(x, self.width)?, inside(y, self.height)?);
        self.pixels
            .get_mut(y as usize * self.width as usize + x as usize)
    }
}

/// On the same side of all three edges.
fn is_inside([a, b, c]: [[f32; 2]; 3], p: [f32; 2]) -> bool {
    let side = |a: [f32; 2], b: [f32; 2]| {
        (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) >= 0.0
    };
    let first = side(a, b);
    first == side(b, c) && first == side(c, a)
}
