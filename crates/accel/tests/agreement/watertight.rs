//! What counts as a hit must not open cracks.

use std::sync::Arc;

use ombra_accel::{Accel, AnyHit, Instance, Instances, Mesh, StructureKind, Traversable};
use ombra_geometry::triangle::TriangleTest;
use ombra_geometry::{
    EdgeRule, GeometryId, Object, Point3, Ray, Transform, TriangleMesh, Vector3, World,
};

use crate::meshes;
use crate::numbers::Numbers;

/// Size and place of a mesh.
const PLACES: [(f32, f32); 5] = [
    (1.0, 0.0),
    (1e-6, 0.0),
    (1e6, 0.0),
    (100.0, 1e6),
    (1e3, 1e7),
];

fn ball((scale, by): (f32, f32)) -> TriangleMesh {
    meshes::moved(&meshes::icosphere(3), scale, by)
}

/// A vertex, or a point on an edge, of a triangle that `from` sees from the front, and not so much
/// from the side that it could be at the rim of the ball.
fn target(mesh: &TriangleMesh, towards: Vector3<f64>, numbers: &mut Numbers) -> Point3<f64> {
    loop {
        let triangle = numbers.below(mesh.triangles().len());
        let normal = mesh.geometric_normal(triangle).unwrap();
        if normal.dot(towards) < -0.4 {
            let [a, b, _] = mesh.corners(triangle).map(Point3::wide);
            let along = [0.0, 0.5, numbers.within(0.0, 1.0)][numbers.below(3)];
            return a.lerp(b, f64::from(along));
        }
    }
}

/// How many rays at vertices and edges, from `away` extents of a ball, go through.
fn leaks_from(
    away: f64,
    mesh: &TriangleMesh,
    accel: &impl Traversable,
    placed: &Transform<Object, World>,
    rays: usize,
) -> usize {
    let mut numbers = Numbers::new(33);
    let extent = f64::from(mesh.bounds().extent().max_norm());
    let leaks = |_: &usize| {
        let towards = numbers.direction().wide();
        let target = target(mesh, towards, &mut numbers);
        let ray = Ray::new(target - towards * (away * extent), towards);
        let mut accept = |_: &_| AnyHit::Accept;
        let found = accel.search(&placed.ray(&ray), EdgeRule::Closed, None, &mut accept);
        found.is_none()
    };
    (0..rays).filter(leaks).count()
}

/// From within a closed mesh, at edges and vertices.
fn leaks_from_within(
    (scale, _): (f32, f32),
    mesh: &TriangleMesh,
    accel: &impl Traversable,
    rays: usize,
) -> usize {
    let mut numbers = Numbers::new(31);
    let centre = mesh.bounds().centre();
    let ray = |_: &usize| {
        let from = centre + numbers.point(0.5).to_vector() * scale;
        let [a, b, _] = mesh.corners(numbers.below(mesh.triangles().len()));
        let along = [0.0, 0.5, numbers.within(0.0, 1.0)][numbers.below(3)];
        let target: Point3 = a.lerp(b, along);
        let ray = Ray::new(from, target - from);
        accel.intersect(&ray).is_none()
    };
    (0..rays).filter(ray).count()
}

#[test]
fn no_ray_escapes_from_a_closed_mesh_in_any_structure() {
    for place in PLACES {
        let mesh = ball(place);
        for &kind in StructureKind::ALL {
            let rays = if kind == StructureKind::BruteForce {
                300
            } else {
                6_000
            };
            let accel = Accel::build(meshes::geometry(mesh.clone()), kind);
            let leaks = leaks_from_within(place, &mesh, &accel, rays);
            assert_eq!(leaks, 0, "{kind}, size and place {place:?}");
        }
    }
}

#[test]
fn no_ray_from_outside_slips_through_a_closed_mesh_from_however_far() {
    // Near enough for single precision, hardly so, hardly not, and far.
    const AWAY: [f64; 5] = [2.0, 15.0, 17.0, 1e4, 1e8];
    let uneven = Transform::<Object, World>::scale(Vector3::new(1.0, 0.02, 3.0));
    for place in PLACES {
        let mesh = ball(place);
        for &kind in StructureKind::ALL {
            let rays = if kind == StructureKind::BruteForce {
                60
            } else {
                600
            };
            let alone = Arc::new(Accel::build(meshes::geometry(mesh.clone()), kind));
            let instance = Instance::new(GeometryId(0), uneven);
            let placed = Instances::new(vec![Arc::clone(&alone)], vec![instance]);
            let placed = Accel::build(placed, kind);
            for away in AWAY {
                let about = format!("{kind}, size and place {place:?}, from {away}");
                let here = Transform::identity();
                let leaks = leaks_from(away, &mesh, &*alone, &here, rays);
                assert_eq!(leaks, 0, "{about}");
                let leaks = leaks_from(away, &mesh, &placed, &uneven, rays);
                assert_eq!(leaks, 0, "{about}, unevenly scaled");
            }
        }
    }
}

#[test]
fn a_sliver_is_hit_as_well_as_any_triangle_by_every_test() {
    for test in TriangleTest::ALL {
        let mut numbers = Numbers::new(32);
        for width in [1e-2, 1e-3, 1e-4, 1e-5] {
            for _ in 0..3000 {
                // Lying across y, so that its box is flat, and along x.
                let [a, b] = [-0.9, 0.8].map(|x| Point3::new(x, 0.0, 0.3));
                let c = b + Vector3::Z * width;
                let mesh = Mesh::with_test(meshes::soup(vec![[a, b, c]]), test);
                let accel = Accel::build(mesh, StructureKind::BruteForce);
                let target = a.lerp(b.lerp(c, 0.5), numbers.within(0.3, 0.9));
                let direction = numbers.direction();
                if direction.y.abs() < 0.2 {
                    continue;
                }
                let ray = Ray::new(target - direction, direction);
                let hit = accel.intersect(&ray);
                let off = hit.map(|hit| (hit.t - 1.0).abs());
                assert!(
                    off.is_some_and(|off| off < 4e-6),
                    "{test}, {width}: {ray:?}: {hit:?}"
                );
            }
        }
    }
}

#[test]
fn a_flat_face_is_hit_from_where_double_precision_is_blunter_than_the_pad() {
    let mut numbers = Numbers::new(34);
    for &kind in StructureKind::ALL {
        let cube = Accel::build(meshes::geometry(meshes::cuboid(0.5)), kind);
        for away in [1e10, 1e11, 1e12, 1e13] {
            for _ in 0..100 {
                let target = numbers.point(0.3).wide();
                let towards = numbers.direction().wide();
                let ray = Ray::new(target - towards * away, towards);
                let mut accept = |_: &_| AnyHit::Accept;
                let found = cube.search(&ray, EdgeRule::Closed, None, &mut accept);
                assert!(found.is_some(), "{kind} from {away}: {ray:?}");
            }
        }
    }
}
