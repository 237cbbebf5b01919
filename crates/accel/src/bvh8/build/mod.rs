//! The binary tree that the wide one is made of.

pub(crate) mod binned;
pub(crate) mod item;

use ombra_geometry::Aabb;

/// A binary tree whose leaves hold up to eight primitives each, in depth-first order: the left child
/// of node i is node i + 1.
#[derive(Clone, Debug, Default)]
pub(crate) struct BinaryTree {
    pub(crate) nodes: Vec<BinaryNode>,
}

/// A node of the binary tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BinaryNode {
    pub(crate) bounds: Aabb,
    /// Of a leaf: the first of its primitives in the list. Otherwise the right child.
    pub(crate) first_or_right: u32,
    /// Of a leaf: how many. Otherwise 0.
    pub(crate) count: u32,
}

impl BinaryNode {
    pub(crate) const fn is_leaf(&self) -> bool {
        self.count > 0
    }
}

impl BinaryTree {
    /// The children of an inner node.
    pub(crate) fn children(&self, node: usize) -> [usize; 2] {
        [node + 1, self.nodes[node].first_or_right as usize]
    }
}
