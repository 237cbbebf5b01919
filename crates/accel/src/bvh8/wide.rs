//! The tree that builders make: nodes, and leaves that name lists of primitives.

use super::node::{Child, Node};

/// A wide tree.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WideTree {
    pub(crate) root: Child,
    pub(crate) nodes: Vec<Node>,
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
}
