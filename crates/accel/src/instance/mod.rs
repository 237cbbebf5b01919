//! Two levels: a geometry is built once and placed many times.

mod in_turn;

use std::ops::ControlFlow;
use std::sync::Arc;

use ombra_geometry::{Aabb, EdgeRule, GeometryId, Hit, InstanceId, Object, Ray, Transform, World};

use crate::distance::Placed;
use crate::{
    Accel, AnyHit, Candidate, Counter, Measured, Nearby, NoDistance, Place, Primitives, Reach,
    Traversable as _, TraversalRay,
};

/// One placement of a geometry.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Which geometry.
    pub geometry: GeometryId,
    /// Where it stands.
    pub world_from_object: Transform<Object, World>,
    /// What sees it: a query whose mask has a bit in common with this one. A query that names no mask
    /// has all bits, so nothing sees an instance whose mask is 0.
    pub mask: u32,
}

impl Instance {
    /// Seen by every query.
    #[must_use]
    pub const fn new(geometry: GeometryId, world_from_object: Transform<Object, World>) -> Self {
        Self {
            geometry,
            world_from_object,
            mask: u32::MAX,
        }
    }
}

/// Geometries and their placements: the primitives of the top level.
///
/// A hit's `instance` is the index of the placement, its `geometry` that of the geometry.
///
/// A list of shapes that is placed once, or that has but one, does without a level of its own: each
/// of its shapes is a primitive here. To make a ray ready for a structure costs more than to test a
/// few shapes.
#[derive(Clone, Debug)]
pub struct Instances<P> {
    geometries: Vec<Arc<Accel<P>>>,
    instances: Vec<Instance>,
    /// In the order of `instances`; `None` where the placement moves nothing, so that a geometry
    /// placed as it is answers bit for bit like the geometry alone.
    object_from_world: Vec<Option<Transform<World, Object>>>,
    entries: Vec<Entry>,
    /// In the order of `entries`: each hit asks for the box of its primitive.
    bounds: Vec<Aabb>,
}

/// A primitive of the top level.
#[derive(Clone, Copy, Debug)]
struct Entry {
    instance: u32,
    geometry: GeometryId,
    mask: u32,
    /// A shape of that instance; otherwise it is all of it.
    shape: Option<u32>,
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
        let mut placed = vec![0_u32; geometries.len()];
        for instance in &instances {
            placed[instance.geometry.index()] += 1;
        }
        let mut entries = Vec::with_capacity(instances.len());
        let mut bounds = Vec::with_capacity(instances.len());
        for (index, instance) in (0..).zip(&instances) {
            let geometry = &geometries[instance.geometry.index()];
            let shapes = geometry.primitives().plain();
            let once = placed[instance.geometry.index()] == 1;
            if let Some(shapes) = shapes.filter(|shapes| once || shapes.len() == 1) {
                for shape in 0..shapes.len() as u32 {
                    entries.push(Entry {
                        instance: index,
                        geometry: instance.geometry,
                        mask: instance.mask,
                        shape: Some(shape),
                    });
                    let own = shapes.bounds(shape);
                    bounds.push(bounds_of(instance, own));
                }
            } else {
                entries.push(Entry {
                    instance: index,
                    geometry: instance.geometry,
                    mask: instance.mask,
                    shape: None,
                });
                let own = geometry.bounds();
                bounds.push(bounds_of(instance, own));
            }
        }
        Self {
            geometries,
            instances,
            object_from_world,
            entries,
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

    /// [`Primitives::crossings`] of what a mask sees.
    #[inline]
    pub(crate) fn crossings_seen<C: Counter, F: FnMut(&Candidate) -> AnyHit>(
        &self,
        mask: u32,
        rule: EdgeRule,
        (ray, t_max): (&TraversalRay, f64),
        primitive: u32,
        counter: &mut C,
        report: &mut F,
    ) -> ControlFlow<()> {
        let entry = self.entries[primitive as usize];
        if entry.mask & mask == 0 {
            return ControlFlow::Continue(());
        }
        counter.test();
        let Entry {
            instance,
            geometry,
            shape,
            ..
        } = entry;
        let local = self.local(instance, ray, t_max);
        let mut terminated = ControlFlow::Continue(());
        let mut place = |candidate: &Candidate| {
            let placed = Candidate {
                geometry,
                instance: InstanceId(instance),
                ..*candidate
            };
            let answer = report(&placed);
            if answer == AnyHit::Terminate {
                terminated = ControlFlow::Break(());
            }
            answer
        };
        let accel = &self.geometries[geometry.index()];
        match (shape, accel.primitives().plain()) {
            (Some(shape), Some(shapes)) => shapes.test(&local, shape, &mut place),
            _ => {
                search_below(accel, &local, rule, counter, &mut place);
                terminated
            }
        }
    }

    #[inline(always)]
    fn local(&self, instance: u32, ray: &TraversalRay, t_max: f64) -> Ray<f64> {
        let mut local = match &self.object_from_world[instance as usize] {
            None => ray.ray,
            Some(object_from_world) => object_from_world.ray(&ray.ray),
        };
        local.t_max = t_max;
        local
    }
}

/// A search in a geometry. It takes a stack of its own, which shapes are spared.
#[inline(never)]
fn search_below<P: Primitives, C: Counter>(
    accel: &Accel<P>,
    ray: &Ray<f64>,
    rule: EdgeRule,
    counter: &mut C,
    any_hit: &mut dyn FnMut(&Candidate) -> AnyHit,
) {
    accel.search_with(ray, rule, counter, any_hit);
}

impl<P: Primitives> Primitives for Instances<P> {
    type Prepared = EdgeRule;

