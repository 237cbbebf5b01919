//! The finished tree: one flat array.

use ombra_geometry::{Aabb, Point3};

use super::build::{BinaryNode, BinaryTree};

/// A node, to the byte:
///
/// | bytes  | inner node                          | leaf                             |
/// |--------|-------------------------------------|----------------------------------|
/// | 0..12  | `min`: smallest corner, x y z       | the same                         |
/// | 12..16 | `first`: where its two children are | `first`: its first primitive     |
/// | 16..28 | `max`: largest corner, x y z        | the same                         |
/// | 28..32 | `count`: 0                          | `count`: how many primitives, ≥ 1 |
///
/// Each corner and the number behind it make one 16-byte vector.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub(super) struct Node {
    pub(super) min: [f32; 3],
    /// An index into `Layout::siblings`, or, of a leaf, into `Layout::primitives`.
    pub(super) first: u32,
    pub(super) max: [f32; 3],
    pub(super) count: u32,
}

/// The two children of a node: always wanted together, so they share a cache line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Siblings(pub(super) [Node; 2]);

const _: () = assert!(size_of::<Node>() == 32);
const _: () = assert!(size_of::<Siblings>() == 64);

/// The finished tree, in depth-first order.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Layout {
    /// `None` if there are no primitives.
    pub(super) root: Option<Node>,
    pub(super) siblings: Vec<Siblings>,
    /// The primitives of each leaf next to each other.
    pub(super) primitives: Vec<u32>,
}

impl Layout {
    /// Lays out a binary tree, cut off at its leaves.
    pub(super) fn new(tree: BinaryTree, is_leaf: &[bool]) -> Self {
        let inner = is_leaf.iter().filter(|&&leaf| !leaf).count();
        let mut siblings = Vec::with_capacity(inner);
        let root = (!tree.nodes.is_empty()).then(|| lay(&tree, is_leaf, 0, &mut siblings));
        siblings.shrink_to_fit();
        Self {
            root,
            siblings,
            primitives: tree.primitives,
        }
    }

    /// Bytes held on the heap.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.siblings.as_slice()) + size_of_val(self.primitives.as_slice())
    }
}

/// Lays out what is below a node and says what to write for the node itself.
fn lay(tree: &BinaryTree, is_leaf: &[bool], index: usize, siblings: &mut Vec<Siblings>) -> Node {
    let node = &tree.nodes[index];
    if is_leaf[index] {
        return Node::new(node, node.first, node.count);
    }
    let place = siblings.len();
    let unset = Node::new(node, 0, 0);
    siblings.push(Siblings([unset; 2]));
    let children = tree.children(index);
    siblings[place] = Siblings(children.map(|child| lay(tree, is_leaf, child, siblings)));
    Node::new(node, place as u32, 0)
}

impl Node {
    fn new(node: &BinaryNode, first: u32, count: u32) -> Self {
        Self {
            min: node.bounds.min.to_array(),
            first,
            max: node.bounds.max.to_array(),
            count,
        }
    }

    /// Its box.
    pub(super) fn bounds(&self) -> Aabb {
        Aabb {
            min: Point3::from(self.min),
            max: Point3::from(self.max),
        }
    }

    /// Whether it holds primitives.
    #[inline]
    pub(super) const fn is_leaf(&self) -> bool {
        self.count > 0
    }
}
