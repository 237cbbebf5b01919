//! The scale of a heat map, and the bar with numbers that explains it.

use ombra_scene::Rgb;

use super::{digits, heat};

/// What the colours mean: 0 is the darkest, `top` the lightest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    /// A round number above 0.
    pub(super) top: f32,
    /// Whether some pixels are above it.
    pub(super) exceeded: bool,
}

/// Ticks beside the one at 0.
const TICKS: usize = 4;

impl Scale {
    /// The least round scale that covers that share of some counts.
    pub(super) fn covering(counts: &[f32], share: f64) -> Self {
        let mut sorted: Vec<f32> = counts.iter().copied().filter(|c| c.is_finite()).collect();
        sorted.sort_unstable_by(f32::total_cmp);
        let last = sorted.len().saturating_sub(1);
        let covered = sorted.get((last as f64 * share).ceil() as usize);
        let top = round_up(covered.copied().unwrap_or(0.0));
        let exceeded = sorted.last().is_some_and(|&largest| largest > top);
        Self { top, exceeded }
    }

    /// The text of a tick, counted from 0 at the bottom.
    fn tick(&self, tick: usize) -> String {
        let value = self.top * tick as f32 / TICKS as f32;
        let more = if tick == TICKS && self.exceeded {
            "+"
        } else {
            ""
        };
        let (value, unit) = match value {
            v if v >= 1e6 => (v / 1e6, "M"),
            v if v >= 1e4 => (v / 1e3, "k"),
            v => (v, ""),
        };
        format!("{value}{unit}{more}")
    }
}

/// The least of 4, 8, 12, 20 times a power of ten that is not below a number: numbers that four
/// ticks divide into round ones.
fn round_up(value: f32) -> f32 {
    let mut power = 1.0_f32;
    loop {
        for step in [4.0, 8.0, 12.0, 20.0] {
            if step * power >= value || power > 1e30 {
                return step * power;
            }
        }
        power *= 10.0;
    }
}

/// Draws the legend over the right edge of a picture, if the picture is large enough for it.
pub(super) fn draw(pixels: &mut [Rgb], width: u32, height: u32, scale: &Scale) {
    let (width, height) = (width as usize, height as usize);
    let dot = (height / 270).max(1);
    let texts: Vec<String> = (0..=TICKS).map(|tick| scale.tick(tick)).collect();
    let letters = texts.iter().map(String::len).max().unwrap_or(0);
    let text_width = letters * (digits::WIDTH + 1) * dot;
    let bar_width = 6 * dot;
    let margin = 3 * dot;
    let panel_width = margin + bar_width + 2 * dot + text_width + margin;
    let panel_height = (height * 3 / 4).min(150 * dot);
    let bar_height = panel_height.saturating_sub(2 * margin + digits::HEIGHT * dot);
    // Each number needs its line, and the picture is to be more than its legend.
    if panel_width * 3 > width || bar_height < (TICKS + 1) * (digits::HEIGHT + 2) * dot {
        return;
    }
    let left = width - panel_width;
    let top = (height - panel_height) / 2;
    let mut fill = |x: usize, y: usize, w: usize, h: usize, colour: Rgb| {
        for row in y..y + h {
            pixels[row * width + x..row * width + x + w].fill(colour);
        }
    };
    fill(left, top, panel_width, panel_height, Rgb::grey(0.004));
    let bar_left = left + margin;
    let bar_top = top + margin + digits::HEIGHT * dot / 2;
    for row in 0..bar_height {
        let fraction = 1.0 - row as f32 / (bar_height - 1) as f32;
        fill(bar_left, bar_top + row, bar_width, 1, heat(fraction));
    }
    for (tick, text) in texts.iter().enumerate() {
        let y = bar_top + (bar_height - 1) * (TICKS - tick) / TICKS;
        let x = bar_left + bar_width;
        let line = y.min(bar_top + bar_height - dot);
        fill(x - dot, line, 2 * dot, dot, Rgb::WHITE);
        let (text_left, text_top) = (x + 2 * dot, y - digits::HEIGHT * dot / 2);
        digits::dots(text, |column, row| {
            let (x, y) = (text_left + column * dot, text_top + row * dot);
            fill(x, y, dot, dot, Rgb::WHITE);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_the_scale_is_round_and_covers_what_it_is_to_cover() {
        for (value, top) in [
            (0.0, 4.0),
            (4.0, 4.0),
            (9.0, 12.0),
            (101.0, 120.0),
            (9e4, 1.2e5),
        ] {
            assert_eq!(round_up(value), top);
        }
        let mut counts = vec![7.0; 999];
        counts.push(1e6);
        let scale = Scale::covering(&counts, 0.99);
        assert_eq!((scale.top, scale.exceeded), (8.0, true));
        assert_eq!(scale.tick(TICKS), "8+");
        assert_eq!(Scale::covering(&[], 0.99).top, 4.0);
        assert_eq!(Scale::covering(&[f32::NAN, f32::INFINITY], 0.99).top, 4.0);
    }

    #[test]
    fn large_numbers_are_short() {
        let scale = Scale {
            top: 2e5,
            exceeded: false,
        };
        let texts: Vec<_> = (0..=TICKS).map(|tick| scale.tick(tick)).collect();
        assert_eq!(texts, ["0", "50k", "100k", "150k", "200k"]);
    }

    #[test]
    fn the_legend_stays_within_the_picture_whatever_its_size() {
        let scale = Scale {
            top: 400.0,
            exceeded: true,
        };
        for (width, height) in [
            (1, 1),
            (40, 400),
            (400, 40),
            (200, 100),
            (960, 540),
            (77, 2000),
        ] {
            let mut pixels = vec![Rgb::BLACK; (width * height) as usize];
            draw(&mut pixels, width, height, &scale);
            let drawn = pixels.iter().filter(|&&p| p != Rgb::BLACK).count();
            assert!(drawn * 2 <= pixels.len());
            assert_eq!(drawn > 0, width >= 200 && height >= 100, "{width}x{height}");
        }
    }
}
