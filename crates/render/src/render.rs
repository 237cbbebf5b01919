//! The rendering itself: pass after pass over the film.

use std::sync::atomic::{AtomicU64, Ordering};

use ombra_pipeline::{
    Control, Cpu, Done, Exception, LaunchError, LaunchException, LaunchReport, RayGeneration,
};
use ombra_scene::{Camera, Rgb, World};

use crate::compare::LocalLight;
use crate::display::Response;
use crate::exposure::Exposure;
use crate::film::{Crop, Film, Pixel};
use crate::integrator::{AmbientOcclusion, Cost, Depth, Normals, Whitted};
use crate::raster::Raster;
use crate::settings::{MAX_DEPTH, MAX_PIXELS, MAX_SIDE, MAX_SPP};
use crate::{IntegratorKind, Progress, Settings, Watch};

/// Passes double the number of samples until they take so many: a preview is never far behind.
const LONGEST_PASS: u32 = 16;

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// A picture without pixels.
    #[error("a picture of {width} x {height} pixels has no pixels")]
    EmptyPicture {
        /// The width that was asked for.
        width: u32,
        /// The height that was asked for.
        height: u32,
    },
    /// A side is longer than [`MAX_SIDE`].
    #[error("a picture of {width} x {height} pixels is too large: a side has at most {MAX_SIDE}")]
    PictureTooLarge {
        /// The width that was asked for.
        width: u32,
        /// The height that was asked for.
        height: u32,
    },
    /// The crop has no pixels, or not all of its pixels are in the picture.
    #[error(
        "the crop {crop} (x0,y0,x1,y1) must hold pixels and lie within the picture of {width} x {height}"
    )]
    CropOutside {
        /// The crop that was asked for.
        crop: Crop,
        /// The width of the picture.
        width: u32,
        /// The height of the picture.
        height: u32,
    },
    /// More pixels at once than [`MAX_PIXELS`].
    #[error(
        "{pixels} pixels are too many at once, at most {MAX_PIXELS}: render parts of the picture"
    )]
    FilmTooLarge {
        /// How many were asked for.
        pixels: u64,
    },
    /// Memory does not suffice for the film.
    #[error("there is no memory for {pixels} pixels: render parts of the picture")]
    OutOfMemory {
        /// How many were asked for.
        pixels: u64,
    },
    /// No samples, or more than [`MAX_SPP`].
    #[error("{spp} samples a pixel: there must be 1 to {MAX_SPP}")]
    SamplesOutOfRange {
        /// How many were asked for.
        spp: u32,
    },
    /// More bounces than [`MAX_DEPTH`].
    #[error("a depth of {max_depth} bounces is too much: at most {MAX_DEPTH}")]
    DepthOutOfRange {
        /// How many were asked for.
        max_depth: u32,
    },
    /// A share of light below 0, infinite or NaN.
    #[error("the least importance of a ray is {least_importance}: 0 or more is needed")]
    ImportanceOutOfRange {
        /// What was asked for.
        least_importance: f32,
    },
    /// A film that makes no picture.
    #[error(
        "a film with sensitivity {}, fog {} and white {} makes no picture: they must be finite, fog 0 or \
         more, the others above 0",
        .response.sensitivity, .response.fog, .response.white
    )]
    NoResponse {
        /// What was asked for.
        response: Response,
    },
    /// Light bounced more often than the stack of a thread allows. It allows [`MAX_DEPTH`] bounces
    /// unless threads were given less than the two megabytes that they have by default.
    #[error(
        "the stack of a thread is used up after {bounces} bounces: render with a smaller depth"
    )]
    StackOverflow {
        /// How many bounces there was room for.
        bounces: u32,
    },
    /// A camera in whose picture straight lines are not straight, so that no triangle is one there.
    #[error("this camera cannot be rasterized: straight edges are not straight in its picture")]
    NotRasterizable,
    /// A ray program raised an exception: a camera whose numbers make no rays.
    #[error(transparent)]
    Launch(LaunchError),
}

impl From<LaunchError> for RenderError {
    fn from(error: LaunchError) -> Self {
        match error {
            LaunchError::Exception(LaunchException {
                exception: Exception::StackOverflow { depth },
                ..
            }) => Self::StackOverflow { bounces: depth },
            other => Self::Launch(other),
        }
    }
}

/// A picture, or as much of it as was done when it was stopped.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendering {
    /// The picture.
    pub film: Film,
    /// How many rays were traced.
    pub rays: u64,
    /// Whether it was stopped before the end.
    pub stopped: bool,
}

impl Rendering {
    /// See [`Film::display`].
    #[must_use]
    pub fn display(&self) -> Vec<Rgb> {
        self.film.display()
    }

    /// See [`Film::raw`].
    #[must_use]
    pub fn raw(&self) -> Vec<Rgb> {
        self.film.raw()
    }
}

