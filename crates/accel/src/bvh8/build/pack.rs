//! Copies triangles into leaves.

use ombra_geometry::TriangleMesh;
use rayon::prelude::*;

use super::super::node::{Child, MAX_LEAF, Node};
use super::super::quad::Quad;
use super::super::wide::WideTree;
use super::lanes::zeroed_quads;

/// Nodes a task.
const TASK: usize = 256;

/// Makes quads of the lists that leaves name, in the order of the nodes.
pub(crate) fn pack(tree: &mut WideTree, list: &[u32], mesh: &TriangleMesh) -> Vec<Quad> {
    if tree.root.is_leaf() {
        let count = quads_of(tree.root);
        let mut quads = zeroed_quads(count);
        tree.root = lay(tree.root, 0, &mut quads, list, mesh);
        return quads;
    }
    let counts: Vec<usize> = tree
        .nodes
        .par_chunks(TASK)
        .map(|nodes| leaves(nodes).map(|leaf| quads_of(*leaf)).sum())
        .collect();
    let mut quads = zeroed_quads(counts.iter().sum());
    let mut tasks = Vec::with_capacity(counts.len());
    let mut left = quads.as_mut_slice();
    let mut first = 0;
    for (nodes, &count) in tree.nodes.chunks_mut(TASK).zip(&counts) {
        let own;
        (own, left) = left.split_at_mut(count);
        tasks.push((nodes, own, first));
        first += count;
    }
    tasks
        .into_par_iter()
        .for_each(|(nodes, mut own, mut first)| {
            for leaf in nodes.iter_mut().flat_map(|node| &mut node.child) {
                if leaf.is_leaf() {
                    let quads;
                    (quads, own) = std::mem::take(&mut own).split_at_mut(quads_of(*leaf));
                    *leaf = lay(*leaf, first, quads, list, mesh);
                    first += quads.len();
                }
            }
        });
    quads
}

fn leaves(nodes: &[Node]) -> impl Iterator<Item = &Child> {
    let children = nodes.iter().flat_map(|node| &node.child);
    children.filter(|child| child.is_leaf())
}

/// How many quads a leaf of a list becomes.
fn quads_of(leaf: Child) -> usize {
    if leaf.range().len() > MAX_LEAF / 2 {
        2
    } else {
        1
    }
}

/// Fills the quads of a leaf of a list, and says what it is now.
fn lay(leaf: Child, first: usize, quads: &mut [Quad], list: &[u32], mesh: &TriangleMesh) -> Child {
    Quad::lay(quads, mesh, &list[leaf.range()]);
    Child::triangles(first, quads.len() == 2)
}
