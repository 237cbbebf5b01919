//! The walk that shows what is in leaves to a visitor: plain for rays that are to be traced in double
//! precision.

use std::ops::ControlFlow;

use arrayvec::ArrayVec;

use super::kernel::{self, STACK};
use super::node::{Child, WIDTH};
use super::places::places;
use super::quad::Quad;
use super::{Body, Leaves, Wide};
use crate::{Span, TraversalRay, Visitor};

impl Wide {
    /// See [`Structure::traverse`](crate::Structure::traverse).
    #[inline]
    pub(super) fn traverse<V: Visitor>(
        &self,
        ray: &TraversalRay,
        visitor: &mut V,
    ) -> ControlFlow<()> {
        if let Body::Full(tree, Leaves::Lists(list)) = &self.body
            && let Some(ray) = kernel::ready(self.level, ray, &self.near)
        {
            return kernel::walk_lists(self.level, tree, list, &ray, visitor);
        }
        self.traverse_plainly(ray, visitor)
    }

    /// The same with boxes tested in double precision, one by one, with the pad that is made for that.
    #[inline(never)]
    fn traverse_plainly<V: Visitor>(&self, ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()> {
        let mut waiting = ArrayVec::<(Child, f64), STACK>::new();
        waiting.push((self.root(), f64::NEG_INFINITY));
        let inverse = ray.inverse_direction();
        let limit = |t_max: f64| t_max - ray.box_start;
        while let Some((child, entry)) = waiting.pop() {
            if entry > limit(visitor.t_max()) {
                continue;
            }
            if child.is_leaf() {
                self.leaf(child, visitor)?;
                continue;
            }
            visitor.node();
            let node = self.node(child);
            let mut entered = ArrayVec::<(Child, f64), WIDTH>::new();
            for (bounds, child) in node.children() {
                if let Some([from, _]) = ray.clip(inverse, &bounds.wide(), visitor.t_max()) {
                    entered.push((child, from));
                }
            }
            entered.sort_by(|a, b| b.1.total_cmp(&a.1));
            waiting.extend(entered);
        }
        ControlFlow::Continue(())
    }

    fn leaf<V: Visitor>(&self, leaf: Child, visitor: &mut V) -> ControlFlow<()> {
        match &self.body {
            Body::Full(_, Leaves::Lists(list)) => visitor.leaf(&list[leaf.range()], Span::ALL),
            _ => visitor.leaf(&self.list(leaf), Span::ALL),
        }
    }

    /// What is in a leaf, as a visitor knows it: the numbers of primitives, or places.
    pub(super) fn list(&self, leaf: Child) -> ArrayVec<u32, WIDTH> {
        match &self.body {
            Body::Compact(_, blocks) => blocks.triangles(leaf),
            Body::Full(_, Leaves::Lists(list)) => list[leaf.range()].iter().copied().collect(),
            Body::Full(_, Leaves::Places(_)) => places(leaf),
            Body::Full(_, Leaves::Quads(quads)) => {
                Quad::triangles(&quads[leaf.quad()..leaf.quad() + leaf.places() / 4])
            }
        }
    }
}
