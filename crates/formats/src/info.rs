//! What a file holds.

use std::path::Path;

use ombra_accel::Primitives as _;
use ombra_geometry::triangle::TriangleTest;
use ombra_scene::{Material, Object};
use serde::Serialize;

use crate::city::{CityInfo, city_info, is_city};
use crate::elevation::{ElevationInfo, elevation_info, is_tiff};
use crate::error::{Fault, FormatError};
use crate::finding::Finding;
use crate::gltf::{self, GltfInfo};
use crate::image::{ImageInfo, image_info};
use crate::input::Input;
use crate::limits::Limits;
use crate::mesh::{Model, ModelFormat, ending, read_model};
use crate::scene::{SceneFile, read_scene};

/// What a file holds.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum FileInfo {
    /// A model.
    Model(ModelInfo),
    /// A picture.
    Image(ImageInfo),
    /// A scene file.
    Scene(SceneInfo),
    /// A glTF or GLB file.
    Gltf(GltfInfo),
    /// A city.
    City(CityInfo),
    /// A surface or terrain model.
    Elevation(ElevationInfo),
}

/// What a model holds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModelInfo {
    /// How it is written.
    pub format: ModelFormat,
    /// How many vertices the file defines.
    pub vertices: u64,
    /// How many triangles it has, polygons cut and those without area left out.
    pub triangles: u64,
    /// How many triangles have no area.
    pub degenerate_triangles: u64,
    /// Whether every part has normals.
    pub normals: bool,
    /// Whether every part has texture coordinates.
    pub uvs: bool,
    /// The smallest and the largest corner of the box around its triangles, if it has any.
    pub bounds: Option<[[f32; 3]; 2]>,
    /// Its materials.
    pub materials: Vec<MaterialInfo>,
    /// What its user should hear of.
    pub findings: Vec<Finding>,
}

/// What a scene file holds, the models that it refers to included.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneInfo {
    /// How many objects there are.
    pub objects: u64,
    /// How many triangles and other shapes the objects have.
    pub primitives: u64,
    /// How many materials there are.
    pub materials: u64,
    /// How many lights there are.
    pub lights: u64,
    /// Whether the file says where the camera is.
    pub camera: bool,
    /// What its user should hear of.
    pub findings: Vec<Finding>,
}

/// One material of a model.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MaterialInfo {
    /// Its name.
    pub name: String,
    /// "diffuse", "textured", "phong", "mirror", "glass" or "light".
    pub kind: &'static str,
    /// How many triangles have it.
    pub triangles: u64,
}

/// Reads what a file holds. Models, scenes and cities are read as a whole, pictures by their headers.
///
/// # Errors
/// As those of [`read_model`], and when the file is of no known kind.
pub fn inspect(path: impl AsRef<Path>) -> Result<FileInfo, FormatError> {
    let path = path.as_ref();
    let length = std::fs::metadata(path).map_err(|source| {
        let action = "be opened";
        FormatError::file(Fault::Io { action, source }).in_file(path)
    })?;
    if length.is_file() && length.len() == 0 {
        return Err(FormatError::file(Fault::Empty).in_file(path));
    }
    if matches!(ending(path).as_str(), "obj" | "ply" | "stl") {
        let model = read_model(path, &Limits::default())?;
        return Ok(FileInfo::Model(model_info(&model)));
    }
    if gltf::is_named(path) {
        let file = gltf::read_gltf(path, TriangleTest::default(), &Limits::default())?;
        return Ok(FileInfo::Gltf(file.info));
    }
    if ending(path) == "toml" {
        let file = read_scene(path, TriangleTest::default(), &Limits::default())?;
        return Ok(FileInfo::Scene(scene_info(file)));
    }
    if begins(path, is_tiff)? {
        return Ok(FileInfo::Elevation(elevation_info(path)?));
    }
    if begins(path, is_city)? {
        return Ok(FileInfo::City(city_info(path)?));
    }
    let info = image_info(path).map_err(|e| e.in_file(path))?;
    Ok(FileInfo::Image(info))
}

/// Whether the first bytes of a file, unpacked, are of a kind.
pub(crate) fn begins(path: &Path, is_so: impl Fn(&[u8]) -> bool) -> Result<bool, FormatError> {
    const HEAD: usize = 4096;
    let peek = || -> Result<bool, FormatError> {
        let mut source = Input::on_disk(path).source(&Limits::default())?;
        Ok(is_so(source.peek(HEAD)?))
    };
    peek().map_err(|error| error.in_file(path))
}

fn model_info(model: &Model) -> ModelInfo {
    let bounds = model.bounds();
    let every =
        |has: fn(&crate::Part) -> bool| !model.parts.is_empty() && model.parts.iter().all(has);
    ModelInfo {
        format: model.format,
        vertices: model.vertices,
        triangles: model.triangles() as u64,
        degenerate_triangles: model.degenerate_triangles,
        normals: every(|p| p.mesh.normals().is_some()),
        uvs: every(|p| p.mesh.uvs().is_some()),
        bounds: (!bounds.is_empty()).then(|| [bounds.min.to_array(), bounds.max.to_array()]),
        materials: (model.parts.iter())
            .map(|part| MaterialInfo {
                name: part.name.clone(),
                kind: kind(&model.materials[part.material]),
                triangles: part.mesh.triangles().len() as u64,
            })
            .collect(),
        findings: model.findings.clone(),
    }
}

fn scene_info(file: SceneFile) -> SceneInfo {
    let scene = &file.scene;
    let primitives = |object: &Object| scene.geometries[object.geometry.index()].len() as u64;
    SceneInfo {
        objects: scene.objects.len() as u64,
        primitives: scene.objects.iter().map(primitives).sum(),
        materials: scene.materials.len() as u64,
        lights: scene.lights.len() as u64,
        camera: scene.camera.is_some(),
        findings: file.findings,
    }
}

pub(crate) fn kind(material: &Material) -> &'static str {
    if material.is_light_source() {
        "light"
    } else if !material.transmission.is_black() {
        "glass"
    } else if !material.reflection.is_black() {
        "mirror"
    } else if !material.specular.is_black() {
        "phong"
    } else if matches!(material.diffuse, ombra_scene::Texture::Picture(_)) {
        "textured"
    } else {
        "diffuse"
    }
}
