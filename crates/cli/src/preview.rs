//! The picture in the terminal while it grows: two pixels a character cell.

use std::fmt::Write as _;
use std::ops::Range;

use ombra::render::Film;
use ombra::scene::Rgb;

/// The widest preview, in character cells.
const MAX_COLUMNS: usize = 72;

/// The picture as lines of half blocks in 24-bit colour, as wide as the terminal allows.
pub(crate) fn half_blocks(film: &Film, columns: usize, rows: usize) -> String {
    let (width, height) = (film.width() as usize, film.height() as usize);
    let fitting = (rows.saturating_sub(4) * 2 * width / height.max(1)).max(1);
    let columns = columns
        .saturating_sub(1)
        .clamp(1, MAX_COLUMNS)
        .min(width)
        .min(fitting);
    let pixels = film.display();
    let rows = (columns * height).div_ceil(width * 2).max(1);
    let mut text = String::new();
    for row in 0..rows {
        for column in 0..columns {
            let cell = |half: usize| {
                let x = span(column, columns, width);
                let y = span(row * 2 + half, rows * 2, height);
                mean(&pixels, width, x, y)
            };
            let [upper, lower] = [cell(0), cell(1)].map(bytes);
            let _ = write!(
                text,
                "\x1b[38;2;{};{};{};48;2;{};{};{}m\u{2580}",
                upper[0], upper[1], upper[2], lower[0], lower[1], lower[2]
            );
        }
        text += "\x1b[0m\n";
    }
    text
}

/// Which of `size` pixels lie in one of `cells` cells: at least one.
fn span(cell: usize, cells: usize, size: usize) -> Range<usize> {
    let from = (cell * size / cells).min(size - 1);
    let to = ((cell + 1) * size / cells).max(from + 1);
    from..to.min(size)
}

/// The mean of the pixels in a rectangle of a picture.
fn mean(pixels: &[Rgb], width: usize, x: Range<usize>, y: Range<usize>) -> Rgb {
    let count = (x.len() * y.len()) as f32;
    let rows = y.map(|y| &pixels[y * width..][x.clone()]);
    let sum = rows.flatten().fold(Rgb::BLACK, |sum, &pixel| sum + pixel);
    sum / count
}

fn bytes(colour: Rgb) -> [u8; 3] {
    colour.to_srgb().map(|x| (x * 255.0).round() as u8)
}
