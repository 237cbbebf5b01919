//! The description of a scene.

use ombra_accel::Geometry;
use ombra_geometry::{GeometryId, InstanceId, Object as ObjectSpace, Transform, Vector3, World};

use crate::{Background, Camera, Cutoff, Light, Material, MaterialId, Rgb};

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
#[derive(Clone, Debug)]
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
    pub background: Background,
    /// What is seen where rays are followed no further.
    pub cutoff: Cutoff,
    /// Where rays that leave a surface begin to look, as a distance along them; 0 or more. They start
    /// off their surface by what rounding demands, so 0 will do. More looks past what is that near: an
    /// old way to keep a surface from shading itself, which old pictures show.
    pub t_min: f32,
    /// The camera, if the description names one.
    pub camera: Option<Camera>,
    /// Which way is up, for a camera and lights that have to be made up. Of any length but 0.
    pub up: Vector3,
}

impl Default for Scene {
    /// Nothing, in the dark.
    fn default() -> Self {
        Self {
            geometries: Vec::new(),
            materials: Vec::new(),
            objects: Vec::new(),
            lights: Vec::new(),
            ambient: Rgb::BLACK,
            background: Background::default(),
            cutoff: Cutoff::default(),
            t_min: 0.0,
            camera: None,
            up: Vector3::Y,
        }
    }
}

/// A description that does not fit together.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
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
    /// Rays cannot begin to look there.
    #[error("t_min is {t_min}; 0 or more is needed")]
    NoBeginning {
        /// What it is.
        t_min: f32,
    },
    /// A light belongs to an object that is not there.
    #[error("light {light} belongs to object {object}, but there are {count}")]
    NoSuchObject {
        /// Which light, from 0.
        light: usize,
        /// What it names.
        object: InstanceId,
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
        self.materials.push(material);
        let material = MaterialId(self.materials.len() as u32 - 1);
        self.place(name, geometry, material, world_from_object);
    }

    /// Adds an object with a geometry of its own and one of the materials.
    pub fn place(
        &mut self,
        name: impl Into<String>,
        geometry: Geometry,
        material: MaterialId,
        world_from_object: Transform<ObjectSpace, World>,
    ) {
        let geometry = self.add_geometry(geometry);
        self.place_again(name, geometry, material, world_from_object);
    }

    /// Adds a geometry that no object places yet.
    pub fn add_geometry(&mut self, geometry: Geometry) -> GeometryId {
        self.geometries.push(geometry);
        GeometryId(self.geometries.len() as u32 - 1)
    }

    /// Adds an object with one of the geometries, which others may share, and one of the materials.
    pub fn place_again(
        &mut self,
        name: impl Into<String>,
        geometry: GeometryId,
        material: MaterialId,
        world_from_object: Transform<ObjectSpace, World>,
    ) {
        self.objects.push(Object {
            name: name.into(),
            geometry,
            material,
            world_from_object,
        });
    }

    /// What a ray in this direction brings that is followed no further.
    #[must_use]
    #[inline]
    pub fn beyond(&self, direction: Vector3) -> Rgb {
        match self.cutoff {
            Cutoff::Background => self.background.at(direction),
            Cutoff::Black => Rgb::BLACK,
        }
    }

    /// Checks that every object names a geometry and a material that is there, every light of an object
    /// an object, and that rays begin somewhere.
    ///
    /// # Errors
    /// The first that does not.
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
        if !(0.0..=f32::MAX).contains(&self.t_min) {
            return Err(SceneError::NoBeginning { t_min: self.t_min });
        }
        for (index, light) in self.lights.iter().enumerate() {
            if let Light::Luminous { object, .. } = light
                && object.index() >= self.objects.len()
            {
                return Err(SceneError::NoSuchObject {
                    light: index,
                    object: *object,
                    count: self.objects.len(),
                });
            }
        }
        Ok(())
    }
}
