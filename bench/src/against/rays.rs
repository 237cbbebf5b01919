//! The rays of a scene, made once and then the same for all.

use ombra_accel::{Accel, Mesh, StructureKind, Traversable};
use ombra_geometry::{Point3, Ray, Vector3};

use crate::meshes::{Light, MeshScene};
use crate::random::Random;

/// Rays of one kind.
#[derive(Clone, Debug)]
pub(super) struct Workload {
    pub(super) name: &'static str,
    pub(super) rays: Vec<Ray>,
    /// Whether any hit will do.
    pub(super) any: bool,
    /// Whether neighbours go the same way.
    pub(super) coherent: bool,
}

/// How many kinds of rays there are.
pub(super) const WORKLOADS: usize = 4;

/// By which share of a scene's diagonal rays start off the surface that they leave.
const OFF_THE_SURFACE: f32 = 2e-5;

/// Primary rays through `side²` pixels, one diffuse bounce and one shadow ray where they hit, and as
/// many random rays through the whole box.
pub(super) fn make(scene: &MeshScene, side: u32) -> [Workload; WORKLOADS] {
    let kind = StructureKind::default();
    let accel = Accel::build(Mesh::new(scene.mesh.clone()), kind);
    let primary = primary(scene, side);
    let diagonal = scene.mesh.bounds().extent().length();
    let (mut diffuse, mut shadow) = (Vec::new(), Vec::new());
    let mut random = Random::new(1234);
    for ray in &primary {
        let Some(hit) = accel.intersect(ray) else {
            continue;
        };
        let [a, b, c] = scene.mesh.corners(hit.primitive.index());
        // Thinner than single precision can say which way it faces.
        let Some(normal) = (b - a).cross(c - a).normalized() else {
            continue;
        };
        let normal = if normal.dot(ray.direction) > 0.0 {
            -normal
        } else {
            normal
        };
        let place = ray.at(hit.t) + normal * (OFF_THE_SURFACE * diagonal);
        if let Some(direction) = around(normal, &mut random) {
            diffuse.push(Ray::new(place, direction));
        }
        if let Some(ray) = towards(&scene.view.light, place, &mut random)
            && ray.direction.dot(normal) > 0.0
        {
            shadow.push(ray);
        }
    }
    let workload = |name, rays, any, coherent| Workload {
        name,
        rays,
        any,
        coherent,
    };
    let mut all = [
        workload("primary", primary, false, true),
        workload("diffuse", diffuse, false, false),
        workload("shadow", shadow, true, false),
        workload("random", anywhere(scene, side), false, false),
    ];
    // A zero in a direction makes infinities in some tracers: what they do with them is not measured
    // here.
    let not_zero = |x: f32| if x.abs() < 1e-9 { 1e-9 } else { x };
    for ray in all.iter_mut().flat_map(|workload| &mut workload.rays) {
        let d = ray.direction;
        ray.direction = Vector3::new(not_zero(d.x), not_zero(d.y), not_zero(d.z));
    }
    all
}

/// Row by row, through the middle of each pixel of a square picture.
fn primary(scene: &MeshScene, side: u32) -> Vec<Ray> {
    let view = &scene.view;
    let forward = unit(view.target - view.eye);
    let right = unit(forward.cross(Vector3::Y));
    let up = right.cross(forward);
    let place = |i: u32| ((i as f32 + 0.5) / side as f32 * 2.0 - 1.0) * view.tangent;
    let pixels = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    pixels
        .map(|(x, y)| {
            let direction = forward + right * place(x) - up * place(y);
            Ray::new(view.eye, unit(direction))
        })
        .collect()
}

/// From anywhere in the box of the scene to anywhere.
fn anywhere(scene: &MeshScene, side: u32) -> Vec<Ray> {
    let bounds = scene.mesh.bounds();
    let mut random = Random::new(99);
    (0..side * side)
        .map(|_| {
            let origin = Point3::new(
                random.between(bounds.min.x, bounds.max.x),
                random.between(bounds.min.y, bounds.max.y),
                random.between(bounds.min.z, bounds.max.z),
            );
            let [x, y, z] = random.in_ball();
            Ray::new(origin, unit(Vector3::new(x, y, z)))
        })
        .collect()
}

/// A direction off a matt surface: as likely as its cosine (Malley's method).
fn around(normal: Vector3, random: &mut Random) -> Option<Vector3> {
    let [x, y] = random.in_disk();
    let (s, t) = normal.orthonormal_basis();
    let height = (1.0 - x * x - y * y).max(0.0).sqrt().max(1e-3);
    (s * x + t * y + normal * height).normalized()
}

fn towards(light: &Light, place: Point3, random: &mut Random) -> Option<Ray> {
    let (a, b) = (random.unit(), random.unit());
    match *light {
        Light::Area { corner, sides } => {
            let way = corner + sides[0] * a + sides[1] * b - place;
            let direction = way.normalized()?;
            // Ends a little before the lamp, which might be a triangle too.
            let t_max = way.length() * 0.999;
            Some(Ray {
                t_max,
                ..Ray::new(place, direction)
            })
        }
        Light::Sun { towards, spread } => {
            let sun = unit(towards);
            let (s, t) = sun.orthonormal_basis();
            let off = s * ((a * 2.0 - 1.0) * spread) + t * ((b * 2.0 - 1.0) * spread);
            Some(Ray::new(place, (sun + off).normalized()?))
        }
    }
}

/// Of length one; views are not degenerate, and what is has no direction to prefer.
fn unit(direction: Vector3) -> Vector3 {
    direction.normalized().unwrap_or(Vector3::Z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::{Found, Size, load};

    #[test]
    fn every_workload_has_rays_and_all_are_valid() {
        for name in ["interior", "city"] {
            let Found::Scene(scene) = load(name, Size::Tiny).unwrap() else {
                panic!("{name} needs no data");
            };
            let all = make(&scene, 16);
            assert_eq!(all[0].rays.len(), 256);
            for workload in &all {
                assert!(workload.rays.len() > 30, "{name} {}", workload.name);
                assert!(workload.rays.iter().all(Ray::is_valid), "{name}");
            }
        }
    }
}
