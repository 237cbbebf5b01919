//! What a query sees of the instances.

use std::ops::ControlFlow;

use ombra_geometry::{Aabb, EdgeRule, Ray};

use crate::{
    Accel, AnyHit, Candidate, Counter, Distances, Instances, Measured, NoDistance, Primitives,
    Statistics, Traversable, TraversalRay,
};

/// Instances as queries with a mask see them: those whose [mask](crate::Instance::mask) has a bit in
/// common with it.
///
/// A view and not a field of the ray, which has four for ever; a program that traces two kinds of rays
/// makes two views.
#[derive(Debug)]
pub struct Masked<'a, P> {
    accel: &'a Accel<Instances<P>>,
    mask: u32,
}

impl<P> Clone for Masked<'_, P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P> Copy for Masked<'_, P> {}

impl<P: Primitives> Accel<Instances<P>> {
    /// What queries with a mask see.
    #[must_use]
    pub const fn masked(&self, mask: u32) -> Masked<'_, P> {
        Masked { accel: self, mask }
    }
}

impl<'a, P: Measured> Masked<'a, P> {
    /// What answers questions about distances from what is seen.
    ///
    /// # Errors
    /// As for [`Accel::distances`], seen or not.
    pub fn distances(&self) -> Result<Distances<'a, Instances<P>>, NoDistance> {
        self.accel.distances_seen(self.mask)
    }
}

impl<P: Primitives> Masked<'_, P> {
    fn search_with<C: Counter>(
        &self,
        ray: &Ray<f64>,
        rule: EdgeRule,
        counter: &mut C,
        any_hit: &mut dyn FnMut(&Candidate) -> AnyHit,
    ) -> Option<Candidate> {
        let ray = TraversalRay::new(ray, self.accel.reach())?;
        let seen = Seen {
            instances: self.accel.primitives(),
            mask: self.mask,
        };
        self.accel.search_among(&seen, &ray, rule, counter, any_hit)
    }
}

impl<P: Primitives> Traversable for Masked<'_, P> {
    fn search(
        &self,
        ray: &Ray<f64>,
        rule: EdgeRule,
        statistics: Option<&mut Statistics>,
        any_hit: &mut dyn FnMut(&Candidate) -> AnyHit,
    ) -> Option<Candidate> {
        match statistics {
            None => self.search_with(ray, rule, &mut (), any_hit),
            Some(statistics) => self.search_with(ray, rule, statistics, any_hit),
        }
    }

    /// Those of all instances, seen or not.
    fn bounds(&self) -> Aabb {
        self.accel.bounds()
    }

    fn bytes(&self) -> usize {
        self.accel.bytes()
    }
}

/// The primitives of the view.
struct Seen<'a, P> {
    instances: &'a Instances<P>,
    mask: u32,
}

impl<P: Primitives> Primitives for Seen<'_, P> {
    type Prepared = EdgeRule;

    fn len(&self) -> usize {
        self.instances.len()
    }

    #[inline]
    fn bounds(&self, primitive: u32) -> Aabb {
        self.instances.bounds(primitive)
    }

    fn prepare(&self, _ray: &TraversalRay, rule: EdgeRule) -> EdgeRule {
        rule
    }

    #[inline]
    fn crossings<C: Counter, F: FnMut(&Candidate) -> AnyHit>(
        &self,
        rule: &EdgeRule,
        ray: &TraversalRay,
        t_max: f64,
        primitive: u32,
        counter: &mut C,
        report: &mut F,
    ) -> ControlFlow<()> {
        let range = (ray, t_max);
        self.instances
            .crossings_seen(self.mask, *rule, range, primitive, counter, report)
    }

    fn bytes(&self) -> usize {
        self.instances.bytes()
    }
}
