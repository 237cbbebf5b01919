//! What the two loops cost, counted and not timed.

use ombra_accel::{Statistics, StructureKind};
use ombra_pipeline::Cpu;
use ombra_scene::{Camera, World};

use super::finer::{Cut, recut};
use super::rays;
use crate::exposure::Exposure;
use crate::raster::{Raster, Tally};
use crate::{Crop, RenderError, Settings};

/// A scene with more triangles than this is not cut finer, but thinned out.
const MOST_TRIANGLES: u64 = 1 << 19;

/// What it took to find what is seen at one sample of each pixel, by either loop.
///
/// Without any help both test every primitive with every pixel, in one order or the other. What
/// helps the rasterizer is that it looks, row by row, between the edges of each primitive alone; what
/// helps rays is the acceleration structure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Columns and rows.
    pub size: [u32; 2],
    /// How many pixels.
    pub pixels: u64,
    /// How many primitives rays can meet.
    pub primitives: u64,
    /// How many triangles and planes are drawn: more where curved shapes become triangles.
    pub drawn: u64,
    /// Of the rasterizer.
    pub raster: Tally,
    /// Of the rays.
    pub rays: Statistics,
}

impl Operations {
    /// How many coverage tests the rasterizer makes if it tests every pixel for every primitive.
    #[must_use]
    pub const fn all_coverage_tests(&self) -> u64 {
        self.drawn.saturating_mul(self.pixels)
    }

    /// How many intersection tests rays make without a structure.
    #[must_use]
    pub const fn all_intersection_tests(&self) -> u64 {
        self.primitives.saturating_mul(self.pixels)
    }

    /// Counts with one sample a pixel, in its middle.
    pub(super) fn of(
        world: &World,
        camera: &Camera,
        settings: &Settings,
        cpu: &Cpu,
    ) -> Result<Self, RenderError> {
        let settings = centred(settings);
        let exposure = Exposure::new(camera, &settings, 0..1).through_pinhole();
        let extent = settings.extent();
        cpu.install(|| {
            let raster = Raster::new(world, camera, &settings)?;
            let (_, tally) = raster.seen(&exposure, 0);
            let (_, statistics) = rays::seen(world, camera, &extent, &exposure, 0);
            Ok(Self {
                size: [extent.width(), extent.height()],
                pixels: extent.pixels(),
                primitives: world.primitives() as u64,
                drawn: raster.primitives(),
                raster: tally,
                rays: statistics,
            })
        })
    }
}

fn centred(settings: &Settings) -> Settings {
    Settings {
        spp: 1,
        ..settings.clone()
    }
}

/// A quarter, half and all of the width and height.
pub(super) fn with_resolution(
    world: &World,
    camera: &Camera,
    settings: &Settings,
    cpu: &Cpu,
) -> Result<Vec<Operations>, RenderError> {
    let part = |n: u32, of: u32| (n / of).max(1);
    let counted = [4, 2, 1].map(|of| {
        let crop = settings.crop.map(|crop| Crop {
            x0: crop.x0 / of,
            y0: crop.y0 / of,
            x1: (crop.x1 / of).max(crop.x0 / of + 1),
            y1: (crop.y1 / of).max(crop.y0 / of + 1),
        });
        let settings = Settings {
            width: part(settings.width, of),
            height: part(settings.height, of),
            crop,
            ..settings.clone()
        };
        Operations::of(world, camera, &settings, cpu)
    });
    counted.into_iter().collect()
}

/// What was done to a scene of triangles to have more or fewer of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Growth {
    /// In words.
    pub scene: String,
    /// What it costs then.
    pub operations: Operations,
}

/// The same surfaces in once, four and sixteen times as many triangles or, where that is too much,
/// every sixteenth and every fourth triangle and all.
pub(super) fn with_primitives(
    world: &World,
    camera: &Camera,
    settings: &Settings,
    kind: StructureKind,
    cpu: &Cpu,
) -> Result<Vec<Growth>, RenderError> {
    let settings = centred(settings);
    let count = cpu.install(|| Raster::new(world, camera, &settings))?;
    let finer = count.primitives().saturating_mul(16) <= MOST_TRIANGLES;
    let cuts = if finer {
        [
            ("triangles as they are", Cut::Finer(0)),
            ("each triangle cut in 4", Cut::Finer(1)),
            ("each triangle cut in 16", Cut::Finer(2)),
        ]
    } else {
        [
            ("every 16th triangle", Cut::Every(16)),
            ("every 4th triangle", Cut::Every(4)),
            ("all triangles", Cut::Every(1)),
        ]
    };
    let mut growth = Vec::with_capacity(cuts.len());
    for (words, cut) in cuts {
        let world = cpu.install(|| {
            let scene = recut(world, camera, &settings, cut)?;
            let built = World::build(scene, kind);
            Ok::<_, RenderError>(
                built.expect("its objects name what it has, as those of the scene did"),
            )
        })?;
        growth.push(Growth {
            scene: words.to_owned(),
            operations: Operations::of(&world, camera, &settings, cpu)?,
        });
    }
    Ok(growth)
}
