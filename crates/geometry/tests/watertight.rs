//! No ray escapes from a closed mesh through an edge or a vertex, and counting crossings tells
//! inside from outside.
//!
//! Every ray is tested against every triangle of a small closed mesh, so the claim does not rest on
//! a structure. `OMBRA_WATERTIGHT_RAYS` sets how many rays are fired (10⁶ if it is not set; a full
//! check is 100000000).

use ombra_geometry::mesh::generate::{cuboid, icosphere, torus};
use ombra_geometry::triangle::TriangleTest;
use ombra_geometry::{Aabb, Crossing, EdgeRule, Point3, Ray, TriangleMesh, Vector3};

/// How many rays are fired at one mesh before another one is made.
const RAYS_A_MESH: u64 = 2_000;

/// SplitMix64: Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in `[0, 1)`.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.unit()
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }

    fn vector(&mut self, reach: f64) -> Vector3<f64> {
        let mut one = || self.between(-reach, reach);
        Vector3::new(one(), one(), one())
    }
}

/// A closed mesh and a point well inside.
struct Closed {
    mesh: TriangleMesh,
    inside: Point3<f64>,
    size: f64,
}

/// A ball, a box or a ring, of any size, anywhere up to 10⁶ from the origin of coordinates along
/// each axis, its vertices moved a little.
fn closed(random: &mut Random) -> Closed {
    let away = 10_f64.powf(random.between(-1.0, 6.0));
    // Large enough that vertices in single precision still enclose the point inside.
    let size = away * 10_f64.powf(random.between(-3.0, 0.0));
    let centre = Point3::new(0.0, 0.0, 0.0) + random.vector(away);
    let (near, s) = (centre.cast::<f32>(), size as f32);
    let (mesh, inside) = match random.below(4) {
        0 => (icosphere(0, near, s), centre),
        1 => (icosphere(1, near, s), centre),
        2 => (cuboid(&Aabb::around([near]).padded(s)), centre),
        _ => {
            let (sin, cos) = random.between(0.0, 6.3).sin_cos();
            // The cross-section is a hexagon, the ring a decagon: its sides cut inward.
            let on_ring = Vector3::new(cos, sin, 0.0) * (size * 0.72 * 0.97);
            (torus(near, [s * 0.72, s * 0.28], [10, 6]), centre + on_ring)
        }
    };
    let jitter = if random.below(2) == 0 {
        0.0
    } else {
        size * 0.02
    };
    let moved = mesh
        .positions()
        .iter()
        .map(|p| (p.wide() + random.vector(jitter)).cast());
    let mesh = TriangleMesh::new(moved.collect(), mesh.triangles().to_vec()).unwrap();
    let inside = inside + random.vector(size * 0.03);
    Closed { mesh, inside, size }
}

/// A vertex of the mesh, or a point on an edge: its middle, a point that is a dyadic part of the
/// way, or any point.
fn target(mesh: &TriangleMesh, random: &mut Random) -> Point3<f64> {
    let triangle = random.below(mesh.triangles().len());
    let corners = mesh.corners(triangle).map(Point3::wide);
    let side = random.below(3);
    let (from, to) = (corners[side], corners[(side + 1) % 3]);
    match random.below(4) {
        0 => from,
        1 => from.lerp(to, 0.5),
        2 => from.lerp(to, random.below(17) as f64 / 16.0),
        _ => from.lerp(to, random.unit()),
    }
}

/// Every crossing of the ray with the mesh.
fn crossings(
    mesh: &TriangleMesh,
    ray: &Ray<f64>,
    single: bool,
    rule: EdgeRule,
) -> impl Iterator<Item = Crossing> {
    let test = TriangleTest::Watertight.prepare(ray, single, rule);
    (0..mesh.triangles().len()).filter_map(move |i| test.crossing(mesh.corners(i)))
}

/// A ray from inside to a point on an edge or a vertex; half of them as single precision has it.
fn aimed(from: Point3<f64>, to: Point3<f64>, random: &mut Random) -> Ray<f64> {
    let length = 10_f64.powf(random.between(-3.0, 3.0));
    let exact = Ray::new(from, (to - from) * length);
    if random.below(2) == 0 {
        return exact;
    }
    let origin: Point3 = from.cast();
    let direction: Vector3 = (to - origin.wide()).cast();
    Ray::new(origin, direction).into()
}

