//! A font of three by five dots: digits and what else a tick of a scale needs.

/// Columns of a glyph.
pub(super) const WIDTH: usize = 3;
/// Rows of a glyph.
pub(super) const HEIGHT: usize = 5;

/// The rows of a glyph from the top, the leftmost dot being the highest of three bits; a blank for
/// a character that the font does not have.
pub(super) const fn glyph(character: char) -> [u8; HEIGHT] {
    match character {
        '0' => [0b111, 0b101, 0b101, 0b101, 0b111],
        '1' => [0b010, 0b110, 0b010, 0b010, 0b111],
        '2' => [0b111, 0b001, 0b111, 0b100, 0b111],
        '3' => [0b111, 0b001, 0b011, 0b001, 0b111],
        '4' => [0b101, 0b101, 0b111, 0b001, 0b001],
        '5' => [0b111, 0b100, 0b111, 0b001, 0b111],
        '6' => [0b111, 0b100, 0b111, 0b101, 0b111],
        '7' => [0b111, 0b001, 0b010, 0b010, 0b010],
        '8' => [0b111, 0b101, 0b111, 0b101, 0b111],
        '9' => [0b111, 0b101, 0b111, 0b001, 0b111],
        '.' => [0b000, 0b000, 0b000, 0b000, 0b010],
        '+' => [0b000, 0b010, 0b111, 0b010, 0b000],
        'k' => [0b100, 0b101, 0b110, 0b101, 0b101],
        'M' => [0b101, 0b111, 0b111, 0b101, 0b101],
        _ => [0; HEIGHT],
    }
}

/// Calls `dot` with the column and row of each dot of a text, one blank column between glyphs.
pub(super) fn dots(text: &str, mut dot: impl FnMut(usize, usize)) {
    for (place, character) in text.chars().enumerate() {
        for (row, bits) in glyph(character).into_iter().enumerate() {
            for column in (0..WIDTH).filter(|column| bits >> (WIDTH - 1 - column) & 1 == 1) {
                dot(place * (WIDTH + 1) + column, row);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glyphs_differ() {
        let all: Vec<char> = "0123456789.+kM ".chars().collect();
        for (i, &a) in all.iter().enumerate() {
            for &b in &all[..i] {
                assert_ne!(glyph(a), glyph(b), "{a} and {b}");
            }
        }
    }

    #[test]
    fn a_one_is_a_one() {
        let mut drawn = [['.'; WIDTH]; HEIGHT];
        dots("1", |x, y| drawn[y][x] = '#');
        let drawn: Vec<String> = drawn.iter().map(|row| row.iter().collect()).collect();
        assert_eq!(drawn, [".#.", "##.", ".#.", ".#.", "###"]);
    }
}
