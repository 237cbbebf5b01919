//! From when to when places lie in shadow, and of what.
//!
//! Each moment of shadow counts for the building that the ray toward the sun meets first, and it is known whether another
//! one stands behind it: whether the shadow would stay if the first one were taken away. What follows from
//! these stretches, such as minutes, the first sun or the longest, needs no more tracing.

mod runs;
mod stretch;
mod summary;
mod sweep;

use arrayvec::ArrayVec;
use ombra_accel::Level;
use ombra_geometry::Point3;
use ombra_sun::Sheet;
use rayon::prelude::*;

use crate::exact::{TILES, checked, together};
use crate::kernel::{FindRoom, Job, find_stretches};
use crate::occluder::Occluders;
use crate::tile::{PLACES, Tile, is_somewhere};
use crate::tiles::Tiles;
use crate::way::Way;
use crate::ways::Ways;

use runs::Runs;
pub use stretch::{Stretch, Stretches};
pub use summary::{Counted, Share, Summary};
use sweep::Sweep;

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
    ///
    /// # Panics
    /// If this machine does not have the level, see [`Level::available`].
    #[must_use]
    pub fn at_level(self, level: Level) -> Self {
        let level = checked(level);
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
        let parts: Vec<Stretches> = lists
            .par_chunks(TILES)
            .map_init(Room::new, |room, lists| {
                let tiles: ArrayVec<Tile, TILES> =
                    lists.iter().map(|list| Tile::new(list)).collect();
                let mut all = Stretches::default();
                let count = together(&tiles);
                let parts = tiles.chunks(count).zip(lists.chunks(count));
                for (tiles, lists) in parts {
                    self.some(tiles, lists, room, &mut all);
                }
                all
            })
            .collect();
        Stretches::concat(&parts)
    }

    /// Of tiles that lie near one another, and the places that they were made of.
    fn some(&self, tiles: &[Tile], lists: &[&[Point3]], room: &mut Room, all: &mut Stretches) {
        let Room { find, sweep, runs } = room;
        for ways in &self.ways {
            let job = Job {
                occluders: self.occluders,
                more: None,
                ways,
                tiles,
            };
            let way = &ways.list()[0];
            find_stretches(self.level, job, find, &mut |shown| {
                let runs = &mut runs[shown.tile];
                runs.add(way, shown, sweep);
                if shown.arc + 1 == way.len() {
                    runs.end_all(way.starts[shown.arc] + way.seconds[shown.arc]);
                }
            });
        }
        for (runs, places) in runs.iter_mut().zip(lists) {
            runs.take(places.iter().map(is_somewhere), all);
        }
    }
}

/// What a search needs besides, kept between searches.
struct Room {
    find: FindRoom,
    sweep: Sweep,
    /// By tile.
    runs: ArrayVec<Runs, TILES>,
}

impl Room {
    fn new() -> Self {
        Self {
            find: FindRoom::new(),
            sweep: Sweep::default(),
            runs: (0..TILES).map(|_| Runs::new()).collect(),
        }
    }
}
