//! Binary trees over boxes: how the three builders differ is only where they cut a list in two.

mod lbvh;
mod median;
mod sah;

use ombra_geometry::Aabb;

use super::MAX_DEPTH;
use crate::Bounded;

pub use lbvh::Lbvh;
pub use median::Median;
pub use sah::Sah;

/// Lists shorter than this are not worth a task of their own.
const PARALLEL: usize = 2048;

/// A way to cut a list of primitives in two, again and again. It sees boxes, never triangles.
///
/// The result must not depend on the number of threads.
pub trait Builder: Send + Sync + 'static {
    /// A primitive, with what the builder wants to know about it.
    type Item: Send + Sync;

    /// Works out what the builder wants to know, and the order to begin with.
    fn items(primitives: &[Bounded]) -> Vec<Self::Item>;

    /// The primitive itself.
    fn bounded(item: &Self::Item) -> &Bounded;

    /// Rearranges two or more items and says how many go to the left. `None`, none or all of them:
    /// there is no good cut, and the list is halved as it comes out.
    fn split(items: &mut [Self::Item]) -> Option<usize>;
}

/// A full binary tree with one primitive a leaf, in depth-first order: the left child of node `i`
/// is node `i + 1`, and a subtree of k leaves takes 2k − 1 nodes. So where each subtree goes is
/// known before it is built, and two threads can build two of them into one array.
#[derive(Debug)]
pub(super) struct BinaryTree {
    pub(super) nodes: Vec<BinaryNode>,
    /// Each node's primitives lie next to each other here.
    pub(super) primitives: Vec<u32>,
}

/// A node of the binary tree; a leaf if `count` is 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct BinaryNode {
    pub(super) bounds: Aabb,
    /// The first of its primitives.
    pub(super) first: u32,
    /// How many primitives lie below.
    pub(super) count: u32,
}

impl BinaryTree {
    /// The children of an inner node.
    pub(super) fn children(&self, node: usize) -> [usize; 2] {
        let left = node + 1;
        [left, node + 2 * self.nodes[left].count as usize]
    }
}

/// Builds a tree by cutting in two.
pub(super) fn grow<B: Builder>(primitives: &[Bounded]) -> BinaryTree {
    let mut items = B::items(primitives);
    let unset = BinaryNode {
        bounds: Aabb::EMPTY,
        first: 0,
        count: 0,
    };
    let mut nodes = vec![unset; (2 * items.len()).saturating_sub(1)];
    if !items.is_empty() {
        grow_subtree::<B>(&mut items, 0, 0, &mut nodes);
    }
    let primitives = items.iter().map(|item| B::bounded(item).primitive);
    BinaryTree {
        primitives: primitives.collect(),
        nodes,
    }
}

/// Fills `nodes` with the tree over `items`, which begin at `first` in the whole list.
///
/// Everywhere `depth` + ⌈log₂ items⌉ ≤ [`MAX_DEPTH`]: any cut keeps that below the limit, halving
/// keeps it at the limit.
fn grow_subtree<B: Builder>(
    items: &mut [B::Item],
    first: u32,
    depth: usize,
    nodes: &mut [BinaryNode],
) {
    let count = items.len();
    let (node, below) = nodes
        .split_first_mut()
        .expect("a subtree has 2 · items − 1 nodes");
    node.first = first;
    node.count = count as u32;
    if let [item] = items {
        node.bounds = B::bounded(item).bounds;
        return;
    }
    let levels = count.next_power_of_two().ilog2() as usize;
    let cut = if depth + levels < MAX_DEPTH {
        B::split(items).filter(|&cut| 0 < cut && cut < count)
    } else {
        None
    };
    let cut = cut.unwrap_or(count / 2);
    let (left_items, right_items) = items.split_at_mut(cut);
    let (left, right) = below.split_at_mut(2 * cut - 1);
    let mut grow_left = |left: &mut _| grow_subtree::<B>(left_items, first, depth + 1, left);
    let mut grow_right =
        |right: &mut _| grow_subtree::<B>(right_items, first + cut as u32, depth + 1, right);
    if count < PARALLEL {
        grow_left(left);
        grow_right(right);
    } else {
        rayon::join(|| grow_left(left), || grow_right(right));
    }
    node.bounds = left[0].bounds.union(right[0].bounds);
}

/// The box around the centres of some primitives' boxes.
fn centre_bounds<'a>(primitives: impl IntoIterator<Item = &'a Bounded>) -> Aabb {
    Aabb::around(primitives.into_iter().map(|p| p.bounds.centre()))
}
