//! What casts shadow.

use ombra_geometry::{Point3, TriangleMesh};

/// A flat convex polygon of three or four corners that casts shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet {
    /// Local metres, counter-clockwise as seen from outside. A triangle repeats its last corner.
    pub corners: [Point3; 4],
    /// Whether both sides cast shadow: it is no part of a closed solid.
    pub is_two_sided: bool,
    /// The building that it belongs to, by its place in [`City::buildings`](crate::City), or
    /// [`Facet::TERRAIN`], or [`Facet::CONTEXT`].
    pub owner: u32,
}

impl Facet {
    /// The owner of what is ground and no building.
    pub const TERRAIN: u32 = u32::MAX;

    /// The owner of what is neither: added models, and what stands on the ground of a surface model.
    pub const CONTEXT: u32 = u32::MAX - 1;

    /// Whether it has three corners.
    #[must_use]
    pub fn is_triangle(&self) -> bool {
        self.corners[2] == self.corners[3]
    }

    /// All of them as triangles, for rays: of four corners two, of three one.
    #[must_use]
    pub fn mesh(facets: &[Self]) -> TriangleMesh {
        let mut positions = Vec::with_capacity(4 * facets.len());
        let mut triangles = Vec::with_capacity(2 * facets.len());
        for facet in facets {
            let first = positions.len() as u32;
            positions.extend(facet.corners);
            triangles.push([first, first + 1, first + 2]);
            if !facet.is_triangle() {
                triangles.push([first, first + 2, first + 3]);
            }
        }
        TriangleMesh::new(positions, triangles).expect("corners are counted as they come")
    }
}
