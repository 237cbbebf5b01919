//! The tree itself, and the way down in it that all walks share.

use std::ops::ControlFlow;

use ombra_geometry::{Aabb, Axis};

use super::build::{Branch, grow};
use crate::cells::{CellRay, Root, padded};
use crate::{Bounded, Reach, Span, Visitor};

/// The largest depth of a tree, and so of any stack.
pub(super) const MAX_DEPTH: usize = 64;

/// A kd-tree.
#[derive(Clone, Debug)]
pub(super) struct KdTree {
    pub(super) root: Root,
    /// Depth first, the root first: the lower child of a node comes right after it.
    pub(super) nodes: Vec<Node>,
    pub(super) references: Vec<u32>,
    /// How many leaves there are.
    pub(super) leaves: u32,
}

/// A node: 16 bytes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Node {
    /// Cut in two. Below the plane: coordinates less than it.
    Inner {
        axis: Axis,
        /// The index of the child above the plane.
        above: u32,
        plane: f64,
    },
    /// Not cut.
    Leaf(Leaf),
}

const _: () = assert!(size_of::<Node>() == 16);

/// A part of the references.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaf {
    first: u32,
    count: u32,
    /// How many leaves come before it.
    pub(super) ordinal: u32,
}

/// A child that the ray comes to later, `from` where it crosses the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Postponed {
    pub(super) node: u32,
    pub(super) from: f64,
    pub(super) to: f64,
}

impl KdTree {
    pub(super) fn build(primitives: &[Bounded], reach: &Reach) -> Self {
        let root = Root::new(reach);
        let branch = if root.can_be_cut() {
            grow(&padded(primitives, reach), root.bounds())
        } else {
            Branch::Leaf((0..primitives.len() as u32).collect())
        };
        let mut tree = Self {
            root,
            nodes: Vec::new(),
            references: Vec::new(),
            leaves: 0,
        };
        tree.lay_down(branch, primitives);
        tree.nodes.shrink_to_fit();
        tree.references.shrink_to_fit();
        tree
    }

    fn lay_down(&mut self, branch: Branch, primitives: &[Bounded]) {
        match branch {
            Branch::Leaf(list) => {
                self.nodes.push(Node::Leaf(Leaf {
                    first: self.references.len() as u32,
                    count: list.len() as u32,
                    ordinal: self.leaves,
                }));
                self.leaves += 1;
                let names = list.iter().map(|&i| primitives[i as usize].primitive);
                self.references.extend(names);
            }
            Branch::Inner {
                axis,
                plane,
                children,
            } => {
                let node = self.nodes.len();
                let [below, above] = *children;
                self.nodes.push(Node::Inner {
                    axis,
                    above: 0,
                    plane,
                });
                self.lay_down(below, primitives);
                self.nodes[node] = Node::Inner {
                    axis,
                    above: self.nodes.len() as u32,
                    plane,
                };
                self.lay_down(above, primitives);
            }
        }
    }

    pub(super) fn bytes(&self) -> usize {
        self.root.bytes()
            + size_of_val(self.nodes.as_slice())
            + size_of_val(self.references.as_slice())
    }

    /// The primitives of a leaf.
    #[inline]
    fn list(&self, leaf: Leaf) -> &[u32] {
        &self.references[leaf.first as usize..(leaf.first + leaf.count) as usize]
    }

    /// Shows the visitor what a leaf lists, if anything, for the part of the ray that lies in it.
    #[inline]
    pub(super) fn show<V: Visitor>(
        &self,
        leaf: Leaf,
        span: Span,
        visitor: &mut V,
    ) -> ControlFlow<()> {
        match self.list(leaf) {
            [] => ControlFlow::Continue(()),
            list => visitor.leaf(list, span),
        }
    }

    /// From a node down to the leaf in which the ray is at `from`, and where it leaves that leaf
    /// or, if that comes first, reaches `to`. Calls `postpone` with each child that is met on
    /// `[from, to)` after the leaf, the farthest first.
    ///
    /// A plane counts as crossed at the very t at which it is met, and the returned t is that of a
    /// plane not yet crossed, or `to`: so it is greater than `from` if `to` is. Every walk ends
    /// because of this.
    #[inline]
    pub(super) fn descend<V: Visitor>(
        &self,
        ray: &CellRay,
        mut node: u32,
        from: f64,
        mut to: f64,
        visitor: &mut V,
        mut postpone: impl FnMut(Postponed),
    ) -> (Leaf, f64) {
        loop {
            visitor.node();
            match self.nodes[node as usize] {
                Node::Leaf(leaf) => return (leaf, to),
                Node::Inner { axis, above, plane } => {
                    let crossing = ray.crossing(axis, plane);
                    let (near, far) = if ray.runs_down(axis) {
                        (above, node + 1)
                    } else {
                        (node + 1, above)
                    };
                    // Not `<=`: in the plane, NaN counts as above it.
                    if !(crossing > from) {
                        node = far;
                        continue;
                    }
                    if crossing < to {
                        postpone(Postponed {
                            node: far,
                            from: crossing,
                            to,
                        });
                        to = crossing;
                    }
                    node = near;
                }
            }
        }
    }
}

/// The parts of a box below and above a plane.
pub(super) fn halves(bounds: &Aabb<f64>, axis: Axis, plane: f64) -> [Aabb<f64>; 2] {
    let mut halves = [*bounds; 2];
    halves[0].max[axis] = plane;
    halves[1].min[axis] = plane;
    halves
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::tests::{check_listing, scenes};

    fn leaves(
        tree: &KdTree,
        node: usize,
        bounds: Aabb<f64>,
        found: &mut Vec<(Aabb<f64>, Vec<u32>)>,
    ) {
        match tree.nodes[node] {
            Node::Leaf(leaf) => {
                assert_eq!(leaf.ordinal as usize, found.len());
                found.push((bounds, tree.list(leaf).to_vec()));
            }
            Node::Inner { axis, above, plane } => {
                let [lower, upper] = halves(&bounds, axis, plane);
                leaves(tree, node + 1, lower, found);
                leaves(tree, above as usize, upper, found);
            }
        }
    }

    #[test]
    fn every_primitive_is_listed_wherever_its_padded_box_reaches() {
        for (primitives, reach) in scenes() {
            let tree = KdTree::build(&primitives, &reach);
            let mut found = Vec::new();
            leaves(&tree, 0, *tree.root.bounds(), &mut found);
            assert_eq!(found.len(), tree.leaves as usize);
            check_listing(&primitives, &reach, &found);
        }
    }

    #[test]
    fn the_same_boxes_make_the_same_tree_whatever_the_number_of_threads() {
        for (primitives, reach) in scenes() {
            let built = |threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
                let tree = pool.unwrap().install(|| KdTree::build(&primitives, &reach));
                format!("{tree:?}")
            };
            assert_eq!(built(1), built(3));
        }
    }
}
