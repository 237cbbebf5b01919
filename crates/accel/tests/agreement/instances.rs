//! Two levels: any structure over any structure.

use std::sync::Arc;

use ombra_accel::{Accel, Geometry, Instance, Instances, Shapes, StructureKind, Traversable};
use ombra_geometry::shape::{Shape, Sphere};
use ombra_geometry::{GeometryId, Object, Point3, Ray, Transform, TriangleMesh, Vector3, World};

use crate::answers::{Answers, assert_same, bits};
use crate::{meshes, rays};

type Placement = Transform<Object, World>;

fn geometries() -> Vec<Geometry> {
    let ball = |x: f32| Shape::from(Sphere::new(Point3::new(x, 0.0, 0.5), 0.75));
    vec![
        meshes::geometry(meshes::icosphere(2)),
        meshes::geometry(meshes::cuboid(0.5)),
        meshes::geometry(meshes::random_soup(200, 1.0, 0.3)),
        Geometry::Shapes(Shapes(vec![ball(0.0), ball(0.5), ball(-2.0)])),
        meshes::geometry(TriangleMesh::default()),
        // Map coordinates in object space.
        meshes::geometry(meshes::moved(&meshes::icosphere(1), 10.0, 1e6)),
    ]
}

fn scaled(x: f64, y: f64, z: f64) -> Transform<Object, Object> {
    Transform::scale(Vector3::new(x, y, z))
}

fn turned(radians: f64) -> Transform<Object, Object> {
    Transform::rotation(Vector3::new(1.0, 2.0, -0.5), radians)
}

fn at(x: f64, y: f64, z: f64) -> Placement {
    Transform::translation(Vector3::new(x, y, z))
}

/// All geometries in many ways, some in the same place.
fn placements(x: f64) -> Vec<Instance> {
    let sheared = [
        [1.0, 0.5, 0.0, x + 3.0],
        [0.0, 1.0, -0.7, 0.0],
        [0.2, 0.0, 1.0, 2.0],
    ];
    let ways = [
        at(x, 0.0, 0.0),
        at(x, 0.0, 0.0),
        scaled(1.0, 0.2, 3.0).then(&at(x - 2.0, 1.0, 0.0)),
        scaled(1.0, 1e-3, 1.0)
            .then(&turned(0.4))
            .then(&at(x, 0.0, 1.0)),
        scaled(-1.0, 1.0, 1.0).then(&at(x + 1.0, -1.0, 0.0)),
        turned(1.1).then(&at(x + 0.5, 2.0, -1.0)),
        Transform::from_rows(sheared).unwrap(),
    ];
    let mut placements = Vec::new();
    for geometry in 0..5 {
        placements.extend(
            ways.iter()
                .map(|&world_from_object| Instance::new(GeometryId(geometry), world_from_object)),
        );
    }
    // Far out in object space, at home in the world.
    placements.push(Instance::new(GeometryId(5), at(x - 1e6, 1e6, -1e6)));
    placements.push(Instance::new(
        GeometryId(5),
        at(-1e6, 1e6, -1e6)
            .then(&Transform::<World, World>::rotation(
                Vector3::new(0.3, -1.0, 0.7),
                0.6,
            ))
            .then(&Transform::<World, World>::translation(Vector3::new(
                x, 3.0, 0.0,
            ))),
    ));
    placements
}

fn two_levels(
    top: StructureKind,
    bottom: StructureKind,
    placements: Vec<Instance>,
) -> Accel<Instances<Geometry>> {
    let geometries = geometries().into_iter();
    let geometries = geometries.map(|geometry| Arc::new(Accel::build(geometry, bottom)));
    Accel::build(Instances::new(geometries.collect(), placements), top)
}

fn corners(accel: &impl Traversable) -> Vec<Point3> {
    accel.bounds().corners().to_vec()
}

#[test]
fn every_structure_over_every_structure_agrees_with_brute_force() {
    for x in [0.0, 1e6] {
        let judge = two_levels(
            StructureKind::BruteForce,
            StructureKind::BruteForce,
            placements(x),
        );
        let mut rays = rays::around(&corners(&judge), 0.15);
        let towards = moved_rays(&rays::of_mesh(&meshes::icosphere(2), 0.15), x as f32);
        rays.extend(towards);
        let name = format!("instances at {x}");
        let hits = assert_same(&name, &|kind| two_levels(kind, kind, placements(x)), &rays);
        assert!(hits > 0);
        // What is below may be any structure, the same or not.
        let under_brute_force = |kind| two_levels(StructureKind::BruteForce, kind, placements(x));
        assert_same(&name, &under_brute_force, &rays[..rays.len() / 4]);
    }
}

/// With few placements many rays at once are asked of one after another.
#[test]
fn a_few_placements_agree_with_brute_force() {
    let stays = |geometry| Instance::new(GeometryId(geometry), Transform::identity());
    let unseen = Instance {
        mask: 0,
        ..stays(1)
    };
    let mut few = vec![
        vec![stays(0)],
        vec![stays(0), stays(3), stays(0), stays(2), stays(4), unseen],
    ];
    few.extend(placements(0.0).chunks(5).map(<[_]>::to_vec));
    few.extend(placements(1e6).chunks(7).map(|some| {
        let mut some = some.to_vec();
        some.insert(1, stays(2));
        some
    }));
    for placements in few {
        let build = |kind| two_levels(kind, kind, placements.clone());
        let judge = build(StructureKind::BruteForce);
        let x = judge.bounds().centre().x;
        let mut rays = rays::around(&corners(&judge), 0.1);
        rays.extend(rays::of_mesh(&meshes::icosphere(2), 0.15));
        rays.extend(moved_rays(&rays::of_mesh(&meshes::icosphere(2), 0.15), x));
        let name = format!("{} placements about {x}", placements.len());
        assert_same(&name, &build, &rays);
    }
}

