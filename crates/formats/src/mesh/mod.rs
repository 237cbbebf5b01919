//! Models: triangle meshes with materials, out of OBJ, PLY and STL files.

pub(crate) mod finish;
mod mtl;
mod normals;
mod obj;
mod ply;
mod polygon;
mod reference;
mod stl;

use std::path::{Path, PathBuf};

use ombra_geometry::{Aabb, TriangleMesh};
use ombra_scene::Material;
use serde::Serialize;

use crate::error::{Fault, FormatError};
use crate::finding::Finding;
use crate::input::{Assets, Input};
use crate::limits::Limits;
use crate::source::Source;

pub use normals::with_normals;
pub(crate) use polygon::MOST_CLIPPED_CORNERS;
pub(crate) use reference::resolve;

/// What a model file holds.
#[derive(Clone, Debug)]
pub struct Model {
    /// How it was written.
    pub format: ModelFormat,
    /// The meshes, one a material that is used, in the order of first use.
    pub parts: Vec<Part>,
    /// The materials that the parts use.
    pub materials: Vec<Material>,
    /// What its user should hear of.
    pub findings: Vec<Finding>,
    /// The files that were read for it, its own first.
    pub files: Vec<PathBuf>,
    /// How many vertices the file defines. The parts have more where normals or texture
    /// coordinates split them, and fewer where no triangle uses them.
    pub vertices: u64,
    /// How many triangles were left out because their area is zero.
    pub degenerate_triangles: u64,
}

/// The part of a model that has one material.
#[derive(Clone, Debug)]
pub struct Part {
    /// The material's name.
    pub name: String,
    /// The triangles. Has normals only if the file gives them, by normals or smoothing groups;
    /// see [`with_normals`] for those that do not.
    pub mesh: TriangleMesh,
    /// Which of the model's materials it has.
    pub material: usize,
}

/// How a model is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum ModelFormat {
    /// Wavefront OBJ.
    Obj,
    /// PLY as text.
    PlyAscii,
    /// PLY, binary, little endian.
    PlyLittleEndian,
    /// PLY, binary, big endian.
    PlyBigEndian,
    /// STL as text.
    StlAscii,
    /// STL, binary.
    StlBinary,
}

impl ModelFormat {
    /// Whether it is STL, which is z up by custom.
    #[must_use]
    pub const fn is_stl(self) -> bool {
        matches!(self, Self::StlAscii | Self::StlBinary)
    }

    /// Its name, such as "PLY (binary, little endian)".
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Obj => "OBJ",
            Self::PlyAscii => "PLY (ASCII)",
            Self::PlyLittleEndian => "PLY (binary, little endian)",
            Self::PlyBigEndian => "PLY (binary, big endian)",
            Self::StlAscii => "STL (ASCII)",
            Self::StlBinary => "STL (binary)",
        }
    }
}

impl Model {
    /// The box around all triangles.
    #[must_use]
    pub fn bounds(&self) -> Aabb {
        let parts = self.parts.iter().map(|p| p.mesh.bounds());
        parts.fold(Aabb::EMPTY, Aabb::union)
    }

    /// How many triangles there are.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.parts.iter().map(|p| p.mesh.triangles().len()).sum()
    }

    /// A model of one part with the default material.
    fn of_one_part(
        format: ModelFormat,
        raw: finish::Raw,
        mut findings: Vec<Finding>,
    ) -> Result<Self, FormatError> {
        let vertices = raw.positions.len() as u64;
        let (mesh, mended) = finish::finish(raw)?;
        mended.report(&mut findings);
        let material = Material::default();
        let mut parts = Vec::new();
        if mesh.triangles().is_empty() {
            findings.push(Finding::NoTriangles);
        } else {
            parts.push(Part {
                name: material.name.clone(),
                mesh,
                material: 0,
            });
        }
        Ok(Self {
            format,
            parts,
            materials: vec![material],
            findings,
            files: Vec::new(),
            vertices,
            degenerate_triangles: mended.degenerate,
        })
    }
}

/// Reads an OBJ file (with the materials files and textures that it names), a PLY or an STL file,
/// each plain or in gzip.
///
/// The content decides where it can: PLY files begin with "ply". Otherwise the ending does. No file
/// outside the model's own folder is opened.
///
/// # Errors
/// When the file cannot be opened, is not what its ending says, or is broken; the error names the
/// file, the place, what is wrong and what would be right. What can be passed over is, and is
/// listed in [`Model::findings`].
pub fn read_model(path: impl AsRef<Path>, limits: &Limits) -> Result<Model, FormatError> {
    let path = path.as_ref();
    read(&Input::on_disk(path), &Assets::beside(path), limits)
}

/// Reads a model that is in memory, with `assets` to find the files that it names; the ending of
/// `name` says what it is, as in [`read_model`].
///
/// # Errors
/// As those of [`read_model`].
pub fn read_model_bytes(
    name: impl AsRef<Path>,
    bytes: &[u8],
    assets: &Assets<'_>,
    limits: &Limits,
) -> Result<Model, FormatError> {
    read(&Input::in_memory(name.as_ref(), bytes), assets, limits)
}

pub(crate) fn read(
    input: &Input<'_>,
    assets: &Assets<'_>,
    limits: &Limits,
) -> Result<Model, FormatError> {
    let mut model = (input.source(limits))
        .and_then(|source| read_source(source, input.name(), assets, limits))
        .map_err(|e| e.in_file(input.name()))?;
    model.files.insert(0, input.name().to_owned());
    Ok(model)
}

fn read_source(
    mut source: Source<'_>,
    path: &Path,
    assets: &Assets<'_>,
    limits: &Limits,
) -> Result<Model, FormatError> {
    if source.peek(1)?.is_empty() {
        return Err(FormatError::file(Fault::Empty));
    }
    if ply::begins(&mut source)? {
        return ply::read(&mut source);
    }
    match ending(path).as_str() {
        "obj" => obj::read(&mut source, assets, limits),
        "ply" => ply::read(&mut source),
        "stl" => stl::read(&mut source),
        "gltf" | "glb" => Err(FormatError::file(Fault::Unexpected {
            found: "a glTF file".to_owned(),
            expected: "a model alone (glTF is a scene, which read_gltf reads)",
        })),
        _ => Err(FormatError::file(Fault::UnknownContent {
            known: "models with the ending obj, ply, stl, gltf or glb (each also with .gz)",
        })),
    }
}

/// The ending of a model's name in small letters, that before ".gz" if there is such.
pub(crate) fn ending(path: &Path) -> String {
    let ending_of = |path: &Path| {
        let ending = path.extension().unwrap_or_default();
        ending.to_string_lossy().to_ascii_lowercase()
    };
    match ending_of(path).as_str() {
        "gz" => ending_of(&path.with_extension("")),
        ending => ending.to_owned(),
    }
}
