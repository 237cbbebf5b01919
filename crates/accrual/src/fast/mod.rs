//! Shadow time of a long period from some of its days, that stand for those around them.
//!
//! From one day to the next the sun's way hardly changes, so neither does the shadow. How many days it
//! takes depends on the city, the period and the hours, and no formula tells: so at some places, spread
//! over all, every day is measured, and those days are taken that come close enough to that at each of
//! these. Where a place's shadow changes much from one of these days to the next, every day is measured there,
//! too: what happens in between is not known.

mod choice;
mod day;

use std::sync::atomic::{AtomicUsize, Ordering};

use ombra_geometry::Point3;
use ombra_sun::Sheet;

use crate::exact::{Exact, Sums, by_tiles};
use crate::occluder::Occluders;
use crate::tile::{PLACES, Tile};
use crate::tiles::Tiles;

use choice::Choice;
pub use choice::Difference;
use day::Day;

/// Measures the shadow of a long period by some of its days.
#[derive(Debug)]
pub struct Fast<'a> {
    every: Exact<'a>,
    /// The days that are taken.
    some: Exact<'a>,
    /// To which of these days each of their sheets belongs.
    day_of: Vec<usize>,
    choice: Choice,
    /// How far a place may be off, in seconds.
    tolerance: f64,
    /// How many places were measured on every day.
    refined: AtomicUsize,
}

impl<'a> Fast<'a> {
    /// With as many days as keep shadow time within `tolerance`, a share of the time that the sun is up (0.005 for
    /// half a percent): `days` has the sheets of each day of the period, and `tiles` the places that will be asked for. If that takes
    /// nearly all days, or there is no tolerance, it is all of them.
    ///
    /// `None` if `is_wanted` said no meanwhile.
    #[must_use]
    pub fn new(
        occluders: &'a Occluders,
        days: &[Vec<Sheet>],
        tiles: &Tiles,
        tolerance: f64,
        is_wanted: impl Fn() -> bool + Sync,
    ) -> Option<Self> {
        let days: Vec<Day<'_>> = days.iter().filter_map(|sheets| Day::new(sheets)).collect();
        let choice = Choice::new(occluders, &days, tiles, tolerance, is_wanted)?;
        let all: Vec<Sheet> = days.iter().flat_map(|day| day.sheets).cloned().collect();
        let taken = choice
            .taken
            .iter()
            .map(|own| days[own.day].sheets)
            .enumerate();
        let some = taken.flat_map(|(k, sheets)| {
            let lasting = sheets.iter().filter(|sheet| !sheet.arcs().is_empty());
            lasting.map(move |sheet| (sheet.clone(), k))
        });
        let (some, day_of): (Vec<Sheet>, Vec<usize>) = some.unzip();
        Some(Self {
            every: Exact::new(occluders, &all),
            some: Exact::new(occluders, &some),
            day_of,
            tolerance: tolerance * days.iter().map(|day| day.seconds).sum::<f64>(),
            choice,
            refined: AtomicUsize::new(0),
        })
    }

    /// How many days stand for all; 0 if every day is measured everywhere.
    #[must_use]
    pub fn days(&self) -> usize {
        self.choice.taken.len()
    }

    /// How far it is off where it was compared with every day.
    #[must_use]
    pub fn error(&self) -> Difference {
        self.choice.error
    }

    /// At how many places so far every day was measured.
    #[must_use]
    pub fn refined(&self) -> usize {
        self.refined.load(Ordering::Relaxed)
    }

    /// How many seconds each place lies in shadow. As with [`Exact::seconds`], neighbours should come one after
    /// another.
    #[must_use]
    pub fn seconds(&self, places: &[Point3]) -> Vec<f64> {
        self.each(&places.chunks(PLACES).collect::<Vec<_>>())
    }

    /// The same for some of the tiles, see [`Tiles::range`].
    #[must_use]
    pub fn seconds_of(&self, tiles: &Tiles, which: std::ops::Range<usize>) -> Vec<f64> {
        self.each(&tiles.lists(which))
    }

    fn each(&self, lists: &[&[Point3]]) -> Vec<f64> {
        by_tiles(lists, |tiles, room| {
            let mut sums = Sums::new();
            if self.choice.taken.is_empty() {
                sums = self.every.sums(tiles, room);
                self.count(tiles);
                return sums;
            }
            let taken = self.choice.taken.len();
            let mut by_day = vec![[0.0; PLACES]; taken * tiles.len()];
            self.some.by_way(tiles, room, |tile, sheet, seconds| {
                let sums = &mut by_day[tile * taken + self.day_of[sheet]];
                for (sum, seconds) in sums.iter_mut().zip(seconds) {
                    *sum += seconds;
                }
            });
            for (tile, by_day) in tiles.chunks(1).zip(by_day.chunks_exact(taken)) {
                match self.by_some(by_day) {
                    Some(own) => sums.push(own),
                    None => {
                        sums.extend(self.every.sums(tile, room));
                        self.count(tile);
                    }
                }
            }
            sums
        })
    }

    fn count(&self, tiles: &[Tile]) {
        let places = tiles.iter().map(|tile| tile.count).sum();
        self.refined.fetch_add(places, Ordering::Relaxed);
    }

    /// What the days that are taken tell, if they do.
    fn by_some(&self, by_day: &[[f64; PLACES]]) -> Option<[f64; PLACES]> {
        let mut seconds = [0.0; PLACES];
        let mut squares = [0.0; PLACES];
        let mut last = by_day[0];
        for (own, taken) in by_day.iter().zip(&self.choice.taken) {
            for place in 0..PLACES {
                seconds[place] += taken.times * own[place];
                squares[place] += taken.unknown(last[place], own[place]).powi(2);
            }
            last = *own;
        }
        let is_known = |square: &f64| choice::is_known(square.sqrt(), self.tolerance);
        squares.iter().all(is_known).then_some(seconds)
    }
}
