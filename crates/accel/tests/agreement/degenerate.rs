//! What a city and a careless program bring along: rays along walls, triangles without area, rays
//! that are none, and things without an end.

use ombra_accel::{Accel, Geometry, Primitives as _, Shapes, StructureKind, Traversable};
use ombra_geometry::shape::{Cylinder, Ends, Plane, Shape, Sphere, Torus};
use ombra_geometry::{Aabb, Normal3, Point3, Ray, TriangleMesh, Vector3};

use crate::answers::assert_agreement;
use crate::numbers::Numbers;
use crate::{meshes, rays};

/// A house: a footprint in units, and a height.
struct House {
    x: [f32; 2],
    y: [f32; 2],
    height: f32,
}

/// Houses that stand apart or wall to wall, on a floor that reaches further than they do.
fn houses() -> Vec<House> {
    let mut houses = Vec::new();
    for i in 0..6_u8 {
        for j in 0..6_u8 {
            let (x, y) = (4.0 * f32::from(i), 4.0 * f32::from(j));
            let width = if (i + j) % 3 == 0 { 4.0 } else { 2.0 };
            let height = f32::from(1 + (i * 7 + j * 5) % 9);
            houses.push(House {
                x: [x, x + width],
                y: [y, y + 2.0],
                height,
            });
        }
    }
    houses
}

/// The floor at 0 first, then roofs and walls; each box closed but for its bottom.
fn city(houses: &[House], unit: f32, by: f32) -> TriangleMesh {
    let at = |x: f32, y: f32, z: f32| Point3::new(x * unit + by, y * unit - by, z * unit);
    let mut triangles = Vec::new();
    let mut quad = |[a, b, c, d]: [Point3; 4]| triangles.extend([[a, b, c], [a, c, d]]);
    let (from, to) = (-8.0, 32.0);
    quad([
        at(from, from, 0.0),
        at(to, from, 0.0),
        at(to, to, 0.0),
        at(from, to, 0.0),
    ]);
    for house in houses {
        let ([x0, x1], [y0, y1], top) = (house.x, house.y, house.height);
        let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)];
        quad(corners.map(|(x, y)| at(x, y, top)));
        for k in 0..4 {
            let ((ax, ay), (bx, by)) = (corners[k], corners[(k + 1) % 4]);
            quad([
                at(ax, ay, 0.0),
                at(bx, by, 0.0),
                at(bx, by, top),
                at(ax, ay, top),
            ]);
        }
    }
    meshes::soup(triangles)
}

/// The height of what lies under a place: the highest roof that it is on, rims included, or the floor.
fn height_at(houses: &[House], x: f32, y: f32) -> f32 {
    let over = |house: &&House| {
        (house.x[0]..=house.x[1]).contains(&x) && (house.y[0]..=house.y[1]).contains(&y)
    };
    houses
        .iter()
        .filter(over)
        .map(|house| house.height)
        .fold(0.0, f32::max)
}