    fn len(&self) -> usize {
        self.entries.len()
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
        self.crossings_seen(u32::MAX, *rule, (ray, t_max), primitive, counter, report)
    }

    fn closest_many(
        &self,
        rays: &[Ray],
        hits: &mut [Option<Hit>],
        reach: &Reach,
        slow: &mut dyn FnMut(usize),
    ) -> bool {
        self.closest_in_turn(rays, hits, reach, slow)
    }

    fn any_many(
        &self,
        rays: &[Ray],
        hits: &mut [bool],
        reach: &Reach,
        slow: &mut dyn FnMut(usize),
    ) -> bool {
        self.any_in_turn(rays, hits, reach, slow)
    }

    fn bytes(&self) -> usize {
        self.geometries.iter().map(|g| g.bytes()).sum::<usize>()
            + size_of_val(self.instances.as_slice())
            + size_of_val(self.object_from_world.as_slice())
            + size_of_val(self.entries.as_slice())
            + size_of_val(self.bounds.as_slice())
    }
}

impl<P: Measured> Measured for Instances<P> {
    fn check(&self, placed: Option<&Transform<Object, World>>) -> Result<(), NoDistance> {
        if placed.is_some() {
            return Err(NoDistance::Nested);
        }
        for (index, own) in (0..).zip(&self.instances) {
            let below = self.geometries[own.geometry.index()].primitives();
            let placed = (!own.world_from_object.is_identity()).then_some(&own.world_from_object);
            below.check(placed).map_err(|reason| reason.at(index))?;
        }
        Ok(())
    }

    fn measure(&self, primitive: u32, place: &Place<'_>, nearby: &mut Nearby) -> ControlFlow<()> {
        let Entry {
            instance, shape, ..
        } = self.entries[primitive as usize];
        let own = &self.instances[instance as usize];
        if !nearby.sees(own.mask) {
            return ControlFlow::Continue(());
        }
        let back = self.object_from_world[instance as usize].as_ref();
        let place = Place {
            placed: back.map(|back| Placed::new(&own.world_from_object, back)),
            geometry: own.geometry,
            instance: InstanceId(instance),
            ..*place
        };
        let accel = &self.geometries[own.geometry.index()];
        match shape {
            Some(shape) => accel.primitives().measure(shape, &place, nearby),
            None => accel.measure(&place, nearby),
        }
    }
}

/// The box around something that is placed, and around every hit on it.
fn bounds_of(instance: &Instance, own: Aabb) -> Aabb {
    // A hit found in object space can lie a little outside of the bounds there, and an uneven scale
    // can make that more than the level above allows for. Where nothing is moved it does not.
    if instance.world_from_object.is_identity() {
        own
    } else {
        instance.world_from_object.aabb(&around_hits(own))
    }
}

/// The box that holds every hit that counts on something with these bounds: padded by what rounding
/// can do to a ray from anywhere within 10¹⁰ extents.
fn around_hits(bounds: Aabb) -> Aabb {
    if bounds.is_finite() && !bounds.is_empty() {
        let pad = Reach::of(&bounds).hit_pad_limit();
        Aabb::enclosing(bounds.wide().padded(pad))
    } else {
        bounds
    }
}