/// Renders a picture.
///
/// The picture grows in passes over all of it, of 1, 1, 2, 4 … samples a pixel, so that there is
/// something to see from the start.
///
/// # Errors
/// When the settings make no picture, memory does not suffice, or the camera makes invalid rays.
pub fn render(
    world: &World,
    camera: &Camera,
    settings: &Settings,
    cpu: &Cpu,
    watch: Watch<'_>,
) -> Result<Rendering, RenderError> {
    settings.validate()?;
    let job = Job {
        camera,
        settings,
        cpu,
        quantity: settings
            .integrator
            .quantity(world, camera, settings.response),
    };
    match settings.integrator {
        IntegratorKind::Whitted => {
            job.run(watch, |exposure| Whitted::new(world, exposure, settings))
        }
        IntegratorKind::Raster => {
            let raster = cpu.install(|| Raster::new(world, camera, settings))?;
            job.rasterize(watch, &raster)
        }
        IntegratorKind::Normals => job.run(watch, |exposure| Normals::new(world, exposure)),
        IntegratorKind::Depth => job.run(watch, |exposure| Depth::new(world, exposure)),
        IntegratorKind::Cost => job.run(watch, |exposure| Cost::new(world, exposure)),
        IntegratorKind::AmbientOcclusion => {
            job.run(watch, |exposure| AmbientOcclusion::new(world, exposure))
        }
    }
}

/// Renders local shading of what rays meet: what [`IntegratorKind::Raster`] draws, the other way.
pub(crate) fn render_local(
    world: &World,
    camera: &Camera,
    settings: &Settings,
    cpu: &Cpu,
    watch: Watch<'_>,
) -> Result<Rendering, RenderError> {
    settings.validate()?;
    let kind = IntegratorKind::Raster;
    let job = Job {
        camera,
        settings,
        cpu,
        quantity: kind.quantity(world, camera, settings.response),
    };
    job.run(watch, |exposure| {
        LocalLight::new(world, exposure.through_pinhole())
    })
}

/// A rendering under way, whatever the integrator.
struct Job<'a> {
    camera: &'a Camera,
    settings: &'a Settings,
    cpu: &'a Cpu,
    quantity: crate::display::Quantity,
}

impl<'a> Job<'a> {
    /// `integrator` makes the ray programs of one pass.
    fn run<P: RayGeneration<Output = Pixel>>(
        &self,
        watch: Watch<'_>,
        integrator: impl Fn(Exposure<'a>) -> P,
    ) -> Result<Rendering, RenderError> {
        let extent = self.settings.extent();
        let size = [extent.width(), extent.height(), 1];
        self.passes(watch, |exposure, pixels, control| {
            let program = integrator(exposure);
            Ok(self.cpu.launch(&program, size, pixels, control)?)
        })
    }

    /// No rays, and so no launch.
    fn rasterize(&self, watch: Watch<'_>, raster: &Raster<'_>) -> Result<Rendering, RenderError> {
        self.passes(watch, |exposure, pixels, control| {
            let done = |indices| {
                if let Some(progress) = control.progress {
                    progress(Done { indices, rays: 0 });
                }
            };
            let exposure = exposure.through_pinhole();
            let pass = self
                .cpu
                .install(|| raster.expose(&exposure, pixels, control.stop, &done));
            Ok(LaunchReport {
                stopped: pass.stopped,
                ..LaunchReport::default()
            })
        })
    }

    /// Pass after pass; `expose` adds the samples of one to all pixels of the film.
    fn passes(
        &self,
        watch: Watch<'_>,
        expose: impl Fn(Exposure<'a>, &mut [Pixel], &Control<'_>) -> Result<LaunchReport, RenderError>,
    ) -> Result<Rendering, RenderError> {
        let Settings {
            width, height, spp, ..
        } = *self.settings;
        let Watch {
            stop,
            progress,
            mut pass,
        } = watch;
        let extent = self.settings.extent();
        let pixels = extent.pixels();
        let film = Film::new([width, height], extent, spp, self.quantity)
            .ok_or(RenderError::OutOfMemory { pixels })?;
        let mut rendering = Rendering {
            film,
            rays: 0,
            stopped: false,
        };
        let counts = Counts::new(pixels * u64::from(spp));
        let mut begin = 0;
        while begin < spp && !rendering.stopped {
            let end = spp.min(begin + begin.clamp(1, LONGEST_PASS));
            let report = |done: Done| {
                let now = counts.add(done, end - begin);
                if let Some(progress) = progress {
                    progress(now);
                }
            };
            let control = Control {
                stop,
                progress: Some(&report),
            };
            let exposure = Exposure::new(self.camera, self.settings, begin..end);
            let launch = expose(exposure, rendering.film.pixels_mut(), &control)?;
            rendering.rays += launch.rays;
            rendering.stopped = launch.stopped;
            if let Some(pass) = &mut pass {
                pass(&rendering.film);
            }
            begin = end;
        }
        Ok(rendering)
    }
}

/// What all threads have done together.
struct Counts {
    done: AtomicU64,
    rays: AtomicU64,
    total: u64,
}

impl Counts {
    const fn new(total: u64) -> Self {
        Self {
            done: AtomicU64::new(0),
            rays: AtomicU64::new(0),
            total,
        }
    }

    fn add(&self, done: Done, samples: u32) -> Progress {
        let add = |count: &AtomicU64, n: u64| count.fetch_add(n, Ordering::Relaxed) + n;
        Progress {
            done: add(&self.done, done.indices * u64::from(samples)),
            total: self.total,
            rays: add(&self.rays, done.rays),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stack_that_is_used_up_is_told_in_words_that_help() {
        let error = RenderError::from(LaunchError::Exception(LaunchException {
            index: [1, 2, 0],
            exception: Exception::StackOverflow { depth: 77 },
        }));
        assert_eq!(
            error.to_string(),
            "the stack of a thread is used up after 77 bounces: render with a smaller depth"
        );
    }
}
