//! A structure over primitives: what answers queries.

use std::ops::ControlFlow;
use std::path::Path;

use ombra_geometry::{Aabb, EdgeRule, Hit, Ray};
use rayon::prelude::*;

use crate::bvh8::file::StructureFileError;
use crate::bvh8::{Bvh8, Care, Items, Level, Shown, Wide};
use crate::distance::Boxes;
use crate::search::Search;
use crate::{
    AnyHit, AnyStructure, Bounded, Candidate, Counter, Measured, Nearby, Place, Primitives, Reach,
    Span, Statistics, StructureKind, Traversable, TraversalRay, Visitor,
};

/// Primitives with a structure over them.
#[derive(Clone, Debug)]
pub struct Accel<P> {
    pub(crate) primitives: P,
    pub(crate) structure: AnyStructure,
    /// Endless primitives: they have no place in any structure and are tested for every ray.
    pub(crate) unbounded: Vec<u32>,
    pub(crate) reach: Reach,
    pub(crate) bounds: Aabb,
}

impl<P: Primitives> Accel<P> {
    /// Builds the named structure. Primitives with an empty or NaN box are left out.
    ///
    /// # Panics
    /// When there are 2³² primitives or more: an id has 32 bits. A mesh cannot have so many.
    #[must_use]
    pub fn build(primitives: P, kind: StructureKind) -> Self {
        let count = u32::try_from(primitives.len()).expect("ids of primitives have 32 bits");
        let (structure, unbounded, mut bounds) = match kind {
            StructureKind::Bvh8 => Self::build_wide(&primitives, AnyStructure::Bvh8),
            StructureKind::Bvh8Fast => Self::build_wide(&primitives, AnyStructure::Bvh8Fast),
            StructureKind::Bvh8High => Self::build_wide(&primitives, AnyStructure::Bvh8High),
            StructureKind::Bvh8Compact => Self::build_wide(&primitives, AnyStructure::Bvh8Compact),
            _ => Self::build_plain(&primitives, count, kind),
        };
        let reach = Reach::of(&bounds);
        if !unbounded.is_empty() {
            bounds = Aabb::UNBOUNDED;
        }
        Self {
            primitives,
            structure,
            unbounded,
            reach,
            bounds,
        }
    }

    /// Builds a wide tree; and says which primitives it leaves out since they have no end, and the box
    /// around the others.
    fn build_wide<C: Care>(
        primitives: &P,
        any: fn(Bvh8<C>) -> AnyStructure,
    ) -> (AnyStructure, Vec<u32>, Aabb) {
        let mut items = Items::of(primitives);
        let unbounded = std::mem::take(&mut items.unbounded);
        let bounds = items.bounds.bounds();
        let bounds_of = |primitive| primitives.bounds(primitive);
        let (reach, mesh) = (Reach::of(&bounds), primitives.watertight());
        let tree = Bvh8::new(items, &reach, mesh, &bounds_of);
        (any(tree), unbounded, bounds)
    }

    /// Builds a structure of a kind that sees nothing but boxes; and those primitives that it leaves
    /// out since they have no end, and the box around the others.
    fn build_plain(
        primitives: &P,
        count: u32,
        kind: StructureKind,
    ) -> (AnyStructure, Vec<u32>, Aabb) {
        let mut unbounded = Vec::new();
        let mut bounds = Aabb::EMPTY;
        let mut bounded: Vec<_> = (0..count)
            .into_par_iter()
            .map(|primitive| Bounded {
                bounds: primitives.bounds(primitive),
                primitive,
            })
            .collect();
        bounded.retain(|own| {
            if own.bounds.is_empty() {
                return false;
            }
            let finite = own.bounds.is_finite();
            if finite {
                bounds = bounds.union(own.bounds);
            } else {
                unbounded.push(own.primitive);
            }
            finite
        });
        let structure = kind.build(&bounded, &Reach::of(&bounds));
        (structure, unbounded, bounds)
    }

    /// Of a structure that was built before. No primitive is endless.
    pub(crate) const fn of_parts(
        primitives: P,
        structure: AnyStructure,
        reach: Reach,
        bounds: Aabb,
    ) -> Self {
        Self {
            primitives,
            structure,
            unbounded: Vec::new(),
            reach,
            bounds,
        }
    }

    /// Saves the structure with all that it traces, for [`TriangleTree`](crate::TriangleTree) to
    /// load: a wide tree (`bvh8`, `bvh8-fast`, `bvh8-high`) over triangles that are tested by the
    /// watertight test. The file is written beside the path and renamed when it is whole.
    ///
    /// # Errors
    /// When it is another structure, or over something else, or the file cannot be written; what was
    /// at the path before is still there then.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), StructureFileError> {
        let path = path.as_ref();
        // What has no end would be left out.
        let tree = self.structure.wide().filter(|_| self.unbounded.is_empty());
        let triangles = self.primitives.len() as u32;
        let saved = tree.and_then(|tree| tree.save(path, self.bounds, triangles));
        saved.unwrap_or_else(|| {
            let (path, kind) = (path.to_owned(), self.structure.kind());
            Err(StructureFileError::NotSaved { path, kind })
        })
    }

    /// The primitives.
    #[must_use]
    pub const fn primitives(&self) -> &P {
        &self.primitives
    }

    /// What bounds the rounding of queries.
    pub(crate) const fn reach(&self) -> &Reach {
        &self.reach
    }

    /// The same, traced with a level of instructions that is not the best one of this machine. What
    /// is not traced by kernels stays as it is.
    ///
    /// # Panics
    /// When this machine does not have the level.
    #[must_use]
    pub fn at_level(mut self, level: Level) -> Self {
        assert!(
            Level::available().contains(&level),
            "this machine does not have the level {level:?}"
        );
        if let Some(tree) = self.structure.wide_mut() {
            tree.level = level;
        }
        self
    }

    /// Bytes of the structure alone.
    #[must_use]
    pub fn structure_bytes(&self) -> usize {
        self.structure.bytes() + size_of_val(self.unbounded.as_slice())
    }
}

