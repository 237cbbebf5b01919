//! Phong's scattering: what a light does to a surface without any detour.

use ombra_geometry::Vector3;
use ombra_scene::light::LightSample;
use ombra_scene::{Material, Rgb};

use super::Side;
use crate::optics;

/// What of a light is scattered toward the viewer, were nothing in between: the diffuse and the
/// specular part, kd (N · L) + ks (R · V)ⁿ, times the light that arrives. Black where the light is
/// behind the surface.
///
/// Phong, "Illumination for Computer Generated Pictures", CACM 18(6), 1975. `diffuse` is the
/// material's diffuse colour at the place, `wo` leads to the viewer.
#[inline]
pub(crate) fn scattered(
    material: &Material,
    diffuse: Rgb,
    side: &Side,
    wo: Vector3,
    light: &LightSample,
) -> Rgb {
    let Some([diffuse, specular]) = terms(material, diffuse, side, wo, light) else {
        return Rgb::BLACK;
    };
    (diffuse + specular) * light.incident
}

/// The diffuse and the specular part of [`scattered`], of light of strength 1; none where the light is
/// behind the surface.
#[inline]
pub(crate) fn terms(
    material: &Material,
    diffuse: Rgb,
    side: &Side,
    wo: Vector3,
    light: &LightSample,
) -> Option<[Rgb; 2]> {
    let cosine = side.shading_normal.dot(light.wi);
    if !(cosine > 0.0 && side.is_in_front(light.wi)) {
        return None;
    }
    let mut specular = Rgb::BLACK;
    if !material.specular.is_black() {
        let highlight = optics::reflected(light.wi, side.shading_normal).dot(wo);
        specular = material.specular * highlight.max(0.0).powf(material.shininess);
    }
    Some([diffuse * cosine, specular])
}
