//! Squares of numbers, made ready to be packed, and packed.

use std::io::{self, Write as _};

use flate2::Compression;
use flate2::write::ZlibEncoder;

use crate::raster::cells::Cells;

/// Cells on a tile's side.
pub(super) const SIDE: usize = 256;

/// Good packing without much waiting; more gains a hundredth.
const LEVEL: u32 = 6;

/// The tiles that cover the cells of all bands, row by row. What lies beyond the edge is NaN.
pub(super) fn packed_tiles(bands: &[Cells<'_>]) -> io::Result<Vec<Vec<u8>>> {
    let across = bands[0].width.div_ceil(SIDE);
    let down = bands[0].height.div_ceil(SIDE);
    let tiles = (0..across * down).map(|i| packed(bands, SIDE * (i % across), SIDE * (i / across)));
    tiles.collect()
}

fn packed(bands: &[Cells<'_>], left: usize, top: usize) -> io::Result<Vec<u8>> {
    let mut zlib = ZlibEncoder::new(Vec::new(), Compression::new(LEVEL));
    let mut values = vec![f32::NAN; SIDE * bands.len()];
    for y in top..top + SIDE {
        values.fill(f32::NAN);
        for (band, cells) in bands
            .iter()
            .enumerate()
            .filter(|(_, cells)| y < cells.height)
        {
            let right = (left + SIDE).min(cells.width);
            let row = &cells.values[y * cells.width..][left..right];
            let own = values.iter_mut().skip(band).step_by(bands.len());
            for (value, &cell) in own.zip(row) {
                // There are many NaNs; the same raster is the same bytes only if one is written.
                *value = if cell.is_nan() { f32::NAN } else { cell };
            }
        }
        zlib.write_all(&predicted(&values, bands.len()))?;
    }
    zlib.finish()
}

/// The floating-point predictor (TIFF Technical Note 3): the highest bytes of all numbers of a row,
/// then the next ones, to the lowest, each byte as its difference from the one before. Neighbours
/// share sign, exponent and the first bits, so that most of the differences are 0. With several bands it is the
/// difference from the last byte of the same band.
fn predicted(values: &[f32], bands: usize) -> Vec<u8> {
    let mut bytes = vec![0_u8; 4 * values.len()];
    for (i, value) in values.iter().enumerate() {
        for (plane, byte) in value.to_be_bytes().into_iter().enumerate() {
            bytes[plane * values.len() + i] = byte;
        }
    }
    for i in (bands..bytes.len()).rev() {
        bytes[i] = bytes[i].wrapping_sub(bytes[i - bands]);
    }
    bytes
}
