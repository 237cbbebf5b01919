//! What a structure stands over: things with a box that a ray can be tested against.

mod geometry;
mod mesh;
mod shapes;

use std::cmp::Ordering;
use std::ops::ControlFlow;

use ombra_geometry::{
    Aabb, Crossing, EdgeRule, GeometryId, Hit, InstanceId, PrimitiveId, Ray, TriangleMesh,
};

use crate::{Counter, Reach, TraversalRay};

pub use geometry::Geometry;
pub use mesh::Mesh;
pub use shapes::Shapes;

/// A list of primitives.
pub trait Primitives: Send + Sync {
    /// What is worked out once a ray.
    type Prepared;

    /// How many there are: at most 2³² − 1.
    fn len(&self) -> usize;

    /// Whether there are none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The box around one. It may be unbounded; a primitive whose box is empty or NaN is never hit.
    fn bounds(&self, primitive: u32) -> Aabb;

    /// Works out what only depends on the ray.
    fn prepare(&self, ray: &TraversalRay, rule: EdgeRule) -> Self::Prepared;

    /// Reports the crossings of the ray with one primitive, t in `[t_min, t_max]` (the ray's own
    /// `t_max` is out of date), and heeds the answer.
    ///
    /// # Errors
    /// `Break` if a report was answered with [`AnyHit::Terminate`].
    fn crossings<C: Counter, F: FnMut(&Candidate) -> AnyHit>(
        &self,
        prepared: &Self::Prepared,
        ray: &TraversalRay,
        t_max: f64,
        primitive: u32,
        counter: &mut C,
        report: &mut F,
    ) -> ControlFlow<()>;

    /// Bytes held on the heap, structures of a lower level included.
    fn bytes(&self) -> usize;

    /// The triangles, if that is what these are and they are tested by the watertight test.
    fn watertight(&self) -> Option<&TriangleMesh> {
        None
    }

    /// The closest hits of many rays, if there is a quicker way than one ray after another: by whoever
    /// has structures of its own below. No if there is none, and then nothing is done. `slow` is told
    /// which rays have to be asked for one by one all the same.
    fn closest_many(
        &self,
        rays: &[Ray],
        hits: &mut [Option<Hit>],
        reach: &Reach,
        slow: &mut dyn FnMut(usize),
    ) -> bool {
        let _ = (rays, hits, reach, slow);
        false
    }

    /// The same of whether there are hits.
    fn any_many(
        &self,
        rays: &[Ray],
        hits: &mut [bool],
        reach: &Reach,
        slow: &mut dyn FnMut(usize),
    ) -> bool {
        let _ = (rays, hits, reach, slow);
        false
    }

    /// The same list where its primitives need nothing worked out for a ray, so that a level above
    /// may test them itself.
    fn plain(&self) -> Option<&Shapes> {
        None
    }
}

/// What to make of a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnyHit {
    /// It counts: look only for nearer ones from here on.
    Accept,
    /// As if it were not there.
    Ignore,
    /// It counts, and it is enough: look no further.
    Terminate,
}

/// A crossing that may become the hit: ids, and t in the precision in which it was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// Where on the ray.
    pub t: f64,
    /// See [`Hit::u`].
    pub u: f32,
    /// See [`Hit::v`].
    pub v: f32,
    /// Which primitive of the geometry.
    pub primitive: PrimitiveId,
    /// Which geometry.
    pub geometry: GeometryId,
    /// Which placement of the geometry.
    pub instance: InstanceId,
}

impl Candidate {
    /// Of a primitive on its own; instancing fills in the rest.
    #[must_use]
    #[inline]
    pub fn new(crossing: Crossing, primitive: u32) -> Self {
        Self {
            t: crossing.t,
            u: crossing.u,
            v: crossing.v,
            primitive: PrimitiveId(primitive),
            geometry: GeometryId(0),
            instance: InstanceId(0),
        }
    }

    /// As the answer to a query; here `t` is rounded, once.
    #[must_use]
    #[inline]
    pub fn hit(&self) -> Hit {
        Hit {
            t: self.t as f32,
            u: self.u,
            v: self.v,
            primitive: self.primitive,
            geometry: self.geometry,
            instance: self.instance,
        }
    }

    /// The order of hits: the nearer first, of equally near ones that with the smaller ids (see
    /// [`Hit`]).
    #[must_use]
    #[inline]
    pub fn order(&self, other: &Self) -> Ordering {
        let ids = |c: &Self| (c.instance, c.geometry, c.primitive);
        // Not `total_cmp`: 0 and −0 are equally near. A crossing's t is not NaN.
        let nearer = self.t.partial_cmp(&other.t).unwrap_or(Ordering::Equal);
        nearer.then_with(|| ids(self).cmp(&ids(other)))
    }

    /// Whether this comes before another one in that [order](Self::order).
    #[must_use]
    #[inline]
    pub fn precedes(&self, other: &Self) -> bool {
        self.order(other).is_lt()
    }
}
