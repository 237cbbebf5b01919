//! What counts as a hit must not open cracks.

use ombra_accel::{Accel, StructureKind, Traversable};
use ombra_geometry::{Point3, Ray, Vector3};

use crate::meshes;
use crate::numbers::Numbers;

/// From within a closed mesh, at edges and vertices.
fn leaks(scale: f32, by: f32, rays: usize, kind: StructureKind) -> usize {
    let mesh = meshes::moved(&meshes::icosphere(3), scale, by);
    let accel = Accel::build(meshes::geometry(mesh.clone()), kind);
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
    for &kind in StructureKind::ALL {
        let rays = if kind == StructureKind::BruteForce {
            300
        } else {
            20_000
        };
        for (scale, by) in [
            (1.0, 0.0),
            (1e-6, 0.0),
            (1e6, 0.0),
            (100.0, 1e6),
            (1e3, 1e7),
        ] {
            assert_eq!(
                leaks(scale, by, rays, kind),
                0,
                "{kind}, size {scale} at {by}"
            );
        }
    }
}

#[test]
fn a_sliver_is_hit_as_well_as_any_triangle() {
    let mut numbers = Numbers::new(32);
    for width in [1e-2, 1e-3, 1e-4, 1e-5] {
        for _ in 0..3000 {
            // Lying across y, so that its box is flat, and along x.
            let [a, b] = [-0.9, 0.8].map(|x| Point3::new(x, 0.0, 0.3));
            let c = b + Vector3::Z * width;
            let mesh = meshes::geometry(meshes::soup(vec![[a, b, c]]));
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
                "{width}: {ray:?}: {hit:?}"
            );
        }
    }
}
