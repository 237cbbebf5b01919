//! glTF 2.0 and its binary form GLB: Khronos Group, "glTF 2.0 Specification", 2.0.1, 2021.
//!
//! A document is a scene: meshes that nodes place, cameras, lights, materials. What of it is used,
//! and how its materials become Whitted's, is on the page `docs/gltf.md`. On the way in:
//!
//! - `container.rs` takes a GLB file apart, `document.rs` and `surface.rs` are the JSON as types,
//!   `extension.rs` knows which extensions are read;
//! - `uri.rs`, `buffer.rs`, `accessor.rs`, `mode.rs` and `primitive.rs` go from bytes to triangles,
//!   within the bounds of `budget.rs`;
//! - `node.rs` and `instancing.rs` place them;
//! - `texture.rs`, `material.rs` and `phong.rs` say what they are made of;
//! - `camera.rs`, `light.rs`, `emitter.rs` and `metering.rs` are about what sees and what shines;
//! - `build.rs` puts the scene together.

mod accessor;
mod budget;
mod buffer;
mod build;
mod camera;
mod container;
mod document;
mod emitter;
mod extension;
mod info;
mod instancing;
mod light;
mod material;
mod metering;
mod mode;
mod node;
mod notes;
mod phong;
mod primitive;
mod surface;
mod texture;
mod uri;

use std::path::{Path, PathBuf};

use ombra_geometry::triangle::TriangleTest;
use ombra_scene::Scene;

use crate::error::{Fault, FormatError};
use crate::finding::Finding;
use crate::input::Input;
use crate::limits::Limits;
use crate::mesh::ending;
use crate::scene::Picture;

pub use info::GltfInfo;

/// What a glTF file holds.
#[derive(Clone, Debug)]
pub struct GltfFile {
    /// The scene. It has a camera only if the file does, and lights if the file has any or something
    /// in it shines.
    pub scene: Scene,
    /// What the file's camera wants its picture to be like.
    pub picture: Picture,
    /// What its user should hear of.
    pub findings: Vec<Finding>,
    /// The files that were read, its own first; none for a document in memory.
    pub files: Vec<PathBuf>,
    /// What the document holds.
    pub info: GltfInfo,
}

/// Where the files are that a document names.
#[derive(Clone, Copy, Debug)]
enum Folder<'a> {
    /// In this folder or below it. Nothing outside of it is opened.
    Open(&'a Path),
    /// Nowhere: no file is opened.
    None,
}

/// Whether a file's name says that it is glTF.
pub(crate) fn is_named(path: &Path) -> bool {
    matches!(ending(path).as_str(), "gltf" | "glb")
}

/// Reads a glTF or GLB file (also in gzip) with the buffers and pictures that it names, which must
/// lie in its folder or below it.
///
/// # Errors
/// When a file cannot be read or is broken; the error names the file, the place in the document, what
/// is wrong and what would be right. What can be passed over is, and is listed in
/// [`GltfFile::findings`].
pub fn read_gltf(
    path: impl AsRef<Path>,
    test: TriangleTest,
    limits: &Limits,
) -> Result<GltfFile, FormatError> {
    read_input(&Input::on_disk(path.as_ref()), test, limits)
}

pub(crate) fn read_input(
    input: &Input<'_>,
    test: TriangleTest,
    limits: &Limits,
) -> Result<GltfFile, FormatError> {
    let name = input.name();
    let folder = match input.is_in_memory() {
        true => Folder::None,
        false => Folder::Open(name.parent().unwrap_or(Path::new(""))),
    };
    let read = || {
        let bytes = input.source(limits)?.rest()?;
        read(&bytes, ending(name) == "glb", folder, test, limits)
    };
    let mut file = read().map_err(|error| error.in_file(name))?;
    file.files.insert(0, name.to_owned());
    Ok(file)
}

/// Reads a document that is in memory: the bytes of a GLB file, or the text of a glTF file. It opens
/// no files: buffers must be in it, and pictures that are not are left out.
///
/// # Errors
/// As those of [`read_gltf`].
pub fn parse_gltf(
    bytes: &[u8],
    test: TriangleTest,
    limits: &Limits,
) -> Result<GltfFile, FormatError> {
    read(bytes, false, Folder::None, test, limits)
}

fn read(
    bytes: &[u8],
    named_glb: bool,
    folder: Folder<'_>,
    test: TriangleTest,
    limits: &Limits,
) -> Result<GltfFile, FormatError> {
    let mut findings = Vec::new();
    let parts = container::parts(bytes, named_glb, &mut findings)?;
    let document = document::parse(parts.json)?;
    let mut file = build::build(&document, &parts, folder, test, limits)?;
    file.findings.splice(0..0, findings);
    file.info.findings.clone_from(&file.findings);
    Ok(file)
}

/// An error at a place in the document.
fn wrong(place: impl Into<String>, message: impl Into<String>) -> FormatError {
    FormatError::file(Fault::InDocument {
        place: place.into(),
        message: message.into(),
    })
}
