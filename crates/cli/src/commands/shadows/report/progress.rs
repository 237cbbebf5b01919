//! Long measuring in parts: how far it is, and whether it goes on.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use ombra::accrual::Tiles;

use crate::progress::Jobs;

/// How far it is, for whoever looks, and whether it goes on.
pub(super) struct Progress<'a> {
    pub(super) bar: Jobs,
    pub(super) done: u64,
    pub(super) total: u64,
    pub(super) stop: &'a AtomicBool,
}

impl Progress<'_> {
    /// After so many more places. `None` if it was interrupted.
    pub(super) fn step(&mut self, places: usize) -> Option<()> {
        self.done += places as u64;
        self.bar.update(self.done, self.total, "places");
        (!self.stop.load(Ordering::Relaxed)).then_some(())
    }
}

impl Drop for Progress<'_> {
    fn drop(&mut self) {
        self.bar.finish();
    }
}

/// So many tiles at once are measured between two looks at whether to go on.
pub(super) fn blocks(tiles: &Tiles) -> impl Iterator<Item = Range<usize>> {
    const BLOCK: usize = 256;
    let count = tiles.len();
    (0..count)
        .step_by(BLOCK)
        .map(move |first| first..count.min(first + BLOCK))
}
