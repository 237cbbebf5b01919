//! Generated scenes, the same on every machine.

mod balls;
mod hills;

use ombra_accel::StructureKind;
use ombra_geometry::{Angle, Point3, Vector3};
use ombra_scene::camera::{Perspective, Pose, Projection};
use ombra_scene::{Camera, Light, Rgb, Scene, World, light::Falloff};

use crate::Settings;

/// A scene and the camera that looks at it.
#[derive(Clone, Debug)]
pub struct Stage {
    /// What is there.
    pub world: World,
    /// Who looks at it.
    pub camera: Camera,
    /// How many pixels wide and high the picture is.
    pub pixels: u32,
}

/// All scenes, by name.
///
/// # Errors
/// When a description does not fit together.
pub fn all(settings: &Settings) -> anyhow::Result<Vec<(&'static str, Stage)>> {
    let stage = |scene| stage(scene, settings.pixels, settings.accel);
    Ok(vec![
        ("balls", stage(balls::scene())?),
        ("hills", stage(hills::scene(settings.detail)?)?),
    ])
}

fn stage(mut scene: Scene, pixels: u32, accel: StructureKind) -> anyhow::Result<Stage> {
    scene.ambient = Rgb::grey(0.15);
    scene.background = Rgb::new(0.5, 0.7, 0.9).into();
    scene.lights = vec![
        Light::Directional {
            direction: Vector3::new(-1.0, -2.0, -0.5),
            intensity: Rgb::grey(0.6),
        },
        Light::Point {
            position: Point3::new(-3.0, 6.0, 4.0),
            intensity: Rgb::new(0.4, 0.35, 0.3),
            falloff: Falloff::None,
        },
    ];
    let pose = Pose::look_at(Point3::new(0.0, 3.0, 9.0), Point3::ORIGIN, Vector3::Y)?;
    let fov = Angle::from_degrees(50.0);
    let camera = Camera {
        pose,
        projection: Projection::Perspective(Perspective::new(fov)),
    };
    Ok(Stage {
        world: World::build(scene, accel)?,
        camera,
        pixels,
    })
}
