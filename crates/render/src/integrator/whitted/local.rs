//! Phong's local term: what lights do to a surface without any detour.

use ombra_pipeline::{Context, Exception};
use ombra_scene::light::LightSample;
use ombra_scene::{Interaction, Light, Material, Rgb};

use super::Whitted;
use super::shadow::{Filter, Shadow};
use super::side::Side;
use crate::explain::{self, End, Event, LightWay, Observer, Part, RayKind};
use crate::optics;

impl<O: Observer> Whitted<'_, O> {
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
        let diffuse = material.diffuse_at(place.object_point, place.uv);
        let mut radiance = scene.ambient * diffuse;
        self.observer.tell(|| Event::Adds(Part::Ambient(radiance)));
        if diffuse.is_black() && material.specular.is_black() {
            return Ok(radiance);
        }
        for (index, light) in scene.lights.iter().enumerate() {
            radiance += self.lit(cx, place, side, material, diffuse, index, light)?;
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
        index: usize,
        light: &Light,
    ) -> Result<Rgb, Exception> {
        let Some(light) = light.sample_li(place.point) else {
            self.unlit(index, LightWay::OutOfReach);
            return Ok(Rgb::BLACK);
        };
        let cosine = side.shading_normal.dot(light.wi);
        if !(cosine > 0.0 && side.is_in_front(light.wi)) {
            self.unlit(index, LightWay::Behind);
            return Ok(Rgb::BLACK);
        }
        let mut scattered = diffuse * cosine;
        if !material.specular.is_black() {
            let highlight = optics::reflected(light.wi, side.shading_normal).dot(place.wo);
            scattered += material.specular * highlight.max(0.0).powf(material.shininess);
        }
        if scattered.is_black() {
            self.unlit(index, LightWay::NothingScattered);
            return Ok(Rgb::BLACK);
        }
        let weight = scattered * light.incident;
        let arriving = self.unshadowed(cx, place, index, &light, weight)?;
        self.observer.tell(|| Event::Light {
            light: index,
            diffuse: diffuse * cosine * light.incident,
            specular: (scattered + diffuse * -cosine) * light.incident,
            way: None,
        });
        Ok(weight * arriving)
    }

    /// How much of a light reaches a place.
    fn unshadowed(
        &self,
        cx: &mut Context<'_, Self>,
        place: &Interaction,
        index: usize,
        light: &LightSample,
        weight: Rgb,
    ) -> Result<Rgb, Exception> {
        let ray = place.spawn_within(light.wi, light.distance);
        let kind = RayKind::Shadow { light: index };
        self.observer.tell(|| Event::Wanted { kind, ray, weight });
        let mut filter = Filter::default();
        // A place at the end of the number range has no ray that leaves it.
        if ray.is_valid() {
            explain::trace::<Shadow, _, _>(&self.observer, cx, &ray, &mut filter)?;
        }
        let blocked = filter.is_blocked();
        let arriving = filter.transmitted();
        self.observer
            .tell(|| Event::Ends(if blocked { End::Blocked } else { End::Free }));
        self.observer.tell(|| Event::Done(arriving));
        Ok(arriving)
    }

    /// Tells that a light was not asked for.
    fn unlit(&self, light: usize, way: LightWay) {
        self.observer.tell(|| Event::Light {
            light,
            diffuse: Rgb::BLACK,
            specular: Rgb::BLACK,
            way: Some(way),
        });
    }
}