/// What `OMBRA_WATERTIGHT_RAYS` says. A word that is no number must not pass for a full check.
fn rays_asked_for() -> u64 {
    let Some(asked) = std::env::var_os("OMBRA_WATERTIGHT_RAYS") else {
        return 1_000_000;
    };
    let rays = asked.to_str().and_then(|rays| rays.parse().ok());
    match rays {
        Some(rays) if rays > 0 => rays,
        _ => panic!("OMBRA_WATERTIGHT_RAYS is {asked:?}; it must be a whole number from 1"),
    }
}

/// Runs `check` over seeds on all cores; each gets its own generator.
fn on_all_cores(meshes: u64, check: impl Fn(&mut Random) + Sync) {
    let cores = std::thread::available_parallelism().map_or(1, usize::from) as u64;
    std::thread::scope(|scope| {
        for core in 0..cores {
            let check = &check;
            scope.spawn(move || {
                for seed in (core..meshes).step_by(cores as usize) {
                    check(&mut Random(seed.wrapping_mul(0x5851_f42d_4c95_7f2d)));
                }
            });
        }
    });
}

#[test]
fn no_ray_escapes_through_an_edge_or_a_vertex() {
    let rays = rays_asked_for();
    on_all_cores(rays.div_ceil(RAYS_A_MESH), |random| {
        let Closed { mesh, inside, .. } = closed(random);
        assert!(mesh.is_closed());
        for _ in 0..RAYS_A_MESH.min(rays) {
            let ray = aimed(inside, target(&mesh, random), random);
            let single = random.below(2) == 0;
            let escaped = crossings(&mesh, &ray, single, EdgeRule::Closed)
                .next()
                .is_none();
            assert!(!escaped, "{ray:?} (single: {single}) escapes from {mesh:?}");
        }
    });
}

#[test]
fn counting_crossings_tells_inside_from_outside() {
    let rays = rays_asked_for().div_ceil(4);
    on_all_cores(rays.div_ceil(RAYS_A_MESH), |random| {
        let Closed { mesh, inside, size } = closed(random);
        for _ in 0..RAYS_A_MESH.min(rays) {
            let to = target(&mesh, random);
            let single = random.below(2) == 0;
            let count = |ray: &Ray<f64>| crossings(&mesh, ray, single, EdgeRule::HalfOpen).count();
            let outward = aimed(inside, to, random);
            let found = count(&outward);
            assert!(
                found % 2 == 1,
                "{found} from inside: {outward:?} in {mesh:?}"
            );
            // Outside, so far that the mesh lies ahead, but not so far that single precision fails.
            let away = random.vector(1.0).normalized().unwrap() * (size * 6.0);
            let from = to + away;
            let inward = aimed(from, to, random);
            let found = count(&inward);
            assert!(
                found % 2 == 0,
                "{found} from outside: {inward:?} to {mesh:?}"
            );
        }
    });
}

#[test]
fn lines_along_the_axes_of_a_lattice_cross_a_cube_an_even_number_of_times() {
    // Every line meets only vertices, edges and diagonals, exactly.
    let cube = cuboid(&Aabb::around([
        Point3::ORIGIN,
        Point3::new(2.0_f32, 2.0, 2.0),
    ]));
    let slopes = [-1.0, 0.0, 1.0];
    for x in -1..=3 {
        for y in -1..=3 {
            for (dx, dy) in slopes.into_iter().flat_map(|dx| slopes.map(|dy| (dx, dy))) {
                let from = Point3::new(f64::from(x) - 4.0 * dx, f64::from(y) - 4.0 * dy, -4.0);
                for direction in [
                    Vector3::new(dx, dy, 1.0),
                    Vector3::new(dy, 1.0, dx),
                    Vector3::new(1.0, dx, dy),
                ] {
                    let ray = Ray::new(from, direction);
                    for test in TriangleTest::ALL {
                        for single in [true, false] {
                            let test = test.prepare(&ray, single, EdgeRule::HalfOpen);
                            let crossed = |&i: &usize| test.crossing(cube.corners(i)).is_some();
                            let found = (0..12).filter(crossed).count();
                            assert!(found % 2 == 0, "{found} on {ray:?} by {test:?}");
                        }
                    }
                }
            }
        }
    }
}
