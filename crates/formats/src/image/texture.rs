//! Pictures for surfaces: PNG, JPEG, TGA and BMP, decoded from sRGB to linear light.

use std::path::Path;

use image::{DynamicImage, ImageReader};
use ombra_scene::{Image, Rgb};

use super::{ImageBuffer, check_size, image_fault};
use crate::error::{Fault, FormatError};
use crate::input::{Input, Seekable};
use crate::limits::Limits;

/// Reads a PNG, JPEG, TGA or BMP file as a texture. Opacity is not read.
///
/// # Errors
/// When the file cannot be opened, is broken, or has more pixels than `limits` allow, which is
/// found out before they are decoded.
pub fn read_texture(path: impl AsRef<Path>, limits: &Limits) -> Result<Image, FormatError> {
    texture(&Input::on_disk(path.as_ref()), limits)
}

/// Reads a texture that is in memory as [`read_texture`] does. The content says what it is; the
/// ending of `name` does for TGA, which has no mark of its own.
///
/// # Errors
/// As those of [`read_texture`].
pub fn read_texture_bytes(
    name: impl AsRef<Path>,
    bytes: &[u8],
    limits: &Limits,
) -> Result<Image, FormatError> {
    texture(&Input::in_memory(name.as_ref(), bytes), limits)
}

pub(crate) fn texture(input: &Input<'_>, limits: &Limits) -> Result<Image, FormatError> {
    let read = || {
        let (width, height, pixels) = linear(decode(input, limits)?);
        let count = pixels.len() as u64;
        Image::new(width, height, pixels).ok_or_else(|| pixel_count(width, height, count))
    };
    read().map_err(|e| e.in_file(input.name()))
}

/// The same with opacity as the channel "A".
pub(super) fn read_png(input: &Input<'_>, limits: &Limits) -> Result<ImageBuffer, FormatError> {
    let decoded = decode(input, limits)?;
    let alpha = decoded.color().has_alpha().then(|| alpha(&decoded));
    let (width, height, pixels) = linear(decoded);
    let image = ImageBuffer::new(width, height, pixels)?;
    match alpha {
        Some(alpha) => image.with_channel("A", alpha),
        None => Ok(image),
    }
}

/// A picture that is in memory, as a texture; with its opacity if that is asked for and there.
pub(crate) fn texture_of_bytes(
    bytes: &[u8],
    with_alpha: bool,
    limits: &Limits,
) -> Result<Image, FormatError> {
    let decoded = decode(&Input::in_memory("", bytes), limits)?;
    let alpha = (with_alpha && decoded.color().has_alpha()).then(|| alpha(&decoded));
    let (width, height, pixels) = linear(decoded);
    let count = pixels.len() as u64;
    let image = Image::new(width, height, pixels);
    let image = image.and_then(|image| match alpha {
        Some(alpha) => image.with_alpha(alpha),
        None => Some(image),
    });
    image.ok_or_else(|| pixel_count(width, height, count))
}

/// The mean of a picture that is in memory and holds no colours: red, green and blue as they are
/// written, 0 to 1.
pub(crate) fn mean_of_bytes(bytes: &[u8], limits: &Limits) -> Result<[f32; 3], FormatError> {
    let pixels = decode(&Input::in_memory("", bytes), limits)?.into_rgb8();
    let count = u64::from(pixels.width()) * u64::from(pixels.height());
    let mut sums = [0_u64; 3];
    for pixel in pixels.pixels() {
        for (sum, value) in sums.iter_mut().zip(pixel.0) {
            *sum += u64::from(value);
        }
    }
    Ok(sums.map(|sum| (sum as f64 / (255.0 * count.max(1) as f64)) as f32))
}

/// What the library reads from.
pub(super) type Reader<'a> = ImageReader<Box<dyn Seekable + 'a>>;

pub(super) fn open<'a>(input: &Input<'a>) -> Result<Reader<'a>, FormatError> {
    let mut reader = ImageReader::new(input.seekable()?);
    if let Ok(format) = image::ImageFormat::from_path(input.name()) {
        reader.set_format(format);
    }
    reader.with_guessed_format().map_err(|source| {
        let action = "be read";
        FormatError::file(Fault::Io { action, source })
    })
}

pub(super) fn name(reader: &Reader<'_>) -> &'static str {
    use image::ImageFormat;
    match reader.format() {
        Some(ImageFormat::Png) => "PNG",
        Some(ImageFormat::Jpeg) => "JPEG",
        Some(ImageFormat::Tga) => "TGA",
        Some(ImageFormat::Bmp) => "BMP",
        _ => "image",
    }
}

/// First the header alone, so that a picture that is too large is refused before it is decoded.
fn decode(input: &Input<'_>, limits: &Limits) -> Result<DynamicImage, FormatError> {
    let reader = open(input)?;
    let name = name(&reader);
    let (width, height) = (reader.into_dimensions()).map_err(|e| image_fault(name, &e))?;
    check_size(width.into(), height.into(), limits)?;
    let mut reader = open(input)?;
    let mut library_limits = image::Limits::default();
    // The most that a decoder may hold: sixteen bits in each of four channels.
    library_limits.max_alloc = Some(limits.image_pixels.saturating_mul(8));
    reader.limits(library_limits);
    reader.decode().map_err(|e| image_fault(name, &e))
}

fn alpha(decoded: &DynamicImage) -> Vec<f32> {
    let rgba = decoded.to_rgba16();
    let alpha = rgba.pixels().map(|p| f32::from(p[3]) / 65535.0);
    alpha.collect()
}

fn linear(decoded: DynamicImage) -> (u32, u32, Vec<Rgb>) {
    let (width, height) = (decoded.width(), decoded.height());
    let deep = decoded.color().bytes_per_pixel() / decoded.color().channel_count() > 1;
    let pixels = if deep {
        let pixels = decoded.into_rgb16();
        let decode = |p: &image::Rgb<u16>| Rgb::from_srgb(p.0.map(|x| f32::from(x) / 65535.0));
        pixels.pixels().map(decode).collect()
    } else {
        // There are only 256 values, and many millions of pixels.
        let table: [f32; 256] = std::array::from_fn(|i| Rgb::from_srgb([i as f32 / 255.0; 3]).r);
        let pixels = decoded.into_rgb8();
        let decode = |p: &image::Rgb<u8>| Rgb::from(p.0.map(|x| table[usize::from(x)]));
        pixels.pixels().map(decode).collect()
    };
    (width, height, pixels)
}

fn pixel_count(width: u32, height: u32, pixels: u64) -> FormatError {
    FormatError::file(Fault::PixelCount {
        width: width.into(),
        height: height.into(),
        pixels,
    })
}
