//! PFM, the portable float map (Debevec): 32-bit floating-point numbers, linear, little endian as
//! written here, the bottom row first.

use std::io::{self, Write};

use ombra_scene::Rgb;

use super::{ImageBuffer, netpbm};
use crate::error::{Fault, FormatError, quoted};
use crate::input::Input;
use crate::limits::Limits;

pub(super) fn write(file: &mut impl Write, image: &ImageBuffer) -> io::Result<()> {
    // A negative scale says little endian.
    write!(file, "PF\n{} {}\n-1.0\n", image.width(), image.height())?;
    for row in image.rows().rev() {
        for x in row.iter().flat_map(|pixel| pixel.to_array()) {
            file.write_all(&x.to_le_bytes())?;
        }
    }
    Ok(())
}

/// Reads colour (`PF`) and grey (`Pf`), of either byte order. The size of the scale is not applied.
pub(super) fn read(input: &Input<'_>, limits: &Limits) -> Result<ImageBuffer, FormatError> {
    let expected = "\"PF\" or \"Pf\" at the beginning of a PFM file";
    let (mut source, header) = netpbm::open(input, limits, expected, &[b"PF", b"Pf"])?;
    let components = if header.magic == *b"PF" { 3 } else { 1 };
    let scale: Option<f32> = str::from_utf8(&header.last)
        .ok()
        .and_then(|s| s.parse().ok());
    let little = match scale {
        Some(scale) if scale < 0.0 => true,
        Some(scale) if scale > 0.0 => false,
        _ => {
            let found = quoted(&header.last);
            let expected = "a scale other than 0";
            return Err(FormatError::file(Fault::Unexpected { found, expected }));
        }
    };
    netpbm::check_room(&source, &header, components * 4)?;
    let width = header.width as usize;
    let mut pixels = vec![Rgb::BLACK; width * header.height as usize];
    for (row, pixels) in (1..).zip(pixels.chunks_exact_mut(width).rev()) {
        let place = source.place();
        let bytes = source
            .take(width * components as usize * 4)?
            .ok_or_else(|| {
                let (element, rows) = ("pixels".to_owned(), u64::from(header.height));
                FormatError::new(place, Fault::UnexpectedEnd { element, row, rows })
            })?;
        let number = |bytes: &[u8; 4]| {
            if little {
                f32::from_le_bytes(*bytes)
            } else {
                f32::from_be_bytes(*bytes)
            }
        };
        let numbers: Vec<_> = bytes.as_chunks().0.iter().map(number).collect();
        for (pixel, x) in pixels
            .iter_mut()
            .zip(numbers.chunks_exact(components as usize))
        {
            *pixel = match *x {
                [r, g, b] => Rgb::new(r, g, b),
                _ => Rgb::grey(x[0]),
            };
        }
    }
    ImageBuffer::new(header.width, header.height, pixels)
}
