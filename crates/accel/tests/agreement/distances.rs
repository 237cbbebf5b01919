//! Distances: the tree says what measuring every primitive says, to the bit.

use std::sync::Arc;

use ombra_accel::{
    Accel, ClosestPoint, Geometry, Instance, Instances, Measured, Shapes, StructureKind,
};
use ombra_geometry::shape::{
    Cone, ConvexPolyhedron, Cuboid, Cylinder, Disk, Ends, OrientedBox, Plane, Rectangle, Shape,
    Sphere, Torus, Triangle,
};
use ombra_geometry::{Aabb, GeometryId, Normal3, Object, Point3, Transform, Vector3, World};

use crate::meshes;
use crate::numbers::Numbers;

/// An answer as bits and ids.
pub(crate) type Bits = ([u64; 4], [u32; 5]);

pub(crate) fn bits(found: &ClosestPoint) -> Bits {
    let [x, y, z] = found.point.to_array().map(f64::to_bits);
    (
        [found.distance.to_bits(), x, y, z],
        [
            found.u.to_bits(),
            found.v.to_bits(),
            found.primitive.0,
            found.geometry.0,
            found.instance.0,
        ],
    )
}

/// Places about some corners: at them, between them, near, far, and nowhere.
pub(crate) fn points(corners: &[Point3], count: usize) -> Vec<Point3<f64>> {
    let finite: Vec<_> = corners.iter().filter(|p| p.is_finite()).collect();
    let bounds = Aabb::around(finite.iter().copied().copied());
    let (centre, size) = if finite.is_empty() {
        (Point3::new(0.0, 0.0, 0.0), 1.0)
    } else {
        let bounds = bounds.wide();
        (bounds.centre(), bounds.extent().max_norm())
    };
    let mut numbers = Numbers::new(61);
    let mut points = vec![centre];
    for _ in 0..count {
        points.push(centre + numbers.point(0.6).to_vector().wide() * size);
        for away in [2.0, 1e3, 1e9] {
            points.push(centre + numbers.direction().wide() * (size * away));
        }
        if !finite.is_empty() {
            let mut pick = || finite[numbers.below(finite.len())].wide();
            let (a, b, c) = (pick(), pick(), pick());
            points.push(a);
            points.push(a.lerp(b, 0.5));
            points.push(a.lerp(b, 0.5).lerp(c, 1e-6));
        }
    }
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        points.push(Point3::new(0.0, bad, 0.0));
    }
    points
}

/// Holds the tree against measuring everything. Returns how many answers there were.
fn assert_same<P: Measured>(
    name: &str,
    build: impl Fn(StructureKind) -> Accel<P>,
    points: &[Point3<f64>],
) -> usize {
    let (judge, tree) = (
        build(StructureKind::BruteForce),
        build(StructureKind::default()),
    );
    let (judge, tree) = (judge.distances().unwrap(), tree.distances().unwrap());
    let (mut expected, mut found) = (Vec::new(), Vec::new());
    let mut answers = 0;
    for &point in points {
        let about = || format!("{name}: {point:?}");
        let nearest = judge.closest_point(point, f64::INFINITY);
        let of_tree = tree.closest_point(point, f64::INFINITY);
        assert_eq!(
            of_tree.as_ref().map(bits),
            nearest.as_ref().map(bits),
            "{}",
            about()
        );
        assert!(point.is_finite() || nearest.is_none(), "{}", about());
        let distance = nearest.map_or(1.0, |nearest| nearest.distance);
        for limit in [
            distance,
            distance.next_down(),
            distance * 1.25,
            distance + 1e-3,
            0.0,
            -1.0,
            f64::NAN,
        ] {
            judge.all_within(point, limit, &mut expected);
            tree.all_within(point, limit, &mut found);
            let (a, b): (Vec<_>, Vec<_>) = (
                found.iter().map(bits).collect(),
                expected.iter().map(bits).collect(),
            );
            assert!(
                a == b,
                "{}, {limit}:\nfound    {found:?}\nexpected {expected:?}",
                about()
            );
            let first = found.first().map(bits);
            let closest = tree.closest_point(point, limit);
            assert_eq!(closest.as_ref().map(bits), first, "{}, {limit}", about());
            assert_eq!(
                tree.within_distance(point, limit),
                first.is_some(),
                "{}",
                about()
            );
            let reached = nearest.filter(|nearest| nearest.distance <= limit);
            assert_eq!(first, reached.as_ref().map(bits), "{}, {limit}", about());
            assert!(
                found.iter().all(|near| near.distance <= limit),
                "{}",
                about()
            );
            let order = |near: &ClosestPoint| (near.instance, near.geometry, near.primitive);
            for pair in found.windows(2) {
                let [a, b] = [&pair[0], &pair[1]];
                let nearer = a.distance < b.distance;
                assert!(nearer || (a.distance == b.distance && order(a) < order(b)));
            }
            answers += found.len();
        }
    }
    answers
}

