//! The tree that builders make: nodes, and leaves that name lists of primitives.

use super::kernel::{Tree, stack};
use super::node::{Child, Node};
use super::store::Store;

/// A wide tree.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WideTree<N = Vec<Node>> {
    pub(crate) root: Child,
    pub(crate) nodes: N,
    /// How many levels of nodes there are.
    pub(crate) depth: usize,
}

impl WideTree {
    /// Over no primitives.
    pub(crate) fn nothing() -> Self {
        let mut node = Node::EMPTY;
        node.sort();
        Self {
            root: Child::node(0),
            nodes: vec![node],
            depth: 1,
        }
    }

    /// As it is traced.
    pub(crate) fn stored(self) -> WideTree<Store<Node>> {
        WideTree {
            root: self.root,
            nodes: self.nodes.into(),
            depth: self.depth,
        }
    }
}

impl<N> WideTree<N> {
    /// For the kernels.
    #[inline(always)]
    pub(super) const fn laid<Y: Copy>(&self, layout: Y) -> Tree<Y> {
        Tree {
            root: self.root,
            layout,
            stack: stack(self.depth),
        }
    }
}
