//! Consecutive launch indices at once, for rays that are traced together.

use ombra_accel::Traversable as _;
use ombra_geometry::{Hit, Ray};

use crate::{Context, Control, Pipeline};

/// Some consecutive launch indices as [`RayGeneration::generate_many`] sees them.
///
/// Rays of many indices that are traced in one call are answered sooner than one after another,
/// with the same answers.
///
/// [`RayGeneration::generate_many`]: crate::RayGeneration::generate_many
#[derive(Debug)]
pub struct Batch<'a, P: Pipeline> {
    pipeline: &'a P,
    control: &'a Control<'a>,
    first: usize,
    len: usize,
    size: [u32; 3],
    rays: u64,
}

impl<'a, P: Pipeline> Batch<'a, P> {
    pub(crate) const fn new(
        pipeline: &'a P,
        control: &'a Control<'a>,
        first: usize,
        len: usize,
        size: [u32; 3],
    ) -> Self {
        Self {
            pipeline,
            control,
            first,
            len,
            size,
            rays: 0,
        }
    }

    /// How many launch indices; at least one.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "it never is")]
    pub const fn len(&self) -> usize {
        self.len
    }

    /// The launch as one of the indices sees it, in which programs can be called and rays traced.
    #[must_use]
    #[inline]
    pub fn context(&self, k: usize) -> Context<'a, P> {
        let index = launch_index(self.first + k, self.size);
        Context::new(self.pipeline, self.control, index, self.size)
    }

    /// Whether the launch is to stop, and so what is begun is to be given up.
    #[must_use]
    #[inline]
    pub fn is_stopped(&self) -> bool {
        self.control.is_stopped()
    }

    /// The closest hit of each ray. Any-hit programs are not asked: this is for ray types without.
    ///
    /// # Panics
    /// When there are not as many places for hits as rays.
    pub fn intersect_many(&mut self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        self.rays += rays.len() as u64;
        self.pipeline.world().intersect_many(rays, hits);
    }

    /// Whether each ray has a hit.
    ///
    /// # Panics
    /// When there are not as many places for answers as rays.
    pub fn occluded_many(&mut self, rays: &[Ray], occluded: &mut [bool]) {
        self.rays += rays.len() as u64;
        self.pipeline.world().occluded_many(rays, occluded);
    }

    /// Counts the rays that a context of this batch has traced.
    #[inline]
    pub const fn count(&mut self, cx: &Context<'_, P>) {
        self.rays += cx.rays();
    }

    /// How many rays were traced.
    #[must_use]
    pub const fn rays(&self) -> u64 {
        self.rays
    }
}

/// The launch index of an element of the output buffer. No dimension may be 0.
pub(crate) fn launch_index(element: usize, [width, height, _]: [u32; 3]) -> [u32; 3] {
    let (width, height) = (width as usize, height as usize);
    let (row, layer) = (element / width, element / width / height);
    [element % width, row % height, layer].map(|i| i as u32)
}
