//! The plain walk: for any primitive, and for rays in double precision.

use std::ops::ControlFlow;

use arrayvec::ArrayVec;

use super::kernel::STACK;
use super::node::{Child, WIDTH};
use super::places::places;
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
            Leaves::Places(_) => visitor.leaf(&places(leaf), Span::ALL),
            Leaves::Quads(quads) => {
                let places = leaf.places();
                let numbers = |k: usize| {
                    let at = 9 * places + k;
                    quads[leaf.quad() + at / 40].numbers[at % 40].to_bits()
                };
                let list: ArrayVec<u32, WIDTH> = (0..places)
                    .map(numbers)
                    .filter(|&n| n != u32::MAX)
                    .collect();
                visitor.leaf(&list, Span::ALL)
            }
        }
    }
}
