//! PNG (W3C, "Portable Network Graphics, Third Edition", 2025): 8 bits a channel, sRGB.

use std::io::Write;

use png::{BitDepth, ColorType, Encoder, SrgbRenderingIntent};

use super::{ImageBuffer, Metadata, image_fault};
use crate::error::FormatError;

pub(super) fn write(
    file: &mut impl Write,
    image: &ImageBuffer,
    metadata: &Metadata,
) -> Result<(), FormatError> {
    write_chunks(file, image, metadata).map_err(|e| image_fault("PNG", &e))
}

fn write_chunks(
    file: &mut impl Write,
    image: &ImageBuffer,
    metadata: &Metadata,
) -> Result<(), png::EncodingError> {
    let mut encoder = Encoder::new(file, image.width(), image.height());
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    for (name, value) in metadata.entries() {
        // International text holds any characters.
        encoder.add_itxt_chunk(name.to_owned(), value)?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&image.screen_bytes())?;
    writer.finish()
}

/// Pixels as a PNG file without anything else.
pub(crate) fn png_bytes(
    [width, height]: [u32; 2],
    colour: ColorType,
    pixels: &[u8],
) -> Result<Vec<u8>, FormatError> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width, height);
    encoder.set_color(colour);
    encoder.set_depth(BitDepth::Eight);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(pixels)?;
        writer.finish()
    });
    written.map_err(|error| image_fault("PNG", &error))?;
    Ok(file)
}
