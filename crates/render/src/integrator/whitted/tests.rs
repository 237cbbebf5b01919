//! What leaving out rays that do not count is believed to do.

use ombra_accel::{Geometry, Shapes, StructureKind};
use ombra_geometry::shape::{Plane, Sphere};
use ombra_geometry::{Angle, Point3, Transform, Vector3};
use ombra_pipeline::{Control, Cpu};
use ombra_scene::camera::{Perspective, Pose, Projection};
use ombra_scene::{Camera, Scene, Texture};

use super::*;
use crate::Settings;

const SIDE: u32 = 16;

/// Glass spheres, one within the other, over a chequered floor. All that is to be seen lies between
/// black and white, and the background is white.
fn nested_spheres() -> World {
    let mut scene = Scene {
        background: Rgb::WHITE.into(),
        ambient: Rgb::WHITE,
        ..Scene::default()
    };
    let mut add = |shape, material| {
        let geometry = Geometry::Shapes(Shapes(vec![shape]));
        scene.add("thing", geometry, material, Transform::identity());
    };
    for radius in [1.0, 0.8, 0.6, 0.4] {
        let ball = Sphere::new(Point3::ORIGIN, radius);
        add(ball.into(), Material::glass("glass", 1.5));
    }
    let chequered = Material {
        diffuse: Texture::Checker {
            colours: [Rgb::BLACK, Rgb::WHITE],
            size: 0.5,
        },
        ..Material::default()
    };
    add(
        Plane::new(Point3::new(0.0, -1.5, 0.0), Vector3::Y.to_normal())
            .unwrap()
            .into(),
        chequered,
    );
    World::build(scene, StructureKind::default()).unwrap()
}

fn camera() -> Camera {
    let eye = Point3::new(1.0, 0.7, 4.0);
    Camera {
        pose: Pose::look_at(eye, Point3::ORIGIN, Vector3::Y).unwrap(),
        projection: Projection::Perspective(Perspective::new(Angle::from_degrees(32.0))),
    }
}

/// The picture, and the most rays that a pixel of it took.
fn picture(max_depth: u32, least_importance: f32) -> (Vec<Rgb>, u64) {
    let (world, camera) = (nested_spheres(), camera());
    let settings = Settings {
        width: SIDE,
        height: SIDE,
        max_depth,
        least_importance,
        ..Settings::default()
    };
    let cpu = Cpu::with_threads(1).unwrap();
    let mut most = 0;
    let mut pixels = Vec::new();
    for y0 in 0..SIDE {
        for x0 in 0..SIDE {
            let crop = crate::Crop {
                x0,
                y0,
                x1: x0 + 1,
                y1: y0 + 1,
            };
            let settings = Settings {
                crop: Some(crop),
                ..settings.clone()
            };
            let exposure = Exposure::new(&camera, &settings, 0..1);
            let program = Whitted::new(&world, exposure, &settings);
            let mut pixel = [Pixel::default()];
            let report = cpu
                .launch(&program, [1, 1, 1], &mut pixel, &Control::default())
                .unwrap();
            most = most.max(report.rays);
            pixels.push(pixel[0].average().unwrap());
        }
    }
    (pixels, most)
}

#[test]
fn rays_that_are_left_out_can_hardly_be_seen() {
    for (max_depth, bound) in [(8, 1.0 / 256.0), (12, 1.0 / 128.0)] {
        let (whole, all) = picture(max_depth, 0.0);
        let (pruned, some) = picture(max_depth, Settings::default().least_importance);
        let difference = |(a, b): (&Rgb, &Rgb)| (a.r - b.r).abs();
        let worst = whole
            .iter()
            .zip(&pruned)
            .map(difference)
            .fold(0.0, f32::max);
        assert!(worst < bound, "{worst} at {max_depth} bounces");
        assert!(some < all, "{some} of {all}");
    }
}

#[test]
fn rays_in_glass_do_not_double_with_every_step() {
    // Without leaving any out a pixel takes more than 20 000 rays at 16 bounces.
    for max_depth in [16, 64, crate::MAX_DEPTH] {
        let (_, most) = picture(max_depth, Settings::default().least_importance);
        assert!(most < 400, "{most} at {max_depth} bounces");
    }
}
