//! One entry a level.

use ombra_accel::Level;

use super::lanes::{Pair, Portable};
use super::walk::{Waiting, walk};
use crate::cover::Cover;
use crate::occluder::Occluders;
use crate::tile::Tile;
use crate::way::Way;

/// What a search needs besides, kept between searches.
#[derive(Debug)]
pub(crate) struct Room {
    pub(crate) cover: Box<Cover>,
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
    pub(super) unsafe fn avx2(occluders: &Occluders, way: &Way, tile: &Tile, room: &mut Room) {
        let Room { cover, waiting } = room;
        // SAFETY: the caller's promise.
        unsafe { walk::<Avx2, Pair<Avx2>>(occluders, way, tile, cover, waiting) }
    }

    /// # Safety
    /// - The processor has AVX2 and AVX-512 F.
    #[target_feature(enable = "avx2,avx512f")]
    pub(super) unsafe fn avx512(occluders: &Occluders, way: &Way, tile: &Tile, room: &mut Room) {
        let Room { cover, waiting } = room;
        // SAFETY: the caller's promise.
        unsafe { walk::<Avx2, Avx512>(occluders, way, tile, cover, waiting) }
    }
}

/// Covers, in `room`, what of the way is covered for the tile.
pub(crate) fn cover(level: Level, occluders: &Occluders, way: &Way, tile: &Tile, room: &mut Room) {
    match level {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: a level is one that this machine has.
        Level::Avx2 => unsafe { x86::avx2(occluders, way, tile, room) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Level::Avx512 => unsafe { x86::avx512(occluders, way, tile, room) },
        _ => {
            let Room { cover, waiting } = room;
            // SAFETY: every processor has these.
            unsafe { walk::<Portable, Pair<Portable>>(occluders, way, tile, cover, waiting) }
        }
    }
}
