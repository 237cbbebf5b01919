//! The two loops side by side: rays and rasterization over one scene.

mod rays;
mod visibility;

use ombra_pipeline::Cpu;
use ombra_scene::{Camera, World};

pub use visibility::VisibilityAgreement;

use crate::exposure::Exposure;
use crate::raster::Raster;
use crate::{RenderError, Settings};

/// Compares what is seen in each pixel, at the first sample that `settings` take there.
///
/// # Errors
/// When the settings make no picture, or the camera's cannot be rasterized.
pub fn visibility(
    world: &World,
    camera: &Camera,
    settings: &Settings,
    cpu: &Cpu,
) -> Result<VisibilityAgreement, RenderError> {
    settings.validate()?;
    let exposure = Exposure::new(camera, settings, 0..1).through_pinhole();
    let extent = settings.extent();
    cpu.install(|| {
        let raster = Raster::new(world, camera, settings)?;
        let (drawn, _) = raster.seen(&exposure, 0);
        let (traced, _) = rays::seen(world, camera, &extent, &exposure, 0);
        Ok(VisibilityAgreement::of(&traced, &drawn, &extent))
    })
}
