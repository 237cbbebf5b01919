//! What the structures that cut space have in common: padded boxes, and a ray among planes.
//!
//! Such a structure lists a primitive in every cell that its padded box overlaps, and a crossing
//! counts in the one cell that holds its t. For this the planes cut the ray into disjoint spans,
//! each plane at `(plane − origin) · (1 / direction)`: always this expression, always from the
//! plane's own coordinate. It rounds, but monotonically, so that planes are met in their true order
//! or at the same t; and what the rounding moves is far less than the padding, so a crossing next
//! to a plane is listed on both sides of it.
//!
//! The last half sentence fails for a ray whose origin is so far away that neighbouring planes are
//! met at the same t. Nothing can be cut then, and every primitive is tested if the ray meets the box
//! around all of them.

use std::ops::ControlFlow;
use std::sync::OnceLock;

use ombra_geometry::{Aabb, Axis};

use crate::{Bounded, Reach, Span, TraversalRay, Visitor};

/// Beyond this many extents planes are no longer told apart. Planes and points are off by less than
/// 8 units in the last place of the largest coordinate, 2³² · 2⁻⁵⁰ extents; the padding leaves 2⁻¹⁵.
/// (What counts as a hit may be off by more than that only from beyond 2³⁴ extents.)
const TOLD_APART: f64 = 4_294_967_296.0;

/// Directions for which no product of this module over- or underflows.
const SANE_DIRECTION: std::ops::RangeInclusive<f64> = 1e-150..=1e150;

/// The padded boxes, in the order of the primitives.
pub(crate) fn padded(primitives: &[Bounded], reach: &Reach) -> Vec<Aabb<f64>> {
    let pad = reach.partition_pad();
    let padded = |p: &Bounded| p.bounds.wide().padded(pad);
    primitives.iter().map(padded).collect()
}

/// The box around all cells.
#[derive(Clone, Debug)]
pub(crate) struct Root {
    bounds: Aabb<f64>,
    /// Around the primitives as they are.
    unpadded: Aabb<f64>,
    /// Origins with larger coordinates are too far away; 0 if all are.
    farthest: f64,
    /// Every primitive once, for rays that planes cannot cut. Few scenes ever meet one.
    everything: OnceLock<Vec<u32>>,
}

impl Root {
    pub(crate) fn new(reach: &Reach) -> Self {
        let bounds = reach.bounds().padded(reach.partition_pad());
        let largest = (bounds.min.to_vector().max_norm()).max(bounds.max.to_vector().max_norm());
        let farthest = TOLD_APART * reach.bounds().extent().max_norm();
        Self {
            bounds,
            unpadded: *reach.bounds(),
            farthest: if largest < farthest { farthest } else { 0.0 },
            everything: OnceLock::new(),
        }
    }

    /// Bytes held on the heap.
    pub(crate) fn bytes(&self) -> usize {
        let everything = self.everything.get();
        everything.map_or(0, |list| size_of_val(list.as_slice()))
    }

    /// The padded box around everything.
    pub(crate) const fn bounds(&self) -> &Aabb<f64> {
        &self.bounds
    }

    /// Whether it makes sense to cut: not if everything is in one point or, compared with its
    /// coordinates, as good as in one.
    pub(crate) fn can_be_cut(&self) -> bool {
        self.farthest > 0.0
    }

    /// Takes a ray through the cells by `walk`, or to all primitives where that cannot be done.
    #[inline]
    pub(crate) fn traverse<V: Visitor>(
        &self,
        ray: &TraversalRay,
        references: &[u32],
        visitor: &mut V,
        walk: impl FnOnce(&CellRay, &mut V) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        if references.is_empty() {
            return ControlFlow::Continue(());
        }
        let d = ray.ray.direction;
        let sane = |x: f64| x == 0.0 || SANE_DIRECTION.contains(&x.abs());
        let near = ray.ray.origin.to_vector().max_norm() < self.farthest;
        let sane = sane(d.x) && sane(d.y) && sane(d.z);
        if !(near && sane) {
            // Whether it passes by is only known where nothing overflows.
            if sane
                && ray
                    .clip(ray.inverse_direction(), &self.unpadded, visitor.t_max())
                    .is_none()
            {
                return ControlFlow::Continue(());
            }
            return visitor.leaf(self.everything(references), Span::ALL);
        }
        match CellRay::new(ray, &self.bounds) {
            Some(ray) if ray.enter <= visitor.t_max() => walk(&ray, visitor),
            _ => ControlFlow::Continue(()),
        }
    }

