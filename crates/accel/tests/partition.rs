//! The structures that cut space give the answers of the brute-force loop, bit for bit.

use std::sync::Arc;

use ombra_accel::{
    Accel, AnyHit, Candidate, Geometry, Instance, Instances, Mesh, Primitives, Shapes, Statistics,
    StructureKind, Traversable,
};
use ombra_geometry::shape::{Shape, Sphere};
use ombra_geometry::{EdgeRule, GeometryId, Hit, Point3, Ray, Transform, TriangleMesh, Vector3};
use proptest::prelude::*;

const KINDS: [StructureKind; 7] = [
    StructureKind::Grid,
    StructureKind::Grid2,
    StructureKind::Octree,
    StructureKind::KdStack,
    StructureKind::KdRestart,
    StructureKind::KdShortStack,
    StructureKind::KdRopes,
];

/// Numbers in `[0, 1)`, the same for the same seed.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 = (self.0)
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / 16_777_216.0
    }

    fn below(&mut self, limit: usize) -> usize {
        ((self.next() * limit as f32) as usize).min(limit - 1)
    }

    /// In `[-1, 1)³`.
    fn vector(&mut self) -> Vector3 {
        let mut one = || self.next() * 2.0 - 1.0;
        Vector3::new(one(), one(), one())
    }

    fn point(&mut self) -> Point3 {
        Point3::ORIGIN + self.vector()
    }
}

