//! A list of shapes, as primitives.

use std::ops::ControlFlow;

use ombra_geometry::shape::{Shape, Surface};
use ombra_geometry::{Aabb, EdgeRule, Ray};

use super::{AnyHit, Candidate, Primitives};
use crate::{Counter, TraversalRay};

/// A list of shapes.
#[derive(Clone, Debug, Default)]
pub struct Shapes(pub Vec<Shape>);

impl Shapes {
    /// Reports the crossings of a ray with one shape.
    #[inline]
    pub(crate) fn test(
        &self,
        ray: &Ray<f64>,
        primitive: u32,
        report: &mut impl FnMut(&Candidate) -> AnyHit,
    ) -> ControlFlow<()> {
        let mut terminated = ControlFlow::Continue(());
        // Once one is accepted those behind it do not count.
        let _ = self.0[primitive as usize].visit_crossings(ray, &mut |crossing| match report(
            &Candidate::new(crossing, primitive),
        ) {
            AnyHit::Ignore => ControlFlow::Continue(()),
            AnyHit::Accept => ControlFlow::Break(()),
            AnyHit::Terminate => {
                terminated = ControlFlow::Break(());
                terminated
            }
        });
        terminated
    }
}

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
        t_max: f64,
        primitive: u32,
        counter: &mut C,
        report: &mut F,
    ) -> ControlFlow<()> {
        counter.test();
        let ray = Ray { t_max, ..ray.ray };
        self.test(&ray, primitive, report)
    }

    fn bytes(&self) -> usize {
        size_of_val(self.0.as_slice())
    }

    #[inline]
    fn plain(&self) -> Option<&Shapes> {
        Some(self)
    }
}
