//! The programs that a user writes, as traits.

use ombra_accel::Traversable;
use ombra_geometry::{Hit, Ray};

use crate::{AnyHit, Batch, Context, Exception, LaunchException};

/// A kind of ray: radiance, shadow, whatever a program needs. An uninhabited type does for one.
pub trait RayType {
    /// What a ray of this type carries along, written by its programs, read by whoever traced it.
    type Payload;

    /// For messages.
    const NAME: &'static str;
}

/// What all programs of one pipeline share: their data, and what rays are traced against.
pub trait Pipeline: Sync + Sized {
    /// What rays are traced against.
    type World: Traversable;

    /// What rays are traced against.
    fn world(&self) -> &Self::World;

    /// How deep [`Context::trace`] may be nested: 1 allows rays from ray generation only. One more
    /// is [`Exception::DepthExceeded`].
    ///
    /// Nested traces lie on the stack of a thread, like any recursion in Rust; if that does not
    /// last, the exception is [`Exception::StackOverflow`]. It lasts for a megabyte: a thousand
    /// levels of programs that keep a kilobyte each.
    fn max_trace_depth(&self) -> u32 {
        32
    }
}

/// The programs of one ray type. Each has a default that does nothing.
///
/// # What is promised
/// For one [`Context::trace`]: the any-hit program is asked of hits first; then either the
/// closest-hit program is called, once, or the miss program is, once, and no other.
pub trait RayProgram<R: RayType>: Pipeline {
    /// Asked of each hit that may still count, in no promised order, each crossing at most once.
    ///
    /// Once a hit was accepted, farther ones are not shown any more; which of them were shown
    /// before depends on the structure. So a payload that every structure shall leave the same must
    /// be made of what does not depend on that: of every crossing, by ignoring all of them (in an
    /// order that is not promised), or of whether there is one, by terminating at the first.
    #[inline]
    fn any_hit(&self, ray: &Ray, hit: &Hit, payload: &mut R::Payload) -> AnyHit {
        let _ = (ray, hit, payload);
        AnyHit::Accept
    }

    /// Called with the nearest hit that was accepted or, if the any-hit program terminated the
    /// ray, with the one that it terminated at.
    ///
    /// # Errors
    /// Whatever the program finds exceptional. It comes out of the [`Context::trace`] that led
    /// here, where the caller passes it on or settles it.
    #[inline]
    fn closest_hit(
        &self,
        cx: &mut Context<'_, Self>,
        ray: &Ray,
        hit: &Hit,
        payload: &mut R::Payload,
    ) -> Result<(), Exception> {
        let _ = (cx, ray, hit, payload);
        Ok(())
    }

    /// Called when no hit was accepted.
    ///
    /// # Errors
    /// As those of [`closest_hit`](Self::closest_hit).
    #[inline]
    fn miss(
        &self,
        cx: &mut Context<'_, Self>,
        ray: &Ray,
        payload: &mut R::Payload,
    ) -> Result<(), Exception> {
        let _ = (cx, ray, payload);
        Ok(())
    }
}

/// Where a launch begins, once for every launch index.
///
/// A pipeline with several entry points names each with a type of its own, as ray types are named:
/// `impl RayGeneration<Preview> for City`, launched by `cpu.launch::<Preview, _>(..)`. One entry
/// point needs no name.
pub trait RayGeneration<Entry = ()>: Pipeline {
    /// One element of the output buffer.
    type Output: Send;

    /// Works on the one element of the output buffer that belongs to this launch index. What it
    /// held before is kept, so that a program can add to it.
    ///
    /// A launch that is stopped from outside leaves the element of an index that it gives up as the
    /// program left it. A program that writes only once it has traced all its rays leaves it as it
    /// was before.
    ///
    /// # Errors
    /// Whatever the program finds exceptional; see [`exception`](Self::exception), which is asked
    /// about all but [`Exception::Stopped`].
    fn generate(
        &self,
        cx: &mut Context<'_, Self>,
        output: &mut Self::Output,
    ) -> Result<(), Exception>;

    /// The same for consecutive launch indices at once, if there is a way that is quicker: such as
    /// tracing the first rays of all of them together. It leaves what
    /// [`generate`](Self::generate) leaves, to the bit, or says no and leaves `outputs` as they were;
    /// then each is generated alone. So where something is exceptional it says no, and the exception is
    /// met again where it belongs.
    fn generate_many(&self, batch: &mut Batch<'_, Self>, outputs: &mut [Self::Output]) -> bool {
        let _ = (batch, outputs);
        false
    }

    /// The exception program: may write something else into the element, and says whether the
    /// launch is still good. By default it is not: the launch ends with that error.
    ///
    /// # Errors
    /// The exception, to make the launch fail with it.
    fn exception(
        &self,
        exception: LaunchException,
        output: &mut Self::Output,
    ) -> Result<(), LaunchException> {
        let _ = output;
        Err(exception)
    }
}
