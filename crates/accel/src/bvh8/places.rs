//! The triangles in the leaves as primitives of their own, for plain walks where no mesh is at hand.
//!
//! A walk shows primitives by number and [`Primitives`] find them by it. In leaves triangles are not
//! in the order of their numbers, so here what a walk shows is the place of a triangle, and its
//! number comes in only with a hit.

use std::ops::ControlFlow;

use arrayvec::ArrayVec;
use ombra_geometry::triangle::{PreparedTriangleTest, TriangleTest};
use ombra_geometry::{Aabb, EdgeRule, Point3};

use super::node::{Child, WIDTH};
use super::quad::{NUMBERS, Quad};
use super::store::Store;
use crate::{AnyHit, Candidate, Counter, Primitives, TraversalRay};

/// Where a triangle lies: the first quad of its leaf, times 8, plus its number within the leaf; the
/// highest bit says whether the leaf has eight places and not four.
const EIGHT: u32 = 1 << 31;

/// The places of a leaf. Those without a triangle are among them: no ray crosses what lies there.
pub(super) fn places(leaf: Child) -> ArrayVec<u32, WIDTH> {
    let places = leaf.places() as u32;
    let eight = if places == 8 { EIGHT } else { 0 };
    let first = 8 * leaf.quad() as u32;
    (0..places).map(|k| eight | (first + k)).collect()
}

/// The triangles in the leaves.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    pub(super) quads: Store<Quad>,
    /// All numbers of triangles are below this.
    pub(super) triangles: u32,
}

impl Places {
    /// Component c of the triangle at a place: see [`Quad`].
    fn component(&self, place: u32, component: usize) -> f32 {
        let stride = if place & EIGHT == 0 { 4 } else { 8 };
        let place = (place & !EIGHT) as usize;
        let at = stride * component + place % 8;
        self.quads[place / 8 + at / NUMBERS].numbers[at % NUMBERS]
    }

    pub(super) fn corners(&self, place: u32) -> [Point3; 3] {
        [0, 3, 6].map(|k| Point3::from([k, k + 1, k + 2].map(|c| self.component(place, c))))
    }

    pub(super) fn number(&self, place: u32) -> u32 {
        self.component(place, 9).to_bits()
    }
}

impl Primitives for Places {
    type Prepared = PreparedTriangleTest;

    fn len(&self) -> usize {
        self.triangles as usize
    }

    fn bounds(&self, place: u32) -> Aabb {
        Aabb::around(self.corners(place))
    }

    fn prepare(&self, ray: &TraversalRay, rule: EdgeRule) -> Self::Prepared {
        TriangleTest::Watertight.prepare(&ray.ray, ray.single(), rule)
    }

    fn crossings<C: Counter, F: FnMut(&Candidate) -> AnyHit>(
        &self,
        prepared: &Self::Prepared,
        _ray: &TraversalRay,
        _t_max: f64,
        place: u32,
        counter: &mut C,
        report: &mut F,
    ) -> ControlFlow<()> {
        let number = self.number(place);
        if number == u32::MAX {
            return ControlFlow::Continue(());
        }
        counter.test();
        if let Some(crossing) = prepared.crossing(self.corners(place))
            && report(&Candidate::new(crossing, number)) == AnyHit::Terminate
        {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    /// None: the quads belong to the structure and are counted there.
    fn bytes(&self) -> usize {
        0
    }
}
