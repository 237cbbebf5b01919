//! Squares of numbers, made ready to be packed, and packed.

use std::io::{self, Write as _};

use flate2::Compression;
use flate2::write::ZlibEncoder;

use crate::raster::cells::Cells;

/// Cells on a tile's side.
pub(super) const SIDE: usize = 256;

/// Good packing without much waiting; more gains a hundredth.
const LEVEL: u32 = 6;

/// The tiles that cover the cells, row by row. What lies beyond the edge is NaN.
pub(super) fn packed_tiles(cells: &Cells<'_>) -> io::Result<Vec<Vec<u8>>> {
    let across = cells.width.div_ceil(SIDE);
    let down = cells.height.div_ceil(SIDE);
    let tiles = (0..across * down).map(|i| packed(cells, SIDE * (i % across), SIDE * (i / across)));
    tiles.collect()
}

fn packed(cells: &Cells<'_>, left: usize, top: usize) -> io::Result<Vec<u8>> {
    let mut zlib = ZlibEncoder::new(Vec::new(), Compression::new(LEVEL));
    let right = (left + SIDE).min(cells.width);
    let mut values = [f32::NAN; SIDE];
    for y in top..top + SIDE {
        values.fill(f32::NAN);
        if y < cells.height {
            let row = &cells.values[y * cells.width..][left..right];
            for (value, &cell) in values.iter_mut().zip(row) {
                // There are many NaNs; the same raster is the same bytes only if one is written.
                *value = if cell.is_nan() { f32::NAN } else { cell };
            }
        }
        zlib.write_all(&predicted(&values))?;
    }
    zlib.finish()
}

/// The floating-point predictor (TIFF Technical Note 3): the highest bytes of all numbers of a row,
/// then the next ones, to the lowest, each byte as its difference from the one before. Neighbours
/// share sign, exponent and the first bits, so that most of the differences are 0.
fn predicted(values: &[f32; SIDE]) -> [u8; 4 * SIDE] {
    let mut bytes = [0; 4 * SIDE];
    for (i, value) in values.iter().enumerate() {
        for (plane, byte) in value.to_be_bytes().into_iter().enumerate() {
            bytes[plane * SIDE + i] = byte;
        }
    }
    for i in (1..bytes.len()).rev() {
        bytes[i] = bytes[i].wrapping_sub(bytes[i - 1]);
    }
    bytes
}
