//! A scene that rays can be traced against.

use std::sync::Arc;

use ombra_accel::{
    Accel, AnyHit, Candidate, Counter, Geometry, Instance, Instances, StructureKind, Traversable,
};
use ombra_geometry::{Aabb, EdgeRule, Hit, Ray};

use crate::{Interaction, Material, Scene, SceneError};

/// A scene with an acceleration structure over it, on two levels: one in each geometry, one over
/// all objects.
#[derive(Clone, Debug)]
pub struct World {
    scene: Scene,
    accel: Accel<Instances<Geometry>>,
}

impl World {
    /// Builds the structure named `kind` on both levels.
    ///
    /// # Errors
    /// When the description does not fit together.
    pub fn build(scene: Scene, kind: StructureKind) -> Result<Self, SceneError> {
        scene.validate()?;
        let geometries = scene
            .geometries
            .iter()
            .map(|geometry| Arc::new(Accel::build(geometry.clone(), kind)))
            .collect();
        let instances = scene
            .objects
            .iter()
            .map(|object| Instance {
                geometry: object.geometry,
                world_from_object: object.world_from_object,
            })
            .collect();
        let accel = Accel::build(Instances::new(geometries, instances), kind);
        Ok(Self { scene, accel })
    }

    /// The description.
    #[must_use]
    pub const fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What the object that was hit is made of.
    ///
    /// # Panics
    /// When the hit is not of this world.
    #[must_use]
    #[inline]
    pub fn material(&self, hit: &Hit) -> &Material {
        &self.scene.materials[self.scene.objects[hit.instance.index()].material.index()]
    }

    /// Makes a place of a hit.
    ///
    /// # Panics
    /// When the hit is not of this world.
    #[must_use]
    #[inline]
    pub fn interaction(&self, ray: &Ray, hit: &Hit) -> Interaction {
        let object = &self.scene.objects[hit.instance.index()];
        let geometry = &self.scene.geometries[hit.geometry.index()];
        Interaction::new(ray, hit, geometry, &object.world_from_object)
    }

    /// Bytes of the structures alone.
    #[must_use]
    pub fn structure_bytes(&self) -> usize {
        let lower = self.accel.primitives().geometries().iter();
        self.accel.structure_bytes() + lower.map(|g| g.structure_bytes()).sum::<usize>()
    }
}

impl Traversable for World {
    #[inline]
    fn search<C: Counter, F: FnMut(&Candidate) -> AnyHit>(
        &self,
        ray: &Ray<f64>,
        rule: EdgeRule,
        counter: &mut C,
        any_hit: F,
    ) -> Option<Candidate> {
        self.accel.search(ray, rule, counter, any_hit)
    }

    fn bounds(&self) -> Aabb {
        self.accel.bounds()
    }

    fn bytes(&self) -> usize {
        self.accel.bytes()
    }
}
