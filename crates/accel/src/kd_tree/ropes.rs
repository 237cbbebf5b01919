//! kd-ropes: each leaf knows its neighbours.
//!
//! The idea: a leaf keeps its box and, for each of its six faces, a rope to the node on the other
//! side: the smallest one that covers the whole face. After a leaf the walk follows the rope of the
//! face through which the ray leaves, and goes down from there. No stack, and a few steps only from
//! leaf to leaf, at the price of memory.
//!
//! Havran, Bittner, Žára, "Ray Tracing with Rope Trees", SCCG 1998; Popov, Günther, Seidel,
//! Slusallek, "Stackless KD-Tree Traversal for High Performance GPU Ray Tracing", Computer Graphics
//! Forum 26(3), 2007, whose way to make ropes this is.
//!
//! Why it ends: call a plane crossed if the walk left a leaf through it. A leaf's far faces are
//! planes that are met later than the ray's present t, or faces of the node that the rope led to,
//! which lie beyond the leaf left behind. Planes across one axis are met in their order, or at the
//! same t. So along each axis the far face of every later leaf lies beyond all planes crossed, and
//! no leaf, whose own far face becomes one of them, comes twice.

use std::ops::ControlFlow;

use ombra_geometry::{Aabb, Axis};

use super::node::{KdTree, Node, halves};
use crate::cells::CellRay;
use crate::{Bounded, Reach, Structure, TraversalRay, Visitor};

/// Leads nowhere: out of the tree.
const OUTSIDE: u32 = u32::MAX;

/// The node behind each face: below and above, for each axis.
type Ropes = [[u32; 2]; 3];

/// A kd-tree walked along ropes.
#[derive(Clone, Debug)]
pub struct KdRopes {
    tree: KdTree,
    /// In the order of the leaves' ordinals.
    leaves: Vec<RopedLeaf>,
}

/// What a leaf has besides its primitives.
#[derive(Clone, Copy, Debug)]
struct RopedLeaf {
    /// The planes below and above, for each axis.
    faces: [[f64; 2]; 3],
    ropes: Ropes,
}

impl RopedLeaf {
    /// Where the ray leaves, and to which node.
    #[inline]
    fn exit(&self, ray: &CellRay) -> (f64, u32) {
        let mut exit = (f64::INFINITY, OUTSIDE);
        for axis in Axis::ALL {
            if ray.is_still(axis) {
                continue;
            }
            let side = usize::from(!ray.runs_down(axis));
            let t = ray.crossing(axis, self.faces[axis as usize][side]);
            if t < exit.0 {
                exit = (t, self.ropes[axis as usize][side]);
            }
        }
        exit
    }
}

impl Structure for KdRopes {
    fn build(primitives: &[Bounded], reach: &Reach) -> Self {
        let tree = KdTree::build(primitives, reach);
        let mut leaves = Vec::with_capacity(tree.leaves as usize);
        tie(
            &tree,
            0,
            *tree.root.bounds(),
            [[OUTSIDE; 2]; 3],
            &mut leaves,
        );
        Self { tree, leaves }
    }

    #[inline]
    fn traverse<V: Visitor>(&self, ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()> {
        let tree = &self.tree;
        tree.root
            .traverse(ray, &tree.references, visitor, |ray, visitor| {
                let (mut node, mut from) = (0, ray.enter);
                loop {
                    let (leaf, _) = tree.descend(ray, node, from, ray.exit, visitor, |_| ());
                    let (mut end, rope) = self.leaves[leaf.ordinal as usize].exit(ray);
                    if rope == OUTSIDE {
                        end = f64::INFINITY;
                    }
                    // Planes met at the same t leave nothing between them.
                    if from < end {
                        tree.show(leaf, ray.span(from, end), visitor)?;
                    }
                    if rope == OUTSIDE || visitor.t_max() < end {
                        return ControlFlow::Continue(());
                    }
                    (node, from) = (rope, end);
                }
            })
    }

    fn bytes(&self) -> usize {
        self.tree.bytes() + size_of_val(self.leaves.as_slice())
    }
}

/// Ties the leaves below a node, given the ropes of the node: children inherit them, and each is
/// the neighbour of the other.
fn tie(tree: &KdTree, node: u32, bounds: Aabb<f64>, mut ropes: Ropes, leaves: &mut Vec<RopedLeaf>) {
    for axis in Axis::ALL {
        for (side, rope) in ropes[axis as usize].iter_mut().enumerate() {
            *rope = lowered(tree, *rope, axis, side, &bounds);
        }
    }
    match tree.nodes[node as usize] {
        Node::Leaf(_) => leaves.push(RopedLeaf {
            faces: Axis::ALL.map(|axis| [bounds.min[axis], bounds.max[axis]]),
            ropes,
        }),
        Node::Inner { axis, above, plane } => {
            let [lower, upper] = halves(&bounds, axis, plane);
            let (mut of_lower, mut of_upper) = (ropes, ropes);
            of_lower[axis as usize][1] = above;
            of_upper[axis as usize][0] = node + 1;
            tie(tree, node + 1, lower, of_lower, leaves);
            tie(tree, above, upper, of_upper, leaves);
        }
    }
}

/// Lets a rope from a face of a box lead as far down as a single node covers the face.
fn lowered(tree: &KdTree, mut rope: u32, face: Axis, side: usize, bounds: &Aabb<f64>) -> u32 {
    while rope != OUTSIDE {
        let Node::Inner { axis, above, plane } = tree.nodes[rope as usize] else {
            break;
        };
        let below = rope + 1;
        rope = if axis == face {
            // The half that touches the face.
            if side == 0 { above } else { below }
        } else if bounds.max[axis] <= plane {
            below
        } else if plane <= bounds.min[axis] {
            above
        } else {
            break;
        };
    }
    rope
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::tests::scenes;

    fn node_bounds(tree: &KdTree, node: usize, bounds: Aabb<f64>, all: &mut Vec<Aabb<f64>>) {
        all[node] = bounds;
        if let Node::Inner { axis, above, plane } = tree.nodes[node] {
            let [lower, upper] = halves(&bounds, axis, plane);
            node_bounds(tree, node + 1, lower, all);
            node_bounds(tree, above as usize, upper, all);
        }
    }

    #[test]
    fn a_rope_leads_to_a_neighbour_that_covers_the_face() {
        for (primitives, reach) in scenes() {
            let roped = KdRopes::build(&primitives, &reach);
            let tree = &roped.tree;
            let root = *tree.root.bounds();
            let mut nodes = vec![root; tree.nodes.len()];
            node_bounds(tree, 0, root, &mut nodes);
            assert_eq!(roped.leaves.len(), tree.leaves as usize);
            for (node, bounds) in tree.nodes.iter().zip(&nodes) {
                let Node::Leaf(leaf) = node else { continue };
                let leaf = &roped.leaves[leaf.ordinal as usize];
                for axis in Axis::ALL {
                    let [low, high] = leaf.faces[axis as usize];
                    assert_eq!([low, high], [bounds.min[axis], bounds.max[axis]]);
                    for (side, rope) in leaf.ropes[axis as usize].into_iter().enumerate() {
                        let face = [low, high][side];
                        if rope == OUTSIDE {
                            assert_eq!(face, [root.min[axis], root.max[axis]][side]);
                            continue;
                        }
                        let node = &nodes[rope as usize];
                        assert_eq!(face, [node.max[axis], node.min[axis]][side]);
                        for other in [axis.next(), axis.next().next()] {
                            assert!(node.min[other] <= bounds.min[other]);
                            assert!(bounds.max[other] <= node.max[other]);
                        }
                    }
                }
            }
        }
    }
}
