//! What a document holds, in numbers.

use serde::Serialize;

use crate::finding::Finding;
use crate::info::MaterialInfo;

/// What a glTF file holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct GltfInfo {
    /// "glTF" or "GLB".
    pub format: &'static str,
    /// Which version of glTF it says that it is.
    pub version: String,
    /// What wrote it, if it says.
    pub generator: Option<String>,
    /// How many nodes there are.
    pub nodes: u64,
    /// How many meshes there are.
    pub meshes: u64,
    /// How many objects the scene that is shown has: primitives of meshes, wherever nodes place them.
    pub objects: u64,
    /// How many vertices the triangles of the scene use, those of a mesh that is placed often once.
    pub vertices: u64,
    /// How many triangles the meshes of the scene have, each mesh once.
    pub triangles: u64,
    /// How many triangles rays can meet: those of a mesh once for each place where it stands.
    pub placed_triangles: u64,
    /// The materials that the scene uses.
    pub materials: Vec<MaterialInfo>,
    /// How many textures there are.
    pub textures: u64,
    /// How many images there are.
    pub images: u64,
    /// How many cameras the scene has.
    pub cameras: u64,
    /// How many lights the scene has, those made at what shines not counted.
    pub lights: u64,
    /// How many animations there are; they are not used.
    pub animations: u64,
    /// How many skins there are; they are not used.
    pub skins: u64,
    /// The smallest and the largest corner of the box around the scene, if it has triangles.
    pub bounds: Option<[[f32; 3]; 2]>,
    /// What its user should hear of.
    pub findings: Vec<Finding>,
}
