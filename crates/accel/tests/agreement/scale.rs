//! A model that is larger or smaller has the same hits: nothing is compared with a size of its own.

use ombra_accel::{Accel, StructureKind, Traversable};
use ombra_geometry::{Hit, Point3, Ray, TriangleMesh, Vector3};

use crate::numbers::Numbers;
use crate::{meshes, rays};

/// The same model and the same rays, `by` times as large. `t` stays what it is where directions grow
/// with the model, and grows where they stay.
fn scaled_ray(ray: &Ray, by: f32, grow: bool) -> Ray {
    let t = if grow { 1.0 } else { by };
    Ray {
        origin: Point3::ORIGIN + ray.origin.to_vector() * by,
        direction: if grow {
            ray.direction * by
        } else {
            ray.direction
        },
        t_min: ray.t_min * t,
        t_max: ray.t_max * t,
    }
}

fn models() -> [(&'static str, TriangleMesh); 4] {
    [
        ("ball", meshes::icosphere(2)),
        ("cube", meshes::cuboid(1.0)),
        ("soup", meshes::random_soup(400, 1.0, 0.3)),
        ("slivers", meshes::slivers(100)),
    ]
}

/// What a hit says but for t, and its t as it would be on the model as it was.
fn unscaled(hit: &Hit, t: f32) -> (u32, u32, u32, u32) {
    let (u, v) = (hit.u.to_bits(), hit.v.to_bits());
    (hit.primitive.0, u, v, (hit.t / t).to_bits())
}

#[test]
fn by_a_power_of_two_every_bit_stays() {
    for (name, mesh) in models() {
        let rays = rays::of_mesh(&mesh, 0.25);
        // Of ordinary size: where a ray leaves the range of numbers, so does its multiple.
        let ordinary = |ray: &&Ray| (1e-3..=1e3).contains(&ray.direction.max_norm());
        let rays: Vec<Ray> = rays.iter().filter(ordinary).copied().collect();
        for &kind in StructureKind::ALL {
            let one = Accel::build(meshes::geometry(mesh.clone()), kind);
            let mut found = 0;
            for power in [-20, -13, -1, 1, 10, 20] {
                let by = 2.0_f32.powi(power);
                let moved = meshes::moved(&mesh, by, 0.0);
                let scaled = Accel::build(meshes::geometry(moved), kind);
                for grow in [false, true] {
                    let t = if grow { 1.0 } else { by };
                    let larger: Vec<_> = rays.iter().map(|r| scaled_ray(r, by, grow)).collect();
                    let mut many = vec![None; rays.len()];
                    scaled.intersect_many(&larger, &mut many);
                    for ((ray, larger), many) in rays.iter().zip(&larger).zip(many) {
                        let expected = one.intersect(ray).map(|hit| unscaled(&hit, 1.0));
                        let hit = scaled.intersect(larger);
                        let about = || format!("{name}, {kind}, 2^{power}: {ray:?}");
                        assert_eq!(hit.map(|hit| unscaled(&hit, t)), expected, "{}", about());
                        assert_eq!(many, hit, "{}", about());
                        assert_eq!(scaled.occluded(larger), expected.is_some(), "{}", about());
                        found += usize::from(hit.is_some());
                    }
                }
            }
            assert!(found > 100, "{name}, {kind}: {found} hits");
        }
    }
}

/// Whether a ray passes every edge of a mesh, and every other hit, by so much that rounding cannot
/// matter; worked out in double precision, triangle by triangle.
fn is_clear(ray: &Ray, mesh: &TriangleMesh) -> bool {
    let (origin, direction) = (ray.origin.wide(), ray.direction.wide());
    let mut crossed = Vec::new();
    for triangle in 0..mesh.triangles().len() {
        let [a, b, c] = mesh.corners(triangle).map(Point3::wide);
        let (ab, ac) = (b - a, c - a);
        let across = direction.cross(ac);
        let determinant = ab.dot(across);
        let from = origin - a;
        let u = from.dot(across) / determinant;
        let v = direction.dot(from.cross(ab)) / determinant;
        let inside = u.min(v).min(1.0 - u - v);
        let size = ab.length() * ac.length() * direction.length();
        let edge_on = determinant.abs() < 1e-3 * size;
        if edge_on && inside > -1e3 || inside.abs() < 1e-3 || inside.is_nan() {
            return false;
        }
        if inside > 0.0 {
            crossed.push(ac.dot(from.cross(ab)) / determinant);
        }
    }
    crossed.push(0.0);
    crossed.sort_by(f64::total_cmp);
    crossed.windows(2).all(|pair| pair[1] - pair[0] > 1e-3)
}

#[test]
fn by_any_factor_the_same_triangles_are_hit() {
    for (name, mesh) in models() {
        let mut numbers = Numbers::new(71);
        let rays: Vec<Ray> = (0..400)
            .map(|_| {
                let target = numbers.point(0.9);
                let from = target + numbers.direction() * numbers.within(0.5, 5.0);
                Ray::new(from, (target - from) * numbers.within(0.2, 2.0))
            })
            .filter(|ray| is_clear(ray, &mesh))
            .collect();
        for by in [1e-6, 3.3e-5, 0.7, 1234.5, 1e6] {
            let moved = meshes::moved(&mesh, by, 0.0);
            for &kind in StructureKind::ALL {
                let one = Accel::build(meshes::geometry(mesh.clone()), kind);
                let scaled = Accel::build(meshes::geometry(moved.clone()), kind);
                let mut found = 0;
                for ray in &rays {
                    let ids = |hit: Option<Hit>| hit.map(|hit| hit.primitive);
                    let expected = one.intersect(ray);
                    let larger = scaled_ray(ray, by, true);
                    let hit = scaled.intersect(&larger);
                    let about = || format!("{name}, {kind}, {by}: {ray:?}: {expected:?}, {hit:?}");
                    assert_eq!(ids(hit), ids(expected), "{}", about());
                    assert_eq!(scaled.occluded(&larger), hit.is_some(), "{}", about());
                    let (mut all, mut all_larger) = (Vec::new(), Vec::new());
                    one.all_hits(ray, &mut all);
                    scaled.all_hits(&larger, &mut all_larger);
                    let all = all.into_iter().map(|hit| hit.primitive);
                    let all_larger = all_larger.into_iter().map(|hit| hit.primitive);
                    assert!(all.eq(all_larger), "{}", about());
                    if let (Some(hit), Some(expected)) = (hit, expected) {
                        assert!(
                            (hit.t - expected.t).abs() <= 1e-4 * expected.t,
                            "{}",
                            about()
                        );
                        found += 1;
                    }
                }
                assert!(
                    found > 20 || name == "slivers",
                    "{name}, {kind}: {found} hits"
                );
            }
        }
    }
}

/// Where single precision gives out, double takes over, and the answers are the same.
#[test]
fn at_any_size_a_ray_through_a_ball_hits_the_same_triangle() {
    let ball = meshes::icosphere(2);
    let rays: Vec<Ray> = (0..200)
        .map(|i| {
            let mut numbers = Numbers::new(900 + i);
            let from = Point3::ORIGIN + numbers.direction() * 3.0;
            Ray::new(from, numbers.point(0.8) - from)
        })
        .filter(|ray| is_clear(ray, &ball))
        .collect();
    assert!(rays.len() > 50, "{} rays", rays.len());
    for &kind in StructureKind::ALL {
        let one = Accel::build(meshes::geometry(ball.clone()), kind);
        for by in [1e-30, 1e-12, 1e-9, 1e9, 1e12, 1e30] {
            let scaled = Accel::build(meshes::geometry(meshes::moved(&ball, by, 0.0)), kind);
            for ray in &rays {
                let expected = one.intersect(ray).map(|hit| hit.primitive);
                for grow in [false, true] {
                    let hit = scaled.intersect(&scaled_ray(ray, by, grow));
                    let found = hit.map(|hit| hit.primitive);
                    assert_eq!(found, expected, "{kind}, {by}: {ray:?}");
                }
            }
        }
    }
}

/// Distances have no size of their own either.
#[test]
fn distances_grow_with_the_model() {
    for (name, mesh) in models() {
        let one = Accel::build(meshes::geometry(mesh.clone()), StructureKind::default());
        let one = one.distances().unwrap();
        for power in [-60, -20, 20, 60] {
            let by = 2.0_f32.powi(power);
            let scaled = meshes::geometry(meshes::moved(&mesh, by, 0.0));
            let scaled = Accel::build(scaled, StructureKind::default());
            let mut numbers = Numbers::new(72);
            for _ in 0..100 {
                let point = numbers.point(2.0).to_vector();
                let at = |by: f32| Point3::new(0.0, 0.0, 0.0) + (point * by).wide();
                let near = one.closest_point(at(1.0), f64::INFINITY).unwrap();
                let larger = scaled.distances().unwrap();
                let larger = larger.closest_point(at(by), f64::INFINITY).unwrap();
                assert_eq!(larger.primitive, near.primitive, "{name}, 2^{power}");
                let expected = near.distance * f64::from(by);
                assert_eq!(
                    larger.distance.to_bits(),
                    expected.to_bits(),
                    "{name}, 2^{power}"
                );
                let zero: Vector3<f64> =
                    larger.point - at(by) - (near.point - at(1.0)) * f64::from(by);
                assert!(
                    zero.max_norm() <= 1e-15 * f64::from(by),
                    "{name}, 2^{power}"
                );
            }
        }
    }
}
