//! How open a place is.

use std::f32::consts::TAU;

use ombra_geometry::{Hit, Normal3, Ray, Vector3};
use ombra_pipeline::{
    AnyHit, Batch, Context, Exception, Pipeline, RayGeneration, RayProgram, RayType,
};
use ombra_scene::{Interaction, Rgb, World};

use super::View;
use crate::explain::{self, End, Event, Observer, RayKind};
use crate::exposure::Exposure;
use crate::film::Pixel;
use crate::sampler::{Dimension, Sample};

/// How far away something still occludes, as a share of the diagonal of the scene's finite bounds.
const REACH: f32 = 0.1;

/// Ambient occlusion: the share of the hemisphere over what is seen, weighted by the cosine, that
/// is free of obstacles nearby ([`REACH`]); white where there is nothing. It is a matter of geometry
/// alone: glass and lamps occlude, too.
///
/// Zhukov, Iones, Kronin, "An Ambient Light Illumination Model", EGRW 1998, with a step for their
/// function of the distance; one ray a sample.
pub(crate) struct AmbientOcclusion<'a, O = ()> {
    world: &'a World,
    exposure: Exposure<'a>,
    distance: f32,
    observer: O,
}

impl<'a> AmbientOcclusion<'a> {
    pub(crate) fn new(world: &'a World, exposure: Exposure<'a>) -> Self {
        Self::observed(world, exposure, ())
    }
}

impl<'a, O> AmbientOcclusion<'a, O> {
    pub(crate) fn observed(world: &'a World, exposure: Exposure<'a>, observer: O) -> Self {
        let bounds = world.finite_bounds();
        let distance = if bounds.is_empty() {
            f32::INFINITY
        } else {
            bounds.extent().length() * REACH
        };
        Self {
            world,
            exposure,
            distance,
            observer,
        }
    }
}

/// Asks whether something is in the way.
enum Occlusion {}

impl RayType for Occlusion {
    type Payload = bool;
    const NAME: &'static str = "occlusion";
}

/// The place that a camera ray meets.
enum Seen {}

impl RayType for Seen {
    type Payload = Option<Interaction>;
    const NAME: &'static str = View::NAME;
}

impl<O: Observer> Pipeline for AmbientOcclusion<'_, O> {
    type World = World;

    fn world(&self) -> &World {
        self.world
    }
}

impl<O: Observer> RayProgram<Seen> for AmbientOcclusion<'_, O> {
    fn closest_hit(
        &self,
        _cx: &mut Context<'_, Self>,
        ray: &Ray,
        hit: &Hit,
        place: &mut Option<Interaction>,
    ) -> Result<(), Exception> {
        let met = self.world.interaction(ray, hit);
        self.observer.tell(|| Event::met(hit, &met));
        *place = Some(met);
        Ok(())
    }
}

impl<O: Observer> RayProgram<Occlusion> for AmbientOcclusion<'_, O> {
    #[inline]
    fn any_hit(&self, _ray: &Ray, hit: &Hit, occluded: &mut bool) -> AnyHit {
        self.observer.tell(|| Event::crossed(hit, None));
        *occluded = true;
        AnyHit::Terminate
    }
}

