//! Rays that go much the same way, which kernels may take together: alone, in any order, and among
//! others, each gets its own answer.

use ombra_accel::{Accel, Level, StructureKind, Traversable};
use ombra_geometry::{Aabb, Point3, Ray, TriangleMesh, Vector3};

use crate::answers::bits;
use crate::meshes;
use crate::numbers::Numbers;

const KINDS: [StructureKind; 3] = [
    StructureKind::Bvh8,
    StructureKind::Bvh8High,
    StructureKind::Bvh8Compact,
];

/// Bundles of rays through the corners, edges and insides of a mesh: from one point, along one
/// direction, and from a small region.
fn bundles(mesh: &TriangleMesh, numbers: &mut Numbers) -> Vec<Vec<Ray>> {
    let corners: Vec<[Point3; 3]> = (0..mesh.triangles().len())
        .map(|i| mesh.corners(i))
        .filter(|corners| corners.iter().all(|p| p.is_finite()))
        .collect();
    let bounds = Aabb::around(corners.concat());
    let size = bounds.extent().max_norm();
    if corners.is_empty() || !(size < 1e18) {
        return Vec::new();
    }
    let targets: Vec<Point3> = (0..400)
        .map(|_| {
            let [a, b, c] = corners[numbers.below(corners.len())];
            match numbers.below(3) {
                0 => a,
                1 => a.lerp(b, 0.5),
                _ => a.lerp(b, numbers.within(0.0, 1.0)).lerp(c, 0.25),
            }
        })
        .collect();
    let mut bundles = Vec::new();
    for away in [0.2, 1.5, 4.0, 12.0] {
        let way = numbers.direction();
        let eye = bounds.centre() + way * (away * size);
        bundles.push(targets.iter().map(|&to| Ray::new(eye, to - eye)).collect());
        let sun = |&to: &Point3| Ray::new(to + way * (away * size), -way);
        bundles.push(targets.iter().map(sun).collect());
        let mut down = Vector3::new(0.0, -0.0, 0.0);
        down[ombra_geometry::Axis::ALL[numbers.below(3)]] = -size;
        let straight = |&to: &Point3| Ray::new(to - down, down);
        bundles.push(targets.iter().map(straight).collect());
        let near_by = |&to: &Point3| {
            let from = eye + numbers.direction() * (0.02 * size);
            Ray::new(from, to - from)
        };
        bundles.push(targets.iter().map(near_by).collect());
    }
    bundles
}

/// Some rays of a bundle end or begin at their hit, exactly or by one number, or are no rays at all.
fn limited(rays: &mut [Ray], judge: &impl Traversable) {
    for (k, ray) in rays.iter_mut().enumerate() {
        let Some(hit) = judge.intersect(ray) else {
            continue;
        };
        match k % 9 {
            0 => ray.t_max = hit.t,
            1 => ray.t_min = hit.t,
            2 => ray.t_max = hit.t.next_down().max(0.0),
            3 => ray.t_min = hit.t.next_up(),
            4 if k % 4 == 0 => ray.direction.x = f32::NAN,
            5 if k % 4 == 0 => [ray.t_min, ray.t_max] = [1.0, 0.5],
            _ => {}
        }
    }
}

fn shuffle(rays: &mut [Ray], numbers: &mut Numbers) {
    for k in (1..rays.len()).rev() {
        rays.swap(k, numbers.below(k + 1));
    }
}

fn assert_each_has_its_own(
    name: &str,
    accel: &impl Traversable,
    judge: &impl Traversable,
    rays: &[Ray],
) {
    let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
    accel.intersect_many(rays, &mut hits);
    accel.occluded_many(rays, &mut occluded);
    for ((ray, hit), occluded) in rays.iter().zip(&hits).zip(occluded) {
        let expected = judge.intersect(ray);
        assert_eq!(
            hit.as_ref().map(bits),
            expected.as_ref().map(bits),
            "{name}: {ray:?}"
        );
        assert_eq!(occluded, expected.is_some(), "{name}: {ray:?}");
    }
}

#[test]
fn rays_that_go_together_each_get_their_own_answer() {
    let mut hits = 0;
    for (name, mesh) in meshes::all() {
        let mut numbers = Numbers::new(3);
        let primitives = meshes::geometry(mesh.clone());
        let judge = Accel::build(primitives.clone(), StructureKind::BruteForce);
        let mut bundles = bundles(&mesh, &mut numbers);
        for (k, bundle) in bundles.iter_mut().enumerate() {
            if k % 2 == 1 {
                limited(bundle, &judge);
            }
            hits += bundle.iter().filter(|ray| judge.occluded(ray)).count();
        }
        let mut mixed = bundles.concat();
        shuffle(&mut mixed, &mut numbers);
        for kind in KINDS {
            for level in Level::available() {
                let accel = Accel::build(primitives.clone(), kind).at_level(level);
                let name = format!("{name}, {kind}, {level:?}");
                for bundle in &bundles {
                    assert_each_has_its_own(&name, &accel, &judge, bundle);
                }
                assert_each_has_its_own(&name, &accel, &judge, &mixed);
            }
        }
    }
    assert!(hits > 50_000, "{hits}");
}