    /// Every primitive once, out of lists that may name it several times.
    #[cold]
    fn everything(&self, references: &[u32]) -> &[u32] {
        self.everything.get_or_init(|| {
            let mut primitives = references.to_vec();
            primitives.sort_unstable();
            primitives.dedup();
            primitives.shrink_to_fit();
            primitives
        })
    }
}

/// A ray that meets the root box, ready to be cut by planes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CellRay {
    origin: [f64; 3],
    direction: [f64; 3],
    /// +∞ where the direction is 0, of either sign.
    inverse: [f64; 3],
    /// Where the ray enters the root box, or begins.
    pub(crate) enter: f64,
    /// Where it leaves the root box: beyond `enter`.
    pub(crate) exit: f64,
}

impl CellRay {
    /// Clips a ray to a box (Kay, Kajiya 1986); `None` if it passes by.
    #[inline]
    fn new(ray: &TraversalRay, bounds: &Aabb<f64>) -> Option<Self> {
        let direction = ray.ray.direction.to_array();
        let inverse = ray.inverse_direction().to_array();
        let mut cut = Self {
            origin: ray.ray.origin.to_vector().to_array(),
            direction,
            inverse: std::array::from_fn(|k| {
                if direction[k] == 0.0 {
                    f64::INFINITY
                } else {
                    inverse[k]
                }
            }),
            enter: ray.ray.t_min,
            exit: f64::INFINITY,
        };
        for axis in Axis::ALL {
            let (min, max) = (bounds.min[axis], bounds.max[axis]);
            if cut.is_still(axis) {
                let origin = cut.origin[axis as usize];
                if !(min <= origin && origin <= max) {
                    return None;
                }
            } else {
                let (a, b) = (cut.crossing(axis, min), cut.crossing(axis, max));
                cut.enter = cut.enter.max(a.min(b));
                cut.exit = cut.exit.min(a.max(b));
            }
        }
        (cut.enter < cut.exit).then_some(cut)
    }

    /// The t at which the ray crosses a plane.
    ///
    /// A ray that is parallel to the plane is told its side: +∞ (for ever below) or, above or in
    /// the plane, −∞ or NaN (for ever above). `!(crossing > t)` is therefore "above at t".
    #[inline]
    pub(crate) fn crossing(&self, axis: Axis, plane: f64) -> f64 {
        (plane - self.origin[axis as usize]) * self.inverse[axis as usize]
    }

    /// Whether the ray runs from above to below along an axis.
    #[inline]
    pub(crate) fn runs_down(&self, axis: Axis) -> bool {
        self.inverse[axis as usize] < 0.0
    }

    /// Whether the ray does not move along an axis.
    #[inline]
    pub(crate) fn is_still(&self, axis: Axis) -> bool {
        self.inverse[axis as usize] == f64::INFINITY
    }

    /// A coordinate of the point at t.
    #[inline]
    pub(crate) fn at(&self, axis: Axis, t: f64) -> f64 {
        self.origin[axis as usize] + self.direction[axis as usize] * t
    }

