//! Primitives of your own: the intersection program.

use std::ops::ControlFlow;

use ombra_accel::{Candidate, Counter, Primitives, TraversalRay};
use ombra_geometry::{Aabb, Crossing, EdgeRule, Ray};

use crate::AnyHit;

/// The intersection program of primitives of your own: how many there are, the box around each,
/// and where a ray crosses one.
///
/// A pipeline is traced against them once they are under a structure:
/// `Accel::build(Custom(primitives), StructureKind::default())`.
pub trait Intersection: Send + Sync {
    /// How many primitives there are: at most 2³² − 1.
    fn count(&self) -> usize;

    /// The box around one. A crossing outside of it does not count. It may be unbounded; a
    /// primitive whose box is empty or NaN is never hit.
    fn bounds(&self, primitive: u32) -> Aabb;

    /// Reports each crossing of the ray with one primitive, in any order; `u` and `v` are whatever
    /// the programs of the pipeline want to find in the hit.
    ///
    /// A crossing whose t is not in the ray's `[t_min, t_max]` is reported in vain, so both roots
    /// of a quadratic may be reported as they are; `t_max` is the nearest hit so far and may save
    /// work.
    ///
    /// # Errors
    /// `Break` says that nothing else needs to be reported: use `report(..)?`.
    fn intersect(
        &self,
        ray: &Ray<f64>,
        primitive: u32,
        report: impl FnMut(Crossing) -> ControlFlow<()>,
    ) -> ControlFlow<()>;

    /// Bytes held on the heap, for statistics.
    fn bytes(&self) -> usize {
        0
    }
}

/// Puts an [`Intersection`] under an acceleration structure.
#[derive(Clone, Debug)]
pub struct Custom<I>(pub I);

impl<I: Intersection> Primitives for Custom<I> {
    type Prepared = ();

    fn len(&self) -> usize {
        self.0.count()
    }

    #[inline]
    fn bounds(&self, primitive: u32) -> Aabb {
        self.0.bounds(primitive)
    }

    #[inline]
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
        // Kept here as well, so that a program that does not heed `Break` cannot go on past it.
        let mut flow = ControlFlow::Continue(());
        let _ = self.0.intersect(&ray, primitive, |crossing| {
            let within = ray.t_min <= crossing.t && crossing.t <= ray.t_max;
            if flow.is_continue()
                && within
                && report(&Candidate::new(crossing, primitive)) == AnyHit::Terminate
            {
                flow = ControlFlow::Break(());
            }
            flow
        });
        flow
    }

    fn bytes(&self) -> usize {
        self.0.bytes()
    }
}
