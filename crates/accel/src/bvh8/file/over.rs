//! A tree out of a file over the mesh that it was built over.

use ombra_geometry::TriangleMesh;

use super::super::node::Child;
use super::super::places::{Places, places};
use super::super::{Body, Leaves, Wide};

/// Why a mesh is not the one that a structure out of a file was built over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OtherMesh {
    /// Hits would be others.
    #[error("the mesh is not tested by the watertight test, as a structure out of a file is")]
    Test,
    /// More or fewer triangles.
    #[error("the mesh has {mesh} triangles, but that of the structure had {structure}")]
    Count {
        /// How many the mesh has.
        mesh: usize,
        /// How many there were.
        structure: usize,
    },
    /// A triangle that has moved.
    #[error("triangle {0} is not where it was when the structure was built")]
    Triangle(u32),
}

impl Wide {
    /// Shows triangles by number from here on, if they are those of a mesh with as many of them.
    pub(crate) fn over(&mut self, mesh: &TriangleMesh, from: &Places) -> Result<(), OtherMesh> {
        let mut named = vec![false; mesh.triangles().len()];
        let Body::Full(tree, in_leaves) = &mut self.body else {
            unreachable!("a tree out of a file has all its numbers");
        };
        let children = tree.nodes.iter().flat_map(|node| &node.child);
        let leaves = children.chain([&tree.root]);
        for &leaf in leaves.filter(|child: &&Child| child.is_leaf()) {
            for place in places(leaf) {
                let number = from.number(place);
                if number == u32::MAX {
                    continue;
                }
                if mesh.corners(number as usize) != from.corners(place) {
                    return Err(OtherMesh::Triangle(number));
                }
                named[number as usize] = true;
            }
        }
        // Those are in the tree that have a box.
        let wrong = named
            .iter()
            .enumerate()
            .find(|&(triangle, &named)| named == mesh.triangle_bounds(triangle).is_empty());
        if let Some((triangle, _)) = wrong {
            return Err(OtherMesh::Triangle(triangle as u32));
        }
        *in_leaves = Leaves::Quads(from.quads.clone());
        Ok(())
    }
}
