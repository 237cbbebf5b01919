//! Pictures: what is rendered goes out as PNG, EXR, PFM or PPM; textures come in.

mod exr;
mod metadata;
mod netpbm;
mod pfm;
mod png;
mod ppm;
mod texture;
mod write;

use std::path::Path;

use ombra_scene::Rgb;
use serde::Serialize;

use crate::error::{Fault, FormatError, shown};
use crate::input::Input;
use crate::limits::Limits;

pub(crate) use self::png::png_bytes;
pub use metadata::Metadata;
pub(crate) use texture::{mean_of_bytes, texture, texture_of_bytes};
pub use texture::{read_texture, read_texture_bytes};
pub use write::{OutputFile, write_image};
pub(crate) use write::{file_beside, write_error};

pub use info::ImageInfo;
pub(crate) use info::image_info;

mod info;

/// A picture in linear light, row 0 at the top, with any number of further channels.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageBuffer {
    width: u32,
    height: u32,
    pixels: Vec<Rgb>,
    channels: Vec<Channel>,
}

/// A channel beside red, green and blue: "A" for opacity, "Z" for depth, or any other name.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Its name. Names of EXR files sort channels into layers by dots: "normal.X".
    pub name: String,
    /// One value a pixel.
    pub values: Vec<f32>,
}

/// How a picture is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum ImageFormat {
    /// PNG: 8 bits a channel, sRGB.
    Png,
    /// OpenEXR: 32-bit floating-point numbers, linear, all channels.
    Exr,
    /// Portable float map: 32-bit floating-point numbers, linear.
    Pfm,
    /// Portable pixel map, binary (P6): 8 bits a channel, sRGB.
    Ppm,
}

impl ImageFormat {
    /// All endings.
    pub const KNOWN: &str = "png, exr, pfm, ppm";

    /// The format that the ending of a name stands for.
    ///
    /// # Errors
    /// When there is none; the error lists those that there are.
    pub fn of(path: impl AsRef<Path>) -> Result<Self, FormatError> {
        let path = path.as_ref();
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        match ending.to_ascii_lowercase().as_str() {
            "png" => Ok(Self::Png),
            "exr" => Ok(Self::Exr),
            "pfm" => Ok(Self::Pfm),
            "ppm" => Ok(Self::Ppm),
            _ => {
                let fault = Fault::UnknownEnding {
                    ending: ending.into_owned(),
                    known: Self::KNOWN,
                };
                Err(FormatError::file(fault).in_file(path))
            }
        }
    }
}

impl ImageBuffer {
    /// From pixels in rows.
    ///
    /// # Errors
    /// When there are not `width · height` of them, or none at all.
    pub fn new(width: u32, height: u32, pixels: Vec<Rgb>) -> Result<Self, FormatError> {
        let image = Self {
            width,
            height,
            pixels,
            channels: Vec::new(),
        };
        let count = image.pixels.len();
        image.check(count)?;
        Ok(image)
    }

    /// The same picture with one more channel. Only EXR files hold it.
    ///
    /// # Errors
    /// When it has not one value a pixel.
    pub fn with_channel(
        mut self,
        name: impl Into<String>,
        values: Vec<f32>,
    ) -> Result<Self, FormatError> {
        self.check(values.len())?;
        let name = name.into();
        self.channels.push(Channel { name, values });
        Ok(self)
    }

    /// Pixels in a row.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// The pixels, row by row from the top.
    #[must_use]
    pub fn pixels(&self) -> &[Rgb] {
        &self.pixels
    }

    /// The channels beside red, green and blue.
    #[must_use]
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// How many pixels have a component that is infinite or NaN. PNG and PPM show NaN as 0 and
    /// infinity as 1; EXR and PFM keep both.
    #[must_use]
    pub fn non_finite(&self) -> usize {
        let is_finite = |p: &&Rgb| p.to_array().iter().all(|x| x.is_finite());
        self.pixels.len() - self.pixels.iter().filter(is_finite).count()
    }

    fn rows(&self) -> impl DoubleEndedIterator<Item = &[Rgb]> {
        self.pixels.chunks_exact(self.width as usize)
    }

    /// The pixels as 8-bit sRGB, for screens.
    pub(crate) fn screen_bytes(&self) -> Vec<u8> {
        let byte = |x: f32| (x * 255.0).round() as u8;
        let pixels = self.pixels.iter();
        pixels.flat_map(|p| p.to_srgb().map(byte)).collect()
    }

    fn check(&self, count: usize) -> Result<(), FormatError> {
        let (width, height) = (u64::from(self.width), u64::from(self.height));
        let pixels = count as u64;
        if pixels > 0 && width * height == pixels {
            Ok(())
        } else {
            Err(FormatError::file(Fault::PixelCount {
                width,
                height,
                pixels,
            }))
        }
    }
}

/// Reads a PNG, EXR, PFM or PPM file as linear light; the ending chooses. Pixels of PNG and PPM
/// files are taken as sRGB. An opacity comes as the channel "A".
///
/// # Errors
/// When the file cannot be opened, is broken, or has more pixels than `limits` allow.
pub fn read_image(path: impl AsRef<Path>, limits: &Limits) -> Result<ImageBuffer, FormatError> {
    read(&Input::on_disk(path.as_ref()), limits)
}

/// Reads a picture that is in memory as [`read_image`] does; the ending of `name` chooses the
/// format.
///
/// # Errors
/// As those of [`read_image`].
pub fn read_image_bytes(
    name: impl AsRef<Path>,
    bytes: &[u8],
    limits: &Limits,
) -> Result<ImageBuffer, FormatError> {
    read(&Input::in_memory(name.as_ref(), bytes), limits)
}

fn read(input: &Input<'_>, limits: &Limits) -> Result<ImageBuffer, FormatError> {
    let read = match ImageFormat::of(input.name())? {
        ImageFormat::Png => texture::read_png(input, limits),
        ImageFormat::Exr => exr::read(input, limits),
        ImageFormat::Pfm => pfm::read(input, limits),
        ImageFormat::Ppm => ppm::read(input, limits),
    };
    read.map_err(|e| e.in_file(input.name()))
}

/// Refuses a picture by its size, before its pixels are read.
fn check_size(width: u64, height: u64, limits: &Limits) -> Result<(), FormatError> {
    let limit = limits.image_pixels;
    match width.checked_mul(height) {
        Some(pixels) if pixels <= limit => Ok(()),
        _ => Err(FormatError::file(Fault::ImageTooLarge {
            width,
            height,
            limit,
        })),
    }
}

pub(crate) fn image_fault(format: &'static str, error: &dyn std::fmt::Display) -> FormatError {
    let message = shown(&error.to_string());
    FormatError::file(Fault::Image { format, message })
}
