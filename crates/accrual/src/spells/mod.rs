//! From when to when places lie in shadow, and of what.
//!
//! Each moment of shadow counts for the building that the ray toward the sun meets first, and it is known whether another
//! one stands behind it: whether the shadow would stay if the first one were taken away. What follows from
//! these stretches, such as minutes, the first sun or the longest, needs no more tracing.

mod stretch;
mod sweep;

use arrayvec::ArrayVec;
use ombra_accel::Level;
use ombra_geometry::Point3;
use ombra_sun::Sheet;
use rayon::prelude::*;

use crate::kernel::{FindRoom, Job, find_stretches};
use crate::occluder::Occluders;
use crate::tile::{PLACES, Tile, is_somewhere};
use crate::tiles::Tiles;
use crate::way::Way;
use crate::ways::Ways;

pub use stretch::{Stretch, Stretches};
use sweep::{Arc, Sweep};

/// Finds the stretches of shadow of places, exactly in time.
#[derive(Debug)]
pub struct Spells<'a> {
    occluders: &'a Occluders,
    /// One each.
    ways: Vec<Ways>,
    level: Level,
}

impl<'a> Spells<'a> {
    /// For stretches of time in order that do not overlap.
    #[must_use]
    pub fn new(occluders: &'a Occluders, sheets: &[Sheet]) -> Self {
        let sheets = sheets.par_iter().filter(|sheet| !sheet.arcs().is_empty());
        Self {
            occluders,
            ways: sheets.map(|sheet| Ways::of_one(Way::new(sheet))).collect(),
            level: Level::detect(),
        }
    }

    /// The same at another level of instructions, with the same answers to the bit.
    #[must_use]
    pub fn at_level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// The stretches of each place. As with [`Exact::seconds`](crate::Exact::seconds), neighbours should come one after
    /// another.
    #[must_use]
    pub fn stretches(&self, places: &[Point3]) -> Stretches {
        self.each(&places.chunks(PLACES).collect::<Vec<_>>())
    }

    /// The same for some of the tiles: place after place, see [`Tiles::range`].
    #[must_use]
    pub fn stretches_of(&self, tiles: &Tiles, which: std::ops::Range<usize>) -> Stretches {
        self.each(&tiles.lists(which))
    }

    fn each(&self, lists: &[&[Point3]]) -> Stretches {
        let tiles: Vec<Stretches> = lists
            .par_iter()
            .map_init(
                || (FindRoom::new(), Sweep::default()),
                |(room, sweep), places| self.tile(places, room, sweep),
            )
            .collect();
        Stretches::concat(&tiles)
    }

    fn tile(&self, places: &[Point3], room: &mut FindRoom, sweep: &mut Sweep) -> Stretches {
        let tile = Tile::new(places);
        let mut found: ArrayVec<Vec<Stretch>, PLACES> = places.iter().map(|_| Vec::new()).collect();
        for ways in &self.ways {
            let job = Job {
                occluders: self.occluders,
                more: None,
                ways,
                tiles: std::slice::from_ref(&tile),
            };
            let records = find_stretches(self.level, job, room);
            records.sort_unstable_by_key(|record| record.arc);
            for records in records.chunk_by(|a, b| a.arc == b.arc) {
                let arc = Arc::new(&self.occluders.list, &ways.list()[0], records);
                for (place, found) in found.iter_mut().enumerate() {
                    if is_somewhere(&places[place]) {
                        sweep.add(&arc, place, places[place], found);
                    }
                }
            }
        }
        let mut all = Stretches::default();
        for found in found {
            all.push(found);
        }
        all
    }
}
