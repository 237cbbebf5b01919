//! How a launch is watched and stopped from outside.

use std::fmt;
use std::sync::atomic::AtomicBool;

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
    /// When this becomes true the launch stops soon: elements that were begun are finished.
    pub stop: Option<&'a AtomicBool>,
    /// Called from any thread whenever a part is done.
    pub progress: Option<&'a (dyn Fn(Done) + Sync)>,
}

impl fmt::Debug for Control<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Control")
            .field("stop", &self.stop)
            .field("progress", &self.progress.is_some())
            .finish()
    }
}
