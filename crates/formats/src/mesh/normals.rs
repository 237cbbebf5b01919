//! Normals for meshes that come without.

use ombra_geometry::mesh::smooth_normals;
use ombra_geometry::{Angle, TriangleMesh};

use crate::error::FormatError;

/// Where two triangles of a mesh without normals meet at less than this, the edge looks smooth.
const CREASE: Angle = Angle::from_degrees(35.0);

/// The same mesh with normals, if it has none: smooth where its triangles meet at less than 35°.
///
/// # Errors
/// When splitting vertices at sharp edges gives more of them than a mesh can index.
pub fn with_normals(mesh: TriangleMesh) -> Result<TriangleMesh, FormatError> {
    match mesh.normals() {
        Some(_) => Ok(mesh),
        None => smooth_normals(&mesh, CREASE).map_err(FormatError::file),
    }
}
