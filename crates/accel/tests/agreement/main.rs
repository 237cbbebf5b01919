//! All structures give the same answers, bit for bit. The brute-force loop is the judge.
//!
//! Everything here runs for every kind in `StructureKind::ALL`, so that a structure that is added
//! later is covered without a line.

mod answers;
mod bundles;
mod custom;
mod degenerate;
mod distances;
mod instances;
mod masks;
mod measured;
mod meshes;
mod numbers;
mod proptests;
mod rays;
mod real_meshes;
mod refit;
mod scale;
mod statistics;
mod stretched;
mod watertight;

use ombra_accel::{Geometry, Primitives, Shapes};
use ombra_geometry::Point3;
use ombra_geometry::shape::{Shape, Sphere};

use answers::assert_agreement;
use numbers::Numbers;

#[test]
fn every_structure_agrees_with_brute_force_on_meshes() {
    for (name, mesh) in meshes::all() {
        let rays = rays::of_mesh(&mesh, 0.4);
        let hits = assert_agreement(name, &meshes::geometry(mesh), &rays);
        assert_eq!(hits == 0, name == "nothing", "{name}: {hits} hits");
    }
}

#[test]
fn every_structure_agrees_with_brute_force_on_shapes() {
    let mut numbers = Numbers::new(7);
    let mut shapes = vec![
        Shape::from(Sphere::new(Point3::ORIGIN, 0.0)),
        Shape::from(Sphere::new(Point3::ORIGIN, f32::NAN)),
        Shape::from(Sphere::new(Point3::ORIGIN, 1.0)),
        Shape::from(Sphere::new(Point3::ORIGIN, 1.0)),
        Shape::from(Sphere::new(Point3::ORIGIN, f32::INFINITY)),
    ];
    shapes.extend((0..200).map(|_| {
        let centre = numbers.point(5.0);
        Shape::from(Sphere::new(centre, numbers.within(0.01, 1.0)))
    }));
    let shapes = Geometry::Shapes(Shapes(shapes));
    let corners: Vec<_> = (0..shapes.len() as u32)
        .map(|i| shapes.bounds(i).min)
        .filter(|corner| corner.is_finite())
        .collect();
    let hits = assert_agreement("spheres", &shapes, &rays::around(&corners, 1.0));
    assert!(hits > 0);
}
