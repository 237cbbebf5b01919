//! Phong's local term: what lights do to a surface without any detour.

use ombra_pipeline::{Context, Exception};
use ombra_scene::light::LightSample;
use ombra_scene::{Interaction, Material, Rgb};

use super::shadow::{Shade, Shadow};
use super::{Traced, Whitted};
use crate::explain::{self, End, Event, LightWay, Observer, Part, RayKind};
use crate::sampler::Dimension;
use crate::shading::{self, Side};

impl<O: Observer> Whitted<'_, O> {
    /// The ambient part, and what is scattered of each light that is not in the shade. A light is not
    /// asked if of all lights together a smaller share would arrive at the pixel than makes a ray worth
    /// tracing.
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
        self.observer.tell(|| Event::Adds(Part::Ambient(radiance)));
        if diffuse.is_black() && material.specular.is_black() {
            return Ok(radiance);
        }
        // The share of what arrives of a light below which it is not asked: of all of them together too
        // little would come to the pixel.
        let least = self.least_importance / (traced.importance * scene.lights.len() as f32);
        for (index, light) in scene.lights.iter().enumerate() {
            let xi = || traced.pair(Dimension::Light, index);
            let Some(light) = light.sample_li(place.point, xi) else {
                self.observer.tell(|| unlit(index, LightWay::OutOfReach));
                continue;
            };
            let Some([diffuse, specular]) =
                shading::terms(material, diffuse, side, place.wo, &light)
            else {
                self.observer.tell(|| unlit(index, LightWay::Behind));
                continue;
            };
            let share = diffuse + specular;
            let scattered = share * light.incident;
            let way = if scattered.is_black() {
                Some(LightWay::NothingScattered)
            } else if share.max_component() < least {
                Some(LightWay::Unimportant)
            } else {
                radiance += scattered * self.unshadowed(cx, place, index, &light, scattered)?;
                None
            };
            self.observer.tell(|| Event::Light {
                light: index,
                diffuse: diffuse * light.incident,
                specular: specular * light.incident,
                way,
            });
        }
        Ok(radiance)
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
        let mut shade = Shade::of(light);
        // The light of an object may be met anywhere on its surface.
        let distance = match light.object {
            Some(_) => f32::INFINITY,
            None => light.distance,
        };
        let ray = place.spawn_within(light.wi, distance);
        // A place at the end of the number range has no ray that leaves it.
        let kind = RayKind::Shadow { light: index };
        self.observer.tell(|| Event::Wanted { kind, ray, weight });
        if ray.is_valid() {
            explain::trace::<Shadow, _, _>(&self.observer, cx, &ray, &mut shade)?;
        }
        let end = if shade.is_blocked() {
            End::Blocked
        } else {
            End::Free
        };
        let arriving = shade.transmitted();
        self.observer.tell(|| Event::Ends(end));
        self.observer.tell(|| Event::Done(arriving));
        Ok(arriving)
    }
}

/// A light that no shadow ray asked for.
const fn unlit(light: usize, way: LightWay) -> Event {
    Event::Light {
        light,
        diffuse: Rgb::BLACK,
        specular: Rgb::BLACK,
        way: Some(way),
    }
}
