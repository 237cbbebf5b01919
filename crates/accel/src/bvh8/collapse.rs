//! From two children a node to eight.

use super::build::BinaryTree;
use super::node::{Child, Node, WIDTH};
use super::store::Store;

/// A wide tree whose leaves name lists of primitives.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WideTree<N = Vec<Node>> {
    pub(crate) root: Child,
    pub(crate) nodes: N,
    /// How many levels of nodes there are.
    pub(crate) depth: usize,
}

impl WideTree {
    /// As it is traced.
    pub(crate) fn stored(self) -> WideTree<Store<Node>> {
        WideTree {
            root: self.root,
            nodes: self.nodes.into(),
            depth: self.depth,
        }
    }
}

/// Collapses a binary tree: a node takes in its children, then again and again the children of that
/// one with the largest surface, until it has eight. Wald, Benthin, Boulos, "Getting Rid of Packets",
/// IEEE Symposium on Interactive Ray Tracing 2008.
pub(crate) fn collapse(binary: &BinaryTree) -> WideTree {
    let mut nodes = Vec::with_capacity(binary.nodes.len() / 8 + 1);
    let mut depth = 1;
    let root = match binary.nodes.first() {
        None => {
            nodes.push(Node::EMPTY);
            Child::node(0)
        }
        Some(_) => lay(binary, 0, 0, &mut nodes, &mut depth),
    };
    WideTree { root, nodes, depth }
}

/// Lays out what is below a node of the binary tree.
fn lay(
    binary: &BinaryTree,
    index: usize,
    above: usize,
    nodes: &mut Vec<Node>,
    depth: &mut usize,
) -> Child {
    let node = &binary.nodes[index];
    if node.is_leaf() {
        return Child::list(node.first_or_right as usize, node.count as usize);
    }
    *depth = (above + 1).max(*depth);
    let mut below = [0; WIDTH];
    [below[0], below[1]] = binary.children(index);
    let mut count = 2;
    while count < WIDTH {
        let opened = (0..count)
            .filter(|&k| !binary.nodes[below[k]].is_leaf())
            .map(|k| (binary.nodes[below[k]].bounds.half_area(), k))
            .reduce(|a, b| if b.0 > a.0 { b } else { a });
        let Some((_, k)) = opened else { break };
        [below[k], below[count]] = binary.children(below[k]);
        count += 1;
    }
    let place = nodes.len();
    nodes.push(Node::EMPTY);
    for (k, &child) in below[..count].iter().enumerate() {
        let what = lay(binary, child, above + 1, nodes, depth);
        nodes[place].set(k, &binary.nodes[child].bounds, what);
    }
    nodes[place].sort();
    Child::node(place)
}
