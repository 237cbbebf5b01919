//! Whitted's ray tracing, as taught: trace(point, direction, step).

mod local;
mod shadow;
#[cfg(test)]
mod tests;

use ombra_geometry::{Hit, Ray};
use ombra_pipeline::{
    AnyHit, Batch, Context, Exception, Pipeline, RayGeneration, RayProgram, RayType,
};
use ombra_scene::{Interaction, Material, Rgb, World};

use crate::Settings;
use crate::explain::{self, Absorbed, End, Event, Observer, Part, RayKind, Split};
use crate::exposure::Exposure;
use crate::film::Pixel;
use crate::optics;
use crate::sampler::{Dimension, Sample};
use crate::shading::Side;
use shadow::{Shade, Shadow};

/// trace(point, direction, step) of the lecture, after Whitted, "An Improved Illumination Model for
/// Shaded Display", CACM 23(6), 1980:
///
/// - beyond the last step, and where there is nothing: the background (but see
///   [`Cutoff`](ombra_scene::Cutoff));
/// - a light source: its emission, and nothing else;
/// - any other surface: its emission, if it has any, Phong's local term, what is seen in the mirror
///   direction, and what is seen through the surface, the last two by a ray with one step more.
///
/// A ray of whose light less than a thousandth arrives at the pixel (unless the settings say
/// otherwise) is treated like one beyond the last step: Hall, Greenberg, "A Testbed for Realistic Image
/// Synthesis", IEEE
/// Computer Graphics and Applications 3(8), 1983. In glass every ray becomes two, so without this the
/// number of rays doubles with every step. With it, where surfaces are grey and pass on no more light
/// than arrives (reflection + transmission ≤ 1), the rays of one step have shares that add up to no
/// more than 1, so there are at most a thousand of them, and in glass far fewer.
///
/// Each ray that is left out changes its pixel by less than a thousandth of the difference between
/// what it would have seen and the background, and there may be several: in four nested spheres of
/// glass they add up to less than 1/256 of the largest such difference at 8 bounces and to less than
/// 1/128 at 12 (see the tests).
///
/// What it does it tells an [`Observer`], for [`explain`](crate::explain).
pub(crate) struct Whitted<'a, O = ()> {
    world: &'a World,
    exposure: Exposure<'a>,
    max_depth: u32,
    least_importance: f32,
    observer: O,
}

/// The rays that bring light.
enum Radiance {}

impl RayType for Radiance {
    type Payload = Traced;
    const NAME: &'static str = "radiance";
}

/// What a radiance ray carries.
#[derive(Clone, Copy)]
struct Traced {
    /// The random numbers of the sample that it belongs to.
    sample: Sample,
    /// Which ray of the sample it is: the camera's is 1, the mirrored child of n is 2 n, the other
    /// one 2 n + 1. Beyond 63 steps numbers repeat, which only ties some shadows to others.
    branch: u64,
    /// How often its light was reflected or refracted on the way.
    step: u32,
    /// What share of its light arrives at the pixel, at most: the product of what the surfaces on
    /// the way pass on of the colour of which they pass on most.
    importance: f32,
    /// What it brought.
    radiance: Rgb,
}

impl Traced {
    /// The ray of a camera.
    const fn camera(sample: Sample) -> Self {
        Self {
            sample,
            branch: 1,
            step: 0,
            importance: 1.0,
            radiance: Rgb::BLACK,
        }
    }

    /// The ray in the mirror direction.
    const fn mirrored(&self) -> Self {
        Self {
            branch: self.branch << 1,
            step: self.step + 1,
            ..*self
        }
    }

    /// The ray through the surface.
    const fn through(&self) -> Self {
        Self {
            branch: self.branch << 1 | 1,
            step: self.step + 1,
            ..*self
        }
    }

    /// Two random numbers for the `n`-th of a kind where this ray ends.
    fn pair(&self, dimension: Dimension, n: usize) -> [f32; 2] {
        self.sample.nth_pair(dimension, self.branch, n as u32)
    }
}

impl<'a> Whitted<'a> {
    pub(crate) const fn new(world: &'a World, exposure: Exposure<'a>, settings: &Settings) -> Self {
        Self::observed(world, exposure, settings, ())
    }
}

