//! How a launch is watched and stopped from outside.

use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};

/// A part of a launch that has been done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Done {
    /// How many launch indices.
    pub indices: u64,
    /// How many rays they traced.
    pub rays: u64,
}

/// How a launch is watched and stopped. The default does neither.
#[derive(Clone, Copy, Default)]
pub struct Control<'a> {
    /// When this becomes true, and stays so, the launch stops soon: a launch index that was begun is
    /// finished or, if that takes it many rays, given up by [`Exception::Stopped`]; the elements of
    /// the others are left as they were.
    ///
    /// [`Exception::Stopped`]: crate::Exception::Stopped
    pub stop: Option<&'a AtomicBool>,
    /// Called whenever a part is done, from the thread that did it, so perhaps from several at a
    /// time. The parts add up to what the launch did.
    pub progress: Option<&'a (dyn Fn(Done) + Sync)>,
}

impl Control<'_> {
    #[inline]
    pub(crate) fn is_stopped(&self) -> bool {
        self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
    }
}

impl fmt::Debug for Control<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Control")
            .field("stop", &self.stop)
            .field("progress", &self.progress.is_some())
            .finish()
    }
}
