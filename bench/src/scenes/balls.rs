//! Sixty-four balls, every third a mirror, on a ball as large as a hill.

use ombra_accel::{Geometry, Shapes};
use ombra_geometry::shape::Sphere;
use ombra_geometry::{Point3, Transform};
use ombra_scene::{Material, Rgb, Scene};

pub(super) fn scene() -> Scene {
    let mut scene = Scene::default();
    let mut add = |name: &str, spheres: Vec<Sphere>, material| {
        let shapes = Shapes(spheres.into_iter().map(Into::into).collect());
        scene.add(
            name,
            Geometry::Shapes(shapes),
            material,
            Transform::identity(),
        );
    };
    let ground = Sphere::new(Point3::new(0.0, -101.0, 0.0), 100.0);
    add(
        "ground",
        vec![ground],
        Material::matt("ground", Rgb::grey(0.6)),
    );
    let balls = |mirrors: bool| {
        (0..64_u8)
            .filter(|i| (i % 3 == 0) == mirrors)
            .map(|i| {
                let (x, z) = (f32::from(i % 8) - 3.5, f32::from(i / 8) - 3.5);
                let radius = 0.3 + 0.02 * f32::from(i % 7);
                Sphere::new(Point3::new(1.2 * x, radius - 1.0, 1.2 * z), radius)
            })
            .collect()
    };
    add(
        "matt balls",
        balls(false),
        Material::matt("matt", Rgb::new(0.8, 0.3, 0.2)),
    );
    add("mirror balls", balls(true), mirror());
    scene
}

/// Reflects most light, and has a highlight.
pub(super) fn mirror() -> Material {
    Material {
        specular: Rgb::grey(0.5),
        shininess: 64.0,
        reflection: Rgb::grey(0.7),
        ..Material::matt("mirror", Rgb::grey(0.1))
    }
}
