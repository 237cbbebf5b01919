//! The same as ray programs.

use ombra_accel::AnyHit;
use ombra_geometry::{Hit, Ray};
use ombra_pipeline::{
    Context, Control, Cpu, Exception, LaunchException, Pipeline, RayGeneration, RayProgram, RayType,
};
use ombra_scene::{Rgb, World};

use super::{MAX_DEPTH, Picture, shading};
use crate::scenes::Stage;

/// The picture, and how many rays it took.
pub(super) fn picture(stage: &Stage) -> (Picture, u64) {
    let width = stage.pixels;
    let mut picture = vec![[0; 3]; width as usize * width as usize];
    let launch = Cpu::all_threads().launch(
        &Whitted { stage },
        [width, width, 1],
        &mut picture,
        &Control::default(),
    );
    // The buffer has the size of the launch and exceptions are settled: there is no error.
    let rays = launch.map_or(0, |report| report.rays);
    (picture, rays)
}

struct Whitted<'a> {
    stage: &'a Stage,
}

enum Radiance {}
impl RayType for Radiance {
    type Payload = Rgb;
    const NAME: &'static str = "radiance";
}

enum Shadow {}
impl RayType for Shadow {
    type Payload = bool;
    const NAME: &'static str = "shadow";
}

impl Pipeline for Whitted<'_> {
    type World = World;
    fn world(&self) -> &World {
        &self.stage.world
    }
    fn max_trace_depth(&self) -> u32 {
        // One more for the shadow rays of the last hit.
        MAX_DEPTH + 1
    }
}

impl RayGeneration for Whitted<'_> {
    type Output = [u32; 3];
    fn generate(
        &self,
        cx: &mut Context<'_, Self>,
        output: &mut Self::Output,
    ) -> Result<(), Exception> {
        let [x, y, _] = cx.launch_index();
        let mut colour = Rgb::BLACK;
        cx.trace::<Radiance>(&shading::camera_ray(self.stage, x, y), &mut colour)?;
        *output = shading::bits(colour);
        Ok(())
    }

    fn exception(&self, _: LaunchException, output: &mut [u32; 3]) -> Result<(), LaunchException> {
        *output = [u32::MAX; 3];
        Ok(())
    }
}

impl RayProgram<Radiance> for Whitted<'_> {
    #[inline]
    fn closest_hit(
        &self,
        cx: &mut Context<'_, Self>,
        ray: &Ray,
        hit: &Hit,
        colour: &mut Rgb,
    ) -> Result<(), Exception> {
        let world = &self.stage.world;
        let material = world.material(hit);
        let place = world.interaction(ray, hit);
        *colour = shading::ambient(self.stage, material, &place);
        for light in &world.scene().lights {
            if let Some(sample) = light.sample_li(place.point, || [0.5; 2])
                && let Some((direct, shadow)) = shading::direct(material, &place, &sample)
            {
                let mut blocked = false;
                cx.trace::<Shadow>(&shadow, &mut blocked)?;
                if !blocked {
                    *colour += direct;
                }
            }
        }
        if cx.depth() < MAX_DEPTH && !material.reflection.is_black() {
            let mut reflected = Rgb::BLACK;
            cx.trace::<Radiance>(&shading::mirrored(&place), &mut reflected)?;
            *colour += material.reflection * reflected;
        }
        Ok(())
    }

    fn miss(
        &self,
        _cx: &mut Context<'_, Self>,
        ray: &Ray,
        colour: &mut Rgb,
    ) -> Result<(), Exception> {
        *colour = self.stage.world.scene().background.at(ray.direction);
        Ok(())
    }
}

impl RayProgram<Shadow> for Whitted<'_> {
    fn any_hit(&self, _ray: &Ray, _hit: &Hit, blocked: &mut bool) -> AnyHit {
        *blocked = true;
        AnyHit::Terminate
    }
}
