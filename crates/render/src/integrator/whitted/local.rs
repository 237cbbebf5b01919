//! Phong's local term: what lights do to a surface without any detour.

use ombra_pipeline::{Context, Exception};
use ombra_scene::light::LightSample;
use ombra_scene::{Interaction, Material, Rgb};

use super::shadow::{Shade, Shadow};
use super::{Traced, Whitted};
use crate::sampler::Dimension;
use crate::shading::{self, Side};

impl Whitted<'_> {
    /// The ambient part, and what is scattered of each light that is not in the shade.
    pub(super) fn local(
        &self,
        cx: &mut Context<'_, Self>,
        place: &Interaction,
        side: &Side,
        material: &Material,
        traced: &Traced,
    ) -> Result<Rgb, Exception> {
        let scene = self.world.scene();
        let diffuse = material.diffuse_at(place.object_point, place.uv) * place.tint;
        let mut radiance = scene.ambient * diffuse;
        if diffuse.is_black() && material.specular.is_black() {
            return Ok(radiance);
        }
        for (index, light) in scene.lights.iter().enumerate() {
            let xi = || traced.pair(Dimension::Light, index);
            let Some(light) = light.sample_li(place.point, xi) else {
                continue;
            };
            let scattered = shading::scattered(material, diffuse, side, place.wo, &light);
            if !scattered.is_black() {
                radiance += scattered * self.unshadowed(cx, place, &light)?;
            }
        }
        Ok(radiance)
    }

    /// How much of a light reaches a place.
    fn unshadowed(
        &self,
        cx: &mut Context<'_, Self>,
        place: &Interaction,
        light: &LightSample,
    ) -> Result<Rgb, Exception> {
        let mut shade = Shade::of(light);
        // The light of an object may be met anywhere on its surface.
        let distance = match light.object {
            Some(_) => f32::INFINITY,
            None => light.distance,
        };
        let ray = place.spawn_within(light.wi, distance);
        // A place at the end of the number range has no ray that leaves it.
        if ray.is_valid() {
            cx.trace::<Shadow>(&ray, &mut shade)?;
        }
        Ok(shade.transmitted())
    }
}
