//! What both contestants compute at a hit.

use ombra_geometry::Ray;
use ombra_scene::camera::CameraSample;
use ombra_scene::light::LightSample;
use ombra_scene::{Interaction, Material, Rgb};

use crate::scenes::Stage;

/// The ray through the middle of a pixel.
#[inline]
pub(super) fn camera_ray(stage: &Stage, x: u32, y: u32) -> Ray {
    let screen = [x, y].map(|i| (i as f32 + 0.5) / stage.pixels as f32);
    stage.camera.ray(1.0, CameraSample::pinhole(screen))
}

/// The part of the light that comes from everywhere.
#[inline]
pub(super) fn ambient(stage: &Stage, material: &Material, place: &Interaction) -> Rgb {
    stage.world.scene().ambient * material.diffuse_at(place.object_point, place.uv)
}

/// Phong's term of one light, and the ray that asks whether it arrives; `None` where it cannot.
#[inline]
pub(super) fn direct(
    material: &Material,
    place: &Interaction,
    light: &LightSample,
) -> Option<(Rgb, Ray)> {
    let normal = place.shading_normal.facing(place.wo);
    let cosine = normal.dot(light.wi);
    if cosine <= 0.0 {
        return None;
    }
    let mirrored = (-light.wi).reflect(normal);
    let highlight = mirrored.dot(place.wo).max(0.0).powf(material.shininess);
    let diffuse = material.diffuse_at(place.object_point, place.uv) * cosine;
    let shadow = Ray {
        t_max: light.distance,
        ..place.spawn(light.wi)
    };
    let colour = light.incident * (diffuse + material.specular * highlight);
    Some((colour, shadow))
}

/// The ray into the mirror.
#[inline]
pub(super) fn mirrored(place: &Interaction) -> Ray {
    place.spawn((-place.wo).reflect(place.shading_normal))
}

/// A colour as bits.
#[inline]
pub(super) fn bits(colour: Rgb) -> [u32; 3] {
    colour.to_array().map(f32::to_bits)
}
