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
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GlbMaterial {
    /// For people.
    pub name: String,
    /// Linear red, green, blue and opacity, each 0 to 1; what is outside is clipped.
    pub colour: [f32; 4],
    /// Linear light of its own, 0 to 1; what is outside is clipped.
    pub emission: [f32; 3],
    /// What the colour is multiplied by, place by place.
    pub texture: Option<GlbTexture>,
    /// Whether it shows its colour as it is, in whatever light (`KHR_materials_unlit`).
    pub is_unlit: bool,
}

/// A picture on a surface; its pixels are told apart (the nearest one counts), and it does not repeat.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GlbTexture {
    /// Pixels in a row.
    pub width: u32,
    /// Red, green and blue (sRGB), row by row from the top; whole rows.
    pub pixels: Vec<[u8; 3]>,
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
    /// Where vertices lie on the texture, from its upper left corner (0, 0) to its lower right one (1, 1): one each,
    /// or none at all.
    pub texcoords: Vec<[f32; 2]>,
    /// Which material.
    pub material: usize,
}
