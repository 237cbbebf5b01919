//! What a query costs, counted.

use ombra_accel::{Accel, Statistics, StructureKind, Traversable};

use crate::{meshes, rays};

#[test]
fn brute_force_tests_everything_and_every_other_structure_much_less() {
    let mesh = meshes::icosphere(5);
    let triangles = mesh.triangles().len() as u64;
    let rays: Vec<_> = rays::of_mesh(&mesh, 1.0)
        .into_iter()
        .filter(|ray| ray.is_valid())
        .collect();
    let all = triangles * rays.len() as u64;
    let geometry = meshes::geometry(mesh);
    for &kind in StructureKind::ALL {
        let accel = Accel::build(geometry.clone(), kind);
        let counted = rays.iter().map(|ray| {
            let (hit, statistics) = accel.intersect_counted(ray);
            assert_eq!(
                hit,
                accel.intersect(ray),
                "{kind}: counting changes nothing"
            );
            statistics
        });
        let Statistics {
            nodes_visited,
            tests_made,
        } = counted.sum();
        if kind == StructureKind::BruteForce {
            assert_eq!(tests_made, all);
            assert_eq!(nodes_visited, 0);
        } else {
            assert!(
                0 < tests_made && tests_made < all / 20,
                "{kind}: {tests_made} of {all}"
            );
            assert!(
                0 < nodes_visited && nodes_visited < all / 10,
                "{kind}: {nodes_visited}"
            );
        }
    }
}
