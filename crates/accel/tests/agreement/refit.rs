//! Structures over meshes that move.

use ombra_accel::{Accel, Mesh, StructureKind, Traversable as _};
use ombra_geometry::{Point3, TriangleMesh, Vector3};

use crate::answers::Answers;
use crate::{meshes, rays};

/// Each vertex moved on its own, the further the larger `by`.
fn shaken(mesh: &TriangleMesh, by: f32) -> TriangleMesh {
    let moved = mesh.positions().iter().map(|p| {
        let Vector3 { x, y, z } = p.to_vector();
        Point3::new(
            x + by * (3.0 * y).sin(),
            y - by * (5.0 * z).cos(),
            z * (1.0 + by),
        )
    });
    TriangleMesh::new(moved.collect(), mesh.triangles().to_vec()).unwrap()
}

#[test]
fn a_refitted_structure_answers_as_brute_force_does() {
    for (name, mesh) in [
        ("one", meshes::cuboid(1.0)),
        ("icosphere", meshes::icosphere(3)),
        ("soup", meshes::random_soup(400, 1.0, 0.3)),
        ("nothing", TriangleMesh::default()),
    ] {
        for &kind in StructureKind::ALL {
            let mut accel = Accel::build(Mesh::new(mesh.clone()), kind);
            for by in [0.01, 0.5, 20.0, 1e6] {
                let moved = shaken(&mesh, by);
                let kept = accel.refit(Mesh::new(moved.clone()));
                let keeps = kind.name().starts_with("bvh8") && kind != StructureKind::Bvh8Compact;
                assert_eq!(kept, keeps, "{name}, {kind}");
                let judge = Accel::build(Mesh::new(moved.clone()), StructureKind::BruteForce);
                for ray in rays::of_mesh(&moved, 0.1) {
                    let (found, expected) = (Answers::of(&accel, &ray), Answers::of(&judge, &ray));
                    assert_eq!(found, expected, "{name}, {kind}, {by}: {ray:?}");
                }
            }
        }
    }
}

#[test]
fn a_few_triangles_that_moved_are_found_where_they_are_now() {
    for (name, mesh) in [
        ("icosphere", meshes::icosphere(4)),
        ("soup", meshes::random_soup(4000, 1.0, 0.3)),
        ("slivers", meshes::slivers(900)),
    ] {
        for kind in ["bvh8", "bvh8-fast", "bvh8-high"].map(|name| name.parse().unwrap()) {
            let mut accel = Accel::build(Mesh::new(mesh.clone()), kind);
            let mut positions = mesh.positions().to_vec();
            for round in 0..6 {
                // Inward, outward beyond all others, and back.
                let by = [0.9, 1.5, 0.5, -2.0, 3.0, 1.0][round];
                for k in 0..round.min(4) {
                    let vertex = (k * 577 + round * 31) % positions.len();
                    let [x, y, z] = mesh.positions()[vertex].to_array();
                    positions[vertex] = Point3::new(by * x, y + by - 1.0, by * z);
                }
                let moved =
                    TriangleMesh::new(positions.clone(), mesh.triangles().to_vec()).unwrap();
                assert!(accel.refit(Mesh::new(moved.clone())), "{name}, {kind}");
                let judge = Accel::build(Mesh::new(moved.clone()), StructureKind::BruteForce);
                assert_eq!(accel.bounds(), judge.bounds());
                for ray in rays::of_mesh(&moved, 0.2) {
                    let (found, expected) = (Answers::of(&accel, &ray), Answers::of(&judge, &ray));
                    assert_eq!(found, expected, "{name}, {kind}, {round}: {ray:?}");
                }
            }
        }
    }
}

#[test]
fn a_mesh_with_other_triangles_or_other_ends_is_built_anew() {
    let mesh = meshes::icosphere(1);
    let mut accel = Accel::build(Mesh::new(mesh.clone()), StructureKind::Bvh8);
    assert!(accel.refit(Mesh::new(mesh.clone())));
    let mut fewer = mesh.triangles().to_vec();
    fewer.pop();
    let fewer = TriangleMesh::new(mesh.positions().to_vec(), fewer).unwrap();
    assert!(!accel.refit(Mesh::new(fewer)));
    assert!(!accel.refit(Mesh::new(mesh.clone())));
    let mut endless = mesh.positions().to_vec();
    endless[3].y = f32::INFINITY;
    let endless = TriangleMesh::new(endless, mesh.triangles().to_vec()).unwrap();
    assert!(!accel.refit(Mesh::new(endless)));
    assert!(!accel.refit(Mesh::new(mesh)));
}
