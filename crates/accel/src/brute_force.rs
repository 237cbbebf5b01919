//! No structure at all: every primitive is tested. The judge of all others.

use std::ops::ControlFlow;

use crate::{Bounded, Reach, Span, Structure, TraversalRay, Visitor};

/// A list.
#[derive(Clone, Debug)]
pub struct BruteForce {
    primitives: Vec<u32>,
}

impl Structure for BruteForce {
    fn build(primitives: &[Bounded], _reach: &Reach) -> Self {
        let primitives = primitives.iter().map(|p| p.primitive).collect();
        Self { primitives }
    }

    fn traverse<V: Visitor>(&self, _ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()> {
        visitor.leaf(&self.primitives, Span::ALL)
    }

    fn bytes(&self) -> usize {
        size_of_val(self.primitives.as_slice())
    }
}
