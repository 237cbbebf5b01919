//! Primary visibility of meshes.

use ombra_geometry::mesh::generate;
use ombra_geometry::{Aabb, TriangleMesh};

use crate::{assert_agreement, camera, compared, point, scene, world};

/// Random numbers that are the same in every run: SplitMix64.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / 16_777_216.0
    }

    fn between(&mut self, lo: f32, hi: f32) -> f32 {
        lo + (hi - lo) * self.unit()
    }
}

fn soup(seed: u64, count: u32, reach: f32, size: f32) -> TriangleMesh {
    let mut random = Random(seed);
    let mut positions = Vec::new();
    for _ in 0..count {
        let centre = [(); 3].map(|()| random.between(-reach, reach));
        for _ in 0..3 {
            let [x, y, z] = centre.map(|c| c + random.between(-size, size));
            positions.push(point(x, y, z));
        }
    }
    let triangles = (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    TriangleMesh::new(positions, triangles).unwrap()
}

#[test]
fn balls_and_rings() {
    let eye = camera(point(3.0, 2.0, 5.0), point(0.0, 0.0, 0.0), 40.0);
    for subdivisions in [0, 2, 5] {
        let ball = generate::icosphere(subdivisions, point(0.3, 0.0, 0.0), 1.4);
        assert_agreement(&world(scene(vec![ball])), &eye, "icosphere");
    }
    let ring = generate::torus(point(0.0, 0.0, 0.0), [1.5, 0.5], [128, 64]);
    assert_agreement(&world(scene(vec![ring])), &eye, "torus");
}

#[test]
fn random_soups() {
    let eye = camera(point(3.0, 2.0, 5.0), point(0.0, 0.0, 0.0), 60.0);
    for seed in 0..6 {
        for (count, size) in [(10, 1.5), (200, 0.5), (3000, 0.2)] {
            let mesh = soup(seed, count, 2.0, size);
            assert_agreement(&world(scene(vec![mesh])), &eye, "soup");
        }
    }
}

#[test]
fn meshes_through_the_near_plane() {
    // The eye is in the middle of everything, and in the middle of a floor.
    let eye = camera(point(0.1, 0.05, 0.2), point(1.0, -0.3, 0.4), 75.0);
    for seed in 0..6 {
        let mesh = soup(seed, 400, 1.0, 0.8);
        assert_agreement(&world(scene(vec![mesh])), &eye, "soup around the eye");
    }
    let floor = generate::grid(point(-50.0, -50.0, 0.0), [100.0, 100.0], [1, 1]);
    let fine = generate::grid(point(-50.0, -50.0, -1.0), [100.0, 100.0], [40, 40]);
    let above = camera(point(0.3, 0.2, 0.5), point(5.0, 4.0, 0.4), 90.0);
    assert_agreement(&world(scene(vec![floor, fine])), &above, "floors");
    let room = generate::cuboid(&Aabb::around([
        point(-1.0, -1.0, -1.0),
        point(2.0, 1.0, 3.0),
    ]));
    assert_agreement(&world(scene(vec![room])), &eye, "a room from within");
}

#[test]
fn what_is_behind_the_camera_is_not_seen() {
    let eye = camera(point(0.0, 0.0, 0.0), point(0.0, 0.0, -1.0), 60.0);
    let behind = generate::icosphere(3, point(0.0, 0.0, 5.0), 2.0);
    let agreement = compared(&world(scene(vec![behind])), &eye, 1);
    assert_eq!((agreement.covered, agreement.share()), (0, 1.0));
}

#[test]
fn nothing_is_seen_in_an_empty_scene() {
    let eye = camera(point(0.0, 0.0, 0.0), point(0.0, 0.0, -1.0), 60.0);
    for scene in [scene(vec![]), scene(vec![TriangleMesh::default()])] {
        let agreement = compared(&world(scene), &eye, 4);
        assert_eq!((agreement.covered, agreement.share()), (0, 1.0));
    }
}

#[test]
fn triangles_that_are_none_are_not_seen() {
    let eye = camera(point(0.0, 0.0, 5.0), point(0.0, 0.0, 0.0), 60.0);
    let (nan, infinite) = (f32::NAN, f32::INFINITY);
    let positions = vec![
        point(-1.0, -1.0, 0.0),
        point(1.0, -1.0, 0.0),
        point(0.0, 1.0, 0.0),
        point(nan, 0.0, 0.0),
        point(0.0, infinite, 0.0),
        point(0.0, 0.0, 0.0),
    ];
    // A point, a needle, one without a number, one without an end, and at last a good one.
    let triangles = vec![
        [0, 0, 0],
        [0, 1, 0],
        [0, 1, 3],
        [0, 1, 4],
        [5, 5, 2],
        [0, 1, 2],
    ];
    let mesh = TriangleMesh::new(positions, triangles).unwrap();
    let world = world(scene(vec![mesh]));
    assert_agreement(&world, &eye, "degenerate");
    assert!(compared(&world, &eye, 1).covered > 1000);
}

#[test]
fn coordinates_of_any_size() {
    for size in [1e-20_f32, 1e-6, 1e6, 1e15] {
        let eye = camera(
            point(3.0 * size, 2.0 * size, 5.0 * size),
            point(0.0, 0.0, 0.0),
            40.0,
        );
        let ball = generate::icosphere(3, point(0.0, 0.0, 0.0), 1.4 * size);
        assert_agreement(&world(scene(vec![ball])), &eye, "scaled");
    }
    // Far away from the origin, where single precision has steps of 1/8.
    let centre = point(1e6, 2e6, -1e6);
    let eye = camera(point(1e6 + 300.0, 2e6 + 200.0, -1e6 + 500.0), centre, 40.0);
    let ball = generate::icosphere(3, centre, 140.0);
    assert_agreement(&world(scene(vec![ball])), &eye, "far away");
    // A triangle from one end of the number range to the other.
    let wide = TriangleMesh::new(
        vec![
            point(-1e30, -1e30, -5.0),
            point(1e30, -1e30, -5.0),
            point(0.0, 1e30, -5.0),
        ],
        vec![[0, 1, 2]],
    );
    let eye = camera(point(0.0, 0.0, 0.0), point(0.0, 0.0, -1.0), 60.0);
    assert_agreement(&world(scene(vec![wide.unwrap()])), &eye, "wide");
    // The same with a corner behind the eye.
    let through = TriangleMesh::new(
        vec![
            point(-1e9, -1.0, -5.0),
            point(1e9, -1.0, -5.0),
            point(0.0, -1.0, 1e9),
        ],
        vec![[0, 1, 2]],
    );
    assert_agreement(&world(scene(vec![through.unwrap()])), &eye, "wide floor");
}
