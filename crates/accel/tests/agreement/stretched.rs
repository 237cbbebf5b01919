//! Distances from what a placement stretches along some axes more than along others.

use std::sync::Arc;

use ombra_accel::{Accel, Instance, Instances, NoDistance, Shapes, StructureKind};
use ombra_geometry::shape::{Cuboid, Plane, Shape};
use ombra_geometry::{GeometryId, InstanceId, Normal3, Point3, PrimitiveId, TriangleMesh};

use crate::distances::{at, bits, corners, geometries, points, scaled, turned};
use crate::meshes;

/// Where numbers come out without rounding, what is placed is as far away as what was described there.
#[test]
fn a_stretched_mesh_is_measured_in_the_world() {
    let mesh = meshes::random_soup(200, 1.0, 0.3);
    let place = scaled(2.0, 0.25, -8.0).then(&at(0.0, 0.0, 0.0));
    let positions = mesh.positions().iter().map(|&corner| place.point(corner));
    let moved = TriangleMesh::new(positions.collect(), mesh.triangles().to_vec()).unwrap();
    let kind = StructureKind::default();
    let moved = Accel::build(meshes::geometry(moved), kind);
    let below = Arc::new(Accel::build(meshes::geometry(mesh), kind));
    let placed = Instances::new(vec![below], vec![Instance::new(GeometryId(0), place)]);
    let placed = Accel::build(placed, kind);
    for point in points(&corners(3.0), 50) {
        let found = placed
            .distances()
            .unwrap()
            .closest_point(point, f64::INFINITY);
        let expected = moved
            .distances()
            .unwrap()
            .closest_point(point, f64::INFINITY);
        assert_eq!(
            found.as_ref().map(bits),
            expected.as_ref().map(bits),
            "{point:?}"
        );
    }
}

#[test]
fn a_stretched_flat_shape_is_the_shape_that_it_looks_like() {
    let unit = Cuboid::new(Point3::ORIGIN, Point3::new(1.0, 1.0, 1.0)).unwrap();
    let long = Cuboid::new(Point3::new(0.0, 0.0, 2.0), Point3::new(4.0, 0.5, 3.0)).unwrap();
    let floor = |z: f32| Plane::new(Point3::new(0.0, 0.0, z), Normal3::new(0.0, 0.0, 1.0)).unwrap();
    let place = scaled(4.0, 0.5, 1.0).then(&at(0.0, 0.0, 2.0));
    let kind = StructureKind::default();
    for (own, expected) in [
        (Shape::from(unit), Shape::from(long)),
        (floor(-3.0).into(), floor(-1.0).into()),
    ] {
        let below = Arc::new(Accel::build(Shapes(vec![own]), kind));
        let placed = Instances::new(vec![below], vec![Instance::new(GeometryId(0), place)]);
        let placed = Accel::build(placed, kind);
        let alone = Accel::build(Shapes(vec![expected]), kind);
        for point in points(&corners(3.0), 30) {
            let found = placed
                .distances()
                .unwrap()
                .closest_point(point, f64::INFINITY);
            let expected = alone
                .distances()
                .unwrap()
                .closest_point(point, f64::INFINITY);
            assert_eq!(found.is_some(), expected.is_some());
            if let (Some(found), Some(expected)) = (found, expected) {
                let off = (found.distance - expected.distance).abs();
                assert!(
                    off <= 1e-14 * (10.0 + expected.distance),
                    "{found:?}, {expected:?}"
                );
            }
        }
    }
}

#[test]
fn a_curved_shape_that_is_stretched_has_no_distance_and_says_so() {
    let kind = StructureKind::default();
    let geometries = geometries(kind);
    let curved = Instance::new(GeometryId(3), turned(0.5).then(&at(1.0, 0.0, 0.0)));
    let stretched = Instance::new(
        GeometryId(3),
        scaled(1.0, 2.0, 1.0).then(&at(0.0, 0.0, 0.0)),
    );
    let build = |instances| Accel::build(Instances::new(geometries.clone(), instances), kind);
    assert!(build(vec![curved.clone()]).distances().is_ok());
    let refused = build(vec![curved, stretched]);
    let (instance, primitive) = (InstanceId(1), PrimitiveId(0));
    let refused = refused.distances().unwrap_err();
    assert_eq!(
        refused,
        NoDistance::Stretched {
            instance,
            primitive
        }
    );
    assert!(refused.to_string().contains("instance 1 stretches shape 0"));
}
