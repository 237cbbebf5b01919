//! What it costs to find what the camera sees.

use ombra_accel::Statistics;
use ombra_pipeline::{Context, Exception, Pipeline, RayGeneration, RayProgram};
use ombra_scene::{Rgb, World};

use super::View;
use crate::exposure::Exposure;
use crate::film::Pixel;

/// Counts the steps of camera rays: nodes visited and primitives tested, on both levels of the
/// structure.
pub(crate) struct Cost<'a> {
    world: &'a World,
    exposure: Exposure<'a>,
}

impl<'a> Cost<'a> {
    pub(crate) const fn new(world: &'a World, exposure: Exposure<'a>) -> Self {
        Self { world, exposure }
    }
}

impl Pipeline for Cost<'_> {
    type World = World;

    fn world(&self) -> &World {
        self.world
    }
}

// What is hit does not matter here.
impl RayProgram<View> for Cost<'_> {}

impl RayGeneration for Cost<'_> {
    type Output = Pixel;

    fn generate(&self, cx: &mut Context<'_, Self>, pixel: &mut Pixel) -> Result<(), Exception> {
        self.exposure.expose(cx.launch_index(), pixel, |ray, _| {
            let mut steps = Statistics::default();
            cx.trace_counted::<View>(ray, &mut Rgb::default(), Some(&mut steps))?;
            let (nodes, tests) = (steps.nodes_visited as f32, steps.tests_made as f32);
            Ok(Rgb::new(nodes, tests, nodes + tests))
        })
    }
}
