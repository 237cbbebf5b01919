//! What a model without camera or lights gets, so that there is something to see.

use ombra_accel::Traversable as _;
use ombra_geometry::Vector3;
use ombra_scene::{Camera, Light, Rgb, Scene, World};

/// The camera of the scene or, if it has none, one that sees all of it; `aspect` is the width of the
/// picture over its height.
#[must_use]
pub fn camera(world: &World, aspect: f32) -> Camera {
    let scene = world.scene();
    scene
        .camera
        .unwrap_or_else(|| Camera::framing(&world.bounds(), scene.up, aspect))
}

/// Gives a scene that has no light of any kind a bright one from the upper left of the
/// [framing](Camera::framing) camera, a weak one from the right, and some light from everywhere.
pub(crate) fn light(scene: &mut Scene) {
    let luminous = scene.objects.iter().any(|object| {
        let material = scene.materials.get(object.material.index());
        material.is_some_and(|material| material.is_light_source())
    });
    if !scene.lights.is_empty() || luminous {
        return;
    }
    let up = scene.up.normalized().unwrap_or(Vector3::Y);
    let (right, front) = Camera::sides(up);
    let from = |toward: Vector3, intensity: f32| Light::Directional {
        direction: -toward,
        intensity: Rgb::grey(intensity),
    };
    scene
        .lights
        .push(from(up * 1.2 - right * 0.35 + front, 0.75));
    scene
        .lights
        .push(from(up * 0.3 + right + front * 0.2, 0.25));
    if scene.ambient.is_black() {
        scene.ambient = Rgb::grey(0.12);
    }
}