#[test]
fn a_vertical_ray_along_a_wall_meets_the_roof_or_the_floor() {
    let houses = houses();
    // At 1e7 a single is a whole number; there a unit is 8 of them.
    for (unit, by) in [(1.0, 0.0), (1e-6, 0.0), (1e6, 0.0), (8.0, 1e7), (0.25, 1e6)] {
        let mesh = city(&houses, unit, by);
        let mut places = Vec::new();
        for house in &houses {
            for x in [house.x[0], house.x[1], house.x[0] + 1.0, house.x[0] - 1.0] {
                for y in [house.y[0], house.y[1], house.y[0] + 0.5, house.y[1] + 0.25] {
                    places.push((x, y, height_at(&houses, x, y)));
                }
            }
        }
        let top = 20.0;
        let ray = |&(x, y, _): &(f32, f32, f32)| {
            let from = Point3::new(x * unit + by, y * unit - by, top * unit);
            Ray::new(from, Vector3::new(0.0, 0.0, -unit))
        };
        let rays: Vec<Ray> = places.iter().map(ray).collect();
        for &kind in StructureKind::ALL {
            let accel = Accel::build(meshes::geometry(mesh.clone()), kind);
            let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
            accel.intersect_many(&rays, &mut hits);
            accel.occluded_many(&rays, &mut occluded);
            for (i, (ray, &(x, y, height))) in rays.iter().zip(&places).enumerate() {
                let about = || format!("{kind}, {unit}, {by}: at {x}, {y}");
                let hit = accel.intersect(ray);
                let found = hit.map(|hit| top - hit.t).unwrap_or(f32::NAN);
                assert!(
                    (found - height).abs() < 1e-5,
                    "{found}, {height}: {}",
                    about()
                );
                assert_eq!((hits[i], occluded[i]), (hit, true), "{}", about());
                // Below the roof there is nothing but the floor, and a shorter ray meets nothing.
                let mut all = Vec::new();
                accel.all_hits(ray, &mut all);
                for hit in &all {
                    let z = top - hit.t;
                    let known = houses.iter().map(|h| h.height).chain([0.0]);
                    let off = known
                        .map(|height| (z - height).abs())
                        .fold(f32::MAX, f32::min);
                    assert!(off < 1e-5, "a hit at {z}: {}", about());
                }
                assert!(
                    all.iter().any(|hit| hit.primitive.0 < 2),
                    "no floor: {}",
                    about()
                );
                let short = Ray {
                    t_max: top - height - 1e-3,
                    ..*ray
                };
                assert!(!accel.occluded(&short), "{}", about());
                // Upward along the wall, from between floor and roof.
                let up = Ray {
                    origin: ray.at(top - 0.5),
                    direction: -ray.direction,
                    ..*ray
                };
                let above = accel.intersect(&up).map(|hit| hit.t + 0.5);
                let known =
                    above.is_none_or(|z| houses.iter().any(|h| (h.height - z).abs() < 1e-5));
                assert!(known, "{above:?} upward: {}", about());
            }
        }
    }
}

#[test]
fn points_and_lines_among_triangles_change_nothing() {
    let mesh = meshes::random_soup(300, 1.0, 0.3);
    let mut numbers = Numbers::new(81);
    let good: Vec<_> = (0..mesh.triangles().len())
        .map(|i| mesh.corners(i))
        .collect();
    let mut with = good.clone();
    for triangle in &good {
        let [a, b, _] = *triangle;
        // Where a ray could take them for the triangle that they lie in.
        let point = a.lerp(b, numbers.within(0.0, 1.0));
        with.extend([[point; 3], [a, b, b], [a, b, a], [a, a, b]]);
    }
    let with = meshes::soup(with);
    let rays = rays::of_mesh(&mesh, 0.5);
    for &kind in StructureKind::ALL {
        let expected = Accel::build(meshes::geometry(mesh.clone()), kind);
        let found = Accel::build(meshes::geometry(with.clone()), kind);
        let mut hits = vec![None; rays.len()];
        found.intersect_many(&rays, &mut hits);
        for (ray, many) in rays.iter().zip(hits) {
            let hit = found.intersect(ray);
            assert_eq!(hit, expected.intersect(ray), "{kind}: {ray:?}");
            assert_eq!(many, hit, "{kind}: {ray:?}");
            let (mut all, mut all_expected) = (Vec::new(), Vec::new());
            found.all_hits(ray, &mut all);
            expected.all_hits(ray, &mut all_expected);
            assert_eq!(all, all_expected, "{kind}: {ray:?}");
        }
    }
}

/// Every way for a ray to be none.
fn broken(good: &Ray) -> Vec<Ray> {
    let mut broken = Vec::new();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for axis in ombra_geometry::Axis::ALL {
            let (mut origin, mut direction) = (*good, *good);
            origin.origin[axis] = bad;
            direction.direction[axis] = bad;
            broken.extend([origin, direction]);
        }
    }
    let [t_min, t_max] = [f32::NAN, f32::NAN];
    broken.push(Ray { t_min, ..*good });
    broken.push(Ray { t_max, ..*good });
    broken.push(Ray {
        t_max: -1.0,
        ..*good
    });
    let direction = Vector3::ZERO;
    broken.push(Ray { direction, ..*good });
    broken
}

