//! The walk towards a point: what is nearest first, and nothing that is too far away.

use std::ops::ControlFlow;

use arrayvec::ArrayVec;

use super::Wide;
use super::kernel::STACK;
use super::node::{Child, WIDTH};
use crate::Nearby;
use crate::distance::Boxes;

impl Wide {
    /// Shows `leaf` the primitives that are not certain to be further away than the limit, each once,
    /// roughly from near to far.
    pub(crate) fn measure(
        &self,
        boxes: &Boxes,
        nearby: &mut Nearby,
        mut leaf: impl FnMut(&[u32], &mut Nearby) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut waiting = ArrayVec::<(Child, f64), STACK>::new();
        waiting.push((self.root(), 0.0));
        while let Some((child, distance)) = waiting.pop() {
            if distance > nearby.limit() {
                continue;
            }
            if child.is_leaf() {
                leaf(&self.list(child), nearby)?;
                continue;
            }
            let node = self.node(child);
            let distances = boxes.distances(&node);
            let mut near = ArrayVec::<(Child, f64), WIDTH>::new();
            for (k, distance) in distances.into_iter().enumerate() {
                let is_there = node.lower[0][k] <= node.upper[0][k];
                // What has no number may be near.
                if is_there && !(distance > nearby.limit()) {
                    near.push((node.child[k], distance));
                }
            }
            near.sort_unstable_by(|a, b| b.1.total_cmp(&a.1));
            waiting.extend(near);
        }
        ControlFlow::Continue(())
    }
}
