//! How long a way on the map is.

use super::canvas::Canvas;
use super::text::Face;
use super::{INK, PAPER, round};

/// Pixels that it is long at the most, at scale 1.
const LONGEST: f64 = 170.0;
const HEIGHT: u32 = 8;
/// Dark and light pieces.
const PIECES: u32 = 4;

/// A bar of a round length.
pub(super) struct ScaleBar {
    metres: f64,
    pixels: u32,
    scale: u32,
}

impl ScaleBar {
    pub(super) fn new(metres_per_pixel: f64, scale: u32) -> Self {
        let metres = round::round_down(LONGEST * f64::from(scale) * metres_per_pixel);
        let pixels = (metres / metres_per_pixel).round() as u32;
        Self {
            metres,
            pixels,
            scale,
        }
    }

    /// Draws it so that nothing of it lies right of `right`; `y` is its top.
    pub(super) fn draw(&self, canvas: &mut Canvas, right: i64, y: i64) {
        let scale = self.scale;
        let small = Face::small(scale);
        let text = length(self.metres);
        let bar_right = right - i64::from(small.width(&text) / 2);
        let left = bar_right - i64::from(self.pixels);
        let top = y + i64::from(26 * scale);
        let at = |piece: u32| left + i64::from(self.pixels * piece / PIECES);
        for piece in 0..PIECES {
            let colour = if piece % 2 == 0 { INK } else { PAPER };
            let width = (at(piece + 1) - at(piece)) as u32;
            canvas.rectangle(at(piece), top, width, HEIGHT * scale, colour);
        }
        canvas.frame([left, top], [self.pixels, HEIGHT * scale], scale, INK);
        let label_top = top + i64::from((HEIGHT + 5) * scale);
        small.draw_centred(canvas, left, label_top, "0", INK);
        small.draw_centred(canvas, bar_right, label_top, &text, INK);
    }
}

fn length(metres: f64) -> String {
    let (unit, size) = match metres {
        m if m >= 1000.0 * (1.0 - 1e-9) => ("km", 1e3),
        m if m >= 1.0 - 1e-9 => ("m", 1.0),
        m if m >= 0.01 * (1.0 - 1e-9) => ("cm", 1e-2),
        _ => ("mm", 1e-3),
    };
    let number = metres / size;
    format!("{} {unit}", round::text(number, number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_is_as_long_as_it_says() {
        for (metres_per_pixel, text) in [
            (1.0, "100 m"),
            (0.05, "5 m"),
            (12.0, "2 km"),
            (0.001, "10 cm"),
            (1e-5, "1 mm"),
            (1e12, "1e11 km"),
        ] {
            let bar = ScaleBar::new(metres_per_pixel, 1);
            assert_eq!(length(bar.metres), text);
            let drawn = f64::from(bar.pixels) * metres_per_pixel;
            assert!((drawn / bar.metres - 1.0).abs() < 0.01, "{drawn}");
            assert!((60..=170).contains(&bar.pixels), "{}", bar.pixels);
        }
    }
}
