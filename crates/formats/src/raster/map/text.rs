//! Letters: pictures of Noto Sans Mono at a few sizes, from the crate `noto-sans-mono-bitmap`.
//!
//! The crate is MIT; the font that its pictures show is © Google under the SIL Open Font License 1.1,
//! which asks that its name and licence stay with it. Pictures and not outlines, because they come out
//! the same on every machine.

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

use super::canvas::{Canvas, Colour};

/// A size and weight of letters, all of one width.
#[derive(Clone, Copy)]
pub(super) struct Face {
    weight: FontWeight,
    raster: RasterHeight,
    /// 1, or 2 for twice the size of the raster.
    zoom: u32,
}

impl Face {
    pub(super) fn title(scale: u32) -> Self {
        Self::new(FontWeight::Bold, RasterHeight::Size32, scale)
    }

    pub(super) fn body(scale: u32) -> Self {
        Self::new(FontWeight::Regular, RasterHeight::Size20, scale)
    }

    pub(super) fn small(scale: u32) -> Self {
        if scale == 2 {
            // Drawn by hinted pictures, which are sharper than enlarged ones.
            return Self::new(FontWeight::Regular, RasterHeight::Size32, 1);
        }
        Self::new(FontWeight::Regular, RasterHeight::Size16, scale)
    }

    fn new(weight: FontWeight, raster: RasterHeight, zoom: u32) -> Self {
        Self {
            weight,
            raster,
            zoom,
        }
    }

    /// Pixels from a line to the next.
    pub(super) fn height(self) -> u32 {
        self.raster.val() as u32 * self.zoom
    }

    /// Pixels that a text takes.
    pub(super) fn width(self, text: &str) -> u32 {
        let letters = text.chars().count().min(u32::MAX as usize / 256) as u32;
        letters * self.advance()
    }

    fn advance(self) -> u32 {
        get_raster_width(self.weight, self.raster) as u32 * self.zoom
    }

    /// Draws one line; `x`, `y` is its upper left corner.
    pub(super) fn draw(self, canvas: &mut Canvas, x: i64, y: i64, text: &str, ink: Colour) {
        let mut left = x;
        for c in text.chars() {
            self.draw_letter(canvas, left, y, c, ink);
            left += i64::from(self.advance());
        }
    }

    /// The same around the middle `x`.
    pub(super) fn draw_centred(self, canvas: &mut Canvas, x: i64, y: i64, text: &str, ink: Colour) {
        let left = x - i64::from(self.width(text) / 2);
        self.draw(canvas, left, y, text, ink);
    }

    fn draw_letter(self, canvas: &mut Canvas, x: i64, y: i64, letter: char, ink: Colour) {
        let raster = |c| get_raster(c, self.weight, self.raster);
        let Some(glyph) = raster(letter).or_else(|| raster('\u{fffd}')) else {
            return;
        };
        let cover = |x: i64, y: i64| {
            let at = usize::try_from(x).ok().zip(usize::try_from(y).ok());
            let pixel = at.and_then(|(x, y)| glyph.pixel(x, y));
            f32::from(pixel.unwrap_or(0)) / 255.0
        };
        for row in 0..i64::from(self.height()) {
            for column in 0..i64::from(self.advance()) {
                let cover = if self.zoom == 1 {
                    cover(column, row)
                } else {
                    enlarged(&cover, column, row)
                };
                if cover > 0.0 {
                    canvas.blend(x + column, y + row, ink, cover);
                }
            }
        }
    }

    /// The text in lines that are no wider than `width`, broken between words where that is possible.
    /// What goes beyond `most` lines is cut, and dots say so.
    pub(super) fn lines(self, text: &str, width: u32, most: usize) -> Vec<String> {
        let letters = (width / self.advance()).max(4) as usize;
        let text = shown(text);
        let mut lines = Vec::new();
        let mut line = String::new();
        let mut used = 0;
        for word in text.split_whitespace().flat_map(|w| pieces(w, letters)) {
            let length = word.chars().count();
            if used > 0 && used + 1 + length > letters {
                lines.push(std::mem::take(&mut line));
                used = 0;
            }
            if used > 0 {
                line.push(' ');
                used += 1;
            }
            line += word;
            used += length;
            if lines.len() > most {
                break;
            }
        }
        if used > 0 {
            lines.push(line);
        }
        if lines.len() > most {
            lines.truncate(most);
            if let Some(last) = lines.last_mut() {
                while last.chars().count() > letters - 3 {
                    last.pop();
                }
                last.truncate(last.trim_end().len());
                last.push_str("...");
            }
        }
        lines
    }
}