#[test]
fn a_ray_that_is_none_is_a_miss_and_disturbs_no_other() {
    let mesh = meshes::icosphere(3);
    let mut numbers = Numbers::new(82);
    let mut ray = || {
        let from = Point3::ORIGIN + numbers.direction() * 2.0;
        Ray::new(from, numbers.point(1.0) - from)
    };
    let good: Vec<Ray> = (0..40).map(|_| ray()).collect();
    let bad = broken(&good[0]);
    // One good one between two bad ones, runs of each, and all but one the same.
    let mut mixed: Vec<Ray> = good
        .iter()
        .zip(bad.iter().cycle())
        .flat_map(|(a, b)| [*b, *a])
        .collect();
    mixed.extend(bad.iter().chain(&good).chain(&bad));
    let lists = [
        mixed.clone(),
        mixed[1..10].to_vec(),
        bad.clone(),
        vec![bad[0]],
    ];
    for &kind in StructureKind::ALL {
        let accel = Accel::build(meshes::geometry(mesh.clone()), kind);
        for rays in &lists {
            let (mut hits, mut occluded) = (vec![None; rays.len()], vec![true; rays.len()]);
            accel.intersect_many(rays, &mut hits);
            accel.occluded_many(rays, &mut occluded);
            for (i, ray) in rays.iter().enumerate() {
                let hit = accel.intersect(ray);
                assert!(ray.is_valid() || hit.is_none(), "{kind}: {ray:?}");
                assert_eq!(hits[i], hit, "{kind}: {ray:?}");
                assert_eq!(occluded[i], hit.is_some(), "{kind}: {ray:?}");
                assert_eq!(accel.occluded(ray), hit.is_some(), "{kind}: {ray:?}");
            }
        }
        assert!(
            good.iter().any(|ray| accel.intersect(ray).is_some()),
            "{kind}"
        );
    }
}

#[test]
fn what_has_no_end_stands_beside_what_has_one() {
    let mut numbers = Numbers::new(83);
    let plane = |z: f32, normal: Normal3| {
        Shape::from(Plane::new(Point3::new(0.0, 0.0, z), normal).unwrap())
    };
    let up = Normal3::new(0.0, 0.0, 1.0);
    let mut shapes = vec![
        plane(-3.0, up),
        plane(-3.0, up),
        plane(2.0, Normal3::new(0.2, -1.0, 0.1)),
    ];
    for i in 0..60 {
        let (at, to) = (numbers.point(4.0), numbers.point(4.0));
        let size = numbers.within(0.05, 0.8);
        shapes.push(match i % 3 {
            0 => Sphere::new(at, size).into(),
            1 => Cylinder::new(at, to, size, Ends::Capped).unwrap().into(),
            _ => Torus::new(at, numbers.direction().to_normal(), size, 0.3 * size)
                .unwrap()
                .into(),
        });
    }
    // Endless ones last as well.
    shapes.push(plane(5.0, Normal3::new(1.0, 1.0, 1.0)));
    let shapes = Geometry::Shapes(Shapes(shapes));
    assert_eq!(shapes.bounds(0), Aabb::UNBOUNDED);
    let corner = Point3::new(4.0, 4.0, 4.0);
    let corners = Aabb::around([corner, Point3::ORIGIN - corner.to_vector()]).corners();
    let hits = assert_agreement("endless", &shapes, &rays::around(&corners, 1.0));
    assert!(hits > 0);
    let only = Geometry::Shapes(Shapes(vec![plane(1.0, up), plane(-1.0, up)]));
    assert!(assert_agreement("endless alone", &only, &rays::around(&corners, 0.5)) > 0);
}
