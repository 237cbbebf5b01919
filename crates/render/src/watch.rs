//! How a rendering is watched and stopped.

use std::fmt;
use std::sync::atomic::AtomicBool;

use crate::Film;

/// How far a rendering is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// Samples of pixels that are done.
    pub done: u64,
    /// Samples of pixels that there will be.
    pub total: u64,
    /// Rays that were traced.
    pub rays: u64,
}

/// How a rendering is watched and stopped. The default does neither.
#[derive(Default)]
pub struct Watch<'a> {
    /// When this becomes true the rendering ends soon, and keeps what is done.
    pub stop: Option<&'a AtomicBool>,
    /// Called from any thread whenever some pixels are done. Calls from several threads may come
    /// out of order.
    pub progress: Option<&'a (dyn Fn(Progress) + Sync)>,
    /// Called with the film after each pass over the picture.
    pub pass: Option<&'a mut dyn FnMut(&Film)>,
}

impl fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Watch")
            .field("stop", &self.stop)
            .field("progress", &self.progress.is_some())
            .field("pass", &self.pass.is_some())
            .finish()
    }
}
