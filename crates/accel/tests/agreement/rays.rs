//! Rays, the awkward ones above all.

use ombra_geometry::{Aabb, Axis, Point3, Ray, TriangleMesh, Vector3};

use crate::numbers::Numbers;

/// Rays about a mesh: about its vertices, and through and along its edges. `part` scales their
/// number.
pub(crate) fn of_mesh(mesh: &TriangleMesh, part: f32) -> Vec<Ray> {
    let corners: Vec<_> = (0..mesh.triangles().len())
        .map(|i| mesh.corners(i))
        .filter(|corners| corners.iter().all(|p| p.is_finite()))
        .collect();
    let points = corners.concat();
    let mut rays = around(&points, part);
    let extent = extent_of(&points);
    let mut numbers = Numbers::new(21);
    for _ in 0..share(30, part) {
        let Some(corners) = pick(&corners, &mut numbers) else {
            break;
        };
        let [a, b, c] = corners;
        let away = numbers.direction() * (extent.max_norm() * 2.0);
        let middle = a.lerp(b, 0.5);
        let inside = middle.lerp(c, 0.25);
        // Through an edge, through the inside, along an edge from a corner and from before it.
        rays.push(Ray::new(middle + away, -away));
        rays.push(Ray::between(inside + away, inside - away));
        rays.push(Ray::new(a, b - a));
        rays.push(Ray::new(a + (a - b), b - a));
        // In the plane of the triangle, and very nearly so.
        rays.push(Ray::new(a + (a - inside), inside - a));
        rays.push(Ray::new(a + (a - inside) + away * 1e-6, inside - a));
    }
    rays
}

/// Rays about some points.
pub(crate) fn around(points: &[Point3], part: f32) -> Vec<Ray> {
    let bounds = Aabb::around(points.iter().copied());
    let (centre, extent) = if points.is_empty() {
        (Point3::ORIGIN, Vector3::new(1.0, 1.0, 1.0))
    } else {
        (bounds.centre(), extent_of(points))
    };
    let mut numbers = Numbers::new(20);
    let mut rays = Vec::new();
    random(&mut rays, centre, extent, share(60, part), &mut numbers);
    camera(&mut rays, centre, extent, share(8, part.sqrt()));
    axis_parallel(&mut rays, points, extent, share(10, part), &mut numbers);
    at_points(&mut rays, points, extent, share(15, part), &mut numbers);
    let plain = rays.clone();
    for (i, ray) in plain.iter().enumerate().step_by(3) {
        rays.push(odd_one(ray, i / 3));
    }
    rays
}

fn share(count: usize, part: f32) -> usize {
    (count as f32 * part).ceil() as usize
}

fn pick<T: Copy>(list: &[T], numbers: &mut Numbers) -> Option<T> {
    (!list.is_empty()).then(|| list[numbers.below(list.len())])
}

fn extent_of(points: &[Point3]) -> Vector3 {
    let extent = Aabb::around(points.iter().copied()).extent();
    // Differences can be beyond the range of numbers.
    Vector3::from(extent.to_array().map(|e| e.clamp(0.0, 1e38)))
}

fn place(centre: Point3, extent: Vector3, numbers: &mut Numbers) -> Point3 {
    let p = numbers.point(0.5);
    centre + Vector3::new(p.x * extent.x, p.y * extent.y, p.z * extent.z)
}

/// From outside, from inside, and from afar.
fn random(
    rays: &mut Vec<Ray>,
    centre: Point3,
    extent: Vector3,
    count: usize,
    numbers: &mut Numbers,
) {
    let size = extent.max_norm();
    for _ in 0..count {
        let target = place(centre, extent, numbers);
        let from = centre + numbers.direction() * (1.5 * size);
        rays.push(Ray::new(from, target - from));
        rays.push(Ray::new(target, numbers.direction()));
    }
    for away in [10.0, 100.0, 1e3, 1e6, 1e12] {
        for _ in 0..count.div_ceil(8) {
            let target = place(centre, extent, numbers);
            let from = target + numbers.direction() * (away * size);
            rays.push(Ray::new(from, target - from));
        }
    }
}

/// A picture from one side.
fn camera(rays: &mut Vec<Ray>, centre: Point3, extent: Vector3, side: usize) {
    let size = extent.max_norm();
    let from = centre + Vector3::new(0.3 * size, 0.2 * size, 1.5 * size);
    for pixel in 0..side * side {
        let at = |i: usize| ((i as f32 + 0.5) / side as f32 - 0.5) * size;
        let on_film = Vector3::new(at(pixel % side), at(pixel / side), 0.0);
        rays.push(Ray::new(from, centre + on_film - from));
    }
}

/// Along the axes and across one, through points, where boxes have their faces.
fn axis_parallel(
    rays: &mut Vec<Ray>,
    points: &[Point3],
    extent: Vector3,
    count: usize,
    numbers: &mut Numbers,
) {
    let size = extent.max_norm();
    for _ in 0..count {
        let Some(point) = pick(points, numbers) else {
            return;
        };
        for axis in Axis::ALL {
            let mut along = Vector3::new(0.0, -0.0, 0.0);
            along[axis] = if numbers.below(2) == 0 { 1.0 } else { -1.0 };
            rays.push(Ray::new(point, along));
            rays.push(Ray::new(point - along * (2.0 * size), along));
            let mut across = numbers.direction();
            across[axis] = -0.0;
            rays.push(Ray::new(point, across));
            rays.push(Ray::new(point - across * size, across));
            // Beside a point, between faces.
            let mut beside = point;
            beside[axis.next()] += numbers.within(-0.1, 0.1) * size;
            rays.push(Ray::new(beside - along * (2.0 * size), along));
        }
    }
}

/// Exactly at points, and from point to point.
fn at_points(
    rays: &mut Vec<Ray>,
    points: &[Point3],
    extent: Vector3,
    count: usize,
    numbers: &mut Numbers,
) {
    for _ in 0..count {
        let (Some(a), Some(b)) = (pick(points, numbers), pick(points, numbers)) else {
            return;
        };
        let away = numbers.direction() * (2.0 * extent.max_norm());
        rays.push(Ray::new(a + away, a - (a + away)));
        rays.push(Ray::new(a, b - a));
        rays.push(Ray::between(a, b));
    }
}

/// A ray with one thing odd about it.
fn odd_one(ray: &Ray, which: usize) -> Ray {
    let mut odd = *ray;
    match which % 14 {
        0 => odd.t_max = 1.0,
        1 => odd.t_max = 0.9,
        2 => [odd.t_min, odd.t_max] = [0.3, 1.1],
        3 => odd.t_min = 0.95,
        4 => odd.t_min = f32::NEG_INFINITY,
        5 => odd.t_min = -10.0,
        6 => odd.direction = ray.direction * 1e-20,
        7 => odd.direction = ray.direction * 1e18,
        8 => odd.direction = ray.direction * 1e-40,
        9 => odd.direction.x = f32::NAN,
        10 => odd.direction = Vector3::ZERO,
        11 => odd.origin.z = f32::NAN,
        12 => odd.t_max = -1.0,
        _ => odd.direction.y = f32::INFINITY,
    }
    odd
}
