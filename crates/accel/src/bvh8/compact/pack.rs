//! From the tree that builders make to the compact layout.

use ombra_geometry::TriangleMesh;
use rayon::prelude::*;

use super::super::node::{Child, Node};
use super::super::wide::WideTree;
use super::block::{Blocks, block};
use super::node::SmallNode;

/// Nodes a task.
const TASK: usize = 256;

/// The word of the first leaf of a task: none is taken for the empty one.
const FIRST: usize = 2;

/// Makes nodes smaller and blocks of the lists that leaves name, in the order of the nodes.
pub(crate) fn pack(
    tree: &WideTree,
    list: &[u32],
    mesh: &TriangleMesh,
) -> (WideTree<Vec<SmallNode>>, Blocks) {
    if tree.root.is_leaf() {
        let words = block(mesh, &list[tree.root.range()]);
        let mut blocks = Blocks::with_room(words.len());
        let root = Child::block(blocks.words().len());
        blocks.append(&words);
        blocks.end();
        let nodes = Vec::new();
        let depth = tree.depth;
        return (WideTree { root, nodes, depth }, blocks);
    }
    let tasks: Vec<(Vec<SmallNode>, Vec<u32>)> = (tree.nodes.par_chunks(TASK))
        .map(|nodes| smaller(nodes, list, mesh))
        .collect();
    let mut blocks = Blocks::with_room(tasks.iter().map(|(_, words)| words.len()).sum());
    let mut nodes = Vec::with_capacity(tree.nodes.len());
    for (own, words) in tasks {
        let before = blocks.words().len();
        nodes.extend(own.into_iter().map(|mut node| {
            for child in &mut node.child {
                if child.is_leaf() && *child != Child::EMPTY_BLOCK {
                    *child = Child::block(child.word() - FIRST + before);
                }
            }
            node
        }));
        blocks.append(&words);
    }
    blocks.end();
    let WideTree { root, depth, .. } = *tree;
    (WideTree { root, nodes, depth }, blocks)
}

/// Nodes made smaller, and the words of the leaves below them.
fn smaller(nodes: &[Node], list: &[u32], mesh: &TriangleMesh) -> (Vec<SmallNode>, Vec<u32>) {
    let mut words = Vec::new();
    let small = |node: &Node| {
        SmallNode::new(node, |child| {
            if !child.is_leaf() {
                return child;
            }
            let leaf = Child::block(FIRST + words.len());
            words.extend(block(mesh, &list[child.range()]));
            leaf
        })
    };
    (nodes.iter().map(small).collect(), words)
}