#[test]
fn the_tree_measures_meshes_as_the_loop_does() {
    for (name, mesh) in meshes::all() {
        let points = points(mesh.positions(), 6);
        let build = |kind| Accel::build(meshes::geometry(mesh.clone()), kind);
        let answers = assert_same(name, build, &points);
        assert_eq!(answers == 0, name == "nothing", "{name}: {answers}");
    }
}

/// Some of every kind, endless and degenerate ones among them.
fn shapes() -> Shapes {
    let mut numbers = Numbers::new(62);
    let mut shapes = vec![
        Shape::from(Sphere::new(Point3::ORIGIN, 0.0)),
        Shape::from(Sphere::new(Point3::ORIGIN, f32::NAN)),
        Shape::from(Triangle::new(
            Point3::ORIGIN,
            Point3::ORIGIN,
            Point3::new(1.0, 1.0, 0.0),
        )),
        Plane::new(Point3::new(0.0, 0.0, -7.0), Normal3::new(0.1, 0.2, 1.0))
            .unwrap()
            .into(),
    ];
    for i in 0..60 {
        let (at, to) = (numbers.point(5.0), numbers.point(5.0));
        let along = numbers.direction();
        let size = numbers.within(0.1, 1.0);
        let ends = if i % 2 == 0 { Ends::Capped } else { Ends::Open };
        let sizes = Vector3::new(size, 0.5 * size, 2.0 * size);
        let (x, y) = numbers.direction().orthonormal_basis();
        shapes.push(match i % 10 {
            0 => Sphere::new(at, size).into(),
            1 => Triangle::new(at, at + along, at + x).into(),
            2 => Disk::new(at, along.to_normal(), size).unwrap().into(),
            3 => Rectangle::new(at, x * size, y + x * 0.3).unwrap().into(),
            4 => Cylinder::new(at, to, size, ends).unwrap().into(),
            5 => Cone::new(at, to, size, ends).unwrap().into(),
            6 => Cuboid::new(at, at + sizes).unwrap().into(),
            7 => OrientedBox::new(at, x, y, sizes).unwrap().into(),
            8 => Torus::new(at, along.to_normal(), size, 0.4 * size)
                .unwrap()
                .into(),
            _ => tetrahedron(at, size),
        });
    }
    Shapes(shapes)
}

fn tetrahedron(at: Point3, size: f32) -> Shape {
    let steps = [Vector3::X, Vector3::Y, Vector3::Z].map(|axis| at + axis * size);
    let corners = [at, steps[0], steps[1], steps[2]];
    let faces = [vec![0, 2, 1], vec![0, 1, 3], vec![0, 3, 2], vec![1, 2, 3]];
    ConvexPolyhedron::from_faces(&corners, &faces)
        .unwrap()
        .into()
}

pub(crate) fn corners(bounds: f32) -> Vec<Point3> {
    let corner = Point3::new(bounds, bounds, bounds);
    Aabb::around([corner, Point3::ORIGIN - corner.to_vector()])
        .corners()
        .to_vec()
}

#[test]
fn the_tree_measures_shapes_as_the_loop_does() {
    let build = |kind| Accel::build(shapes(), kind);
    assert!(assert_same("shapes", build, &points(&corners(6.0), 60)) > 0);
}

pub(crate) fn scaled(x: f64, y: f64, z: f64) -> Transform<Object, Object> {
    Transform::scale(Vector3::new(x, y, z))
}

pub(crate) fn turned(radians: f64) -> Transform<Object, Object> {
    Transform::rotation(Vector3::new(1.0, 2.0, -0.5), radians)
}

pub(crate) fn at(x: f64, y: f64, z: f64) -> Transform<Object, World> {
    Transform::translation(Vector3::new(x, y, z))
}

/// Geometry 0 to 2 are meshes, 3 is curved, 4 is flat.
pub(crate) fn geometries(kind: StructureKind) -> Vec<Arc<Accel<Geometry>>> {
    let (curved, flat): (Vec<_>, Vec<_>) = shapes().0.into_iter().partition(|s| !s.is_flat());
    [
        meshes::geometry(meshes::icosphere(2)),
        meshes::geometry(meshes::random_soup(200, 1.0, 0.3)),
        meshes::geometry(meshes::moved(&meshes::icosphere(1), 10.0, 1e6)),
        Geometry::Shapes(Shapes(curved)),
        Geometry::Shapes(Shapes(flat)),
    ]
    .map(|geometry| Arc::new(Accel::build(geometry, kind)))
    .to_vec()
}

