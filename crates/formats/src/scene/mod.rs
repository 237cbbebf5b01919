//! Scene files: a camera, materials, lights and objects, written in TOML.
//!
//! The words are in `description.rs`, one page on them is `docs/scene-file.md`, and the files of the
//! folder `scenes` are examples.

mod assets;
mod build;
mod description;
mod picture;
mod placement;
mod shapes;

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use ombra_geometry::triangle::TriangleTest;
use ombra_scene::Scene;

use crate::error::{Fault, FormatError, Place};
use crate::finding::Finding;
use crate::limits::Limits;

pub use crate::input::Assets;
pub use picture::Picture;

/// What a scene file holds.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// The scene.
    pub scene: Scene,
    /// What the scene wants to be rendered like.
    pub picture: Picture,
    /// What its user should hear of.
    pub findings: Vec<Finding>,
    /// SHA-256, in hexadecimal, over the scene file and then the files that it refers to, each once,
    /// in the order in which they are read. It changes when any of them does.
    pub hash: String,
}

/// The longest scene file, in bytes: they are written by hand.
const MOST_BYTES: u64 = 16 << 20;

/// Reads a scene file and the models and textures that it refers to, which must lie in its folder.
///
/// # Errors
/// When a file cannot be read or does not say what a scene file says; the error names the file, the
/// line, what is wrong and what would be right.
pub fn read_scene(
    path: impl AsRef<Path>,
    test: TriangleTest,
    limits: &Limits,
) -> Result<SceneFile, FormatError> {
    let path = path.as_ref();
    text_of(path)
        .and_then(|text| parse_scene(&text, &Assets::beside(path), test, limits))
        .map_err(|e| e.in_file(path))
}

/// The text of a scene file, which may be a pipe: its length is known once it is read.
pub(crate) fn text_of(path: &Path) -> Result<String, FormatError> {
    let cannot = |source| {
        let action = "be read";
        FormatError::file(Fault::Io { action, source })
    };
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(cannot)?;
    file.take(MOST_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(cannot)?;
    if bytes.len() as u64 > MOST_BYTES {
        let (what, limit) = ("scene file", MOST_BYTES);
        return Err(FormatError::file(Fault::TooLarge { what, limit }));
    }
    String::from_utf8(bytes).map_err(|error| {
        let place = line_of(error.as_bytes(), error.utf8_error().valid_up_to());
        let expected = "text (UTF-8)";
        let found = "something else".to_owned();
        FormatError::new(place, Fault::Unexpected { found, expected })
    })
}

/// Reads a scene from the text of a scene file.
///
/// # Errors
/// See [`read_scene`].
pub fn parse_scene(
    text: &str,
    assets: &Assets<'_>,
    test: TriangleTest,
    limits: &Limits,
) -> Result<SceneFile, FormatError> {
    let description = toml::from_str(text).map_err(|error| {
        let place = error
            .span()
            .map_or(Place::File, |span| line_of(text.as_bytes(), span.start));
        FormatError::new(place, Fault::Description(error.message().to_owned()))
    })?;
    build::build(description, text, assets, test, limits)
}

/// The line, from 1, that a byte of a text is in.
fn line_of(text: &[u8], byte: usize) -> Place {
    let before = &text[..byte.min(text.len())];
    Place::Line(1 + before.iter().filter(|&&b| b == b'\n').count() as u64)
}
