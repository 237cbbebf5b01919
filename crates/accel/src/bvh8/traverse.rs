//! The plain walk: for any primitive, and for rays in double precision.

use std::ops::ControlFlow;

use arrayvec::ArrayVec;

use super::kernel::STACK;
use super::node::{Child, WIDTH};
use super::quad::Quad;
use super::{Leaves, Wide};
use crate::{Span, TraversalRay, Visitor};

impl Wide {
    /// See [`Structure::traverse`](crate::Structure::traverse). Boxes are tested in double
    /// precision, one by one, with the pad that is made for that.
    pub(super) fn traverse<V: Visitor>(
        &self,
        ray: &TraversalRay,
        visitor: &mut V,
    ) -> ControlFlow<()> {
        let mut waiting = ArrayVec::<(Child, f64), STACK>::new();
        waiting.push((self.tree.root, f64::NEG_INFINITY));
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
            let node = &self.tree.nodes[child.index()];
            let mut entered = ArrayVec::<(Child, f64), WIDTH>::new();
            for (bounds, child) in node.children() {
                if let Some([from, _]) = ray.clip(&bounds.wide(), visitor.t_max()) {
                    entered.push((child, from));
                }
            }
            entered.sort_by(|a, b| b.1.total_cmp(&a.1));
            waiting.extend(entered);
        }
        ControlFlow::Continue(())
    }

    fn leaf<V: Visitor>(&self, leaf: Child, visitor: &mut V) -> ControlFlow<()> {
        match &self.leaves {
            Leaves::Lists(list) => visitor.leaf(&list[leaf.range()], Span::ALL),
            Leaves::Quads(quads) => {
                let quads = &quads[leaf.quad()..leaf.quad() + leaf.places() / 4];
                let list = Quad::triangles(quads);
                visitor.leaf(&list, Span::ALL)
            }
        }
    }
}
