//! Two levels: a geometry is built once and placed many times.

use std::ops::ControlFlow;
use std::sync::Arc;

use ombra_geometry::{Aabb, EdgeRule, GeometryId, InstanceId, Object, Transform, World};

use crate::{Accel, AnyHit, Candidate, Counter, Primitives, Traversable, TraversalRay};

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
        Self {
            geometries,
            instances,
            object_from_world,
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
        let instance = &self.instances[primitive as usize];
        let geometry = &self.geometries[instance.geometry.index()];
        // A hit found in object space can lie a little outside the geometry's bounds, and an uneven
        // scale can make that more than this level allows for. Where nothing is moved it does not.
        match self.object_from_world[primitive as usize] {
            None => geometry.bounds(),
            Some(_) => instance.world_from_object.aabb(&geometry.hit_bounds()),
        }
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
        self.geometries[geometry.index()].search(&local, *rule, counter, |candidate| {
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
        });
        terminated
    }

    fn bytes(&self) -> usize {
        self.geometries.iter().map(|g| g.bytes()).sum::<usize>()
            + size_of_val(self.instances.as_slice())
            + size_of_val(self.object_from_world.as_slice())
    }
}
