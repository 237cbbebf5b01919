//! Primitives of your own: the intersection program.

use std::ops::ControlFlow;

use ombra_accel::{Candidate, Counter, Primitives, TraversalRay};
use ombra_geometry::{Aabb, Crossing, EdgeRule, Ray};

use crate::AnyHit;

/// The intersection program of primitives of your own: how many there are, the box around each,
/// and where a ray crosses one.
pub trait Intersection: Send + Sync {
    /// How many primitives there are.
    fn count(&self) -> usize;

    /// The box around one. A crossing outside of it does not count.
    fn bounds(&self, primitive: u32) -> Aabb;

    /// Reports each crossing of the ray with one primitive whose t is in `[t_min, t_max]`; `u` and
    /// `v` are whatever the programs of the pipeline want to find in the hit.
    ///
    /// # Errors
    /// What `report` breaks off with is to be passed on: use `report(..)?`.
    fn intersect(
        &self,
        ray: &Ray<f64>,
        primitive: u32,
        report: &mut dyn FnMut(Crossing) -> ControlFlow<()>,
    ) -> ControlFlow<()>;
}

/// Puts an [`Intersection`] under an acceleration structure.
#[derive(Clone, Debug)]
pub struct Custom<I>(pub I);

impl<I: Intersection> Primitives for Custom<I> {
    type Prepared = ();

    fn len(&self) -> usize {
        self.0.count()
    }

    fn bounds(&self, primitive: u32) -> Aabb {
        self.0.bounds(primitive)
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
        self.0.intersect(
            &ray,
            primitive,
            &mut |crossing| match report(&Candidate::new(crossing, primitive)) {
                AnyHit::Terminate => ControlFlow::Break(()),
                AnyHit::Accept | AnyHit::Ignore => ControlFlow::Continue(()),
            },
        )
    }

    fn bytes(&self) -> usize {
        0
    }
}
