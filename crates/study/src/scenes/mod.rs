//! Generated scenes, the same on every machine: each is the home of another structure.

mod city;
mod hills;
mod stadium;

use ombra::accel::{Geometry, Mesh};
use ombra::geometry::{Angle, MeshError, Point3, Transform, TriangleMesh, Vector3};
use ombra::scene::camera::{Perspective, Pose, PoseError, Projection};
use ombra::scene::{Camera, Light, Material, Rgb, Scene};

/// A scene that is made, not read.
pub(crate) struct Generated {
    /// The name that a person types.
    pub(crate) name: &'static str,
    /// What is in it and why, in one line.
    pub(crate) line: &'static str,
    /// Makes it as fine as asked.
    pub(crate) make: fn(u32) -> Result<Scene, SceneFault>,
}

/// All of them.
pub(crate) const ALL: &[Generated] = &[
    Generated {
        name: "study:hills",
        line: "triangles of one size, evenly spread",
        make: hills::scene,
    },
    Generated {
        name: "study:city",
        line: "long thin walls along the axes, with empty streets between them",
        make: city::scene,
    },
    Generated {
        name: "study:stadium",
        line: "one finely cut thing in the middle of a place a thousand times its size",
        make: stadium::scene,
    },
];

/// What is wrong with how a scene is made.
#[derive(Debug, thiserror::Error)]
pub(crate) enum SceneFault {
    #[error(transparent)]
    Mesh(#[from] MeshError),
    #[error(transparent)]
    Pose(#[from] PoseError),
}

/// A scene of one light, like the sun in the evening, and nothing else yet.
fn under_the_sun(from: Point3, to: Point3) -> Result<Scene, SceneFault> {
    let pose = Pose::look_at(from, to, Vector3::Y)?;
    let fov = Angle::from_degrees(50.0);
    let mut scene = Scene {
        camera: Some(Camera {
            pose,
            projection: Projection::Perspective(Perspective::new(fov)),
        }),
        ..Scene::default()
    };
    scene.lights.push(Light::Directional {
        direction: Vector3::new(-1.0, -0.45, -0.4),
        intensity: Rgb::grey(0.8),
    });
    Ok(scene)
}

fn add(scene: &mut Scene, name: &str, mesh: TriangleMesh) {
    let geometry = Geometry::Mesh(Mesh::new(mesh));
    let material = Material::matt(name, Rgb::grey(0.6));
    scene.add(name, geometry, material, Transform::identity());
}

#[cfg(test)]
mod tests {
    use super::*;
    use ombra::accel::Primitives as _;

    #[test]
    fn every_scene_can_be_made_coarse_and_fine() {
        for generated in ALL {
            let triangles = |detail| {
                let scene = (generated.make)(detail).unwrap();
                scene.validate().unwrap();
                scene.geometries.iter().map(Geometry::len).sum::<usize>()
            };
            let (coarse, fine) = (triangles(0), triangles(40));
            assert!(0 < coarse && coarse < fine, "{}", generated.name);
        }
    }
}
