//! A scene that rays can be traced against.

use std::sync::Arc;

use ombra_accel::{
    Accel, AnyHit, Candidate, Geometry, Instance, Instances, Primitives as _, Statistics,
    StructureKind, Traversable,
};
use ombra_geometry::{Aabb, EdgeRule, Hit, Ray};

use crate::presence;
use crate::{Interaction, Material, Scene, SceneError};

/// A scene with an acceleration structure over it, on two levels: one in each geometry, one over
/// all objects.
#[derive(Clone, Debug)]
pub struct World {
    scene: Scene,
    accel: Accel<Instances<Geometry>>,
    finite_bounds: Aabb,
    /// Whether a hit may be of something that is not there; see `presence.rs`.
    has_gaps: bool,
}

impl World {
    /// Builds the structure named `kind` on both levels.
    ///
    /// # Errors
    /// When the description does not fit together.
    pub fn build(scene: Scene, kind: StructureKind) -> Result<Self, SceneError> {
        scene.validate()?;
        let mut placed = vec![0_u32; scene.geometries.len()];
        for object in &scene.objects {
            placed[object.geometry.index()] += 1;
        }
        let geometries = scene
            .geometries
            .iter()
            .zip(placed)
            .map(|(geometry, placed)| {
                // These are in the structure of the upper level, primitive by primitive.
                let in_upper_level =
                    geometry.len() <= 1 || placed <= 1 && matches!(geometry, Geometry::Shapes(_));
                let kind = if in_upper_level {
                    StructureKind::BruteForce
                } else {
                    kind
                };
                Arc::new(Accel::build(geometry.clone(), kind))
            })
            .collect();
        let instances = scene
            .objects
            .iter()
            .map(|object| Instance::new(object.geometry, object.world_from_object))
            .collect();
        let accel = Accel::build(Instances::new(geometries, instances), kind);
        let finite_bounds = finite_bounds(&scene);
        let has_gaps = scene.materials.iter().any(|material| !material.is_whole());
        Ok(Self {
            scene,
            accel,
            finite_bounds,
            has_gaps,
        })
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

    /// Whether what a ray meets is there: not a back face of a material with one side, and not in a
    /// hole of one. Searches ask this themselves; whoever finds what is seen without a ray has to.
    ///
    /// # Panics
    /// When the candidate is not of this world.
    #[must_use]
    #[inline]
    pub fn is_there(&self, ray: &Ray<f64>, candidate: &Candidate) -> bool {
        !self.has_gaps || presence::is_there(&self.scene, ray, candidate)
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
            .looking_from(self.scene.t_min)
    }

    /// The box around everything that has an end: endless shapes, such as planes, are left out.
    /// Empty if there is nothing else.
    #[must_use]
    pub const fn finite_bounds(&self) -> Aabb {
        self.finite_bounds
    }

    /// How many primitives rays can meet, those of a geometry once for each object that places it.
    #[must_use]
    pub fn primitives(&self) -> usize {
        let objects = self.scene.objects.iter();
        objects
            .map(|object| self.scene.geometries[object.geometry.index()].len())
            .sum()
    }

    /// Bytes of the structures alone.
    #[must_use]
    pub fn structure_bytes(&self) -> usize {
        let lower = self.accel.primitives().geometries().iter();
        self.accel.structure_bytes() + lower.map(|g| g.structure_bytes()).sum::<usize>()
    }
}

fn finite_bounds(scene: &Scene) -> Aabb {
    let of_geometry: Vec<Aabb> = scene
        .geometries
        .iter()
        .map(|geometry| {
            (0..geometry.len() as u32)
                .map(|primitive| geometry.bounds(primitive))
                .filter(Aabb::is_finite)
                .fold(Aabb::EMPTY, Aabb::union)
        })
        .collect();
    let placed = scene.objects.iter().map(|object| {
        let bounds = &of_geometry[object.geometry.index()];
        object.world_from_object.aabb(bounds)
    });
    placed
        .filter(Aabb::is_finite)
        .fold(Aabb::EMPTY, Aabb::union)
}

impl Traversable for World {
    fn search(
        &self,
        ray: &Ray<f64>,
        rule: EdgeRule,
        statistics: Option<&mut Statistics>,
        any_hit: &mut dyn FnMut(&Candidate) -> AnyHit,
    ) -> Option<Candidate> {
        if !self.has_gaps {
            return self.accel.search(ray, rule, statistics, any_hit);
        }
        let mut of_what_is_there = |candidate: &Candidate| {
            if self.is_there(ray, candidate) {
                any_hit(candidate)
            } else {
                AnyHit::Ignore
            }
        };
        self.accel
            .search(ray, rule, statistics, &mut of_what_is_there)
    }

    fn intersect_many(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        if !self.has_gaps {
            return self.accel.intersect_many(rays, hits);
        }
        assert_eq!(rays.len(), hits.len(), "one place for a hit for each ray");
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = self.intersect(ray);
        }
    }

    fn occluded_many(&self, rays: &[Ray], occluded: &mut [bool]) {
        if !self.has_gaps {
            return self.accel.occluded_many(rays, occluded);
        }
        assert_eq!(rays.len(), occluded.len(), "one answer for each ray");
        for (ray, occluded) in rays.iter().zip(occluded) {
            *occluded = self.occluded(ray);
        }
    }

    fn bounds(&self) -> Aabb {
        self.accel.bounds()
    }

    fn bytes(&self) -> usize {
        self.accel.bytes()
    }
}
