//! PPM, the portable pixel map, binary (P6): 8 bits a channel, sRGB.
//!
//! The format asks for the encoding of ITU-R BT.709; as nearly every program does, sRGB is written
//! and read instead.

use std::io::{self, Write};

use ombra_scene::Rgb;

use super::{ImageBuffer, Metadata, netpbm};
use crate::error::{Fault, FormatError, one_line, quoted};
use crate::input::Input;
use crate::limits::Limits;
use crate::number::whole;

pub(super) fn write(
    file: &mut impl Write,
    image: &ImageBuffer,
    metadata: &Metadata,
) -> io::Result<()> {
    writeln!(file, "P6")?;
    for (name, value) in metadata.entries() {
        writeln!(file, "# {name}: {}", one_line(&value))?;
    }
    write!(file, "{} {}\n255\n", image.width(), image.height())?;
    file.write_all(&image.screen_bytes())
}

/// Reads P6 with 8 or 16 bits a channel.
pub(super) fn read(input: &Input<'_>, limits: &Limits) -> Result<ImageBuffer, FormatError> {
    let expected = "\"P6\" at the beginning of a PPM file";
    let (mut source, header) = netpbm::open(input, limits, expected, &[b"P6"])?;
    let largest = match whole(&header.last, "largest value").map_err(FormatError::file)? {
        largest @ 1..=65535 => largest as f32,
        _ => {
            let found = quoted(&header.last);
            let expected = "a largest value from 1 to 65535";
            return Err(FormatError::file(Fault::Unexpected { found, expected }));
        }
    };
    let bytes = if largest < 256.0 { 1 } else { 2 };
    netpbm::check_room(&source, &header, 3 * bytes as u64)?;
    let width = header.width as usize;
    let mut pixels = Vec::with_capacity(width * header.height as usize);
    for row in 1..=u64::from(header.height) {
        let place = source.place();
        let taken = source.take(width * 3 * bytes)?.ok_or_else(|| {
            let (element, rows) = ("pixels".to_owned(), u64::from(header.height));
            FormatError::new(place, Fault::UnexpectedEnd { element, row, rows })
        })?;
        pixels.extend(taken.chunks_exact(3 * bytes).map(|pixel| {
            let component = |i: usize| {
                let value = match pixel[i * bytes..][..bytes] {
                    [high, low] => u16::from_be_bytes([high, low]),
                    ref one => u16::from(one[0]),
                };
                f32::from(value) / largest
            };
            Rgb::from_srgb([0, 1, 2].map(component))
        }));
    }
    ImageBuffer::new(header.width, header.height, pixels)
}
