//! Joins small subtrees into leaves where testing all their primitives is expected to be cheaper
//! than walking down.
//!
//! The surface area heuristic (MacDonald, Booth, "Heuristics for ray tracing using space
//! subdivision", 1990): of the lines that meet a box, those that meet a box within it are as the
//! areas of the two.

use super::build::BinaryTree;

/// What testing the boxes of two children costs.
pub(super) const TRAVERSAL_COST: f64 = 1.0;
/// What testing a primitive costs.
pub(super) const TEST_COST: f64 = 1.0;
/// The most primitives in a leaf.
pub(super) const MAX_LEAF: u32 = 8;

/// Which nodes become leaves. Nodes below a leaf do not matter any more.
pub(super) fn leaves(tree: &BinaryTree) -> Vec<bool> {
    let count = tree.nodes.len();
    let mut is_leaf = vec![false; count];
    // The cost of each subtree times the half area of its box.
    let mut cost = vec![0.0; count];
    // Children come after their parents.
    for i in (0..count).rev() {
        let node = &tree.nodes[i];
        let area = node.bounds.wide().half_area();
        let as_leaf = area * TEST_COST * f64::from(node.count);
        if node.count == 1 {
            is_leaf[i] = true;
            cost[i] = as_leaf;
            continue;
        }
        let [left, right] = tree.children(i);
        let as_inner = area * TRAVERSAL_COST + cost[left] + cost[right];
        is_leaf[i] = node.count <= MAX_LEAF && as_leaf <= as_inner;
        cost[i] = if is_leaf[i] { as_leaf } else { as_inner };
    }
    is_leaf
}
