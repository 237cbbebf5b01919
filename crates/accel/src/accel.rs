//! A structure over primitives: what answers queries.

use std::path::Path;

use ombra_geometry::{Aabb, EdgeRule, Hit, Ray};
use rayon::prelude::*;

use crate::bvh8::file::StructureFileError;
use crate::bvh8::{Bvh8, Item, Level};
use crate::search::Search;
use crate::{
    AnyHit, AnyStructure, Bounded, Candidate, Counter, Primitives, Reach, Span, Statistics,
    StructureKind, Traversable, TraversalRay, Visitor,
};

/// Primitives with a structure over them.
#[derive(Clone, Debug)]
pub struct Accel<P> {
    primitives: P,
    structure: AnyStructure,
    /// Endless primitives: they have no place in any structure and are tested for every ray.
    unbounded: Vec<u32>,
    reach: Reach,
    bounds: Aabb,
}

impl<P: Primitives> Accel<P> {
    /// Builds the named structure. Primitives with an empty or NaN box are left out.
    ///
    /// # Panics
    /// When there are 2³² primitives or more: an id has 32 bits. A mesh cannot have so many.
    #[must_use]
    pub fn build(primitives: P, kind: StructureKind) -> Self {
        let count = u32::try_from(primitives.len()).expect("ids of primitives have 32 bits");
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
        let reach = Reach::of(&bounds);
        let structure = match kind {
            StructureKind::Bvh8 => {
                let item = |own: &Bounded| Item::new(&own.bounds, own.primitive);
                let items = bounded.iter().map(item).collect();
                AnyStructure::Bvh8(Bvh8::new(items, &reach, primitives.watertight()))
            }
            _ => kind.build(&bounded, &reach),
        };
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
    /// load: a `bvh8` over triangles that are tested by the watertight test. The file is written
    /// beside the path and renamed when it is whole.
    ///
    /// # Errors
    /// When it is another structure, or over something else, or the file cannot be written; what was
    /// at the path before is still there then.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), StructureFileError> {
        let path = path.as_ref();
        let saved = match &self.structure {
            AnyStructure::Bvh8(bvh) => {
                let triangles = self.primitives.len() as u32;
                bvh.tree.save(path, self.bounds, triangles)
            }
            _ => None,
        };
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
        if let AnyStructure::Bvh8(bvh) = &mut self.structure {
            bvh.tree.level = level;
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
        if let AnyStructure::Bvh8(bvh) = &self.structure
            && let Some(found) = bvh.tree.search(&ray, rule, counter, any_hit)
        {
            return found;
        }
        let mut search = Search::new(&self.primitives, &ray, rule, counter, any_hit);
        if search.leaf(&self.unbounded, Span::ALL).is_continue() {
            // Broken off or not, what was accepted is in the search.
            let _ = self.structure.traverse(&ray, &mut search);
        }
        search.best()
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
        if let AnyStructure::Bvh8(bvh) = &self.structure
            && let Some(closest) = bvh.tree.closest(ray)
        {
            return closest.map(|candidate| candidate.hit());
        }
        let mut accept = |_: &Candidate| AnyHit::Accept;
        self.search(&(*ray).into(), EdgeRule::Closed, None, &mut accept)
            .map(|candidate| candidate.hit())
    }

    fn occluded(&self, ray: &Ray<f32>) -> bool {
        if let AnyStructure::Bvh8(bvh) = &self.structure
            && let Some(occluded) = bvh.tree.any(ray)
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
        if let AnyStructure::Bvh8(bvh) = &self.structure
            && bvh
                .tree
                .closest_many(rays, hits, &mut |index| slow.push(index))
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
        if let AnyStructure::Bvh8(bvh) = &self.structure
            && bvh
                .tree
                .any_many(rays, occluded, &mut |index| slow.push(index))
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
