//! New boxes and new corners for triangles that moved, in a tree that stays as it is.

use ombra_geometry::{Aabb, TriangleMesh};

use super::build::item::Item;
use super::kernel::Near;
use super::node::{Child, Node};
use super::quad::Quad;
use super::{Body, Leaves, Wide};
use crate::Reach;

impl Wide {
    /// Whether leaves hold triangles as they are.
    pub(crate) const fn can_be_refitted(&self) -> bool {
        matches!(self.body, Body::Full(_, Leaves::Quads(_)))
    }

    /// Takes over the positions of a mesh with the same triangles; no if leaves do not hold them, or not as
    /// they are.
    ///
    /// Where space was cut, boxes of parts become boxes of whole triangles.
    pub(crate) fn refit(&mut self, mesh: &TriangleMesh, reach: &Reach) -> bool {
        let Body::Full(tree, Leaves::Quads(quads)) = &mut self.body else {
            return false;
        };
        let (root, nodes, quads) = (tree.root, tree.nodes.to_mut(), quads.to_mut());
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

/// A triangle that moved, and the box that it had.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moved {
    pub(crate) triangle: u32,
    pub(crate) was: Aabb,
}

impl Wide {
    /// The same where only some triangles moved, in the order of their numbers: what is not on the way
    /// to them is not looked at.
    pub(crate) fn refit_some(
        &mut self,
        mesh: &TriangleMesh,
        moved: &[Moved],
        reach: &Reach,
    ) -> bool {
        let Body::Full(tree, Leaves::Quads(quads)) = &mut self.body else {
            return false;
        };
        let (root, nodes, quads) = (tree.root, tree.nodes.to_mut(), quads.to_mut());
        renew(root, nodes, quads, mesh, moved);
        self.near = Near::new(reach);
        true
    }
}

/// Renews what lies below on the way to triangles that moved, and says what box there is now; `None` if
/// nothing changed. As deep as the tree.
fn renew(
    child: Child,
    nodes: &mut [Node],
    quads: &mut [Quad],
    mesh: &TriangleMesh,
    moved: &[Moved],
) -> Option<Aabb> {
    if child.is_leaf() {
        let triangles = Quad::triangles(&quads[child.quad()..child.quad() + child.places() / 4]);
        let is_moved = |triangle: &u32| {
            let found = moved.binary_search_by_key(triangle, |moved| moved.triangle);
            found.is_ok()
        };
        return triangles
            .iter()
            .any(is_moved)
            .then(|| lay(child, quads, mesh));
    }
    let mut node = nodes[child.index()];
    let mut changed = false;
    for k in 0..node.child.len() {
        let bounds = node.bounds(k);
        if bounds.is_empty() {
            continue;
        }
        // A part of a triangle lies in a box that has a point in common with that of the whole.
        let here: Vec<Moved> = (moved.iter())
            .filter(|moved| !moved.was.intersection(bounds).is_empty())
            .copied()
            .collect();
        if here.is_empty() {
            continue;
        }
        let below = node.child[k];
        if let Some(bounds) = renew(below, nodes, quads, mesh, &here) {
            node.set(k, &bounds, below);
            changed = true;
        }
    }
    changed.then(|| {
        node.sort();
        nodes[child.index()] = node;
        around(&node)
    })
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
