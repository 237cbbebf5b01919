//! Scene files: a camera, materials, lights and objects, written in TOML.
//!
//! The words are in `description.rs`, one page on them is `docs/scene-file.md`, and the files of the
//! folder `scenes` are examples.

mod assets;
mod build;
mod description;
mod shapes;

use std::path::Path;

use ombra_geometry::triangle::TriangleTest;
use ombra_scene::Scene;

use crate::error::{Fault, FormatError, Place, one_line};
use crate::finding::Finding;
use crate::limits::Limits;

pub use assets::Assets;

/// What a scene file holds.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// The scene.
    pub scene: Scene,
    /// What the scene wants to be rendered like.
    pub picture: Picture,
    /// What its user should hear of.
    pub findings: Vec<Finding>,
}

/// What a scene wants to be rendered like, unless somebody says otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Picture {
    /// Width and height in pixels.
    pub size: Option<[u32; 2]>,
    /// Samples a pixel.
    pub spp: Option<u32>,
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
    let cannot = |source| {
        FormatError::file(Fault::Io {
            action: "be read",
            source,
        })
        .in_file(path)
    };
    let size = std::fs::metadata(path).map_err(cannot)?.len();
    if size > MOST_BYTES {
        let fault = Fault::TooLarge {
            what: "scene file",
            limit: MOST_BYTES,
        };
        return Err(FormatError::file(fault).in_file(path));
    }
    let text = std::fs::read_to_string(path).map_err(cannot)?;
    let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
    parse_scene(&text, &Assets::Folder(folder), test, limits).map_err(|e| e.in_file(path))
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
            .map_or(Place::File, |span| line_of(text, span.start));
        FormatError::new(place, Fault::Description(one_line(error.message())))
    })?;
    build::build(description, text, assets, test, limits)
}

/// The line, from 1, that a byte of a text is in.
fn line_of(text: &str, byte: usize) -> Place {
    let before = &text.as_bytes()[..byte.min(text.len())];
    Place::Line(1 + before.iter().filter(|&&b| b == b'\n').count() as u64)
}
