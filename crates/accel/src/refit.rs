//! Meshes whose vertices move.

use ombra_geometry::{Aabb, Point3, TriangleMesh, Vector3};
use rayon::prelude::*;

use crate::bvh8::{Moved, Wide};
use crate::{Accel, Mesh, Primitives, Reach};

impl Accel<Mesh> {
    /// Takes a mesh with the same triangles, whose vertices may have moved. Answers are those of a
    /// structure built anew. Says whether the structure was kept; if not, it was built anew.
    ///
    /// Of the wide trees boxes alone are worked out again, which takes a fraction of a build; the more
    /// vertices have moved against each other, the more of what is then found a new build would
    /// spare. Where no more than one triangle in sixteen moved, nothing but what is on the way to them
    /// is looked at. A structure is built anew if it is of another kind or compact, if triangles
    /// differ, or if another one than before has a corner that is not finite.
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
        let can = self.structure.wide().is_some_and(Wide::can_be_refitted);
        if !can || old.triangles() != new.triangles() {
            return false;
        }
        // Those without an end stay as they are only if there are none.
        if !self.unbounded.is_empty() {
            return false;
        }
        let numbers = moved(old, new);
        if numbers.len() * FEW <= new.triangles().len() {
            let Some((moved, bounds)) = few(old, new, &numbers, &self.bounds) else {
                return false;
            };
            let reach = Reach::of(&bounds);
            return self.refitted(reach, bounds, |tree| tree.refit_some(new, &moved, &reach));
        }
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
        let Some(bounds) = around else {
            return false;
        };
        let reach = Reach::of(&bounds);
        self.refitted(reach, bounds, |tree| tree.refit(new, &reach))
    }

    fn refitted(
        &mut self,
        reach: Reach,
        bounds: Aabb,
        refit: impl FnOnce(&mut Wide) -> bool,
    ) -> bool {
        let kept = self.structure.wide_mut().is_some_and(refit);
        if kept {
            (self.reach, self.bounds) = (reach, bounds);
        }
        kept
    }
}

/// One triangle in so many is few.
const FEW: usize = 16;

/// The box of a triangle that has a place in a tree.
fn finite(mesh: &TriangleMesh, triangle: usize) -> Option<Aabb> {
    let bounds = mesh.triangle_bounds(triangle);
    (!bounds.is_empty() && bounds.is_finite()).then_some(bounds)
}

/// The triangles of these numbers that have a place in a tree, and the box around all triangles now, which
/// was `hull`; `None` if one has a place where it had none, or the other way.
fn few(
    old: &TriangleMesh,
    new: &TriangleMesh,
    numbers: &[u32],
    hull: &Aabb,
) -> Option<(Vec<Moved>, Aabb)> {
    let mut moved = Vec::with_capacity(numbers.len());
    let mut bounds = *hull;
    for &triangle in numbers {
        let place = triangle as usize;
        match (finite(old, place), finite(new, place)) {
            (Some(was), Some(is)) => {
                bounds = bounds.union(is);
                moved.push(Moved { triangle, was });
            }
            (None, None) => {}
            _ => return None,
        }
    }
    // What lay on the outside may have been all that reached so far.
    if !moved.iter().all(|moved| is_within(&moved.was, hull)) {
        let all = (0..new.triangles().len()).into_par_iter();
        bounds = all
            .filter_map(|triangle| finite(new, triangle))
            .reduce(|| Aabb::EMPTY, Aabb::union);
    }
    Some((moved, bounds))
}

/// The triangles of which a corner moved, in the order of their numbers.
fn moved(old: &TriangleMesh, new: &TriangleMesh) -> Vec<u32> {
    let bits = |p: &Point3| p.to_array().map(f32::to_bits);
    let pairs = old.positions().par_iter().zip(new.positions());
    let moves: Vec<bool> = pairs.map(|(old, new)| bits(old) != bits(new)).collect();
    let corners = new.triangles().par_iter().enumerate();
    corners
        .filter(|(_, corners)| corners.iter().any(|&corner| moves[corner as usize]))
        .map(|(triangle, _)| triangle as u32)
        .collect()
}

/// Whether a box does not touch the faces of another one, from inside.
fn is_within(inner: &Aabb, outer: &Aabb) -> bool {
    let [low, high] = [inner.min - outer.min, outer.max - inner.max].map(Vector3::to_array);
    low.into_iter().chain(high).all(|margin| margin > 0.0)
}
