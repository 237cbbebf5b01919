//! Small scenes and cameras to take pictures of them with.

use ombra_accel::{Geometry, Mesh, Shapes, StructureKind};
use ombra_geometry::shape::{Shape, Sphere};
use ombra_geometry::{Angle, Point3, Transform, TriangleMesh, Vector3};
use ombra_pipeline::Cpu;
use ombra_render::{Rendering, Settings, Watch, render};
use ombra_scene::camera::{Camera, Orthographic, Perspective, Pose, Projection};
use ombra_scene::{Light, Material, Rgb, Scene, World};

pub(crate) const WIDTH: u32 = 33;

pub(crate) fn point(x: f32, y: f32, z: f32) -> Point3 {
    Point3::new(x, y, z)
}

pub(crate) fn shape(shape: impl Into<Shape>) -> Geometry {
    Geometry::Shapes(Shapes(vec![shape.into()]))
}

pub(crate) fn ball(x: f32, y: f32, z: f32, radius: f32) -> Geometry {
    shape(Sphere::new(point(x, y, z), radius))
}

/// A parallelogram of two triangles, its normal being `along × across`.
pub(crate) fn quad(corner: Point3, along: Vector3, across: Vector3) -> Geometry {
    let positions = vec![
        corner,
        corner + along,
        corner + along + across,
        corner + across,
    ];
    let mesh = TriangleMesh::new(positions, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    Geometry::Mesh(Mesh::new(mesh))
}

/// A square in the plane y = `height` around the y axis, facing up.
pub(crate) fn floor(height: f32, half: f32) -> Geometry {
    let side = 2.0 * half;
    quad(
        point(-half, height, -half),
        Vector3::new(0.0, 0.0, side),
        Vector3::new(side, 0.0, 0.0),
    )
}

/// A square in the plane z = `depth` around the z axis, facing +z.
pub(crate) fn wall(depth: f32, half: f32) -> Geometry {
    let side = 2.0 * half;
    quad(
        point(-half, -half, depth),
        Vector3::new(side, 0.0, 0.0),
        Vector3::new(0.0, side, 0.0),
    )
}

pub(crate) fn scene(things: Vec<(Geometry, Material)>, lights: Vec<Light>) -> Scene {
    let mut scene = Scene {
        lights,
        ..Scene::default()
    };
    for (geometry, material) in things {
        scene.add("thing", geometry, material, Transform::identity());
    }
    scene
}

pub(crate) fn build(scene: Scene) -> World {
    World::build(scene, StructureKind::default()).unwrap()
}

pub(crate) fn white() -> Material {
    Material::matt("white", Rgb::WHITE)
}

pub(crate) fn directional(x: f32, y: f32, z: f32) -> Light {
    Light::Directional {
        direction: Vector3::new(x, y, z),
        intensity: Rgb::WHITE,
    }
}

/// Looks along −z from far in front; a pixel is `height / WIDTH` units of the scene.
pub(crate) fn flat_camera(height: f32) -> Camera {
    Camera {
        pose: Pose::new(point(0.0, 0.0, 10.0), -Vector3::Z, Vector3::Y).unwrap(),
        projection: Projection::Orthographic(Orthographic { height }),
    }
}

pub(crate) fn camera_at(from: Point3, to: Point3, degrees: f32) -> Camera {
    let fov = Angle::from_degrees(degrees);
    Camera {
        pose: Pose::look_at(from, to, Vector3::new(0.1, 1.0, 0.2)).unwrap(),
        projection: Projection::Perspective(Perspective::new(fov)),
    }
}

pub(crate) fn settings() -> Settings {
    Settings {
        width: WIDTH,
        height: WIDTH,
        ..Settings::default()
    }
}

pub(crate) fn picture(world: &World, camera: &Camera, settings: &Settings) -> Rendering {
    let cpu = Cpu::with_threads(1).unwrap();
    render(world, camera, settings, &cpu, Watch::default()).unwrap()
}

/// What a camera sees in the middle of its picture.
pub(crate) fn middle(scene: Scene, camera: &Camera, max_depth: u32) -> Rgb {
    let settings = Settings {
        max_depth,
        ..settings()
    };
    let rendering = picture(&build(scene), camera, &settings);
    rendering.film.average(WIDTH / 2, WIDTH / 2).unwrap()
}

#[track_caller]
pub(crate) fn assert_close(seen: Rgb, expected: Rgb, tolerance: f32) {
    let close = |a: f32, b: f32| (a - b).abs() <= tolerance;
    assert!(
        close(seen.r, expected.r) && close(seen.g, expected.g) && close(seen.b, expected.b),
        "{seen:?} is not {expected:?}"
    );
}
