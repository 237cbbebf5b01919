//! How much a reader may take on.

use crate::error::{Fault, FormatError};

/// Bounds on what a file may make a reader do.
///
/// Memory follows the content that is really there, never a count that a header declares; these
/// bounds are for content that is really there and too large.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Most bytes that a gzip file may unpack to. 4 GiB by default.
    pub decompressed_bytes: u64,
    /// Longest line of a text file, in bytes. 64 MiB by default: a polygon of millions of corners
    /// is one line.
    pub line_bytes: usize,
    /// Most pixels of one image, and of all the textures together of one model or one scene file
    /// with its models. 67,108,864 by default, which is 8192 × 8192.
    pub image_pixels: u64,
    /// Most pixels of one surface or terrain model. 268,435,456 by default, which is 16384 × 16384 and
    /// takes 1 GiB.
    pub raster_pixels: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            decompressed_bytes: 4 << 30,
            line_bytes: 64 << 20,
            image_pixels: 8192 * 8192,
            raster_pixels: 16384 * 16384,
        }
    }
}

/// Takes the pixels of a texture from what may still be loaded.
pub(crate) fn take_pixels(left: &mut Limits, width: u32, height: u32) -> Result<(), FormatError> {
    let (width, height) = (u64::from(width), u64::from(height));
    let limit = left.image_pixels;
    left.image_pixels = limit.checked_sub(width * height).ok_or_else(|| {
        FormatError::file(Fault::ImageTooLarge {
            width,
            height,
            limit,
        })
    })?;
    Ok(())
}
