//! What a mask hides is as if it were not there.

use std::sync::Arc;

use ombra_accel::{
    Accel, ClosestPoint, Geometry, Instance, Instances, Shapes, StructureKind, Traversable,
};
use ombra_geometry::shape::{Shape, Sphere};
use ombra_geometry::{GeometryId, Hit, Point3, Transform, Vector3};

use crate::numbers::Numbers;
use crate::{meshes, rays};

/// Two geometries, of which one is shapes, eleven times each, with masks.
fn placements() -> Vec<Instance> {
    let masks = [u32::MAX, 1, 2, 3, 4, 0, 1 << 31, 6, 1, 2, 4];
    (0..22)
        .map(|i| {
            let by = Vector3::new(f64::from(i % 5), f64::from(i % 3), f64::from(i % 7));
            let place = Transform::translation(by * 0.8);
            Instance {
                mask: masks[i as usize % masks.len()],
                ..Instance::new(GeometryId(i % 2), place)
            }
        })
        .collect()
}

fn build(kind: StructureKind, placements: Vec<Instance>) -> Accel<Instances<Geometry>> {
    let ball = |x: f32| Shape::from(Sphere::new(Point3::new(x, 0.0, 0.5), 0.75));
    let geometries = [
        meshes::geometry(meshes::icosphere(1)),
        Geometry::Shapes(Shapes(vec![ball(0.0), ball(-1.0)])),
    ];
    let geometries = geometries.map(|geometry| Arc::new(Accel::build(geometry, kind)));
    Accel::build(Instances::new(geometries.to_vec(), placements), kind)
}

/// A hit with its instance's number among those that a mask sees as it is among all.
fn numbered(hit: Option<Hit>, seen: &[u32]) -> Option<Hit> {
    hit.map(|mut hit| {
        hit.instance.0 = seen[hit.instance.index()];
        hit
    })
}

#[test]
fn a_masked_query_sees_what_is_left_without_the_rest() {
    let all = placements();
    for &kind in StructureKind::ALL {
        let accel = build(kind, all.clone());
        let rays = rays::around(&accel.bounds().corners(), 0.4);
        for mask in [0, 1, 2, 5, 1 << 31, 8, u32::MAX] {
            let seen: Vec<u32> = (0..all.len() as u32)
                .filter(|&i| all[i as usize].mask & mask != 0)
                .collect();
            let left = seen.iter().map(|&i| all[i as usize].clone()).collect();
            let (expected, masked) = (build(kind, left), accel.masked(mask));
            let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
            masked.intersect_many(&rays, &mut hits);
            masked.occluded_many(&rays, &mut occluded);
            let mut found = 0;
            for (i, ray) in rays.iter().enumerate() {
                let hit = numbered(expected.intersect(ray), &seen);
                assert_eq!(masked.intersect(ray), hit, "{kind}, {mask:b}: {ray:?}");
                assert_eq!(
                    masked.occluded(ray),
                    hit.is_some(),
                    "{kind}, {mask:b}: {ray:?}"
                );
                assert_eq!((hits[i], occluded[i]), (hit, hit.is_some()));
                assert_eq!(masked.intersect_counted(ray).0, hit);
                let (mut every, mut every_left) = (Vec::new(), Vec::new());
                masked.all_hits(ray, &mut every);
                expected.all_hits(ray, &mut every_left);
                let every_left = every_left
                    .iter()
                    .filter_map(|hit| numbered(Some(*hit), &seen));
                assert_eq!(
                    every,
                    every_left.collect::<Vec<_>>(),
                    "{kind}, {mask:b}: {ray:?}"
                );
                found += usize::from(hit.is_some());
            }
            assert_eq!(found == 0, mask == 0, "{kind}, {mask:b}");
        }
    }
}

#[test]
fn a_query_without_a_mask_has_all_bits() {
    for &kind in StructureKind::ALL {
        let accel = build(kind, placements());
        for ray in rays::around(&accel.bounds().corners(), 0.2) {
            let hit = accel.intersect(&ray);
            assert_eq!(hit, accel.masked(u32::MAX).intersect(&ray), "{kind}");
            // Whose mask is 0 is never seen: every eleventh, from the sixth.
            assert!(hit.is_none_or(|hit| hit.instance.0 % 11 != 5), "{kind}");
        }
    }
}

#[test]
fn distances_are_asked_of_what_a_mask_sees() {
    let all = placements();
    for kind in [StructureKind::BruteForce, StructureKind::default()] {
        let accel = build(kind, all.clone());
        let mut numbers = Numbers::new(91);
        for mask in [0, 1, 6, 1 << 31, u32::MAX] {
            let seen: Vec<u32> = (0..all.len() as u32)
                .filter(|&i| all[i as usize].mask & mask != 0)
                .collect();
            let left = seen.iter().map(|&i| all[i as usize].clone()).collect();
            let (expected, masked) = (build(kind, left), accel.masked(mask));
            let (expected, masked) = (expected.distances(), masked.distances());
            let (expected, masked) = (expected.unwrap(), masked.unwrap());
            let (mut found, mut found_left) = (Vec::new(), Vec::new());
            for _ in 0..50 {
                let point = numbers.point(4.0).wide();
                let numbered = |mut near: ClosestPoint| {
                    near.instance.0 = seen[near.instance.index()];
                    near
                };
                let nearest = expected.closest_point(point, f64::INFINITY).map(numbered);
                assert_eq!(
                    masked.closest_point(point, f64::INFINITY),
                    nearest,
                    "{kind}, {mask:b}"
                );
                assert_eq!(
                    masked.within_distance(point, 0.5),
                    expected.within_distance(point, 0.5)
                );
                masked.all_within(point, 1.5, &mut found);
                expected.all_within(point, 1.5, &mut found_left);
                let found_left = found_left.iter().copied().map(numbered);
                assert!(found.iter().copied().eq(found_left), "{kind}, {mask:b}");
                assert_eq!(nearest.is_none(), mask == 0, "{kind}, {mask:b}");
            }
        }
    }
}
