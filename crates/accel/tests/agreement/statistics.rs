//! What a query costs, counted.

use ombra_accel::{Accel, AnyHit, Statistics, StructureKind, Traversable};
use ombra_geometry::{EdgeRule, Point3, Ray};

use crate::numbers::Numbers;
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

/// What it costs to shoot at places within a ball of radius 1 from `away` of its extents, and how many
/// of 500 rays hit it.
fn cost_from(away: f64, accel: &impl Traversable) -> (usize, Statistics) {
    let mut numbers = Numbers::new(51);
    let mut statistics = Statistics::default();
    let hits = (0..500).filter(|_| {
        let target = Point3::new(0.0, 0.0, 0.0) + numbers.direction().wide() * 0.9;
        let direction = numbers.direction().wide();
        let ray = Ray::new(target - direction * (2.0 * away), direction);
        let counted = Some(&mut statistics);
        let mut accept = |_: &_| AnyHit::Accept;
        accel
            .search(&ray, EdgeRule::Closed, counted, &mut accept)
            .is_some()
    });
    (hits.count(), statistics)
}

#[test]
fn a_ray_from_afar_costs_hardly_more_than_one_from_nearby() {
    let ball = meshes::geometry(meshes::icosphere(4));
    for kind in [StructureKind::Bvh, StructureKind::Bih] {
        let accel = Accel::build(ball.clone(), kind);
        let (hits, near) = cost_from(2.0, &accel);
        assert_eq!(hits, 500);
        for away in [20.0, 1e3, 1e6, 1e9, 1e12] {
            let (hits, far) = cost_from(away, &accel);
            assert_eq!(hits, 500, "{kind} from {away}");
            assert!(
                far.tests_made <= 2 * near.tests_made,
                "{kind} from {away}: {far:?}, near {near:?}"
            );
        }
    }
}

#[test]
fn a_ray_from_afar_that_passes_by_tests_nothing() {
    let ball = meshes::geometry(meshes::icosphere(2));
    let mut numbers = Numbers::new(52);
    for &kind in StructureKind::ALL {
        if kind == StructureKind::BruteForce {
            continue;
        }
        let accel = Accel::build(ball.clone(), kind);
        // Planes tell the first two apart, and not the others.
        for away in [1e3, 1e6, 1e10, 1e12] {
            let direction = numbers.direction().wide();
            let (beside, _) = direction.orthonormal_basis();
            let origin = Point3::new(0.0, 0.0, 0.0) + beside * 4.0 - direction * away;
            let mut statistics = Statistics::default();
            let counted = Some(&mut statistics);
            let mut accept = |_: &_| AnyHit::Accept;
            let ray = Ray::new(origin, direction);
            let found = accel.search(&ray, EdgeRule::Closed, counted, &mut accept);
            assert_eq!(found, None);
            assert_eq!(statistics.tests_made, 0, "{kind} from {away}");
        }
    }
}
