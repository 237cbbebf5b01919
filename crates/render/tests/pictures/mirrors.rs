//! Mirrors, and how deep one looks into them.

use ombra_accel::{Geometry, Mesh};
use ombra_geometry::{Normal3, Point3, TriangleMesh, Vector3};
use ombra_render::MAX_DEPTH;
use ombra_scene::{Light, Material, Rgb, Scene};

use crate::stage::*;

const GREEN: Rgb = Rgb::new(0.0, 1.0, 0.0);

#[test]
fn a_mirror_shows_what_stands_beside_it() {
    // At 45° the camera looks along +x.
    let mirror = quad(
        point(-1.0, -1.0, 1.0),
        Vector3::new(2.0, 0.0, -2.0),
        Vector3::new(0.0, 2.0, 0.0),
    );
    let aside = quad(
        point(5.0, -1.0, -1.0),
        Vector3::new(0.0, 0.0, 2.0),
        Vector3::new(0.0, 2.0, 0.0),
    );
    let tint = Rgb::new(0.5, 0.5, 1.0);
    let seen = scene(
        vec![
            (mirror, Material::mirror("mirror", tint)),
            (aside, Material::luminous("green", GREEN)),
        ],
        vec![],
    );
    assert_eq!(middle(seen.clone(), &flat_camera(0.5), 1), GREEN * 0.5);
    assert_eq!(middle(seen, &flat_camera(0.5), 0), Rgb::BLACK);
}

/// Two mirrors that face one another and a camera between them. Each has a local part of its own.
fn facing_mirrors() -> Scene {
    let part = |reflection: f32, diffuse: f32| Material {
        reflection: Rgb::grey(reflection),
        ..Material::matt("mirror", Rgb::grey(diffuse))
    };
    let mut seen = scene(
        vec![
            (wall(-1.0, 9.0), part(0.5, 1.0)),
            (wall(12.0, 9.0), part(0.25, 4.0)),
        ],
        vec![],
    );
    seen.ambient = Rgb::WHITE;
    seen.background = Rgb::grey(100.0).into();
    seen
}

#[test]
fn the_depth_is_the_number_of_bounces_and_beyond_it_is_the_background() {
    let seen = |depth| middle(facing_mirrors(), &flat_camera(1.0), depth).r;
    assert_eq!(seen(0), 1.0 + 0.5 * 100.0);
    assert_eq!(seen(1), 1.0 + 0.5 * (4.0 + 0.25 * 100.0));
    assert_eq!(seen(2), 1.0 + 0.5 * (4.0 + 0.25 * (1.0 + 0.5 * 100.0)));
}

#[test]
fn the_greatest_depth_fits_into_a_threads_stack() {
    // They reflect all light, so that no ray is left out.
    let part = |depth: f32| {
        let material = Material {
            reflection: Rgb::WHITE,
            ..Material::matt("mirror", Rgb::WHITE)
        };
        (wall(depth, 9.0), material)
    };
    let light = Light::Directional {
        direction: -Vector3::Z,
        intensity: Rgb::BLACK,
    };
    let mut seen = scene(vec![part(-1.0), part(12.0)], vec![light]);
    seen.ambient = Rgb::WHITE;
    let deep = middle(seen, &flat_camera(1.0), MAX_DEPTH);
    // One local part for each surface that is met, and black behind the last.
    assert_eq!(deep, Rgb::grey(1.0 + MAX_DEPTH as f32));
}

/// A triangle in the plane z = 0 whose normals lean a long way to one side.
fn leaning(lean: Normal3) -> Geometry {
    let corners = [[-4.0, -4.0, 0.0], [4.0, -4.0, 0.0], [0.0, 4.0, 0.0]].map(Point3::from);
    let mesh = TriangleMesh::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap();
    Geometry::Mesh(Mesh::new(mesh.with_normals(vec![lean; 3]).unwrap()))
}

#[test]
fn a_mirror_never_shows_what_is_behind_it_whatever_its_normals() {
    for lean in [
        [0.9, 0.0, 0.1],
        [1.0, 0.0, -0.1],
        [-0.8, 0.5, 0.3],
        [0.0, 0.0, 1.0],
    ] {
        let lean = Normal3::from(lean).normalized().unwrap();
        let seen = scene(
            vec![
                (leaning(lean), Material::mirror("mirror", Rgb::WHITE)),
                (wall(-0.5, 90.0), Material::luminous("behind", GREEN)),
            ],
            vec![],
        );
        let world = build(seen);
        let camera = camera_at(point(3.0, 1.0, 2.0), point(0.0, -1.0, 0.0), 20.0);
        let pixels = picture(&world, &camera, &settings()).display();
        assert!(pixels.iter().all(|&pixel| pixel == Rgb::BLACK), "{lean:?}");
    }
}

#[test]
fn no_light_leaks_through_a_surface_whose_normals_lean_towards_it() {
    let lean = Normal3::new(1.0, 0.0, 0.1).normalized().unwrap();
    let lit = scene(
        vec![(leaning(lean), white())],
        vec![directional(-1.0, 0.0, 0.05)],
    );
    assert_eq!(middle(lit, &flat_camera(1.0), 8), Rgb::BLACK);
}
