//! kd-short-stack: a little is remembered.
//!
//! The idea: a stack of a few entries, small enough for registers. When it is full the oldest entry
//! is dropped; when it is empty and the ray has not left the tree, something was dropped, and the
//! walk starts again at the root as in kd-restart.
//!
//! Horn, Sugerman, Houston, Hanrahan, "Interactive k-D Tree GPU Raytracing", I3D 2007.
//! Their other idea, to start again not at the root but at the lowest node that holds the whole
//! rest of the ray ("push-down"), is left out, so that this walk differs from its two relatives in
//! one thing only.

use std::ops::ControlFlow;

use super::node::{KdTree, Postponed};
use crate::{Bounded, Reach, Structure, TraversalRay, Visitor};

/// How many entries the stack has: with four, hardly any ray starts again.
const ENTRIES: usize = 4;

/// A kd-tree walked with a stack of four entries.
#[derive(Clone, Debug)]
pub struct KdShortStack {
    tree: KdTree,
}

/// A stack that forgets its oldest entry when it is full: a ring.
struct ShortStack {
    ring: [Postponed; ENTRIES],
    /// Where the next entry goes.
    top: usize,
    count: usize,
}

impl ShortStack {
    const fn new() -> Self {
        let nothing = Postponed {
            node: 0,
            from: 0.0,
            to: 0.0,
        };
        Self {
            ring: [nothing; ENTRIES],
            top: 0,
            count: 0,
        }
    }

    #[inline]
    fn push(&mut self, entry: Postponed) {
        self.ring[self.top] = entry;
        self.top = (self.top + 1) % ENTRIES;
        self.count = (self.count + 1).min(ENTRIES);
    }

    #[inline]
    fn pop(&mut self) -> Option<Postponed> {
        self.count = self.count.checked_sub(1)?;
        self.top = (self.top + ENTRIES - 1) % ENTRIES;
        Some(self.ring[self.top])
    }
}

impl Structure for KdShortStack {
    fn build(primitives: &[Bounded], reach: &Reach) -> Self {
        let tree = KdTree::build(primitives, reach);
        Self { tree }
    }

    #[inline]
    fn traverse<V: Visitor>(&self, ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()> {
        let tree = &self.tree;
        tree.root
            .traverse(ray, &tree.references, visitor, |ray, visitor| {
                let mut stack = ShortStack::new();
                let (mut node, mut from, mut to) = (0, ray.enter, ray.exit);
                loop {
                    let (leaf, end) =
                        tree.descend(ray, node, from, to, visitor, |far| stack.push(far));
                    tree.show(leaf, ray.span(from, end), visitor)?;
                    if visitor.t_max() < end || end >= ray.exit {
                        return ControlFlow::Continue(());
                    }
                    // An entry begins where the leaf ended: it was the last plane not crossed.
                    (node, to) = stack.pop().map_or((0, ray.exit), |far| (far.node, far.to));
                    from = end;
                }
            })
    }

    fn bytes(&self) -> usize {
        self.tree.bytes()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_stack_forgets_the_oldest_entry() {
        let mut stack = ShortStack::new();
        let (from, to) = (0.0, 1.0);
        for node in 0..ENTRIES as u32 + 2 {
            stack.push(Postponed { node, from, to });
        }
        let popped: Vec<_> = std::iter::from_fn(|| stack.pop().map(|entry| entry.node)).collect();
        assert_eq!(popped, [5, 4, 3, 2]);
    }
}
