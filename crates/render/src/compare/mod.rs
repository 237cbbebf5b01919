//! The two loops side by side: rays and rasterization over one scene.
//!
//! [`compare`] renders a scene three ways (rasterized, with rays and local shading alone, and by
//! Whitted's method) and says how far the first agrees with each of the others, in what is seen and
//! in colour, and what either loop costs in tests.

mod colour;
mod finer;
mod operations;
mod rays;
mod visibility;

use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use ombra_accel::StructureKind;
use ombra_pipeline::Cpu;
use ombra_scene::{Camera, World};

pub use colour::{ColourAgreement, eight_bits};
pub use operations::{Growth, Operations};
pub(crate) use rays::LocalLight;
pub use visibility::VisibilityAgreement;

use crate::exposure::Exposure;
use crate::raster::{Raster, Seen};
use crate::render::{render, render_local};
use crate::{IntegratorKind, RenderError, Rendering, Settings, Watch};

/// One scene, both loops.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// What is seen, at the first sample of each pixel.
    pub visibility: VisibilityAgreement,
    /// The picture of the rasterizer.
    pub raster: Timed,
    /// Local shading of what rays meet.
    pub local: Timed,
    /// The picture of Whitted's method: with shadows, mirrors and glass.
    pub whitted: Timed,
    /// The rasterizer's colours against those of rays with local shading.
    pub shading: ColourAgreement,
    /// The rasterizer's colours against those of Whitted's method: what rays add.
    pub rays_add: ColourAgreement,
    /// What it takes at a quarter, half and all of the resolution.
    pub resolutions: Vec<Operations>,
    /// What it takes with more and more triangles.
    pub primitives: Vec<Growth>,
}

/// A picture and how long it took, all told but for loading the scene and building its structure.
#[derive(Clone, Debug)]
pub struct Timed {
    /// The picture.
    pub rendering: Rendering,
    /// How long it took.
    pub time: Duration,
}

/// Compares both loops over a scene; `settings.integrator` is not heeded. `kind` is the structure of
/// the world. `None` if it was stopped before the end.
///
/// # Errors
/// As for [`render`].
pub fn compare(
    world: &World,
    camera: &Camera,
    settings: &Settings,
    kind: StructureKind,
    cpu: &Cpu,
    watch: &Watch<'_>,
) -> Result<Option<Comparison>, RenderError> {
    let stop = watch.stop;
    let watch = || Watch {
        stop: watch.stop,
        progress: watch.progress,
        pass: None,
    };
    let with = |integrator| Settings {
        integrator,
        ..settings.clone()
    };
    let timed = |picture: &dyn Fn() -> Result<Rendering, RenderError>| {
        let begun = Instant::now();
        let rendering = picture()?;
        let time = begun.elapsed();
        Ok::<_, RenderError>((!rendering.stopped).then_some(Timed { rendering, time }))
    };
    let raster = with(IntegratorKind::Raster);
    let whitted = with(IntegratorKind::Whitted);
    let Some(raster) = timed(&|| render(world, camera, &raster, cpu, watch()))? else {
        return Ok(None);
    };
    let Some(local) = timed(&|| render_local(world, camera, settings, cpu, watch()))? else {
        return Ok(None);
    };
    let Some(whitted) = timed(&|| render(world, camera, &whitted, cpu, watch()))? else {
        return Ok(None);
    };
    let visibility = visibility(world, camera, settings, cpu)?;
    let resolutions = operations::with_resolution(world, camera, settings, cpu)?;
    let is_stopped = || stop.is_some_and(|stop| stop.load(Ordering::Relaxed));
    if is_stopped() {
        return Ok(None);
    }
    let primitives = operations::with_primitives(world, camera, settings, kind, cpu)?;
    if is_stopped() {
        return Ok(None);
    }
    let shading = ColourAgreement::of(&raster.rendering.film, &local.rendering.film);
    let rays_add = ColourAgreement::of(&raster.rendering.film, &whitted.rendering.film);
    Ok(Some(Comparison {
        visibility,
        raster,
        local,
        whitted,
        shading,
        rays_add,
        resolutions,
        primitives,
    }))
}

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
        let is_beside = |pixel: [u32; 2], drawn: &Option<Seen>| {
            rays::see_beside(world, &exposure, pixel, 0, drawn)
        };
        Ok(VisibilityAgreement::of(
            &traced, &drawn, &extent, &is_beside,
        ))
    })
}
