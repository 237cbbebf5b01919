//! Pictures one after another: an animation (GIF), or a folder of PNG files.

mod folder;
mod gif;

use std::path::Path;

use crate::error::FormatError;
use crate::image::{ImageBuffer, Metadata};
use folder::Folder;
use gif::Gif;

/// The place of an animation that is still to be made; nothing is left behind if it is dropped before it is whole.
///
/// A path that ends in `.gif` is one file, a tenth of a second a picture, over and over; any other is a folder of `0000.png`, `0001.png`, …
/// and `frames.json`, which says what each shows.
#[derive(Debug)]
pub struct FrameWriter(Kind);

#[derive(Debug)]
enum Kind {
    Gif(Box<Gif>),
    Folder(Folder),
}

impl FrameWriter {
    /// A place for pictures.
    ///
    /// # Errors
    /// When the folder does not exist or cannot be written into, or a folder of pictures is to take the place of something else.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, FormatError> {
        let path = path.as_ref();
        let is_gif = path
            .extension()
            .is_some_and(|ending| ending.eq_ignore_ascii_case("gif"));
        Ok(Self(if is_gif {
            Kind::Gif(Box::new(Gif::create(path)?))
        } else {
            Kind::Folder(Folder::create(path)?)
        }))
    }

    /// Adds a picture; all are of one size. `name` says what it shows.
    ///
    /// # Errors
    /// When it has another size, or cannot be written.
    pub fn add(&mut self, picture: &ImageBuffer, name: &str) -> Result<(), FormatError> {
        match &mut self.0 {
            Kind::Gif(file) => file.add(picture),
            Kind::Folder(folder) => folder.add(picture, name),
        }
    }

    /// Puts it in its place. The bytes depend on what was added alone.
    ///
    /// # Errors
    /// When there is no picture, or it cannot be written; what was there before is still there then.
    pub fn finish(self, metadata: &Metadata) -> Result<(), FormatError> {
        match self.0 {
            Kind::Gif(file) => file.finish(),
            Kind::Folder(folder) => folder.finish(metadata),
        }
    }
}

#[cfg(test)]
mod tests;
