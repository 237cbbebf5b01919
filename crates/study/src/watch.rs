//! How to follow a study, and how to stop it.

use std::sync::atomic::{AtomicBool, Ordering};

/// How far a study is.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// Jobs that are done.
    pub done: u64,
    /// Jobs there are.
    pub total: u64,
    /// What comes next, for people.
    pub doing: &'a str,
}

/// Who looks on.
#[derive(Clone, Copy, Default)]
pub struct Watch<'a> {
    /// Becomes true to stop the study; it keeps what has been measured.
    pub stop: Option<&'a AtomicBool>,
    /// Told before each job.
    pub progress: Option<&'a dyn Fn(Progress<'_>)>,
}

/// Counts jobs for whoever looks on.
pub(crate) struct Steps<'a> {
    watch: &'a Watch<'a>,
    done: u64,
    total: u64,
}

impl<'a> Steps<'a> {
    pub(crate) const fn new(watch: &'a Watch<'a>, total: u64) -> Self {
        let done = 0;
        Self { watch, done, total }
    }

    /// Says what is done next; false when it should not be.
    pub(crate) fn next(&mut self, doing: impl FnOnce() -> String) -> bool {
        if self.is_stopped() {
            return false;
        }
        if let Some(progress) = self.watch.progress {
            progress(Progress {
                done: self.done,
                total: self.total,
                doing: &doing(),
            });
        }
        self.done += 1;
        true
    }

    pub(crate) fn is_stopped(&self) -> bool {
        let stop = self.watch.stop;
        stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
    }
}
