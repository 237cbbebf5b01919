//! Two levels: a geometry is built once and placed many times.

use std::ops::ControlFlow;
use std::sync::Arc;

use ombra_geometry::{Aabb, EdgeRule, GeometryId, InstanceId, Object, Transform, World};

use crate::{Accel, AnyHit, Candidate, Counter, Primitives, Traversable as _, TraversalRay};

/// One placement of a geometry.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Which geometry.
    pub geometry: GeometryId,
    /// Where it stands.
    pub world_from_object: Transform<Object, World>,
}

/// Geometries and their placements: the primitives of the top level.
///
/// A hit's `instance` is the index of the placement, its `geometry` that of the geometry.
#[derive(Clone, Debug)]
pub struct Instances<P> {
    geometries: Vec<Arc<Accel<P>>>,
    instances: Vec<Instance>,
    /// In the order of `instances`; `None` where the placement moves nothing, so that a geometry
    /// placed as it is answers bit for bit like the geometry alone.
    object_from_world: Vec<Option<Transform<World, Object>>>,
    /// In the order of `instances`: each hit asks for the box of its instance.
    bounds: Vec<Aabb>,
}

impl<P: Primitives> Instances<P> {
    /// From geometries and placements.
    ///
    /// # Panics
    /// When a placement names a geometry that is not there.
    #[must_use]
    pub fn new(geometries: Vec<Arc<Accel<P>>>, instances: Vec<Instance>) -> Self {
        assert!(
            instances
                .iter()
                .all(|i| i.geometry.index() < geometries.len()),
            "an instance names a geometry that is not there"
        );
        let object_from_world = instances
            .iter()
            .map(|i| (!i.world_from_object.is_identity()).then(|| i.world_from_object.inverse()))
            .collect();
        let bounds = instances
            .iter()
            .map(|i| bounds_of(i, &geometries[i.geometry.index()]))
            .collect();
        Self {
            geometries,
            instances,
            object_from_world,
            bounds,
        }
    }

    /// The geometries.
    #[must_use]
    pub fn geometries(&self) -> &[Arc<Accel<P>>] {
        &self.geometries
    }

    /// The placements.
    #[must_use]
    pub fn instances(&self) -> &[Instance] {
        &self.instances
    }
}

impl<P: Primitives> Primitives for Instances<P> {
    type Prepared = EdgeRule;

    fn len(&self) -> usize {
        self.instances.len()
    }

    fn bounds(&self, primitive: u32) -> Aabb {
        self.bounds[primitive as usize]
    }

    fn prepare(&self, _ray: &TraversalRay, rule: EdgeRule) -> Self::Prepared {
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
        counter.test();
        let geometry = self.instances[primitive as usize].geometry;
        let mut local = match &self.object_from_world[primitive as usize] {
            None => ray.ray,
            Some(object_from_world) => object_from_world.ray(&ray.ray),
        };
        local.t_max = t_max;
        let mut terminated = ControlFlow::Continue(());
        let mut place = |candidate: &Candidate| {
            let placed = Candidate {
                geometry,
                instance: InstanceId(primitive),
                ..*candidate
            };
            let answer = report(&placed);
            if answer == AnyHit::Terminate {
                terminated = ControlFlow::Break(());
            }
            answer
        };
        self.geometries[geometry.index()].search_with(&local, *rule, counter, &mut place);
        terminated
    }

    fn bytes(&self) -> usize {
        self.geometries.iter().map(|g| g.bytes()).sum::<usize>()
            + size_of_val(self.instances.as_slice())
            + size_of_val(self.object_from_world.as_slice())
            + size_of_val(self.bounds.as_slice())
    }
}

/// The box around a placed geometry, and around every hit on it.
fn bounds_of<P: Primitives>(instance: &Instance, geometry: &Accel<P>) -> Aabb {
    // A hit found in object space can lie a little outside the geometry's bounds, and an uneven
    // scale can make that more than the level above allows for. Where nothing is moved it does not.
    if instance.world_from_object.is_identity() {
        geometry.bounds()
    } else {
        let around_hits = geometry.hit_bounds();
        instance.world_from_object.aabb(&around_hits)
    }
}