impl<O: Observer> RayGeneration for AmbientOcclusion<'_, O> {
    type Output = Pixel;

    fn generate(&self, cx: &mut Context<'_, Self>, pixel: &mut Pixel) -> Result<(), Exception> {
        self.exposure
            .expose(cx.launch_index(), pixel, |ray, sample| {
                self.observer.tell(|| Event::camera(ray));
                let mut place = None;
                explain::trace::<Seen, _, _>(&self.observer, cx, ray, &mut place)?;
                let openness = match place {
                    Some(place) => self.openness(cx, &place, sample)?,
                    None => Rgb::WHITE,
                };
                self.observer.tell(|| Event::Done(openness));
                Ok(openness)
            })
    }

    /// All camera rays together, then all rays from what they meet.
    fn generate_many(&self, batch: &mut Batch<'_, Self>, pixels: &mut [Pixel]) -> bool {
        // One who listens is told of one ray after another.
        if O::LISTENS {
            return false;
        }
        let shots = self.exposure.shots(batch);
        let mut open = vec![Rgb::WHITE; shots.rays.len()];
        let (mut rays, mut asking) = (Vec::new(), Vec::new());
        for (k, (ray, hit)) in shots.rays.iter().zip(&shots.hits).enumerate() {
            if let Some(hit) = hit {
                let place = self.world.interaction(ray, hit);
                let ray = self.probe(&place, &shots.samples[k]);
                if ray.is_valid() {
                    rays.push(ray);
                    asking.push(k);
                }
            } else if !ray.is_valid() {
                return false;
            }
        }
        if batch.is_stopped() {
            return false;
        }
        let mut occluded = vec![false; rays.len()];
        batch.occluded_many(&rays, &mut occluded);
        for (k, occluded) in asking.into_iter().zip(occluded) {
            if occluded {
                open[k] = Rgb::BLACK;
            }
        }
        for (pixel, open) in pixels.iter_mut().zip(open.chunks(shots.each)) {
            open.iter().for_each(|&open| pixel.add(open));
        }
        true
    }
}

impl<O> AmbientOcclusion<'_, O> {
    /// The ray in one direction over a place.
    fn probe(&self, place: &Interaction, sample: &Sample) -> Ray {
        // The true normal: over a shading normal some directions would start into the surface.
        let normal = place.normal.facing(-place.wo);
        let direction = cosine_weighted(normal, sample.pair(Dimension::Hemisphere));
        place.spawn_within(direction, self.distance)
    }
}

impl<O: Observer> AmbientOcclusion<'_, O> {
    /// Whether something is near in one direction over a place.
    fn openness(
        &self,
        cx: &mut Context<'_, Self>,
        place: &Interaction,
        sample: &Sample,
    ) -> Result<Rgb, Exception> {
        let ray = self.probe(place, sample);
        self.observer.tell(|| Event::Wanted {
            kind: RayKind::Occlusion,
            ray,
            weight: Rgb::WHITE,
        });
        let mut occluded = false;
        if ray.is_valid() {
            explain::trace::<Occlusion, _, _>(&self.observer, cx, &ray, &mut occluded)?;
        }
        let (end, radiance) = if occluded {
            (End::Blocked, Rgb::BLACK)
        } else {
            (End::Free, Rgb::WHITE)
        };
        self.observer.tell(|| Event::Ends(end));
        self.observer.tell(|| Event::Done(radiance));
        Ok(radiance)
    }
}

/// A unit direction over a surface with a density proportional to the cosine to its normal: a
/// uniform point of the disk, lifted (Malley's method).
fn cosine_weighted(normal: Normal3, [u, v]: [f32; 2]) -> Vector3 {
    let normal = normal.to_vector();
    let (s, t) = normal.orthonormal_basis();
    let radius = u.sqrt();
    let (sin, cos) = (v * TAU).sin_cos();
    s * (radius * cos) + t * (radius * sin) + normal * (1.0 - u).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_over_a_surface_follow_the_cosine() {
        let normal = Vector3::new(0.6, -0.48, 0.64).to_normal();
        let n = 64_u32;
        let mut below = [0_u32; 4];
        for i in 0..n * n {
            let xi = [i % n, i / n].map(|x| (x as f32 + 0.5) / n as f32);
            let direction = cosine_weighted(normal, xi);
            assert!((direction.length() - 1.0).abs() < 1e-5);
            let cosine = normal.dot(direction);
            assert!(cosine > 0.0);
            // sin² is uniform.
            below[((1.0 - cosine * cosine) * 4.0).clamp(0.0, 3.0) as usize] += 1;
        }
        assert!(
            below.iter().all(|&count| count.abs_diff(n * n / 4) <= n),
            "{below:?}"
        );
    }
}
