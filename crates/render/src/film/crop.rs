//! A part of a picture.

use std::fmt;

/// A rectangle of pixels: x from `x0` up to but without `x1`, y likewise; (0, 0) is the upper left
/// pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Crop {
    /// The first column.
    pub x0: u32,
    /// The first row.
    pub y0: u32,
    /// The column after the last one.
    pub x1: u32,
    /// The row after the last one.
    pub y1: u32,
}

impl Crop {
    /// All of a picture.
    #[must_use]
    pub const fn all(width: u32, height: u32) -> Self {
        Self {
            x0: 0,
            y0: 0,
            x1: width,
            y1: height,
        }
    }

    /// How many columns.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.x1.saturating_sub(self.x0)
    }

    /// How many rows.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.y1.saturating_sub(self.y0)
    }

    /// How many pixels.
    #[must_use]
    pub const fn pixels(&self) -> u64 {
        self.width() as u64 * self.height() as u64
    }

    /// Whether it holds a pixel and lies within a picture of that size.
    #[must_use]
    pub const fn is_within(&self, width: u32, height: u32) -> bool {
        self.pixels() > 0 && self.x1 <= width && self.y1 <= height
    }
}

impl fmt::Display for Crop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{},{},{}", self.x0, self.y0, self.x1, self.y1)
    }
}
