//! Whitted's ray tracing, as taught: trace(point, direction, step).

mod local;
mod shadow;
mod side;
#[cfg(test)]
mod tests;

use ombra_geometry::{Hit, Ray};
use ombra_pipeline::{AnyHit, Context, Exception, Pipeline, RayGeneration, RayProgram, RayType};
use ombra_scene::{Interaction, Material, Rgb, World};

use crate::explain::{self, End, Event, Observer, Part, RayKind, Split};
use crate::exposure::Exposure;
use crate::film::Pixel;
use crate::optics;
use shadow::{Filter, Shadow};
use side::Side;

/// trace(point, direction, step) of the lecture, after Whitted, "An Improved Illumination Model for
/// Shaded Display", CACM 23(6), 1980:
///
/// - beyond the last step, and where there is nothing: the background;
/// - a light source: its emission, and nothing else;
/// - any other surface: Phong's local term, plus what is seen in the mirror direction, plus what is
///   seen through the surface, each by a ray with one step more.
///
/// A ray of whose light less than a thousandth arrives at the pixel is taken to see the background,
/// like one beyond the last step: Hall, Greenberg, "A Testbed for Realistic Image Synthesis", IEEE
/// Computer Graphics and Applications 3(8), 1983. In glass every ray becomes two, so without this the
/// number of rays doubles with every step. With it, where surfaces are grey and pass on no more light
/// than arrives (reflection + transmission ≤ 1), the rays of one step have shares that add up to no
/// more than 1, so there are at most a thousand of them, and in glass far fewer.
///
/// Each ray that is left out changes its pixel by less than a thousandth of the difference between
/// what it would have seen and the background, and there may be several: in four nested spheres of
/// glass they add up to less than 1/256 of the largest such difference at 8 bounces and to less than
/// 1/128 at 12 (see the tests).
pub(crate) struct Whitted<'a, O = ()> {
    world: &'a World,
    exposure: Exposure<'a>,
    max_depth: u32,
    least_importance: f32,
    observer: O,
}

/// What a ray's light must count for in its pixel for the ray to be worth tracing.
const LEAST_IMPORTANCE: f32 = 1e-3;

/// The rays that bring light.
enum Radiance {}

impl RayType for Radiance {
    type Payload = Traced;
    const NAME: &'static str = "radiance";
}

/// What a radiance ray carries.
#[derive(Clone, Copy)]
struct Traced {
    /// How often its light was reflected or refracted on the way.
    step: u32,
    /// What share of its light arrives at the pixel, at most: the product of what the surfaces on
    /// the way pass on of the colour of which they pass on most.
    importance: f32,
    /// What it brought.
    radiance: Rgb,
}

impl<'a> Whitted<'a> {
    pub(crate) const fn new(world: &'a World, exposure: Exposure<'a>, max_depth: u32) -> Self {
        Self::observed(world, exposure, max_depth, ())
    }
}

impl<'a, O> Whitted<'a, O> {
    pub(crate) const fn observed(
        world: &'a World,
        exposure: Exposure<'a>,
        max_depth: u32,
        observer: O,
    ) -> Self {
        Self {
            world,
            exposure,
            max_depth,
            least_importance: LEAST_IMPORTANCE,
            observer,
        }
    }
}

