//! The questions that a ray can ask, behind one trait.

use ombra_geometry::{Aabb, EdgeRule, Hit, Ray};

use crate::{AnyHit, Candidate, Statistics};

/// Something that rays can be traced against: the one door to every structure.
///
/// All questions are one search with a different word on each hit: accept it, ignore it, stop.
/// A ray that is not valid (NaN, no direction) hits nothing.
///
/// The word on a hit is a `dyn` closure: it is asked a few times a ray, which costs nothing that can
/// be measured, and in return every structure is compiled once and not once for every program.
pub trait Traversable: Send + Sync {
    /// The search behind all questions: shows `any_hit` each hit that may still count, in no
    /// promised order, each crossing at most once, and returns the nearest that it accepted.
    fn search(
        &self,
        ray: &Ray<f64>,
        rule: EdgeRule,
        statistics: Option<&mut Statistics>,
        any_hit: &mut dyn FnMut(&Candidate) -> AnyHit,
    ) -> Option<Candidate>;

    /// The box around everything; unbounded if something in it is.
    fn bounds(&self) -> Aabb;

    /// Bytes held on the heap: structure and primitives.
    fn bytes(&self) -> usize;

    /// The closest hit.
    #[inline]
    fn intersect(&self, ray: &Ray) -> Option<Hit> {
        let mut accept = |_: &Candidate| AnyHit::Accept;
        self.search(&(*ray).into(), EdgeRule::Closed, None, &mut accept)
            .map(|candidate| candidate.hit())
    }

    /// Whether there is any hit.
    #[inline]
    fn occluded(&self, ray: &Ray) -> bool {
        let mut terminate = |_: &Candidate| AnyHit::Terminate;
        self.search(&(*ray).into(), EdgeRule::Closed, None, &mut terminate)
            .is_some()
    }

    /// The closest hit of each of many rays, in their order: what [`intersect`](Self::intersect)
    /// says of each, to the bit, and sooner.
    ///
    /// # Panics
    /// When there are not as many places for hits as rays.
    fn intersect_many(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        assert_eq!(rays.len(), hits.len(), "one place for a hit for each ray");
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = self.intersect(ray);
        }
    }

    /// Whether there is any hit, of each of many rays, in their order.
    ///
    /// # Panics
    /// When there are not as many places for answers as rays.
    fn occluded_many(&self, rays: &[Ray], occluded: &mut [bool]) {
        assert_eq!(rays.len(), occluded.len(), "one answer for each ray");
        for (ray, occluded) in rays.iter().zip(occluded) {
            *occluded = self.occluded(ray);
        }
    }

    /// The closest of those hits that `any_hit` accepts.
    #[inline]
    fn trace(&self, ray: &Ray, any_hit: &mut dyn FnMut(&Hit) -> AnyHit) -> Option<Hit> {
        let mut any_hit = |candidate: &Candidate| any_hit(&candidate.hit());
        self.search(&(*ray).into(), EdgeRule::Closed, None, &mut any_hit)
            .map(|candidate| candidate.hit())
    }

    /// Every crossing once, near to far, in place of what `hits` held.
    ///
    /// An edge that two triangles share belongs to one of them here ([`EdgeRule::HalfOpen`]), so
    /// that a line through a closed mesh crosses it an even number of times. A line that only
    /// touches an edge may therefore cross nothing, although [`intersect`](Self::intersect)
    /// reports the touch.
    fn all_hits(&self, ray: &Ray, hits: &mut Vec<Hit>) {
        let mut found = Vec::new();
        let mut collect = |candidate: &Candidate| {
            found.push(*candidate);
            AnyHit::Ignore
        };
        self.search(&(*ray).into(), EdgeRule::HalfOpen, None, &mut collect);
        found.sort_unstable_by(Candidate::order);
        hits.clear();
        hits.extend(found.iter().map(Candidate::hit));
    }

    /// The closest hit, and what it cost to find.
    fn intersect_counted(&self, ray: &Ray) -> (Option<Hit>, Statistics) {
        let mut statistics = Statistics::default();
        let counted = Some(&mut statistics);
        let accept = &mut |_: &Candidate| AnyHit::Accept;
        let closest = self.search(&(*ray).into(), EdgeRule::Closed, counted, accept);
        (closest.map(|candidate| candidate.hit()), statistics)
    }
}
