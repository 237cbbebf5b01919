//! The one visitor behind all queries: it tests what a traversal shows it and asks what to make of
//! each hit.

use std::ops::ControlFlow;

use ombra_geometry::EdgeRule;

use crate::{AnyHit, Candidate, Counter, Primitives, Span, TraversalRay, Visitor};

/// A query under way.
pub(crate) struct Search<'a, P: Primitives, C> {
    primitives: &'a P,
    prepared: P::Prepared,
    ray: &'a TraversalRay,
    counter: &'a mut C,
    any_hit: &'a mut dyn FnMut(&Candidate) -> AnyHit,
    t_max: f64,
    best: Option<Candidate>,
}

impl<'a, P, C> Search<'a, P, C>
where
    P: Primitives,
    C: Counter,
{
    pub(crate) fn new(
        primitives: &'a P,
        ray: &'a TraversalRay,
        rule: EdgeRule,
        counter: &'a mut C,
        any_hit: &'a mut dyn FnMut(&Candidate) -> AnyHit,
    ) -> Self {
        Self {
            primitives,
            prepared: primitives.prepare(ray, rule),
            ray,
            counter,
            any_hit,
            t_max: ray.ray.t_max,
            best: None,
        }
    }

    /// The nearest hit that was accepted.
    pub(crate) const fn best(&self) -> Option<Candidate> {
        self.best
    }
}

impl<P, C> Visitor for Search<'_, P, C>
where
    P: Primitives,
    C: Counter,
{
    #[inline]
    fn t_max(&self) -> f64 {
        self.t_max
    }

    #[inline]
    fn leaf(&mut self, primitives: &[u32], span: Span) -> ControlFlow<()> {
        let Self {
            primitives: list,
            prepared,
            ray,
            counter,
            any_hit,
            t_max,
            best,
        } = self;
        for &primitive in primitives {
            let limit = *t_max;
            let mut report = |candidate: &Candidate| {
                let nearest = best.as_ref().is_none_or(|best| candidate.precedes(best));
                // The test of a primitive may have rounded the ray's range.
                let in_range = ray.ray.t_min <= candidate.t && candidate.t <= *t_max;
                if !nearest || !in_range || !span.contains(candidate.t) {
                    return AnyHit::Ignore;
                }
                // What has no end on some side is in no structure that could miss it.
                let bounds = list.bounds(primitive);
                let at = ray.ray.at(candidate.t);
                if bounds.is_finite() && !bounds.wide().padded(ray.hit_pad).contains(at) {
                    return AnyHit::Ignore;
                }
                let answer = any_hit(candidate);
                if answer != AnyHit::Ignore {
                    *best = Some(*candidate);
                    *t_max = candidate.t;
                }
                answer
            };
            list.crossings(prepared, ray, limit, primitive, *counter, &mut report)?;
        }
        ControlFlow::Continue(())
    }

    #[inline]
    fn node(&mut self) {
        self.counter.node();
    }
}
