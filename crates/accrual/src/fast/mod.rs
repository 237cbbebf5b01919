//! Shadow time of a long period from some of its days, that stand for those around them.
//!
//! From one day to the next the sun's way hardly changes, so neither does the shadow. How many days it
//! takes depends on the city, the period and the hours, and no formula tells: so at some places, spread
//! over all, every day is measured, and those days are taken that come close enough to that at each of
//! these. Where a place's shadow changes much from one of these days to the next, more days are measured, and every day
//! if need be: what happens in between is not known.

mod choice;
mod day;
mod step;

use std::sync::atomic::{AtomicUsize, Ordering};

use arrayvec::ArrayVec;
use ombra_geometry::Point3;
use ombra_sun::Sheet;

use crate::exact::{Exact, Sums, TILES, by_tiles};
use crate::kernel::Room;
use crate::occluder::Occluders;
use crate::tile::{PLACES, Tile};
use crate::tiles::Tiles;

use choice::Choice;
pub use choice::Difference;
use day::Day;
use step::Step;

/// Measures the shadow of a long period by some of its days.
#[derive(Debug)]
pub struct Fast<'a> {
    every: Exact<'a>,
    /// Some days, then more.
    steps: Vec<Step<'a>>,
    error: Difference,
    /// How far a place may be off, in seconds.
    tolerance: f64,
    /// How many places were measured on more days than the first step has.
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
        let steps = choice.steps.into_iter();
        Some(Self {
            every: Exact::new(occluders, &all),
            steps: steps
                .map(|taken| Step::new(occluders, &days, taken))
                .collect(),
            error: choice.error,
            tolerance: tolerance * days.iter().map(|day| day.seconds).sum::<f64>(),
            refined: AtomicUsize::new(0),
        })
    }

    /// How many days stand for all; 0 if every day is measured everywhere.
    #[must_use]
    pub fn days(&self) -> usize {
        self.steps.first().map_or(0, Step::len)
    }

    /// How far it is off where it was compared with every day.
    #[must_use]
    pub fn error(&self) -> Difference {
        self.error
    }

    /// At how many places so far more days were measured, or every day.
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
        by_tiles(lists, |_, tiles, room| {
            let Some(first) = self.steps.first() else {
                self.count(tiles);
                return self.every.sums(tiles, room);
            };
            let mut sums: Sums = tiles.iter().map(|_| [0.0; PLACES]).collect();
            let mut unknown: ArrayVec<usize, TILES> = ArrayVec::new();
            first.each(tiles, self.tolerance, room, |tile, own| match own {
                Some(own) => sums[tile] = own,
                None => unknown.push(tile),
            });
            for tile in unknown {
                let own = std::slice::from_ref(&tiles[tile]);
                self.count(own);
                sums[tile] = self.by_more(own, room);
            }
            sums
        })
    }

    /// The seconds of one tile of which the first step does not tell.
    fn by_more(&self, tile: &[Tile], room: &mut Room) -> [f64; PLACES] {
        for step in &self.steps[1..] {
            let mut found = None;
            step.each(tile, self.tolerance, room, |_, own| found = own);
            if let Some(seconds) = found {
                return seconds;
            }
        }
        self.every.sums(tile, room)[0]
    }

    fn count(&self, tiles: &[Tile]) {
        let places = tiles.iter().map(|tile| tile.count).sum();
        self.refined.fetch_add(places, Ordering::Relaxed);
    }
}
