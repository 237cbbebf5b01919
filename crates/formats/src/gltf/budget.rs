//! How much a document may make of what is in it.
//!
//! A few bytes can name the same megabyte again and again: primitives whose accessors overlap, nodes
//! that all place a mesh of many primitives. So that memory follows what is really there, the
//! triangles and the objects of a file are bounded by its bytes, buffers included. Files that are not
//! made to harm are far below: a triangle takes three bytes of indices at least, and a node ten.

/// What is allowed whatever the size.
const ALWAYS: u64 = 1 << 18;

/// What a document may make.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    /// Triangles of all geometries.
    pub(super) triangles: u64,
    /// Placements of meshes and, for each, the primitives of the mesh; those that come to nothing
    /// count too, since they take time.
    pub(super) objects: u64,
}

impl Budget {
    /// Of a file of so many bytes, the files of its buffers included.
    pub(super) fn of(bytes: u64) -> Self {
        let most = bytes.max(ALWAYS);
        Self {
            triangles: most,
            objects: most,
        }
    }
}