impl<P: Primitives> Accel<P> {
    /// See [`Traversable::search`].
    pub(crate) fn search_with<C: Counter>(
        &self,
        ray: &Ray<f64>,
        rule: EdgeRule,
        counter: &mut C,
        any_hit: &mut dyn FnMut(&Candidate) -> AnyHit,
    ) -> Option<Candidate> {
        let ray = TraversalRay::new(ray, &self.reach)?;
        if self.structure.wide().is_some_and(Wide::repeats) {
            let mut shown = Shown::default();
            let mut any_hit = |candidate: &Candidate| shown.ask(candidate, any_hit);
            return self.search_ready(&ray, rule, counter, &mut any_hit);
        }
        self.search_ready(&ray, rule, counter, any_hit)
    }

    /// The same for a ray made ready, where `any_hit` may be asked about a triangle more than once.
    fn search_ready<C: Counter>(
        &self,
        ray: &TraversalRay,
        rule: EdgeRule,
        counter: &mut C,
        any_hit: &mut dyn FnMut(&Candidate) -> AnyHit,
    ) -> Option<Candidate> {
        if let Some(tree) = self.structure.wide()
            && let Some(found) = tree.search(ray, rule, counter, any_hit)
        {
            return found;
        }
        self.search_among(&self.primitives, ray, rule, counter, any_hit)
    }

    /// The same among primitives that are these, or fewer of them.
    pub(crate) fn search_among<Q: Primitives, C: Counter>(
        &self,
        primitives: &Q,
        ray: &TraversalRay,
        rule: EdgeRule,
        counter: &mut C,
        any_hit: &mut dyn FnMut(&Candidate) -> AnyHit,
    ) -> Option<Candidate> {
        let mut search = Search::new(primitives, ray, rule, counter, any_hit);
        if search.leaf(&self.unbounded, Span::ALL).is_continue() {
            // Broken off or not, what was accepted is in the search.
            let _ = self.structure.traverse(ray, &mut search);
        }
        search.best()
    }
}

impl<P: Measured> Accel<P> {
    /// Shows all primitives that may be near enough; see [`Distances`](crate::Distances).
    pub(crate) fn measure(&self, place: &Place<'_>, nearby: &mut Nearby) -> ControlFlow<()> {
        let measure = |list: &[u32], nearby: &mut Nearby| {
            list.iter()
                .try_for_each(|&own| self.primitives.measure(own, place, nearby))
        };
        if let Some(tree) = self.structure.wide() {
            measure(&self.unbounded, nearby)?;
            let boxes = Boxes::new(place, &self.reach);
            return tree.measure(&boxes, nearby, measure);
        }
        (0..self.primitives.len() as u32)
            .filter(|&own| !self.primitives.bounds(own).is_empty())
            .try_for_each(|own| self.primitives.measure(own, place, nearby))
    }
}

impl<P: Primitives> Traversable for Accel<P> {
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

    fn intersect(&self, ray: &Ray<f32>) -> Option<Hit> {
        if let Some(tree) = self.structure.wide()
            && let Some(closest) = tree.closest(ray)
        {
            return closest.map(|candidate| candidate.hit());
        }
        let mut accept = |_: &Candidate| AnyHit::Accept;
        self.search(&(*ray).into(), EdgeRule::Closed, None, &mut accept)
            .map(|candidate| candidate.hit())
    }

    fn occluded(&self, ray: &Ray<f32>) -> bool {
        if let Some(tree) = self.structure.wide()
            && let Some(occluded) = tree.any(ray)
        {
            return occluded;
        }
        let mut terminate = |_: &Candidate| AnyHit::Terminate;
        self.search(&(*ray).into(), EdgeRule::Closed, None, &mut terminate)
            .is_some()
    }

    fn intersect_many(&self, rays: &[Ray<f32>], hits: &mut [Option<Hit>]) {
        assert_eq!(rays.len(), hits.len(), "one place for a hit for each ray");
        let mut slow = Vec::new();
        let mut later = |index| slow.push(index);
        let tree = self.structure.wide();
        if tree.is_some_and(|tree| tree.closest_many(rays, hits, &mut later))
            || (self.primitives).closest_many(rays, hits, &self.reach, &mut later)
        {
            for index in slow {
                hits[index] = self.intersect(&rays[index]);
            }
            return;
        }
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = self.intersect(ray);
        }
    }

    fn occluded_many(&self, rays: &[Ray<f32>], occluded: &mut [bool]) {
        assert_eq!(rays.len(), occluded.len(), "one answer for each ray");
        let mut slow = Vec::new();
        let mut later = |index| slow.push(index);
        let tree = self.structure.wide();
        if tree.is_some_and(|tree| tree.any_many(rays, occluded, &mut later))
            || (self.primitives).any_many(rays, occluded, &self.reach, &mut later)
        {
            for index in slow {
                occluded[index] = self.occluded(&rays[index]);
            }
            return;
        }
        for (ray, occluded) in rays.iter().zip(occluded) {
            *occluded = self.occluded(ray);
        }
    }

    fn bounds(&self) -> Aabb {
        self.bounds
    }

    fn bytes(&self) -> usize {
        self.structure_bytes() + self.primitives.bytes()
    }
}
