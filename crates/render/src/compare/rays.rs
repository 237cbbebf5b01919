//! The lecture's first loop: for each pixel, for each primitive that the structure leaves.

use ombra_accel::{Statistics, Traversable as _};
use ombra_geometry::{Hit, Ray};
use ombra_pipeline::{Batch, Context, Exception, Pipeline, RayGeneration, RayProgram, RayType};
use ombra_scene::camera::Camera;
use ombra_scene::{Rgb, World};
use rayon::prelude::*;

use crate::Crop;
use crate::exposure::Exposure;
use crate::film::Pixel;
use crate::raster::shade::local;
use crate::raster::{Seen, TOLERANCE};
use crate::sampler::Sample;

/// What the ray of one sample of each pixel meets first, row by row from the top, and what it took to
/// find it.
pub(super) fn seen(
    world: &World,
    camera: &Camera,
    extent: &Crop,
    exposure: &Exposure<'_>,
    sample: u32,
) -> (Vec<Option<Seen>>, Statistics) {
    let width = extent.width() as usize;
    let mut seen = vec![None; extent.pixels() as usize];
    let rows = seen.par_chunks_mut(width).zip(extent.y0..extent.y1);
    let statistics = rows.map(|(row, y)| {
        let mut row_statistics = Statistics::default();
        for (pixel, x) in row.iter_mut().zip(extent.x0..) {
            let ray = exposure.ray([x, y], &exposure.sample([x, y], sample));
            let (hit, statistics) = world.intersect_counted(&ray);
            row_statistics += statistics;
            *pixel = hit.map(|hit| Seen {
                instance: hit.instance,
                geometry: hit.geometry,
                primitive: hit.primitive,
                depth: f64::from(hit.t) * ray.direction.wide().dot(camera.pose.direction().wide()),
            });
        }
        row_statistics
    });
    let statistics = statistics.sum();
    (seen, statistics)
}

/// How far beside a sample rays look for what was drawn there, in pixels: up to what triangles may be
/// off from a curved shape, and so near that they meet the thinnest of slivers.
const BESIDE: [f32; 3] = [TOLERANCE as f32, 1.0 / 256.0, 1.0 / 4096.0];

/// Whether a ray beside that of a sample sees what was drawn there.
pub(super) fn see_beside(
    world: &World,
    exposure: &Exposure<'_>,
    pixel: [u32; 2],
    sample: u32,
    drawn: &Option<Seen>,
) -> bool {
    let sample = exposure.sample(pixel, sample);
    let wanted = drawn.map(|drawn| (drawn.instance, drawn.primitive));
    BESIDE.iter().any(|&distance| {
        (0..8).any(|eighth: u8| {
            let (sin, cos) = (f32::from(eighth) * std::f32::consts::FRAC_PI_4).sin_cos();
            let ray = exposure.ray_beside(pixel, &sample, [distance * cos, distance * sin]);
            let hit = world.intersect(&ray);
            hit.map(|hit| (hit.instance, hit.primitive)) == wanted
        })
    })
}

/// Local shading of what rays meet, as the rasterizer shades what it draws: no shadow rays, no
/// bounces.
pub(crate) struct LocalLight<'a> {
    world: &'a World,
    exposure: Exposure<'a>,
}

impl<'a> LocalLight<'a> {
    pub(crate) const fn new(world: &'a World, exposure: Exposure<'a>) -> Self {
        Self { world, exposure }
    }
}

/// The rays that see.
pub(crate) enum Primary {}

impl RayType for Primary {
    type Payload = (Sample, Rgb);
    const NAME: &'static str = "primary";
}

impl Pipeline for LocalLight<'_> {
    type World = World;

    fn world(&self) -> &World {
        self.world
    }
}

impl RayProgram<Primary> for LocalLight<'_> {
    fn closest_hit(
        &self,
        _cx: &mut Context<'_, Self>,
        ray: &Ray,
        hit: &Hit,
        (sample, light): &mut (Sample, Rgb),
    ) -> Result<(), Exception> {
        let place = self.world.interaction(ray, hit);
        *light = local(self.world.scene(), &place, self.world.material(hit), sample);
        Ok(())
    }

    fn miss(
        &self,
        _cx: &mut Context<'_, Self>,
        ray: &Ray,
        (_, light): &mut (Sample, Rgb),
    ) -> Result<(), Exception> {
        *light = self.world.scene().background.at(ray.direction);
        Ok(())
    }
}

impl RayGeneration for LocalLight<'_> {
    type Output = Pixel;

    fn generate(&self, cx: &mut Context<'_, Self>, pixel: &mut Pixel) -> Result<(), Exception> {
        self.exposure
            .expose(cx.launch_index(), pixel, |ray, sample| {
                let mut payload = (*sample, Rgb::BLACK);
                cx.trace::<Primary>(ray, &mut payload)?;
                Ok(payload.1)
            })
    }

    fn generate_many(&self, batch: &mut Batch<'_, Self>, pixels: &mut [Pixel]) -> bool {
        (self.exposure).expose_many(batch, pixels, |cx, ray, hit, sample| {
            let mut payload = (*sample, Rgb::BLACK);
            cx.shade::<Primary>(ray, hit, &mut payload)?;
            Ok(payload.1)
        })
    }
}
