//! Surfaces with one side, and with holes: what is not there hides nothing.

use std::sync::Arc;

use ombra_accel::{Geometry, Mesh, Shapes};
use ombra_geometry::shape::{Cylinder, Disk, Ends, Plane, Rectangle, Shape, Sphere};
use ombra_geometry::{Normal3, Transform, TriangleMesh, Vector3};
use ombra_scene::camera::Camera;
use ombra_scene::{
    Cutout, Filter, Image, Material, PictureTexture, Rgb, Scene, UvTransform, World, Wrap,
};

use crate::{assert_agreement, camera, compared, point, world};

/// A square in the plane z = 0 from −1 to 1 whose outside is +z, uv from 0 to 1 over it.
fn square() -> Geometry {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let positions = corners.map(|[x, y]| point(x, y, 0.0)).to_vec();
    let mesh = TriangleMesh::new(positions, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    let uvs = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    Geometry::Mesh(Mesh::new(mesh.with_uvs(uvs).unwrap()))
}

fn one_sided() -> Material {
    Material {
        one_sided: true,
        ..Material::default()
    }
}

/// With holes like the black squares of a chessboard of eight by eight over u and v from 0 to 1, and
/// on beyond.
fn holed() -> Material {
    let image = Image::new(2, 2, vec![Rgb::WHITE; 4]).unwrap();
    let image = image.with_alpha(vec![1.0, 0.25, 0.25, 1.0]).unwrap();
    let picture = PictureTexture {
        filter: Filter::Nearest,
        wrap: [Wrap::Repeat; 2],
        placement: Some(UvTransform([[4.0, 0.0, 0.0], [0.0, 4.0, 0.0]])),
        ..PictureTexture::new(Arc::new(image))
    };
    Material {
        cutout: Some(Cutout {
            picture,
            cutoff: 0.5,
        }),
        ..Material::default()
    }
}

fn of(shape: impl Into<Shape>) -> Geometry {
    Geometry::Shapes(Shapes(vec![shape.into()]))
}

/// Some of a material, and a ball behind all of it.
fn before_a_ball(things: Vec<Geometry>, material: &Material, placed: Vector3<f64>) -> World {
    let mut scene = Scene::default();
    for thing in things {
        scene.add("thing", thing, material.clone(), Transform::scale(placed));
    }
    let ball = of(Sphere::new(point(0.0, 0.0, -3.0), 1.0));
    scene.add("ball", ball, Material::default(), Transform::identity());
    world(scene)
}

fn front() -> Camera {
    camera(point(0.6, 0.8, 5.0), point(0.0, 0.0, 0.0), 45.0)
}

fn behind() -> Camera {
    camera(point(0.6, 0.8, -9.0), point(0.0, 0.0, 0.0), 45.0)
}

const AS_IT_IS: Vector3<f64> = Vector3::new(1.0, 1.0, 1.0);

/// How many pixels see something.
fn covered(world: &World, eye: &Camera) -> u64 {
    compared(world, eye, 1).covered
}

#[test]
fn a_square_with_one_side_is_seen_from_there_alone() {
    // What mirrors turns the order of corners and not the side.
    let mirrored = Vector3::new(-1.0, 1.0, 1.0);
    for placed in [AS_IT_IS, mirrored] {
        let one = before_a_ball(vec![square()], &one_sided(), placed);
        let both = before_a_ball(vec![square()], &Material::default(), placed);
        let ball = before_a_ball(vec![], &Material::default(), placed);
        for eye in [front(), behind()] {
            assert_agreement(&one, &eye, "one side");
        }
        assert_eq!(covered(&one, &front()), covered(&both, &front()));
        assert_eq!(covered(&one, &behind()), covered(&ball, &behind()));
        assert!(covered(&both, &behind()) > covered(&ball, &behind()));
    }
}

#[test]
fn of_a_round_thing_with_one_side_the_far_half_is_not_there() {
    // From outside the near half; through the open end, and from within, nothing.
    let tube = Cylinder::new(point(0.0, -1.0, 0.0), point(0.3, 1.0, 0.5), 0.7, Ends::Open);
    let shapes = || {
        vec![
            of(Sphere::new(point(0.5, 0.2, 1.0), 0.8)),
            of(tube.unwrap()),
        ]
    };
    let round = before_a_ball(shapes(), &one_sided(), AS_IT_IS);
    for eye in [front(), behind()] {
        assert_agreement(&round, &eye, "round");
    }
    let within = camera(point(0.5, 0.2, 1.0), point(0.0, 0.0, -3.0), 60.0);
    assert_agreement(&round, &within, "from within");
    let floor = Plane::new(point(0.0, -1.2, 0.0), Normal3::new(0.0, 1.0, 0.0));
    let ground = before_a_ball(vec![of(floor.unwrap())], &one_sided(), AS_IT_IS);
    let below = camera(point(0.0, -4.0, 3.0), point(0.0, 0.0, 0.0), 60.0);
    for eye in [front(), below] {
        assert_agreement(&ground, &eye, "ground");
    }
    let ball = before_a_ball(vec![], &Material::default(), AS_IT_IS);
    assert_eq!(covered(&ground, &below), covered(&ball, &below));
}

#[test]
fn through_holes_is_seen_what_is_behind() {
    let up = Normal3::new(0.1, 0.3, 1.0);
    let edges = [Vector3::new(2.0, 0.1, 0.0), Vector3::new(0.0, 2.0, 0.3)];
    let disk = Disk::new(point(0.0, 0.0, 0.0), up, 1.0).unwrap();
    let sheet = Rectangle::new(point(-1.0, -1.0, 0.0), edges[0], edges[1]).unwrap();
    let wall = Plane::new(point(0.0, 0.0, -0.5), up).unwrap();
    let ball = Sphere::new(point(0.0, 0.0, 0.0), 1.0);
    for (name, thing) in [
        ("square", square()),
        ("disk", of(disk)),
        ("sheet", of(sheet)),
        ("wall", of(wall)),
        ("ball", of(ball)),
    ] {
        let with_holes = before_a_ball(vec![thing.clone()], &holed(), AS_IT_IS);
        let whole = before_a_ball(vec![thing], &Material::default(), AS_IT_IS);
        for eye in [front(), behind()] {
            assert_agreement(&with_holes, &eye, name);
        }
        let [some, all] = [&with_holes, &whole].map(|world| compared(world, &front(), 1));
        assert!(some.covered < all.covered, "{name}: {some:?}, {all:?}");
        assert!(some.edges > all.edges, "{name}: {some:?}, {all:?}");
    }
}
