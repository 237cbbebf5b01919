//! Shading normals as colours.

use ombra_geometry::{Hit, Ray};
use ombra_pipeline::{Batch, Context, Exception, Pipeline, RayGeneration, RayProgram};
use ombra_scene::{Rgb, World};

use super::{View, view};
use crate::explain::{Event, Observer};
use crate::exposure::Exposure;
use crate::film::Pixel;

/// Shows the unit shading normal n of what is seen as (n + 1) / 2: x is red, y green, z blue, in the
/// world's space; black where there is nothing.
///
/// Normals point out of the surface, whichever side is seen: a surface that is inside out shows by
/// its colour.
pub(crate) struct Normals<'a, O = ()> {
    world: &'a World,
    exposure: Exposure<'a>,
    observer: O,
}

impl<'a> Normals<'a> {
    pub(crate) const fn new(world: &'a World, exposure: Exposure<'a>) -> Self {
        Self::observed(world, exposure, ())
    }
}

impl<'a, O> Normals<'a, O> {
    pub(crate) const fn observed(world: &'a World, exposure: Exposure<'a>, observer: O) -> Self {
        Self {
            world,
            exposure,
            observer,
        }
    }
}

impl<O: Observer> Pipeline for Normals<'_, O> {
    type World = World;

    fn world(&self) -> &World {
        self.world
    }
}

impl<O: Observer> RayProgram<View> for Normals<'_, O> {
    fn closest_hit(
        &self,
        _cx: &mut Context<'_, Self>,
        ray: &Ray,
        hit: &Hit,
        colour: &mut Rgb,
    ) -> Result<(), Exception> {
        let place = self.world.interaction(ray, hit);
        self.observer.tell(|| Event::met(hit, &place));
        *colour = place
            .shading_normal
            .to_array()
            .map(|x| 0.5 * x + 0.5)
            .into();
        Ok(())
    }
}

impl<O: Observer> RayGeneration for Normals<'_, O> {
    type Output = Pixel;

    fn generate(&self, cx: &mut Context<'_, Self>, pixel: &mut Pixel) -> Result<(), Exception> {
        self.exposure.expose(cx.launch_index(), pixel, |ray, _| {
            let mut colour = Rgb::BLACK;
            view(&self.observer, cx, ray, &mut colour)?;
            Ok(colour)
        })
    }

    fn generate_many(&self, batch: &mut Batch<'_, Self>, pixels: &mut [Pixel]) -> bool {
        // One who listens is told of one ray after another.
        !O::LISTENS
            && self.exposure.expose_many(batch, pixels, |cx, ray, hit, _| {
                let mut colour = Rgb::BLACK;
                cx.shade::<View>(ray, hit, &mut colour)?;
                Ok(colour)
            })
    }
}
