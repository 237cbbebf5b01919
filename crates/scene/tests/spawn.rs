//! A ray that leaves a surface does not meet the place it leaves.

use ombra_accel::{Geometry, Mesh, Shapes, StructureKind, Traversable};
use ombra_geometry::shape::Sphere;
use ombra_geometry::{Object, Point3, Ray, Transform, TriangleMesh, Vector3, World as WorldSpace};
use ombra_scene::{Material, Scene, World};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn world(geometry: Geometry, world_from_object: Transform<Object, WorldSpace>) -> World {
    let mut scene = Scene::default();
    scene.add("thing", geometry, Material::default(), world_from_object);
    World::build(scene, StructureKind::BruteForce).unwrap()
}

fn vector(range: f32) -> impl Strategy<Value = Vector3> {
    let one = move || -range..range;
    (one(), one(), one()).prop_map(|(x, y, z)| Vector3::new(x, y, z))
}

/// From a thousandth to a thousand.
fn scale() -> impl Strategy<Value = f32> {
    (-3.0_f32..3.0).prop_map(|exponent| 10_f32.powf(exponent))
}

/// A direction at some angle to a surface, down to nearly none, on either side of it.
fn leaving(normal: Vector3, around: f32, height: f32) -> Vector3 {
    let (s, t) = normal.orthonormal_basis();
    s * around.cos() + t * around.sin() + normal * height
}

/// Steep to grazing, on either side.
fn heights() -> impl Strategy<Value = f32> {
    (-4.0_f32..1.0, any::<bool>()).prop_map(|(e, up)| 10_f32.powf(e) * if up { 1.0 } else { -1.0 })
}

/// The same cases in each run.
fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 4000,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn no_ray_from_a_triangle_meets_it(
        corners in [vector(1.0), vector(1.0), vector(1.0)],
        size in scale(),
        offset in vector(1e6),
        place in prop_oneof![Just(0_u8), Just(1), Just(2)],
        weights in (0.01_f32..0.98, 0.01_f32..0.98),
        around in 0.0_f32..6.3,
        height in heights(),
    ) {
        let (ab, ac) = (corners[1] - corners[0], corners[2] - corners[0]);
        // Slivers have no plane to speak of.
        prop_assume!(ab.cross(ac).length() > 0.05 * ab.length().max(ac.length()).powi(2));
        // At the origin, at the offset with coordinates of its own, or moved to it.
        let (shift, transform) = match place {
            0 => (Vector3::ZERO, Transform::identity()),
            1 => (offset, Transform::identity()),
            _ => (Vector3::ZERO, Transform::translation(offset.wide())),
        };
        let positions = corners.map(|c| Point3::ORIGIN + c * size + shift).to_vec();
        let mesh = TriangleMesh::new(positions.clone(), vec![[0, 1, 2]]).unwrap();
        let world = world(Geometry::Mesh(Mesh::new(mesh)), transform);
        let [a, b, c] = [0, 1, 2].map(|i| transform.point(positions[i].wide()));
        let (u, v) = (f64::from(weights.0), f64::from(weights.1));
        let (u, v) = if u + v > 0.99 { (0.99 - u, 0.99 - v) } else { (u, v) };
        let target = a + (b - a) * u + (c - a) * v;
        let from = target + (b - a).cross(c - a) * (1.0 / f64::from(size));
        let ray = Ray::new(from.cast(), (target - from).cast());
        prop_assume!(ray.is_valid());
        if let Some(hit) = world.intersect(&ray) {
            let place = world.interaction(&ray, &hit);
            let direction = leaving(place.normal.to_vector(), around, height);
            let away = place.spawn(direction);
            prop_assert_eq!(world.intersect(&away), None, "{:?} {:?}", place, away);
        }
    }

    #[test]
    fn no_ray_that_leaves_a_ball_outward_meets_it(
        size in scale(),
        offset in vector(1e6),
        place in prop_oneof![Just(0_u8), Just(1), Just(2)],
        seen_from in vector(1.0),
        distance in scale(),
        around in 0.0_f32..6.3,
        height in heights(),
    ) {
        let Some(seen_from) = seen_from.normalized() else { return Ok(()) };
        // A ball has to be larger than the grain of the coordinates where it stands.
        let size = if place == 0 { size } else { size.max(10.0) };
        let (centre, transform) = match place {
            0 => (Point3::ORIGIN, Transform::identity()),
            1 => (Point3::ORIGIN + offset, Transform::identity()),
            _ => (Point3::ORIGIN, Transform::translation(offset.wide())),
        };
        let ball = Sphere::new(centre, size);
        let world = world(Geometry::Shapes(Shapes(vec![ball.into()])), transform);
        let middle: Point3 = transform.point(centre.wide()).cast();
        let ray = Ray::new(middle + seen_from * (size * (1.0 + distance)), -seen_from);
        if let Some(hit) = world.intersect(&ray) {
            let place = world.interaction(&ray, &hit);
            let direction = leaving(place.normal.to_vector(), around, height.abs());
            prop_assert_eq!(world.intersect(&place.spawn(direction)), None, "{:?}", place);
        }
    }
}

#[test]
fn the_offset_is_small_compared_with_what_it_leaves() {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Point3::from);
    let mesh = TriangleMesh::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap();
    let world = world(Geometry::Mesh(Mesh::new(mesh)), Transform::identity());
    let ray = Ray::new(Point3::new(0.25, 0.25, 1.0), -Vector3::Z);
    let place = world.interaction(&ray, &world.intersect(&ray).unwrap());
    let origin = place.spawn(Vector3::Z).origin;
    assert!(origin.z > 0.0 && origin.z < 2e-6, "{origin:?}");
    assert_eq!(
        place.spawn_within(Vector3::Z, f32::INFINITY).t_max,
        f32::INFINITY
    );
}
