//! Surface and terrain models: rasters of heights, as GeoTIFF (TIFF 6.0, BigTIFF, OGC GeoTIFF 1.1).
//!
//! One band of floating-point numbers or integers, in strips or tiles, plain or packed by Deflate, LZW or
//! PackBits, with or without a predictor. Where its pixels are is told by a scale and a tie point or by a
//! transformation; what the coordinates mean, by the EPSG code among its keys. A pixel may be an area or a
//! point. Without data are the number that GDAL's tag names, NaN, and what no ground can be.
//!
//! ```no_run
//! use ombra_formats::Limits;
//! use ombra_formats::elevation::read_elevation;
//!
//! let surface = read_elevation("dsm.tif", None, &Limits::default())?;
//! let [low, high] = surface.field.range();
//! println!("{:?} pixels, {low} m to {high} m", surface.field.size());
//! # Ok::<(), ombra_formats::FormatError>(())
//! ```

mod geo_tags;
mod info;
mod pixels;
#[cfg(test)]
mod tests;

use std::io::Cursor;
use std::path::Path;

use ombra_city::{Crs, Finding, HeightField, Notes};
use tiff::TiffError;
use tiff::decoder::Decoder;

use crate::error::{Fault, FormatError, shown};
use crate::info::begins;
use crate::input::Input;
use crate::limits::Limits;
use geo_tags::GeoTags;
pub use info::ElevationInfo;
pub(crate) use info::elevation_info;
use pixels::Pixels;

/// No ground lies higher above the sea, or lower below it, in metres; nothing built adds to that.
const HIGHEST: f64 = 9000.0;

/// Heights on a raster of a map, and what was met on the way to them.
#[derive(Clone, Debug)]
pub struct Elevation {
    /// The heights.
    pub field: HeightField,
    /// What its user should hear of.
    pub findings: Vec<Finding>,
}

/// Reads a surface or terrain model; `crs` counts instead of what the file says of its coordinates.
///
/// # Errors
/// When the file cannot be opened, is no TIFF or a broken one, has several bands, more pixels than
/// [`Limits::raster_pixels`] or none with a height, does not say where its pixels are, or names no reference
/// system and none is given.
pub fn read_elevation(
    path: impl AsRef<Path>,
    crs: Option<&Crs>,
    limits: &Limits,
) -> Result<Elevation, FormatError> {
    let input = Input::on_disk(path.as_ref());
    let read = || {
        let bytes = input.source(limits)?.rest()?;
        if bytes.is_empty() {
            return Err(FormatError::file(Fault::Empty));
        }
        if !is_tiff(&bytes) {
            let known = "heights as GeoTIFF";
            return Err(FormatError::file(Fault::UnknownContent { known }));
        }
        parse(&bytes, crs, limits)
    };
    read().map_err(|error| error.in_file(input.name()))
}

/// Whether a file begins as TIFF does.
///
/// # Errors
/// When it cannot be read.
pub fn is_elevation(path: impl AsRef<Path>) -> Result<bool, FormatError> {
    begins(path.as_ref(), is_tiff)
}

/// Whether bytes begin as TIFF and BigTIFF do, in either order of bytes.
pub(crate) fn is_tiff(bytes: &[u8]) -> bool {
    let heads = [b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"];
    heads.iter().any(|head| bytes.starts_with(*head))
}

/// A TIFF in memory.
pub(crate) fn parse(
    bytes: &[u8],
    crs: Option<&Crs>,
    limits: &Limits,
) -> Result<Elevation, FormatError> {
    let mut decoder = decoder(bytes)?;
    let pixels = Pixels::of(&mut decoder, bytes.len() as u64, limits)?;
    let tags = GeoTags::read(&mut decoder)?;
    let crs = match crs {
        Some(crs) => crs.clone(),
        None => tags.crs()?,
    };
    let map_from_pixel = tags.map_from_pixel()?;
    let metres = tags.metres_of_height().unwrap_or(crs.metres_of_height());
    let mut heights = pixels.decode(&mut decoder)?;
    let mut notes = Notes::default();
    for z in heights.iter_mut().filter(|z| !z.is_nan()) {
        let told = f64::from(*z) * metres;
        *z = if told.abs() <= HIGHEST {
            told as f32
        } else {
            let message = format!("height cannot be ({told} m): taken for none");
            notes.add_kind("height", "pixels", message);
            f32::NAN
        };
    }
    let field = HeightField::new(crs, pixels.size, map_from_pixel, heights);
    let field = field.map_err(|error| FormatError::file(Fault::City(error)))?;
    Ok(Elevation {
        field,
        findings: notes.into_findings(),
    })
}

fn decoder(bytes: &[u8]) -> Result<Decoder<Cursor<&[u8]>>, FormatError> {
    let mut limits = tiff::decoder::Limits::default();
    limits.decoding_buffer_size = pixels::LARGEST_CHUNK as usize;
    limits.intermediate_buffer_size = pixels::LARGEST_CHUNK as usize;
    let decoder = Decoder::new(Cursor::new(bytes)).map_err(broken)?;
    Ok(decoder.with_limits(limits))
}

/// What the library says, on one line.
fn broken(error: TiffError) -> FormatError {
    let message = match &error {
        TiffError::IoError(io) if io.kind() == std::io::ErrorKind::UnexpectedEof => {
            "the file is cut off".to_owned()
        }
        _ => shown(&error.to_string()),
    };
    wrong(message)
}

fn wrong(message: impl Into<String>) -> FormatError {
    FormatError::file(Fault::Image {
        format: "TIFF",
        message: message.into(),
    })
}
