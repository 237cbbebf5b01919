//! How much a reader may take on.

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
    /// Most pixels of one image, and of all the textures of one model together. 67,108,864 by
    /// default, which is 8192 × 8192.
    pub image_pixels: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            decompressed_bytes: 4 << 30,
            line_bytes: 64 << 20,
            image_pixels: 8192 * 8192,
        }
    }
}
