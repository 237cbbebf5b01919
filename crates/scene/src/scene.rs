//! The description of a scene.

use ombra_accel::Geometry;
use ombra_geometry::{GeometryId, Object as ObjectSpace, Transform, World};

use crate::{Camera, Light, Material, MaterialId, Rgb};

/// A thing in the scene: a geometry, where it stands, and what it is made of.
#[derive(Clone, Debug)]
pub struct Object {
    /// For messages; need not be unique.
    pub name: String,
    /// Which geometry.
    pub geometry: GeometryId,
    /// Which material.
    pub material: MaterialId,
    /// Where it stands.
    pub world_from_object: Transform<ObjectSpace, World>,
}

/// Everything there is to be seen, as a description.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The geometries that objects place.
    pub geometries: Vec<Geometry>,
    /// The materials that objects are made of.
    pub materials: Vec<Material>,
    /// The things in the scene. The index of an object is the instance of a hit.
    pub objects: Vec<Object>,
    /// The lights.
    pub lights: Vec<Light>,
    /// Light that comes from everywhere and meets no obstacle.
    pub ambient: Rgb,
    /// What is seen where there is nothing.
    pub background: Rgb,
    /// The camera, if the description names one.
    pub camera: Option<Camera>,
}

/// A description that does not fit together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// An object names a geometry that is not there.
    #[error("object {object} uses geometry {geometry}, but there are {count}")]
    NoSuchGeometry {
        /// Which object, from 0.
        object: usize,
        /// What it names.
        geometry: GeometryId,
        /// How many there are.
        count: usize,
    },
    /// An object names a material that is not there.
    #[error("object {object} uses material {}, but there are {count}", .material.0)]
    NoSuchMaterial {
        /// Which object, from 0.
        object: usize,
        /// What it names.
        material: MaterialId,
        /// How many there are.
        count: usize,
    },
}

impl Scene {
    /// Adds an object with a geometry and a material of its own.
    pub fn add(
        &mut self,
        name: impl Into<String>,
        geometry: Geometry,
        material: Material,
        world_from_object: Transform<ObjectSpace, World>,
    ) {
        let object = Object {
            name: name.into(),
            geometry: GeometryId(self.geometries.len() as u32),
            material: MaterialId(self.materials.len() as u32),
            world_from_object,
        };
        self.geometries.push(geometry);
        self.materials.push(material);
        self.objects.push(object);
    }

    /// Checks that every object names a geometry and a material that is there.
    ///
    /// # Errors
    /// The first object that does not.
    pub fn validate(&self) -> Result<(), SceneError> {
        for (index, object) in self.objects.iter().enumerate() {
            let (geometry, material) = (object.geometry, object.material);
            if geometry.index() >= self.geometries.len() {
                let count = self.geometries.len();
                return Err(SceneError::NoSuchGeometry {
                    object: index,
                    geometry,
                    count,
                });
            }
            if material.index() >= self.materials.len() {
                let count = self.materials.len();
                return Err(SceneError::NoSuchMaterial {
                    object: index,
                    material,
                    count,
                });
            }
        }
        Ok(())
    }
}