impl<'a, O> Whitted<'a, O> {
    pub(crate) const fn observed(
        world: &'a World,
        exposure: Exposure<'a>,
        settings: &Settings,
        observer: O,
    ) -> Self {
        Self {
            world,
            exposure,
            max_depth: settings.max_depth,
            least_importance: settings.least_importance,
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
        mut traced: Traced,
    ) -> Result<Rgb, Exception> {
        let beyond = traced.step > self.max_depth;
        if beyond || traced.importance < self.least_importance {
            let radiance = self.world.scene().beyond(ray.direction);
            self.observer.tell(|| {
                Event::Ends(if beyond {
                    End::MaxDepth
                } else {
                    End::Unimportant
                })
            });
            self.observer.tell(|| Event::Done(radiance));
            return Ok(radiance);
        }
        explain::trace::<Radiance, _, _>(&self.observer, cx, ray, &mut traced)?;
        self.observer.tell(|| Event::Done(traced.radiance));
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
                None if material.internal_reflection => 1.0,
                None => 0.0,
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
                radiance += self.weighted(cx, kind, ray, weight, traced.through())?;
            }
        }
        let direction = side.reflected(place.wo);
        let (ray, kind) = (place.spawn(direction), RayKind::Reflected);
        radiance += self.weighted(cx, kind, ray, mirrored, traced.mirrored())?;
        Ok(radiance)
    }

    fn weighted(
        &self,
        cx: &mut Context<'_, Self>,
        kind: RayKind,
        ray: Ray,
        weight: Rgb,
        child: Traced,
    ) -> Result<Rgb, Exception> {
        // A place at the end of the number range has no ray that leaves it.
        if weight.is_black() || !ray.is_valid() {
            return Ok(Rgb::BLACK);
        }
        let importance = child.importance * weight.max_component();
        let child = Traced {
            importance,
            ..child
        };
        self.observer.tell(|| Event::Wanted { kind, ray, weight });
        Ok(weight * self.radiance(cx, &ray, child)?)
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
        let place = self.world.interaction(ray, hit);
        let emission = material.emission_at(place.uv);
        if material.is_light_source() {
            self.observer.tell(|| Event::met(hit, &place));
            self.observer.tell(|| Event::Adds(Part::Emission(emission)));
            self.observer.tell(|| Event::Ends(End::LightSource));
            traced.radiance = emission;
            return Ok(());
        }
        self.observer.tell(|| Event::met(hit, &place));
        self.observer.tell(|| Event::Adds(Part::Emission(emission)));
        // A ray that meets the back of a surface came through what is behind it.
        let absorbed = (!material.absorption.is_black() && !place.is_front()).then(|| {
            let way = hit.t * ray.direction.length();
            Absorbed {
                way,
                left: material.left_after(way),
            }
        });
        if let Some(absorbed) = absorbed {
            self.observer.tell(|| Event::Absorbs(absorbed));
        }
        let side = Side::of(&place);
        traced.radiance = emission
            + self.local(cx, &place, &side, material, traced)?
            + self.bounced(cx, &place, &side, material, traced)?;
        if let Some(absorbed) = absorbed {
            traced.radiance *= absorbed.left;
        }
        Ok(())
    }

    fn miss(
        &self,
        _cx: &mut Context<'_, Self>,
        ray: &Ray,
        traced: &mut Traced,
    ) -> Result<(), Exception> {
        traced.radiance = self.world.scene().background.at(ray.direction);
        Ok(())
    }
}

impl<O: Observer> RayProgram<Shadow> for Whitted<'_, O> {
    /// What is opaque ends the ray, what is transparent dims the light, and a light source lets it
    /// pass: else a lamp would put itself into the shade.
    #[inline]
    fn any_hit(&self, _ray: &Ray, hit: &Hit, shade: &mut Shade) -> AnyHit {
        if shade.looks_for_object() {
            return AnyHit::Accept;
        }
        let material = self.world.material(hit);
        if material.is_light_source() {
            AnyHit::Ignore
        } else if material.transmission.is_black() {
            self.observer.tell(|| Event::crossed(hit, None));
            shade.block();
            AnyHit::Terminate
        } else {
            self.observer
                .tell(|| Event::crossed(hit, Some(material.transmission)));
            shade.dim(material.transmission);
            AnyHit::Ignore
        }
    }

    #[inline]
    fn closest_hit(
        &self,
        _cx: &mut Context<'_, Self>,
        _ray: &Ray,
        hit: &Hit,
        shade: &mut Shade,
    ) -> Result<(), Exception> {
        if shade.looks_for_object() {
            self.observer.tell(|| Event::crossed(hit, None));
        }
        shade.met(Some(hit.instance));
        Ok(())
    }

    #[inline]
    fn miss(
        &self,
        _cx: &mut Context<'_, Self>,
        _ray: &Ray,
        shade: &mut Shade,
    ) -> Result<(), Exception> {
        shade.met(None);
        Ok(())
    }
}

impl<O: Observer> RayGeneration for Whitted<'_, O> {
    type Output = Pixel;

    fn generate(&self, cx: &mut Context<'_, Self>, pixel: &mut Pixel) -> Result<(), Exception> {
        self.exposure
            .expose(cx.launch_index(), pixel, |ray, sample| {
                self.observer.tell(|| Event::camera(ray));
                self.radiance(cx, ray, Traced::camera(*sample))
            })
    }

    /// The rays of the camera go together; of what they bring on, each goes its own way.
    fn generate_many(&self, batch: &mut Batch<'_, Self>, pixels: &mut [Pixel]) -> bool {
        // One who listens is told of one ray after another; and the camera's may not be worth tracing.
        !O::LISTENS
            && self.least_importance <= 1.0
            && (self.exposure).expose_many(batch, pixels, |cx, ray, hit, sample| {
                let mut traced = Traced::camera(*sample);
                cx.shade::<Radiance>(ray, hit, &mut traced)?;
                Ok(traced.radiance)
            })
    }
}
