//! What it costs to find what the camera sees.

use ombra_accel::Statistics;
use ombra_geometry::{Hit, Ray};
use ombra_pipeline::{Context, Exception, Pipeline, RayGeneration, RayProgram};
use ombra_scene::{Rgb, World};

use super::View;
use crate::explain::{Event, Observer, Part};
use crate::exposure::Exposure;
use crate::film::Pixel;

/// Counts the steps of camera rays: nodes visited and primitives tested, on both levels of the
/// structure.
pub(crate) struct Cost<'a, O = ()> {
    world: &'a World,
    exposure: Exposure<'a>,
    observer: O,
}

impl<'a> Cost<'a> {
    pub(crate) const fn new(world: &'a World, exposure: Exposure<'a>) -> Self {
        Self::observed(world, exposure, ())
    }
}

impl<'a, O> Cost<'a, O> {
    pub(crate) const fn observed(world: &'a World, exposure: Exposure<'a>, observer: O) -> Self {
        Self {
            world,
            exposure,
            observer,
        }
    }
}

impl<O: Observer> Pipeline for Cost<'_, O> {
    type World = World;

    fn world(&self) -> &World {
        self.world
    }
}

// What is hit only matters to one who listens.
impl<O: Observer> RayProgram<View> for Cost<'_, O> {
    fn closest_hit(
        &self,
        _cx: &mut Context<'_, Self>,
        ray: &Ray,
        hit: &Hit,
        _payload: &mut Rgb,
    ) -> Result<(), Exception> {
        self.observer
            .tell(|| Event::met(hit, &self.world.interaction(ray, hit)));
        Ok(())
    }
}

impl<O: Observer> RayGeneration for Cost<'_, O> {
    type Output = Pixel;

    fn generate(&self, cx: &mut Context<'_, Self>, pixel: &mut Pixel) -> Result<(), Exception> {
        self.exposure.expose(cx.launch_index(), pixel, |ray, _| {
            let mut steps = Statistics::default();
            self.observer.tell(|| Event::camera(ray));
            cx.trace_counted::<View>(ray, &mut Rgb::default(), Some(&mut steps))?;
            let (nodes, tests) = (steps.nodes_visited as f32, steps.tests_made as f32);
            let measured = Rgb::new(nodes, tests, nodes + tests);
            self.observer.tell(|| Event::Cost(steps));
            self.observer.tell(|| Event::Adds(Part::Measured(measured)));
            self.observer.tell(|| Event::Done(measured));
            Ok(measured)
        })
    }
}
