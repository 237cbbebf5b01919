//! How much of a map is kept at the most.

use super::super::wrong;
use crate::error::FormatError;

/// What may still be kept, in corners.
///
/// A number of one byte in the file is one of eight in memory, and a packed file may hold a thousand
/// times its size: without a bound a small file would fill the memory.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room(usize);

impl Room {
    /// Enough for two million buildings, and less than 1 GB.
    const CORNERS: usize = 16 << 20;

    /// Takes the room of an element with so many corners and so many bytes of tags.
    pub(super) fn take(&mut self, corners: usize, bytes: usize) -> Result<(), FormatError> {
        // What any element costs, its names and numbers included, is that of a few corners.
        let cost = corners.saturating_add(bytes / 8).saturating_add(8);
        self.0 = self.0.checked_sub(cost).ok_or_else(|| {
            let most = Self::CORNERS;
            let message = format!("more than {most} corners of buildings; cut out a smaller area");
            wrong("map", message)
        })?;
        Ok(())
    }
}

impl Default for Room {
    fn default() -> Self {
        Self(Self::CORNERS)
    }
}
