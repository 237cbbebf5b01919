//! kd-restart: nothing is remembered.
//!
//! The idea: after a leaf, start again at the root, with a ray that begins where it left the leaf.
//! No stack at all, at the price of going down from the root for every leaf.
//!
//! Foley, Sugerman, "KD-Tree Acceleration Structures for a GPU Raytracer", Graphics Hardware 2005.
//! It ends because a leaf is always left later than it was entered: a plane that is
//! met at the very t where the ray begins counts as crossed.

use std::ops::ControlFlow;

use super::node::KdTree;
use crate::{Bounded, Reach, Structure, TraversalRay, Visitor};

/// A kd-tree walked from the root for every leaf.
#[derive(Clone, Debug)]
pub struct KdRestart {
    tree: KdTree,
}

impl Structure for KdRestart {
    fn build(primitives: &[Bounded], reach: &Reach) -> Self {
        let tree = KdTree::build(primitives, reach);
        Self { tree }
    }

    #[inline]
    fn traverse<V: Visitor>(&self, ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()> {
        let tree = &self.tree;
        tree.root
            .traverse(ray, &tree.references, visitor, |ray, visitor| {
                let mut from = ray.enter;
                while from < ray.exit {
                    let (leaf, end) = tree.descend(ray, 0, from, ray.exit, visitor, |_| ());
                    tree.show(leaf, ray.span(from, end), visitor)?;
                    if visitor.t_max() < end {
                        break;
                    }
                    from = end;
                }
                ControlFlow::Continue(())
            })
    }

    fn bytes(&self) -> usize {
        self.tree.bytes()
    }
}
