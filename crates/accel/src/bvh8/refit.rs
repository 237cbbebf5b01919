//! New boxes and new corners for triangles that moved, in a tree that stays as it is.

use ombra_geometry::{Aabb, TriangleMesh};

use super::build::item::Item;
use super::kernel::Near;
use super::node::{Child, Node};
use super::quad::Quad;
use super::{Leaves, Wide};
use crate::Reach;

impl Wide {
    /// Takes over the positions of a mesh with the same triangles; no if there are none in the leaves.
    ///
    /// Where space was cut, boxes of parts become boxes of whole triangles.
    pub(crate) fn refit(&mut self, mesh: &TriangleMesh, reach: &Reach) -> bool {
        let Leaves::Quads(quads) = &mut self.leaves else {
            return false;
        };
        let (root, nodes, quads) = (self.tree.root, self.tree.nodes.to_mut(), quads.to_mut());
        if root.is_leaf() {
            lay(root, quads, mesh);
        }
        // What is below a node comes after it.
        for index in (0..nodes.len()).rev() {
            let mut node = nodes[index];
            for k in 0..node.child.len() {
                if node.bounds(k).is_empty() {
                    continue;
                }
                let child = node.child[k];
                let bounds = if child.is_leaf() {
                    lay(child, quads, mesh)
                } else {
                    around(&nodes[child.index()])
                };
                node.set(k, &bounds, child);
            }
            node.sort();
            nodes[index] = node;
        }
        self.near = Near::new(reach);
        true
    }
}

/// The box around all children.
fn around(node: &Node) -> Aabb {
    let children = node.children();
    children.fold(Aabb::EMPTY, |all, (bounds, _)| all.union(bounds))
}

/// Rewrites the quads of a leaf, and says what box it has now.
fn lay(leaf: Child, quads: &mut [Quad], mesh: &TriangleMesh) -> Aabb {
    let quads = &mut quads[leaf.quad()..leaf.quad() + leaf.places() / 4];
    let triangles = Quad::triangles(quads);
    let mut bounds = Item::EMPTY;
    for &triangle in &triangles {
        bounds.add(&Item::new(&mesh.triangle_bounds(triangle as usize), 0));
    }
    Quad::lay(quads, mesh, &triangles);
    bounds.bounds()
}