/// Twice the size: between the four nearest pixels, then made steeper, because a soft edge that is
/// twice as wide looks out of focus.
fn enlarged(cover: &impl Fn(i64, i64) -> f32, x: i64, y: i64) -> f32 {
    // The middle of an enlarged pixel lies a quarter of a pixel from that of its own, three quarters
    // from that of the neighbour on the same side.
    let beside = |v: i64| if v % 2 == 0 { v / 2 - 1 } else { v / 2 + 1 };
    let mix = |own: f32, other: f32| 0.75 * own + 0.25 * other;
    let row = |y: i64| mix(cover(x / 2, y), cover(beside(x), y));
    let soft = mix(row(y / 2), row(beside(y)));
    (1.8 * (soft - 0.5) + 0.5).clamp(0.0, 1.0)
}

/// A word in pieces of at most `most` letters.
fn pieces(word: &str, most: usize) -> impl Iterator<Item = &str> {
    let mut rest = word;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let end = rest.char_indices().nth(most).map_or(rest.len(), |(i, _)| i);
        let (piece, after) = rest.split_at(end);
        rest = after;
        Some(piece)
    })
}

/// The text with signs that the font has not in place of ones that mean the same.
fn shown(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\u{2010}'..='\u{2015}' | '\u{2212}' => shown.push('-'),
            '\u{2018}' | '\u{2019}' | '\u{2032}' => shown.push('\''),
            '\u{201c}'..='\u{201e}' | '\u{2033}' => shown.push('"'),
            '\u{2026}' => shown.push_str("..."),
            '\u{2264}' => shown.push_str("<="),
            '\u{2265}' => shown.push_str(">="),
            '\u{2022}' => shown.push('·'),
            c if c.is_control() || c.is_whitespace() => shown.push(' '),
            c => shown.push(c),
        }
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str, letters: u32, most: usize) -> Vec<String> {
        let face = Face::body(1);
        face.lines(text, letters * face.advance(), most)
    }

    #[test]
    fn long_texts_are_wrapped_and_then_cut() {
        assert_eq!(lines("  one   two ", 20, 2), ["one two"]);
        assert_eq!(lines("one two three", 8, 2), ["one two", "three"]);
        assert_eq!(
            lines("one two three four five", 8, 2),
            ["one two", "three..."]
        );
        assert_eq!(lines("abcdefghij", 4, 3), ["abcd", "efgh", "ij"]);
        assert_eq!(lines("abcdefghij", 4, 2), ["abcd", "e..."]);
        assert!(lines(" \n\t ", 9, 2).is_empty());
        assert!(lines("", 0, 1).is_empty());
    }

    #[test]
    fn a_line_is_never_wider_than_asked() {
        let face = Face::title(2);
        let text = "Schattendauer — Übersicht für ßtraße \u{4e2d} ".repeat(300);
        for width in [200, 333, 820] {
            let lines = face.lines(&text, width, 3);
            assert_eq!(lines.len(), 3);
            assert!(lines.iter().all(|l| face.width(l) <= width), "{lines:?}");
        }
    }

    #[test]
    fn signs_of_typography_become_those_of_the_font() {
        assert_eq!(shown("9:00–15:30 ‘a’ …\u{a0}≤"), "9:00-15:30 'a' ... <=");
        for c in "Łódź, Åbo, Málaga, ±0.5 %, 21° · Île".chars() {
            let raster = get_raster(c, FontWeight::Regular, RasterHeight::Size20);
            assert!(raster.is_some(), "{c}");
        }
    }
}