#[test]
fn every_structure_agrees_with_brute_force_under_extreme_placements() {
    let sheared = [
        [1.0, 30.0, 0.0, -2.0],
        [0.0, 1.0, -20.0, 0.0],
        [0.5, 0.0, 1.0, 2.0],
    ];
    let ways: [(&str, f32, Placement); 6] = [
        (
            "large",
            1.0,
            scaled(1e15, 1e15, 1e15).then(&at(3e14, 0.0, 0.0)),
        ),
        (
            "small",
            1.0,
            scaled(1e-15, 1e-15, 1e-15).then(&at(0.0, 1e-15, 0.0)),
        ),
        (
            "thin",
            1.0,
            scaled(1.0, 1e-15, 1.0)
                .then(&turned(0.3))
                .then(&at(0.0, 0.0, 1.0)),
        ),
        ("long", 1.0, scaled(1.0, 1e15, 1.0).then(&at(0.0, 0.0, 1.0))),
        ("sheared", 1.0, Transform::from_rows(sheared).unwrap()),
        // Rays from outside begin where no single is.
        (
            "huge in its own space",
            1e38,
            scaled(1e-38, 1e-38, 1e-38).then(&at(1.0, 0.0, 0.0)),
        ),
    ];
    for (name, size, world_from_object) in ways {
        let mesh = meshes::moved(&meshes::icosphere(2), size, 0.0);
        let placed = |kind| {
            let geometry = Accel::build(meshes::geometry(mesh.clone()), kind);
            let instance = Instance::new(GeometryId(0), world_from_object);
            let placed = Instances::new(vec![Arc::new(geometry)], vec![instance]);
            Accel::build(placed, kind)
        };
        let mut rays = rays::around(&corners(&placed(StructureKind::BruteForce)), 0.15);
        let own = rays::of_mesh(&meshes::icosphere(2), 0.1);
        rays.extend(own.into_iter().map(|ray| {
            let scaled = Ray {
                origin: Point3::ORIGIN + ray.origin.to_vector() * size,
                direction: ray.direction * size,
                ..ray
            };
            world_from_object.ray(&scaled)
        }));
        let hits = assert_same(name, &placed, &rays);
        assert!(hits > 100, "{name}: {hits} hits");
    }
}

fn moved_rays(rays: &[Ray], x: f32) -> Vec<Ray> {
    let by = Vector3::new(x, 0.0, 0.0);
    rays.iter()
        .map(|ray| Ray {
            origin: ray.origin + by,
            ..*ray
        })
        .collect()
}

#[test]
fn a_geometry_placed_as_it_is_answers_bit_for_bit_like_the_geometry_alone() {
    for (name, mesh) in meshes::all() {
        let rays = rays::of_mesh(&mesh, 0.15);
        let geometry = meshes::geometry(mesh);
        for &kind in StructureKind::ALL {
            let alone = Arc::new(Accel::build(geometry.clone(), kind));
            let placed = Instance::new(GeometryId(0), Transform::identity());
            let placed = Instances::new(vec![Arc::clone(&alone)], vec![placed]);
            let placed = Accel::build(placed, kind);
            assert_eq!(placed.bounds(), alone.bounds(), "{name}, {kind}");
            for ray in &rays {
                let (found, expected) = (Answers::of(&placed, ray), Answers::of(&*alone, ray));
                assert!(
                    found == expected,
                    "{name}, {kind}: {ray:?}\nfound    {found:?}\nexpected {expected:?}"
                );
            }
        }
    }
}

#[test]
fn of_equal_hits_the_lowest_ids_win() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Point3::from);
    let ray = Ray::new(Point3::new(0.25, 0.25, 1.0), -Vector3::Z);
    for &kind in StructureKind::ALL {
        let twice = meshes::geometry(meshes::soup(vec![triangle; 20]));
        let accel = Arc::new(Accel::build(twice, kind));
        assert_eq!(accel.intersect(&ray).unwrap().primitive.0, 0, "{kind}");
        let mut all = Vec::new();
        accel.all_hits(&ray, &mut all);
        let order: Vec<_> = all.iter().map(|hit| hit.primitive.0).collect();
        assert_eq!(order, (0..20).collect::<Vec<_>>(), "{kind}");

        let geometry = |i| Instance::new(GeometryId(i), Transform::identity());
        let instances = vec![geometry(1), geometry(0), geometry(1)];
        let top = Instances::new(vec![Arc::clone(&accel), accel], instances);
        let hit = Accel::build(top, kind).intersect(&ray).unwrap();
        assert_eq!(bits(&hit)[3..], [0, 1, 0], "{kind}");
    }
}

#[test]
fn an_uneven_scale_opens_no_cracks() {
    let cube = Arc::new(Accel::build(
        meshes::geometry(meshes::icosphere(3)),
        StructureKind::Bvh,
    ));
    let flat = Instance::new(
        GeometryId(0),
        scaled(1.0, 1.0, 0.02).then(&at(0.3, 0.7, 0.0)),
    );
    let accel = Accel::build(Instances::new(vec![cube], vec![flat]), StructureKind::Bvh);
    let mut numbers = crate::numbers::Numbers::new(41);
    for _ in 0..20_000 {
        let within = numbers.direction() * numbers.within(0.0, 0.9);
        let from = Point3::new(0.3 + within.x, 0.7 + within.y, 0.02 * within.z);
        let mut ray = Ray::new(from, numbers.direction());
        ray.direction.z *= 0.02;
        assert!(accel.intersect(&ray).is_some(), "{ray:?}");
    }
}
