//! What a program sees of the launch around it.

use ombra_accel::{Candidate, Statistics, Traversable};
use ombra_geometry::{EdgeRule, Hit, Ray};

use crate::{Control, Exception, Pipeline, RayProgram, RayType};

/// How much of a thread's stack nested traces may take, in bytes: half of what a thread of Rust has
/// unless it is told otherwise, so that whatever one trace needs still fits beyond.
const STACK_LIMIT: usize = 1 << 20;

/// After how many rays of one launch index the stop from outside is asked for again: rarely enough
/// to cost nothing, and still within a few milliseconds.
const RAYS_BETWEEN_STOPS: u64 = 1024;

/// The launch as one launch index sees it: its place in it, and the way to trace rays.
#[derive(Debug)]
pub struct Context<'a, P: Pipeline> {
    pipeline: &'a P,
    control: &'a Control<'a>,
    index: [u32; 3],
    size: [u32; 3],
    depth: u32,
    rays: u64,
}

impl<'a, P: Pipeline> Context<'a, P> {
    pub(crate) const fn new(
        pipeline: &'a P,
        control: &'a Control<'a>,
        index: [u32; 3],
        size: [u32; 3],
    ) -> Self {
        Self {
            pipeline,
            control,
            index,
            size,
            depth: 0,
            rays: 0,
        }
    }

    /// Which element of the launch this is.
    #[must_use]
    #[inline]
    pub const fn launch_index(&self) -> [u32; 3] {
        self.index
    }

    /// How large the launch is; dimensions that are not used are 1.
    #[must_use]
    #[inline]
    pub const fn launch_size(&self) -> [u32; 3] {
        self.size
    }

    /// How deep traces are nested here: 0 in ray generation, 1 in a hit of a camera ray.
    #[must_use]
    #[inline]
    pub const fn depth(&self) -> u32 {
        self.depth
    }

    /// How many rays this launch index has traced so far.
    #[must_use]
    #[inline]
    pub const fn rays(&self) -> u64 {
        self.rays
    }

    /// Traces a ray: its any-hit program is asked of hits, then its closest-hit or its miss program
    /// is called.
    ///
    /// # Errors
    /// When the ray is not valid, when traces are nested too deep for the pipeline or for the stack,
    /// when the launch is stopped from outside, and what the programs raise.
    #[inline]
    pub fn trace<R: RayType>(
        &mut self,
        ray: &Ray,
        payload: &mut R::Payload,
    ) -> Result<(), Exception>
    where
        P: RayProgram<R>,
    {
        self.trace_counted::<R>(ray, payload, None)
    }

    /// The same, adding the steps of the traversal to `statistics` if there are any.
    ///
    /// # Errors
    /// As [`trace`](Self::trace).
    #[inline]
    pub fn trace_counted<R: RayType>(
        &mut self,
        ray: &Ray,
        payload: &mut R::Payload,
        statistics: Option<&mut Statistics>,
    ) -> Result<(), Exception>
    where
        P: RayProgram<R>,
    {
        let pipeline = self.pipeline;
        let limit = pipeline.max_trace_depth();
        if self.depth >= limit {
            return Err(depth_exceeded(limit));
        }
        if self.stack_used() > STACK_LIMIT {
            return Err(stack_overflow(self.depth));
        }
        // Refused traces are not counted, so once this is so it stays so until the program gives in.
        if self.rays % RAYS_BETWEEN_STOPS == RAYS_BETWEEN_STOPS - 1 && self.control.is_stopped() {
            return Err(Exception::Stopped);
        }
        self.rays += 1;
        let mut any_hit = |candidate: &Candidate| pipeline.any_hit(ray, &candidate.hit(), payload);
        let hit = pipeline
            .world()
            .search(&(*ray).into(), EdgeRule::Closed, statistics, &mut any_hit)
            .map(|candidate| candidate.hit());
        self.shade::<R>(ray, hit.as_ref(), payload)
    }

    /// What follows when it is known what a ray meets: its closest-hit or its miss program is called,
    /// one level deeper.
    ///
    /// # Errors
    /// When the ray is not valid, and what the programs raise.
    #[inline]
    pub fn shade<R: RayType>(
        &mut self,
        ray: &Ray,
        hit: Option<&Hit>,
        payload: &mut R::Payload,
    ) -> Result<(), Exception>
    where
        P: RayProgram<R>,
    {
        let pipeline = self.pipeline;
        self.depth += 1;
        let result = match hit {
            Some(hit) => pipeline.closest_hit(self, ray, hit, payload),
            None if ray.is_valid() => pipeline.miss(self, ray, payload),
            // A ray that is not valid hits nothing, so it is enough to look at those that miss.
            None => Err(invalid::<R>(ray)),
        };
        self.depth -= 1;
        result
    }

    /// How far the stack has grown since ray generation began. This context lies where it began.
    #[inline]
    fn stack_used(&self) -> usize {
        let here = 0_u8;
        let address = std::ptr::from_ref(&here).addr();
        std::ptr::from_ref(self).addr().abs_diff(address)
    }

    /// An element of a buffer, or the exception that there is none.
    ///
    /// # Errors
    /// When the index is out of range.
    #[inline]
    pub fn element<'b, T>(&self, buffer: &'b [T], index: usize) -> Result<&'b T, Exception> {
        buffer.get(index).ok_or(Exception::IndexOutOfRange {
            index,
            length: buffer.len(),
        })
    }
}

// Out of the way of what happens for every ray.

#[cold]
fn depth_exceeded(limit: u32) -> Exception {
    Exception::DepthExceeded { limit }
}

#[cold]
fn stack_overflow(depth: u32) -> Exception {
    Exception::StackOverflow { depth }
}

#[cold]
fn invalid<R: RayType>(ray: &Ray) -> Exception {
    Exception::InvalidRay {
        ray_type: R::NAME,
        ray: *ray,
    }
}