    /// The span of a cell. The first and the last one are endless.
    #[inline]
    pub(crate) fn span(&self, from: f64, to: f64) -> Span {
        Span {
            from: if from <= self.enter {
                f64::NEG_INFINITY
            } else {
                from
            },
            to: if to >= self.exit { f64::INFINITY } else { to },
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use ombra_geometry::{Point3, Ray};

    fn scene(boxes: impl IntoIterator<Item = Aabb>) -> (Vec<Bounded>, Reach) {
        let numbered = (0..).zip(boxes);
        let primitives: Vec<_> = numbered
            .map(|(primitive, bounds)| Bounded { bounds, primitive })
            .collect();
        let all = primitives
            .iter()
            .fold(Aabb::EMPTY, |all, p| all.union(p.bounds));
        (primitives, Reach::of(&all))
    }

    /// Numbers in `[0, 1)`, always the same ones.
    fn numbers() -> impl FnMut() -> f32 {
        let mut state = 1_u32;
        move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 16_777_216.0
        }
    }

    /// Boxes to build over: few and many, apart and all alike, flat, large and small, far away.
    pub(crate) fn scenes() -> Vec<(Vec<Bounded>, Reach)> {
        let mut next = numbers();
        let mut soup = |count: usize, size: f32, flat: f32, at: f32| {
            let boxes: Vec<_> = (0..count)
                .map(|_| {
                    let mut corner = || Point3::new(next(), next(), next() * flat);
                    let (a, b) = (corner(), corner());
                    let moved = |p: Point3| Point3::new(p.x + at, p.y + at, p.z + at);
                    Aabb::around([moved(a), moved(a.lerp(b, size))])
                })
                .collect();
            scene(boxes)
        };
        let unit = Aabb::around([Point3::ORIGIN, Point3::new(1.0, 1.0, 1.0)]);
        let point = |p: f32| Aabb::around([Point3::new(p, p, p)]);
        vec![
            scene([]),
            scene([unit]),
            scene([point(1e7)]),
            scene([unit; 300]),
            scene([point(0.0), unit, point(1.0)]),
            soup(1000, 0.05, 1.0, 0.0),
            soup(4200, 0.02, 1.0, 0.0),
            soup(300, 1.0, 1.0, 0.0),
            soup(1000, 0.05, 0.0, 0.0),
            soup(300, 0.1, 0.0, 1e7),
            soup(500, 0.1, 1.0, 1e6),
        ]
    }

    /// Every padded box must be listed, once, wherever it overlaps a cell. Cells may be off by
    /// rounding, so boxes are taken a thousandth of their padding smaller.
    pub(crate) fn check_listing(
        primitives: &[Bounded],
        reach: &Reach,
        cells: &[(Aabb<f64>, Vec<u32>)],
    ) {
        let pad = reach.partition_pad();
        let boxes = padded(primitives, reach);
        for (bounds, list) in cells {
            let mut sorted = list.clone();
            sorted.sort_unstable();
            sorted.dedup();
            assert_eq!(sorted.len(), list.len(), "listed twice in {bounds:?}");
            for (p, padded) in primitives.iter().zip(&boxes) {
                let overlaps = !bounds.intersection(padded.padded(-0.001 * pad)).is_empty();
                let listed = sorted.binary_search(&p.primitive).is_ok();
                assert!(listed || !overlaps, "{p:?} is missing in {bounds:?}");
                let apart = bounds.intersection(padded.padded(0.001 * pad)).is_empty();
                assert!(!listed || !apart, "{p:?} does not belong in {bounds:?}");
            }
        }
    }

    #[test]
    fn a_ray_in_a_plane_is_above_it_for_ever() {
        let (_, reach) = scene([Aabb::around([Point3::ORIGIN, Point3::new(2.0, 2.0, 2.0)])]);
        for still in [0.0, -0.0] {
            let ray = Ray::new(
                Point3::new(-1.0, 1.0, 1.0),
                ombra_geometry::Vector3::new(1.0, still, still),
            );
            let ray = TraversalRay::new(&ray, &reach).unwrap();
            let ray = CellRay::new(&ray, reach.bounds()).unwrap();
            assert!(ray.is_still(Axis::Y) && !ray.runs_down(Axis::Y));
            assert!(!(ray.crossing(Axis::Y, 1.0) > f64::MIN));
            assert!(!(ray.crossing(Axis::Y, 0.5) > f64::MIN));
            assert!(ray.crossing(Axis::Y, 1.5) > f64::MAX);
            assert_eq!((ray.enter, ray.exit), (1.0, 3.0));
        }
    }

    #[test]
    fn a_scene_in_one_point_or_as_good_as_in_one_is_not_cut() {
        for (bounds, cut) in [
            (Aabb::around([Point3::new(3.0, 3.0, 3.0)]), false),
            (
                Aabb::around([Point3::new(0.0, 0.0, 1e7), Point3::new(1e-6, 0.0, 1e7)]),
                false,
            ),
            (
                Aabb::around([Point3::ORIGIN, Point3::new(1e-30, 0.0, 0.0)]),
                true,
            ),
        ] {
            assert_eq!(
                Root::new(&Reach::of(&bounds)).can_be_cut(),
                cut,
                "{bounds:?}"
            );
        }
    }
}
