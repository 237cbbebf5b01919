//! What of the sun's way lies in shadow for all places of a tile: kept from one run for a run after a change.

use std::sync::atomic::{AtomicU64, Ordering};

/// The most numbers that are kept: half a gigabyte.
const MOST: usize = 1 << 26;

/// For each tile and each sheet the arcs that are covered wholly, for all places of the tile.
///
/// It takes eight bytes for each sixteen places and sheet. Many threads may fill it in.
#[derive(Debug)]
pub struct Dark {
    arcs: Vec<AtomicU64>,
    sheets: usize,
}

impl Dark {
    /// Room for so many tiles and sheets; none if that takes more than half a gigabyte.
    #[must_use]
    pub fn new(tiles: usize, sheets: usize) -> Option<Self> {
        let count = tiles.checked_mul(sheets).filter(|&count| count <= MOST)?;
        let arcs = (0..count).map(|_| AtomicU64::new(0)).collect();
        Some(Self { arcs, sheets })
    }

    pub(crate) fn set(&self, tile: usize, sheet: usize, arcs: u64) {
        self.arcs[tile * self.sheets + sheet].store(arcs, Ordering::Relaxed);
    }

    pub(crate) fn get(&self, tile: usize, sheet: usize) -> u64 {
        self.arcs[tile * self.sheets + sheet].load(Ordering::Relaxed)
    }
}
