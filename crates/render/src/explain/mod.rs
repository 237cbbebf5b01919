//! The tree of rays behind a pixel: which rays were sent, what each met, and what light it brought.
//!
//! The tree is written down by an observer while the very programs run that render, so it adds up to
//! the pixel of the picture to the last bit; see [`SampleTree::adds_up_to`].

mod observer;
mod recorder;
mod sum;
mod tree;

use ombra_pipeline::{Control, Cpu, RayGeneration};
use ombra_scene::{Camera, Rgb, World};

use crate::exposure::Exposure;
use crate::film::{Crop, Pixel};
use crate::integrator::{AmbientOcclusion, Cost, Depth, Normals, Whitted};
use crate::{IntegratorKind, RenderError, Settings};

pub(crate) use observer::{Event, Observer, trace};
pub use recorder::MAX_RAYS;
use recorder::Recorder;
pub use tree::{
    Absorbed, Crossing, End, LightPart, LightWay, Part, PixelTree, Place, RayKind, SampleTree,
    Split, TracedRay,
};

/// Why there is no tree.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExplainError {
    /// The pixel is not in the picture.
    #[error(
        "pixel {x},{y} is outside of the picture of {width} x {height}: columns go from 0 to {}, rows from 0 to {}",
        .width - 1, .height - 1
    )]
    PixelOutside {
        /// The column that was asked for.
        x: u32,
        /// The row that was asked for.
        y: u32,
        /// The width of the picture.
        width: u32,
        /// The height of the picture.
        height: u32,
    },
    /// The pixel has no such sample.
    #[error("there is no sample {sample}: a pixel has {spp}, counted from 0")]
    NoSuchSample {
        /// The one that was asked for.
        sample: u32,
        /// How many there are.
        spp: u32,
    },
    /// One sample has more rays than [`MAX_RAYS`].
    #[error(
        "sample {sample} has more than {MAX_RAYS} rays, too many to keep: take a smaller depth"
    )]
    TooManyRays {
        /// Which sample.
        sample: u32,
    },
    /// The picture is made without rays.
    #[error("{integrator} traces no rays, so there are none to explain: take another integrator")]
    NoRays {
        /// What makes the picture.
        integrator: IntegratorKind,
    },
    /// There would be no picture either.
    #[error(transparent)]
    Render(#[from] RenderError),
}

/// All rays of one pixel of the picture that [`render`](crate::render()) makes with the same
/// arguments. Memory is taken for all of them; [`Explainer`] gives one sample at a time.
///
/// # Errors
/// When there is no such picture or pixel, the picture is made without rays, or one sample has more
/// than [`MAX_RAYS`] of them.
pub fn explain(
    world: &World,
    camera: &Camera,
    settings: &Settings,
    pixel: [u32; 2],
    cpu: &Cpu,
) -> Result<PixelTree, ExplainError> {
    let mut explainer = Explainer::new(world, camera, settings, pixel)?;
    let samples = (0..settings.spp).map(|index| explainer.sample(index, cpu));
    let samples = samples.collect::<Result<_, _>>()?;
    Ok(PixelTree {
        pixel,
        colour: explainer.colour(),
        samples,
    })
}

/// Explains one pixel, a sample at a time, in the memory of one sample.
///
/// A ray takes about half a kilobyte, and a sample has at most [`MAX_RAYS`], in ordinary scenes a few
/// dozen.
#[derive(Clone, Debug)]
pub struct Explainer<'a> {
    world: &'a World,
    camera: &'a Camera,
    /// Of this pixel alone.
    settings: Settings,
    pixel: Pixel,
}

impl<'a> Explainer<'a> {
    /// For one pixel of a picture; the crop of the settings plays no part.
    ///
    /// # Errors
    /// When there is no such picture or pixel, or the picture is made without rays.
    pub fn new(
        world: &'a World,
        camera: &'a Camera,
        settings: &Settings,
        [x, y]: [u32; 2],
    ) -> Result<Self, ExplainError> {
        let Settings { width, height, .. } = *settings;
        let one = |x: u32, y: u32| Settings {
            crop: Some(Crop {
                x0: x,
                y0: y,
                x1: x + 1,
                y1: y + 1,
            }),
            ..settings.clone()
        };
        one(0, 0).validate()?;
        if settings.integrator == IntegratorKind::Raster {
            let integrator = settings.integrator;
            return Err(ExplainError::NoRays { integrator });
        }
        if x >= width || y >= height {
            return Err(ExplainError::PixelOutside {
                x,
                y,
                width,
                height,
            });
        }
        Ok(Self {
            world,
            camera,
            settings: one(x, y),
            pixel: Pixel::default(),
        })
    }

    /// The rays of one sample.
    ///
    /// # Errors
    /// When there is no such sample, or it has more than [`MAX_RAYS`] rays.
    pub fn sample(&mut self, index: u32, cpu: &Cpu) -> Result<SampleTree, ExplainError> {
        self.sample_within(index, cpu, MAX_RAYS)
    }

    fn sample_within(
        &mut self,
        index: u32,
        cpu: &Cpu,
        max_rays: usize,
    ) -> Result<SampleTree, ExplainError> {
        let spp = self.settings.spp;
        if index >= spp {
            return Err(ExplainError::NoSuchSample { sample: index, spp });
        }
        let recorder = Recorder::new(spp, max_rays);
        let exposure = Exposure::new(self.camera, &self.settings, index..index + 1);
        let (world, pixel, seen) = (self.world, &mut self.pixel, &recorder);
        match self.settings.integrator {
            IntegratorKind::Whitted => launch(
                &Whitted::observed(world, exposure, &self.settings, seen),
                pixel,
                cpu,
                seen,
            ),
            integrator @ IntegratorKind::Raster => {
                return Err(ExplainError::NoRays { integrator });
            }
            IntegratorKind::Normals => {
                launch(&Normals::observed(world, exposure, seen), pixel, cpu, seen)
            }
            IntegratorKind::Depth => {
                launch(&Depth::observed(world, exposure, seen), pixel, cpu, seen)
            }
            IntegratorKind::Cost => {
                launch(&Cost::observed(world, exposure, seen), pixel, cpu, seen)
            }
            IntegratorKind::AmbientOcclusion => launch(
                &AmbientOcclusion::observed(world, exposure, seen),
                pixel,
                cpu,
                seen,
            ),
        }?;
        if recorder.full().load(std::sync::atomic::Ordering::Relaxed) {
            return Err(ExplainError::TooManyRays { sample: index });
        }
        Ok(recorder.finish(index))
    }

    /// The mean of the samples that were explained so far; black if there are none.
    #[must_use]
    pub fn colour(&self) -> Rgb {
        self.pixel.average().unwrap_or(Rgb::BLACK)
    }
}

/// Runs the programs for the one pixel, until the recorder is full.
fn launch<P: RayGeneration<Output = Pixel>>(
    program: &P,
    pixel: &mut Pixel,
    cpu: &Cpu,
    recorder: &Recorder,
) -> Result<(), RenderError> {
    let control = Control {
        stop: Some(recorder.full()),
        progress: None,
    };
    cpu.launch(program, [1, 1, 1], std::slice::from_mut(pixel), &control)?;
    Ok(())
}
