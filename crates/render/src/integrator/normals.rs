//! Shading normals as colours.

use ombra_geometry::{Hit, Ray};
use ombra_pipeline::{Context, Exception, Pipeline, RayGeneration, RayProgram};
use ombra_scene::{Rgb, World};

use super::View;
use crate::exposure::Exposure;
use crate::film::Pixel;

/// Shows the unit shading normal n of what is seen as (n + 1) / 2: x is red, y green, z blue, in the
/// world's space; black where there is nothing.
///
/// Normals point out of the surface, whichever side is seen: a surface that is inside out shows by
/// its colour.
pub(crate) struct Normals<'a> {
    world: &'a World,
    exposure: Exposure<'a>,
}

impl<'a> Normals<'a> {
    pub(crate) const fn new(world: &'a World, exposure: Exposure<'a>) -> Self {
        Self { world, exposure }
    }
}

impl Pipeline for Normals<'_> {
    type World = World;

    fn world(&self) -> &World {
        self.world
    }
}

impl RayProgram<View> for Normals<'_> {
    fn closest_hit(
        &self,
        _cx: &mut Context<'_, Self>,
        ray: &Ray,
        hit: &Hit,
        colour: &mut Rgb,
    ) -> Result<(), Exception> {
        let normal = self.world.interaction(ray, hit).shading_normal;
        *colour = normal.to_array().map(|x| 0.5 * x + 0.5).into();
        Ok(())
    }
}

impl RayGeneration for Normals<'_> {
    type Output = Pixel;

    fn generate(&self, cx: &mut Context<'_, Self>, pixel: &mut Pixel) -> Result<(), Exception> {
        self.exposure.expose(cx.launch_index(), pixel, |ray, _| {
            let mut colour = Rgb::BLACK;
            cx.trace::<View>(ray, &mut colour)?;
            Ok(colour)
        })
    }
}
