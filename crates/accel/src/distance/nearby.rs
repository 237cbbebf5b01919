//! A question about distances under way: what was found so far.

use std::cmp::Ordering;
use std::ops::ControlFlow;

use ombra_geometry::PrimitiveId;
use ombra_geometry::triangle::Nearest;

use super::{ClosestPoint, Place};

/// A question about distances under way.
#[derive(Debug)]
pub struct Nearby {
    mask: u32,
    limit: f64,
    found: Found,
}

#[derive(Debug)]
enum Found {
    Closest(Option<ClosestPoint>),
    Any(bool),
    All(Vec<ClosestPoint>),
}

impl Nearby {
    const fn new(mask: u32, limit: f64, found: Found) -> Self {
        Self { mask, limit, found }
    }

    pub(super) const fn closest(mask: u32, limit: f64) -> Self {
        Self::new(mask, limit, Found::Closest(None))
    }

    pub(super) const fn any(mask: u32, limit: f64) -> Self {
        Self::new(mask, limit, Found::Any(false))
    }

    pub(super) fn all(mask: u32, limit: f64, mut list: Vec<ClosestPoint>) -> Self {
        list.clear();
        Self::new(mask, limit, Found::All(list))
    }

    /// Whether it is asked of an instance with this mask.
    #[inline]
    pub(crate) const fn sees(&self, mask: u32) -> bool {
        self.mask & mask != 0
    }

    /// What is farther away than this (strictly) need not be measured. It shrinks as nearer points
    /// are found.
    #[must_use]
    #[inline]
    pub const fn limit(&self) -> f64 {
        self.limit
    }

    /// Tells of the nearest point of a primitive, in the space of the query.
    ///
    /// # Errors
    /// `Break` if nothing else need be measured.
    #[inline]
    pub fn report(
        &mut self,
        place: &Place<'_>,
        primitive: u32,
        nearest: &Nearest,
    ) -> ControlFlow<()> {
        let distance = nearest.offset.length();
        // An offset that is NaN or infinite is none.
        if !(distance <= self.limit && distance < f64::INFINITY) {
            return ControlFlow::Continue(());
        }
        let here = || ClosestPoint {
            point: place.point + nearest.offset,
            distance,
            u: nearest.u,
            v: nearest.v,
            primitive: PrimitiveId(primitive),
            geometry: place.geometry,
            instance: place.instance,
        };
        match &mut self.found {
            Found::Closest(best) => {
                let here = here();
                if best.as_ref().is_none_or(|best| order(&here, best).is_lt()) {
                    *best = Some(here);
                    self.limit = distance;
                }
            }
            Found::Any(any) => {
                *any = true;
                return ControlFlow::Break(());
            }
            Found::All(list) => list.push(here()),
        }
        ControlFlow::Continue(())
    }

    pub(super) const fn is_found(&self) -> bool {
        matches!(self.found, Found::Any(true))
    }

    pub(super) fn into_closest(self) -> Option<ClosestPoint> {
        match self.found {
            Found::Closest(best) => best,
            _ => None,
        }
    }

    pub(super) fn into_all(self) -> Vec<ClosestPoint> {
        match self.found {
            Found::All(mut list) => {
                list.sort_unstable_by(order);
                // Once, in however many leaves a structure lists it.
                list.dedup_by(|a, b| order(a, b).is_eq());
                list
            }
            _ => Vec::new(),
        }
    }
}

/// The nearer first, of those equally near the one with the smaller ids.
fn order(a: &ClosestPoint, b: &ClosestPoint) -> Ordering {
    let ids = |c: &ClosestPoint| (c.instance, c.geometry, c.primitive);
    let nearer = a.distance.total_cmp(&b.distance);
    nearer.then_with(|| ids(a).cmp(&ids(b)))
}