impl<O: Observer> Whitted<'_, O> {
    /// The lecture's function.
    fn radiance(
        &self,
        cx: &mut Context<'_, Self>,
        ray: &Ray,
        step: u32,
        importance: f32,
    ) -> Result<Rgb, Exception> {
        let background = self.world.scene().background;
        if step > self.max_depth {
            self.observer.tell(|| Event::Ends(End::MaxDepth));
            return Ok(background);
        }
        if importance < self.least_importance {
            self.observer.tell(|| Event::Ends(End::Unimportant));
            return Ok(background);
        }
        let mut traced = Traced {
            step,
            importance,
            radiance: background,
        };
        explain::trace::<Radiance, _, _>(&self.observer, cx, ray, &mut traced)?;
        Ok(traced.radiance)
    }

    /// What is seen in the mirror and through the surface.
    fn bounced(
        &self,
        cx: &mut Context<'_, Self>,
        place: &Interaction,
        side: &Side,
        material: &Material,
        traced: &Traced,
    ) -> Result<Rgb, Exception> {
        let mut mirrored = material.reflection;
        let mut radiance = Rgb::BLACK;
        if !material.transmission.is_black() {
            let eta = side.eta(material.index_of_refraction);
            let through = side.refracted(place.wo, eta);
            let share = match through {
                None => 1.0,
                Some(_) if material.fresnel => optics::fresnel(side.cosine(place.wo), eta),
                Some(_) => 0.0,
            };
            self.observer.tell(|| {
                Event::Splits(Split {
                    eta,
                    mirrored: share,
                    total: through.is_none(),
                })
            });
            mirrored += material.transmission * share;
            if let Some(direction) = through {
                let weight = material.transmission * (1.0 - share);
                let ray = place.spawn(direction);
                let kind = RayKind::Transmitted;
                radiance += self.weighted(cx, kind, ray, weight, traced)?;
            }
        }
        let direction = side.reflected(place.wo);
        let ray = place.spawn(direction);
        radiance += self.weighted(cx, RayKind::Reflected, ray, mirrored, traced)?;
        Ok(radiance)
    }

    fn weighted(
        &self,
        cx: &mut Context<'_, Self>,
        kind: RayKind,
        ray: Ray,
        weight: Rgb,
        traced: &Traced,
    ) -> Result<Rgb, Exception> {
        // A place at the end of the number range has no ray that leaves it.
        if weight.is_black() || !ray.is_valid() {
            return Ok(Rgb::BLACK);
        }
        let importance = traced.importance * weight.max_component();
        self.observer.tell(|| Event::Wanted { kind, ray, weight });
        let radiance = self.radiance(cx, &ray, traced.step + 1, importance)?;
        self.observer.tell(|| Event::Done(radiance));
        Ok(weight * radiance)
    }
}

impl<O: Observer> Pipeline for Whitted<'_, O> {
    type World = World;

    fn world(&self) -> &World {
        self.world
    }

    /// A shadow ray from the last step is nested one deeper than that step.
    fn max_trace_depth(&self) -> u32 {
        self.max_depth + 2
    }
}

impl<O: Observer> RayProgram<Radiance> for Whitted<'_, O> {
    fn closest_hit(
        &self,
        cx: &mut Context<'_, Self>,
        ray: &Ray,
        hit: &Hit,
        traced: &mut Traced,
    ) -> Result<(), Exception> {
        let material = self.world.material(hit);
        if material.is_light_source() {
            self.observer
                .tell(|| Event::met(hit, &self.world.interaction(ray, hit)));
            self.observer
                .tell(|| Event::Adds(Part::Emission(material.emission)));
            self.observer.tell(|| Event::Ends(End::LightSource));
            traced.radiance = material.emission;
            return Ok(());
        }
        let place = self.world.interaction(ray, hit);
        self.observer.tell(|| Event::met(hit, &place));
        let side = Side::of(&place);
        traced.radiance = self.local(cx, &place, &side, material)?
            + self.bounced(cx, &place, &side, material, traced)?;
        Ok(())
    }
}

impl<O: Observer> RayProgram<Shadow> for Whitted<'_, O> {
    /// What is opaque ends the ray, what is transparent dims the light, and a light source lets it
    /// pass: else a lamp would put itself into the shade.
    #[inline]
    fn any_hit(&self, _ray: &Ray, hit: &Hit, filter: &mut Filter) -> AnyHit {
        let material = self.world.material(hit);
        if material.is_light_source() {
            AnyHit::Ignore
        } else if material.transmission.is_black() {
            self.observer.tell(|| Event::crossed(hit, None));
            filter.block();
            AnyHit::Terminate
        } else {
            self.observer
                .tell(|| Event::crossed(hit, Some(material.transmission)));
            filter.dim(material.transmission);
            AnyHit::Ignore
        }
    }
}

impl<O: Observer> RayGeneration for Whitted<'_, O> {
    type Output = Pixel;

    fn generate(&self, cx: &mut Context<'_, Self>, pixel: &mut Pixel) -> Result<(), Exception> {
        self.exposure.expose(cx.launch_index(), pixel, |ray, _| {
            self.observer.tell(|| Event::camera(ray));
            let radiance = self.radiance(cx, ray, 0, 1.0)?;
            self.observer.tell(|| Event::Done(radiance));
            Ok(radiance)
        })
    }
}