fn mesh(corners: Vec<Point3>) -> Geometry {
    let triangles = (0..corners.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    let triangles = triangles.collect();
    Geometry::Mesh(Mesh::new(TriangleMesh::new(corners, triangles).unwrap()))
}

/// Triangles of about some size, in `[-1, 1]³`.
fn soup(count: usize, size: f32, seed: u64) -> Vec<Point3> {
    let mut numbers = Numbers(seed);
    (0..count)
        .flat_map(|_| {
            let at = numbers.point();
            [(); 3].map(|()| at + numbers.vector() * size)
        })
        .collect()
}

/// A square of 2 × 2 · `n`² triangles at a height, across z.
fn square(n: u32, z: f32) -> Vec<Point3> {
    let at = |i: u32, j: u32| {
        let along = |i: u32| i as f32 / n as f32 * 2.0 - 1.0;
        Point3::new(along(i), along(j), z)
    };
    (0..n * n)
        .flat_map(|k| {
            let (i, j) = (k / n, k % n);
            let [a, b] = [at(i, j), at(i + 1, j)];
            let [c, d] = [at(i, j + 1), at(i + 1, j + 1)];
            [a, b, d, a, d, c]
        })
        .collect()
}

fn moved(corners: Vec<Point3>, scale: f32, by: f32) -> Vec<Point3> {
    let by = Vector3::new(by, by, by);
    let moved = |p: Point3| Point3::ORIGIN + p.to_vector() * scale + by;
    corners.into_iter().map(moved).collect()
}

fn spheres(count: usize, seed: u64) -> Geometry {
    let mut numbers = Numbers(seed);
    let sphere = |_| Shape::from(Sphere::new(numbers.point(), numbers.next() * 0.2));
    Geometry::Shapes(Shapes((0..count).map(sphere).collect()))
}

/// Rays that a structure over these primitives may find hard.
fn rays(primitives: &Geometry, count: usize, seed: u64) -> Vec<Ray> {
    let mut numbers = Numbers(seed);
    let bounds = Accel::build(primitives.clone(), StructureKind::BruteForce).bounds();
    let (centre, extent) = if bounds.is_empty() {
        (Point3::ORIGIN, 1.0)
    } else {
        (bounds.centre(), bounds.extent().max_norm().max(1e-30))
    };
    let corner = |numbers: &mut Numbers| match primitives {
        Geometry::Mesh(mesh) if !mesh.mesh().positions().is_empty() => {
            let positions = mesh.mesh().positions();
            positions[numbers.below(positions.len())]
        }
        _ => centre + numbers.vector() * (0.5 * extent),
    };
    let mut rays = Vec::new();
    for i in 0..count {
        let within = centre + numbers.vector() * (0.6 * extent);
        let mut axis = Vector3::ZERO.to_array();
        axis[i % 3] = if i % 2 == 0 { 1.0 } else { -1.0 };
        let axis = Vector3::from(axis);
        // Cell planes lie at halves, quarters and so on of the box as well as at corners.
        let fraction = numbers.below(9) as f32 / 8.0;
        let on_plane = bounds.min.lerp(bounds.max, fraction);
        let (a, b) = (corner(&mut numbers), corner(&mut numbers));
        let middle = a.lerp(b, 0.5);
        let away = numbers.vector() * extent;
        let any = numbers.vector();
        rays.extend([
            Ray::new(within, any),
            Ray::new(within + away * 3.0, within - (within + away * 3.0)),
            Ray::new(within - axis * (2.0 * extent), axis),
            Ray::new(on_plane - axis * (2.0 * extent), axis),
            Ray::new(a - axis * extent, axis),
            Ray::new(a, axis),
            Ray::new(a, b - a),
            Ray::new(b + away, a - (b + away)),
            Ray::new(middle + away, middle - (middle + away)),
            Ray::new(within + away * 1e3, -away),
            Ray::new(a + away * 1e6, a - (a + away * 1e6)),
            Ray::new(a + away * 1e12, -away),
            Ray::between(within, a.lerp(b, 1.5)),
            Ray {
                t_min: numbers.next() * 0.5,
                t_max: 0.5 + numbers.next(),
                ..Ray::between(a + away, b)
            },
        ]);
    }
    let good = Ray::new(centre, Vector3::X);
    let nan = f32::NAN;
    rays.extend([
        Ray::new(centre, Vector3::ZERO),
        Ray::new(centre, Vector3::new(nan, 0.0, 0.0)),
        Ray::new(Point3::new(nan, 0.0, 0.0), Vector3::X),
        Ray::new(Point3::new(f32::INFINITY, 0.0, 0.0), Vector3::X),
        Ray::new(centre, Vector3::new(1e-45, 0.0, 0.0)),
        Ray::new(centre, Vector3::new(f32::MAX, 1e-45, -0.0)),
        Ray { t_min: nan, ..good },
        Ray { t_max: nan, ..good },
        Ray {
            t_min: 1.0,
            t_max: 0.0,
            ..good
        },
        Ray {
            t_min: f32::NEG_INFINITY,
            ..good
        },
    ]);
    rays
}

fn bits(hit: &Hit) -> (u32, u32, u32, u32, u32, u32) {
    let numbers = (hit.t.to_bits(), hit.u.to_bits(), hit.v.to_bits());
    let ids = (hit.primitive.0, hit.geometry.0, hit.instance.0);
    (numbers.0, numbers.1, numbers.2, ids.0, ids.1, ids.2)
}

/// Every crossing that is shown to the any-hit program, sorted.
fn shown(accel: &impl Traversable, ray: &Ray) -> Vec<(u64, u32, u32)> {
    let mut shown = Vec::new();
    let closed = EdgeRule::Closed;
    let mut note = |candidate: &Candidate| {
        let (t, primitive) = (candidate.t, candidate.primitive.0);
        shown.push((t.to_bits(), primitive, candidate.instance.0));
        AnyHit::Ignore
    };
    accel.search(&(*ray).into(), closed, None, &mut note);
    shown.sort_unstable();
    shown
}

fn check<P: Primitives + Clone>(name: &str, primitives: &P, rays: &[Ray]) {
    let judge = Accel::build(primitives.clone(), StructureKind::BruteForce);
    let mut hits = Vec::new();
    let expected: Vec<_> = rays
        .iter()
        .map(|ray| {
            judge.all_hits(ray, &mut hits);
            let all: Vec<_> = hits.iter().map(bits).collect();
            let closest = judge.intersect(ray).as_ref().map(bits);
            (closest, judge.occluded(ray), all, shown(&judge, ray))
        })
        .collect();
    for kind in KINDS {
        let accel = Accel::build(primitives.clone(), kind);
        for (ray, (closest, occluded, all, every)) in rays.iter().zip(&expected) {
            let context = || format!("{name}, {kind}, {ray:?}");
            assert_eq!(
                accel.intersect(ray).as_ref().map(bits),
                *closest,
                "{}",
                context()
            );
            assert_eq!(accel.occluded(ray), *occluded, "{}", context());
            accel.all_hits(ray, &mut hits);
            let found: Vec<_> = hits.iter().map(bits).collect();
            assert_eq!(found, *all, "{}", context());
            assert_eq!(shown(&accel, ray), *every, "{}", context());
        }
    }
}

fn check_geometry(name: &str, primitives: &Geometry, count: usize) {
    check(name, primitives, &rays(primitives, count, 7));
}

#[test]
fn nothing_and_next_to_nothing_give_the_same_answers() {
    let p = Point3::new;
    let one = [p(0.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.0, 1.0, 0.0)];
    let nan = p(f32::NAN, 0.0, 0.0);
    let needle = [p(0.0, 0.0, 0.0), p(1.0, 1.0, 1.0), p(0.5, 0.5, 0.5)];
    check_geometry("nothing", &mesh(vec![]), 20);
    check_geometry("one", &mesh(one.to_vec()), 100);
    check_geometry("all the same", &mesh(one.repeat(200)), 20);
    check_geometry("a point", &mesh(vec![p(1e7, 1e7, 1e7); 300]), 20);
    check_geometry("no area", &mesh(needle.repeat(50)), 20);
    let with_nan = [one, [nan; 3], one.map(|c| c + Vector3::Z)].concat();
    check_geometry("NaN", &mesh(with_nan), 50);
    check_geometry("no shapes", &Geometry::Shapes(Shapes(vec![])), 20);
}

#[test]
fn flat_scenes_give_the_same_answers() {
    check_geometry("a square", &mesh(square(16, 0.0)), 40);
    check_geometry("a square high up", &mesh(square(16, 1e7)), 20);
    let tiny = moved(square(4, 0.0), 1e-6, 0.0);
    let tiny = tiny.into_iter().map(|p| Point3::new(p.x, p.y, 1e7));
    check_geometry("a tiny square very high up", &mesh(tiny.collect()), 20);
    let storeys: Vec<_> = (0..8).flat_map(|i| square(6, i as f32 * 0.25)).collect();
    check_geometry("storeys", &mesh(storeys.clone()), 40);
    let on_edge = storeys.iter().map(|p| Point3::new(p.z, p.x, p.y));
    check_geometry("walls", &mesh(on_edge.collect()), 40);
    let everywhere = square(12, 0.0).into_iter().flat_map(|p| {
        [
            p,
            Point3::new(p.x * 2.0, p.y, p.z),
            Point3::new(p.z, p.x, p.y),
        ]
    });
    check_geometry("crossing planes", &mesh(everywhere.collect()), 30);
}

#[test]
fn soups_of_every_size_and_place_give_the_same_answers() {
    check_geometry("small", &mesh(soup(1500, 0.05, 1)), 40);
    check_geometry("large", &mesh(soup(300, 1.0, 2)), 30);
    for (scale, by) in [
        (1e-6, 0.0),
        (1e6, 0.0),
        (1.0, 1e6),
        (100.0, 1e7),
        (1e-20, 0.0),
        (1e18, 0.0),
    ] {
        let corners = moved(soup(400, 0.1, 3), scale, by);
        check_geometry(&format!("{scale} at {by}"), &mesh(corners), 15);
    }
}

#[test]
fn slivers_and_mixed_sizes_give_the_same_answers() {
    let mut numbers = Numbers(5);
    let slivers: Vec<_> = (0..400)
        .flat_map(|_| {
            let (a, along) = (numbers.point(), numbers.vector());
            [a, a + along, a + along * 0.5 + numbers.vector() * 1e-5]
        })
        .collect();
    check_geometry("slivers", &mesh(slivers), 40);
    let mixed = [
        soup(10, 1000.0, 8),
        soup(500, 0.05, 9),
        moved(soup(200, 0.5, 10), 1e-4, 0.3),
    ];
    check_geometry("huge and tiny", &mesh(mixed.concat()), 40);
}

#[test]
fn spheres_give_the_same_answers() {
    check_geometry("spheres", &spheres(400, 11), 60);
    let tiny = Sphere::new(Point3::ORIGIN, 1e-30);
    let far = Sphere::new(Point3::new(0.0, 0.0, 1e-29), 1e-30);
    let dots = Geometry::Shapes(Shapes(vec![tiny.into(), far.into()]));
    let from = |z: f32| Ray::new(Point3::new(0.0, 0.0, z), Vector3::Z);
    check("dots", &dots, &[from(-1.0), from(-1e-20), from(-1e-28)]);
}

#[test]
fn instances_give_the_same_answers() {
    let geometry = mesh(soup(100, 0.3, 12));
    let lower = Arc::new(Accel::build(geometry.clone(), StructureKind::KdStack));
    let mut numbers = Numbers(13);
    let instances = (0..40)
        .map(|i| {
            let place = if i == 0 {
                Transform::identity()
            } else {
                Transform::translation((numbers.vector() * 4.0).wide())
            };
            Instance::new(GeometryId(0), place)
        })
        .collect();
    let placed = Instances::new(vec![lower], instances);
    check("instances", &placed, &rays(&geometry, 25, 14));
}

#[test]
fn a_walk_visits_cells_and_counts_them() {
    let geometry = mesh(soup(2000, 0.02, 15));
    for kind in KINDS {
        let accel = Accel::build(geometry.clone(), kind);
        let mut all = Statistics::default();
        let through = Ray::new(Point3::new(-3.0, 0.1, 0.2), Vector3::X);
        let ignore = &mut |_: &Candidate| AnyHit::Ignore;
        accel.search(&through.into(), EdgeRule::Closed, Some(&mut all), ignore);
        let nodes = all.nodes_visited;
        assert!((5..500).contains(&nodes), "{kind}: {nodes} nodes");
        let tests = accel.intersect_counted(&through).1.tests_made;
        assert!(tests < 500, "{kind}: {tests} tests of 2000");
    }
}

#[test]
fn memory_stays_in_proportion_whatever_the_primitives_are() {
    let scenes = [
        ("huge", soup(2000, 1.0, 16)),
        ("the same", soup(1, 1.0, 17).repeat(2000)),
        ("flat", square(32, 0.0)),
        (
            "huge and tiny",
            [soup(1000, 100.0, 18), soup(1000, 0.01, 19)].concat(),
        ),
    ];
    for (name, corners) in scenes {
        let count = corners.len() / 3;
        let geometry = mesh(corners);
        for kind in KINDS {
            let bytes = Accel::build(geometry.clone(), kind).structure_bytes();
            assert!(
                bytes <= 2500 * count,
                "{name}, {kind}: {bytes} bytes for {count}"
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 48,
        rng_seed: prop::test_runner::RngSeed::Fixed(20),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// Corners and rays on a coarse lattice: everything coincides with something.
    #[test]
    fn coinciding_corners_planes_and_rays_give_the_same_answers(
        corners in prop::collection::vec((0_i8..4, 0_i8..4, 0_i8..4), 3..120),
        rays in prop::collection::vec(((-1_i8..5, -1_i8..5, -1_i8..5), (-1_i8..2, -1_i8..2, -1_i8..2)), 20),
    ) {
        let point = |(x, y, z): (i8, i8, i8)| Point3::new(f32::from(x), f32::from(y), f32::from(z));
        let geometry = mesh(corners.into_iter().map(point).collect());
        let rays: Vec<_> = rays
            .into_iter()
            .map(|(origin, towards)| Ray::new(point(origin), point(towards) - Point3::ORIGIN))
            .collect();
        check("on a lattice", &geometry, &rays);
    }
}
