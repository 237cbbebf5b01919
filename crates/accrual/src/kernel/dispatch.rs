//! One entry a level.

use ombra_accel::Level;

use super::lanes::{Lanes, Pair, Portable};
use super::walk::{Waiting, walk};
use crate::cover::Cover;
use crate::occluder::Occluders;
use crate::tile::{PLACES, Tile};
use crate::way::Way;

/// What a search needs besides, kept between searches.
#[derive(Debug)]
pub(crate) struct Room {
    cover: Box<Cover>,
    waiting: Vec<Waiting>,
}

impl Room {
    pub(crate) fn new() -> Self {
        Self {
            cover: Cover::new(),
            waiting: Vec::new(),
        }
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::super::lanes::{Avx2, Avx512};
    use super::*;

    /// # Safety
    /// - The processor has AVX2.
    #[target_feature(enable = "avx2")]
    pub(super) unsafe fn avx2(job: Job<'_>, room: &mut Room, seconds: &mut [f64; PLACES]) {
        // SAFETY: the caller's promise.
        unsafe { add::<Avx2, Pair<Avx2>>(job, room, seconds) }
    }

    /// # Safety
    /// - The processor has AVX2 and AVX-512 F.
    #[target_feature(enable = "avx2,avx512f")]
    pub(super) unsafe fn avx512(job: Job<'_>, room: &mut Room, seconds: &mut [f64; PLACES]) {
        // SAFETY: the caller's promise.
        unsafe { add::<Avx2, Avx512>(job, room, seconds) }
    }
}

/// Before what, on which way, seen from where.
#[derive(Clone, Copy)]
pub(crate) struct Job<'a> {
    pub(crate) occluders: &'a Occluders,
    pub(crate) way: &'a Way,
    pub(crate) tile: &'a Tile,
}

/// Adds to the seconds of each place how long the way is covered.
pub(crate) fn add_seconds(
    level: Level,
    job: Job<'_>,
    room: &mut Room,
    seconds: &mut [f64; PLACES],
) {
    match level {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: a level is one that this machine has.
        Level::Avx2 => unsafe { x86::avx2(job, room, seconds) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Level::Avx512 => unsafe { x86::avx512(job, room, seconds) },
        // SAFETY: every processor has these.
        _ => unsafe { add::<Portable, Pair<Portable>>(job, room, seconds) },
    }
}

/// # Safety
/// - The processor has the instructions of both.
#[inline(always)]
unsafe fn add<N: Lanes, P: Lanes>(job: Job<'_>, room: &mut Room, seconds: &mut [f64; PLACES]) {
    let Room { cover, waiting } = room;
    // SAFETY: the caller's promise.
    unsafe { walk::<N, P>(job.occluders, job.way, job.tile, cover, waiting) };
    cover.add_seconds(&job.way.seconds, seconds);
}