fn placements(x: f64) -> Vec<Instance> {
    let even = [
        at(x, 0.0, 0.0),
        scaled(-0.5, 0.5, 0.5)
            .then(&turned(0.4))
            .then(&at(x - 1.0, 2.0, 0.0)),
        turned(1.1).then(&at(x + 0.5, 2.0, -1.0)),
    ];
    let sheared = [
        [1.0, 0.5, 0.0, x + 3.0],
        [0.0, 1.0, -0.7, 0.0],
        [0.2, 0.0, 1.0, 2.0],
    ];
    let uneven = [
        scaled(1.0, 0.2, 3.0).then(&at(x - 2.0, 1.0, 0.0)),
        scaled(1.0, 1e-3, 1.0)
            .then(&turned(0.4))
            .then(&at(x, 0.0, 1.0)),
        Transform::from_rows(sheared).unwrap(),
    ];
    let mut placements = Vec::new();
    for geometry in [0, 1, 3, 4] {
        let ways = even
            .iter()
            .chain(if geometry == 3 { &[][..] } else { &uneven });
        placements.extend(ways.map(|way| Instance::new(GeometryId(geometry), *way)));
    }
    placements.push(Instance::new(GeometryId(0), Transform::identity()));
    placements.push(Instance::new(GeometryId(2), at(x - 1e6, 1e6, -1e6)));
    placements
}

#[test]
fn two_trees_measure_instances_as_two_loops_do() {
    for x in [0.0, 1e6] {
        let build = |kind| {
            let instances = Instances::new(geometries(kind), placements(x));
            Accel::build(instances, kind)
        };
        let mut points = points(&corners(5.0), 12);
        let by = Vector3::new(x, 0.0, 0.0);
        points.iter_mut().for_each(|point| *point += by);
        assert!(assert_same(&format!("instances at {x}"), build, &points) > 0);
    }
}

#[test]
fn extreme_placements_are_measured_as_well() {
    for (name, place) in [
        ("large", scaled(1e15, 1e15, 1e15).then(&at(3e14, 0.0, 0.0))),
        (
            "small",
            scaled(1e-15, 1e-15, 1e-15).then(&at(0.0, 1e-15, 0.0)),
        ),
        (
            "thin",
            scaled(1.0, 1e-15, 1.0)
                .then(&turned(0.3))
                .then(&at(0.0, 0.0, 1.0)),
        ),
        ("long", scaled(1.0, 1e15, 1.0).then(&at(0.0, 0.0, 1.0))),
    ] {
        let build = |kind| {
            let ball = Arc::new(Accel::build(meshes::geometry(meshes::icosphere(2)), kind));
            let placed = vec![Instance::new(GeometryId(0), place)];
            Accel::build(Instances::new(vec![ball], placed), kind)
        };
        let corners: Vec<_> = meshes::icosphere(2)
            .positions()
            .iter()
            .map(|&corner| place.point(corner))
            .collect();
        assert!(assert_same(name, build, &points(&corners, 10)) > 0);
    }
}

#[test]
fn of_what_is_equally_far_away_the_lowest_ids_win() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Point3::from);
    let point = Point3::new(0.25, 0.25, 1.0);
    for &kind in StructureKind::ALL {
        let same = Arc::new(Accel::build(
            meshes::geometry(meshes::soup(vec![triangle; 20])),
            kind,
        ));
        let geometry = |i| Instance::new(GeometryId(i), Transform::identity());
        let hidden = Instance {
            mask: 0,
            ..geometry(0)
        };
        let instances = vec![hidden, geometry(1), geometry(0)];
        let top = Instances::new(vec![Arc::clone(&same), same], instances);
        let top = Accel::build(top, kind);
        let near = top.distances().unwrap().closest_point(point, 2.0).unwrap();
        assert_eq!(near.distance, 1.0, "{kind}");
        assert_eq!(
            [near.instance.0, near.geometry.0, near.primitive.0],
            [1, 1, 0],
            "{kind}"
        );
        let mut all = Vec::new();
        top.distances().unwrap().all_within(point, 1.0, &mut all);
        let expected = [1, 2]
            .into_iter()
            .flat_map(|i| (0..20).map(move |own| (i, own)));
        let found: Vec<_> = all
            .iter()
            .map(|near| (near.instance.0, near.primitive.0))
            .collect();
        assert_eq!(found, expected.collect::<Vec<_>>(), "{kind}");
    }
}
