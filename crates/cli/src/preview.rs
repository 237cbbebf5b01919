//! The picture in the terminal while it grows: two pixels a character cell.

use std::fmt::Write as _;

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
    let rows = (columns * height).div_ceil(width * 2).max(1);
    let mut text = String::new();
    for row in 0..rows {
        for column in 0..columns {
            let cell = |half: usize| mean(film, [column, columns], [row * 2 + half, rows * 2]);
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

/// The mean of the pixels in one cell of a raster of `[columns, rows]` cells.
fn mean(film: &Film, [column, columns]: [usize; 2], [row, rows]: [usize; 2]) -> Rgb {
    let span = |cell: usize, cells: usize, size: u32| {
        let from = cell * size as usize / cells;
        let to = ((cell + 1) * size as usize / cells).max(from + 1);
        from as u32..(to as u32).min(size)
    };
    let mut sum = Rgb::BLACK;
    let mut count = 0.0;
    for y in span(row, rows, film.height()) {
        for x in span(column, columns, film.width()) {
            if let Some(pixel) = film.average(x, y) {
                sum += pixel;
                count += 1.0;
            }
        }
    }
    if count > 0.0 { sum / count } else { sum }
}

fn bytes(colour: Rgb) -> [u8; 3] {
    colour.to_srgb().map(|x| (x * 255.0).round() as u8)
}
