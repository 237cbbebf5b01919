//! The finished tree: one flat array.

use ombra_geometry::{Aabb, Axis, Point3};

use super::build::{BinaryNode, BinaryTree};

/// A node by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Node {
    /// Its box.
    pub(super) bounds: Aabb,
    /// An index into `Layout::siblings`, or, of a leaf, into `Layout::primitives`.
    pub(super) first: u32,
    /// How many primitives a leaf has, at least 1; otherwise 0.
    pub(super) count: u32,
}

/// The two children a and b of a node: always wanted together, so they share a cache line and are
/// tested as one. To the byte, all of it 32-bit numbers:
///
/// | bytes  | field       | holds                                          |
/// |--------|-------------|------------------------------------------------|
/// | 0..16  | `planes[0]` | x: lowest of a, lowest of b, highest of a, of b |
/// | 16..32 | `planes[1]` | the same in y                                  |
/// | 32..48 | `planes[2]` | the same in z                                  |
/// | 48..56 | `first`     | [`Node::first`] of a, of b                     |
/// | 56..64 | `count`     | [`Node::count`] of a, of b                     |
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Siblings {
    pub(super) planes: [[f32; 4]; 3],
    pub(super) first: [u32; 2],
    pub(super) count: [u32; 2],
}

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
    siblings.push(Siblings::new([unset; 2]));
    let children = tree.children(index);
    siblings[place] = Siblings::new(children.map(|child| lay(tree, is_leaf, child, siblings)));
    Node::new(node, place as u32, 0)
}

impl Node {
    fn new(node: &BinaryNode, first: u32, count: u32) -> Self {
        Self {
            bounds: node.bounds,
            first,
            count,
        }
    }

    /// Whether it holds primitives.
    pub(super) const fn is_leaf(&self) -> bool {
        self.count > 0
    }
}

impl Siblings {
    pub(super) fn new([a, b]: [Node; 2]) -> Self {
        let planes = Axis::ALL.map(|axis| {
            let (a, b) = (a.bounds, b.bounds);
            [a.min[axis], b.min[axis], a.max[axis], b.max[axis]]
        });
        Self {
            planes,
            first: [a.first, b.first],
            count: [a.count, b.count],
        }
    }

    /// The two, each by itself.
    pub(super) fn nodes(&self) -> [Node; 2] {
        [0, 1].map(|child| Node {
            bounds: Aabb {
                min: Point3::from(self.planes.map(|plane| plane[child])),
                max: Point3::from(self.planes.map(|plane| plane[child + 2])),
            },
            first: self.first[child],
            count: self.count[child],
        })
    }
}
