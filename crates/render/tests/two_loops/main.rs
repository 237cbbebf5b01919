//! The rasterizer against rays: both must see the same, but where an edge runs through a sample.

mod gaps;
mod meshes;
mod shading;
mod shapes;

use ombra_accel::{Geometry, Mesh, StructureKind};
use ombra_geometry::{Angle, Point3, Transform, TriangleMesh, Vector3};
use ombra_pipeline::Cpu;
use ombra_render::Settings;
use ombra_render::compare::{VisibilityAgreement, visibility};
use ombra_scene::camera::{Camera, Perspective, Pose, Projection};
use ombra_scene::{Material, Scene, World};

pub(crate) fn point(x: f32, y: f32, z: f32) -> Point3 {
    Point3::new(x, y, z)
}

pub(crate) fn scene(meshes: Vec<TriangleMesh>) -> Scene {
    let mut scene = Scene::default();
    for mesh in meshes {
        let geometry = Geometry::Mesh(Mesh::new(mesh));
        scene.add("mesh", geometry, Material::default(), Transform::identity());
    }
    scene
}

pub(crate) fn world(scene: Scene) -> World {
    World::build(scene, StructureKind::default()).unwrap()
}

pub(crate) fn camera(from: Point3, to: Point3, degrees: f32) -> Camera {
    let fov = Angle::from_degrees(degrees);
    Camera {
        pose: Pose::look_at(from, to, Vector3::new(0.1, 1.0, 0.2)).unwrap(),
        projection: Projection::Perspective(Perspective::new(fov)),
    }
}

pub(crate) fn settings(width: u32, height: u32, spp: u32) -> Settings {
    Settings {
        width,
        height,
        spp,
        ..Settings::default()
    }
}

/// Compares at the middle of pixels and at the places of the first of several samples.
#[track_caller]
pub(crate) fn assert_agreement(world: &World, camera: &Camera, name: &str) {
    for spp in [1, 4] {
        let agreement = compared(world, camera, spp);
        println!("{name}, {spp} spp: {agreement:?}");
        assert!(
            agreement.share() >= 0.999,
            "{name}, {spp} spp: {agreement:?}"
        );
        assert_eq!(
            agreement.differing_elsewhere, 0,
            "{name}, {spp} spp: {agreement:?}"
        );
    }
}

pub(crate) fn compared(world: &World, camera: &Camera, spp: u32) -> VisibilityAgreement {
    let settings = settings(320, 200, spp);
    visibility(world, camera, &settings, &Cpu::all_threads()).unwrap()
}
