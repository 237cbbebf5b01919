//! kd-stack: what is still to do waits on a stack.
//!
//! The idea: at a plane that the ray crosses in the node, go to the near child and put the far one
//! on a stack; after a leaf, take the last one put there. Each node is visited once at most.
//!
//! Havran, "Heuristic Ray Shooting Algorithms", PhD thesis, Czech Technical University, 2000.

use std::ops::ControlFlow;

use arrayvec::ArrayVec;

use super::node::{KdTree, MAX_DEPTH, Postponed};
use crate::{Bounded, Reach, Structure, TraversalRay, Visitor};

/// A kd-tree walked with a stack.
#[derive(Clone, Debug)]
pub struct KdStack {
    tree: KdTree,
}

impl Structure for KdStack {
    fn build(primitives: &[Bounded], reach: &Reach) -> Self {
        let tree = KdTree::build(primitives, reach);
        Self { tree }
    }

    #[inline]
    fn traverse<V: Visitor>(&self, ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()> {
        let tree = &self.tree;
        tree.root
            .traverse(ray, &tree.references, visitor, |ray, visitor| {
                let mut stack = ArrayVec::<Postponed, MAX_DEPTH>::new();
                let (mut node, mut from, mut to) = (0, ray.enter, ray.exit);
                loop {
                    let (leaf, end) =
                        tree.descend(ray, node, from, to, visitor, |far| stack.push(far));
                    tree.show(leaf, ray.span(from, end), visitor)?;
                    if visitor.t_max() < end {
                        return ControlFlow::Continue(());
                    }
                    let Some(next) = stack.pop() else {
                        return ControlFlow::Continue(());
                    };
                    (node, from, to) = (next.node, next.from, next.to);
                }
            })
    }

    fn bytes(&self) -> usize {
        self.tree.bytes()
    }
}
