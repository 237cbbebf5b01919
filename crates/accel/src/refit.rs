//! Meshes whose vertices move.

use ombra_geometry::{Aabb, TriangleMesh};
use rayon::prelude::*;

use crate::bvh8::Wide;
use crate::{Accel, Mesh, Primitives, Reach};

impl Accel<Mesh> {
    /// Takes a mesh with the same triangles, whose vertices may have moved. Answers are those of a
    /// structure built anew. Says whether the structure was kept; if not, it was built anew.
    ///
    /// Of the wide trees boxes alone are worked out again, which takes a fraction of a build; the more
    /// vertices have moved against each other, the more of what is then found a new build would
    /// spare. A structure is built anew if it is of another kind, if triangles differ, or if another
    /// one than before has a corner that is not finite.
    pub fn refit(&mut self, mesh: Mesh) -> bool {
        let kept = self.refit_in_place(&mesh);
        if kept {
            self.primitives = mesh;
        } else {
            *self = Self::build(mesh, self.structure.kind());
        }
        kept
    }

    fn refit_in_place(&mut self, mesh: &Mesh) -> bool {
        let (old, new) = (self.primitives.watertight(), mesh.watertight());
        let (Some(old), Some(new)) = (old, new) else {
            return false;
        };
        if self.structure.wide().is_none() || old.triangles() != new.triangles() {
            return false;
        }
        let finite = |mesh: &TriangleMesh, triangle: usize| {
            let bounds = mesh.triangle_bounds(triangle);
            (!bounds.is_empty() && bounds.is_finite()).then_some(bounds)
        };
        // `None` if a triangle had a place in the tree before or has one now, but not both.
        let around = (0..new.triangles().len())
            .into_par_iter()
            .map(
                |triangle| match (finite(old, triangle), finite(new, triangle)) {
                    (Some(_), Some(bounds)) => Some(bounds),
                    (None, None) => Some(Aabb::EMPTY),
                    _ => None,
                },
            )
            .try_reduce(|| Aabb::EMPTY, |a, b| Some(a.union(b)));
        // Those without an end stay as they are only if there are none.
        let Some(bounds) = around.filter(|_| self.unbounded.is_empty()) else {
            return false;
        };
        let reach = Reach::of(&bounds);
        let refit = |tree: &mut Wide| tree.refit(new, &reach);
        if !self.structure.wide_mut().is_some_and(refit) {
            return false;
        }
        (self.reach, self.bounds) = (reach, bounds);
        true
    }
}
