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

/// A picture as it is added.
#[derive(Debug)]
pub struct Packed(PackedKind);

#[derive(Debug)]
enum PackedKind {
    Gif(::gif::Frame<'static>),
    Picture(ImageBuffer),
}

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

    /// Packs a picture, for [`add`](Self::add): that takes most of the time, and many threads may do it at once.
    ///
    /// # Errors
    /// When it is too large for an animation.
    pub fn pack(&self, picture: ImageBuffer) -> Result<Packed, FormatError> {
        Ok(Packed(match &self.0 {
            Kind::Gif(file) => {
                PackedKind::Gif(gif::pack(&picture).map_err(|error| error.in_file(file.path()))?)
            }
            Kind::Folder(_) => PackedKind::Picture(picture),
        }))
    }

    /// Adds a picture that it packed; all are of one size. `name` says what it shows.
    ///
    /// # Errors
    /// When it has another size, or cannot be written.
    ///
    /// # Panics
    /// If another one packed it, for a place of another kind.
    pub fn add(&mut self, picture: &Packed, name: &str) -> Result<(), FormatError> {
        match (&mut self.0, &picture.0) {
            (Kind::Gif(file), PackedKind::Gif(frame)) => file.add(frame),
            (Kind::Folder(folder), PackedKind::Picture(picture)) => folder.add(picture, name),
            _ => panic!("a picture is packed for the place that it is added to"),
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
