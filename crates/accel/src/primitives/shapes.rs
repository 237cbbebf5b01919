//! A list of shapes, as primitives.

use std::ops::ControlFlow;

use ombra_geometry::shape::{Shape, Surface};
use ombra_geometry::{Aabb, EdgeRule};

use super::{AnyHit, Candidate, Primitives};
use crate::{Counter, TraversalRay};

/// A list of shapes.
#[derive(Clone, Debug, Default)]
pub struct Shapes(pub Vec<Shape>);

impl Primitives for Shapes {
    type Prepared = ();

    fn len(&self) -> usize {
        self.0.len()
    }

    fn bounds(&self, primitive: u32) -> Aabb {
        self.0[primitive as usize].bounds()
    }

    fn prepare(&self, _ray: &TraversalRay, _rule: EdgeRule) -> Self::Prepared {}

    #[inline]
    fn crossings<C: Counter, F: FnMut(&Candidate) -> AnyHit>(
        &self,
        _prepared: &Self::Prepared,
        ray: &TraversalRay,
        _t_max: f64,
        primitive: u32,
        counter: &mut C,
        report: &mut F,
    ) -> ControlFlow<()> {
        counter.test();
        for crossing in self.0[primitive as usize].crossings(&ray.ray) {
            if report(&Candidate::new(crossing, primitive)) == AnyHit::Terminate {
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }

    fn bytes(&self) -> usize {
        size_of_val(self.0.as_slice())
    }
}
