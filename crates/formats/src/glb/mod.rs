//! Models of our own making as binary glTF 2.0, for any viewer.

mod write;

/// A model: coloured meshes with names. y is up, as glTF has it, unless `up` says otherwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GlbModel {
    /// What meshes are made of.
    pub materials: Vec<GlbMaterial>,
    /// The meshes, each a node of its own.
    pub meshes: Vec<GlbMesh>,
    /// Which way is up in the coordinates of the meshes, of any length; none is y.
    pub up: Option<[f32; 3]>,
}

/// A colour with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct GlbMaterial {
    /// For people.
    pub name: String,
    /// Linear red, green, blue and opacity, each 0 to 1; what is outside is clipped.
    pub colour: [f32; 4],
    /// Linear light of its own, 0 to 1; what is outside is clipped.
    pub emission: [f32; 3],
}

/// Triangles of one material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GlbMesh {
    /// For people.
    pub name: String,
    /// The vertices; finite.
    pub positions: Vec<[f32; 3]>,
    /// Triangles as indices of vertices. They are seen from both sides.
    pub triangles: Vec<[u32; 3]>,
    /// Which material.
    pub material: usize,
}
