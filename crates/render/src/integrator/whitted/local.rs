//! Phong's local term: what lights do to a surface without any detour.

use ombra_pipeline::{Context, Exception};
use ombra_scene::light::LightSample;
use ombra_scene::{Interaction, Light, Material, Rgb};

use super::Whitted;
use super::shadow::{Filter, Shadow};
use super::side::Side;
use crate::optics;

impl Whitted<'_> {
    /// The ambient part, and of each light that is not in the shade the diffuse and the specular
    /// part: kd (N · L) + ks (R · V)ⁿ (Phong, "Illumination for Computer Generated Pictures", CACM
    /// 18(6), 1975).
    pub(super) fn local(
        &self,
        cx: &mut Context<'_, Self>,
        place: &Interaction,
        side: &Side,
        material: &Material,
    ) -> Result<Rgb, Exception> {
        let scene = self.world.scene();
        let diffuse = material.diffuse_at(place.object_point, place.uv) * place.tint;
        let mut radiance = scene.ambient * diffuse;
        if diffuse.is_black() && material.specular.is_black() {
            return Ok(radiance);
        }
        for light in &scene.lights {
            radiance += self.lit(cx, place, side, material, diffuse, light)?;
        }
        Ok(radiance)
    }

    /// What one light adds.
    fn lit(
        &self,
        cx: &mut Context<'_, Self>,
        place: &Interaction,
        side: &Side,
        material: &Material,
        diffuse: Rgb,
        light: &Light,
    ) -> Result<Rgb, Exception> {
        let Some(light) = light.sample_li(place.point) else {
            return Ok(Rgb::BLACK);
        };
        let cosine = side.shading_normal.dot(light.wi);
        if !(cosine > 0.0 && side.is_in_front(light.wi)) {
            return Ok(Rgb::BLACK);
        }
        let mut scattered = diffuse * cosine;
        if !material.specular.is_black() {
            let highlight = optics::reflected(light.wi, side.shading_normal).dot(place.wo);
            scattered += material.specular * highlight.max(0.0).powf(material.shininess);
        }
        if scattered.is_black() {
            return Ok(Rgb::BLACK);
        }
        Ok(scattered * light.incident * self.unshadowed(cx, place, &light)?)
    }

    /// How much of a light reaches a place.
    fn unshadowed(
        &self,
        cx: &mut Context<'_, Self>,
        place: &Interaction,
        light: &LightSample,
    ) -> Result<Rgb, Exception> {
        let ray = place.spawn_within(light.wi, light.distance);
        let mut filter = Filter::default();
        // A place at the end of the number range has no ray that leaves it.
        if ray.is_valid() {
            cx.trace::<Shadow>(&ray, &mut filter)?;
        }
        Ok(filter.transmitted())
    }
}
