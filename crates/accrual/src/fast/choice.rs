//! Which days are taken.

use rayon::prelude::*;

use crate::exact::Exact;
use crate::occluder::Occluders;
use crate::tiles::Tiles;

use super::day::{Day, Taken, evenly, turning};

/// What of the tolerance may be used up at the places that are compared: others are not looked at, and a few
/// of them are farther off.
const MARGIN: f64 = 1.0 / 3.0;

/// At how many of the places the first days may leave it open: where they do so at many, they are too few for the others.
const OPEN: f64 = 0.2;

/// How many tolerances may be in question from day to day where not every day is measured: jumps fall this
/// way and that, so what is in question is more than what is wrong.
const QUESTION: f64 = 0.7;

/// How many tiles are compared, of how many: more would take longer than what they spare.
const TILES: std::ops::RangeInclusive<usize> = 16..=128;
const OF: usize = 32;

/// How far days are moved, as a share of a step between them.
const SHIFTS: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// Whether so many seconds in question can be left so.
pub(super) fn is_known(question: f64, tolerance: f64) -> bool {
    question <= QUESTION * tolerance
}

/// A comparison with every day.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// At how many places.
    pub places: usize,
    /// The largest difference, as a share of the time that the sun is up, 0 to 1.
    pub most: f64,
    /// The mean of all.
    pub mean: f64,
}

/// How many times as many days are taken where the first ones do not tell.
const MORE: usize = 3;

/// Days that stand for others, and how well.
#[derive(Clone, Debug, Default)]
pub(super) struct Choice {
    /// What is tried one after another, until it tells: some days, then more. Empty if every day is needed.
    pub(super) steps: Vec<Vec<Taken>>,
    pub(super) error: Difference,
    /// How many days are measured for a place in the mean.
    cost: f64,
    /// At which share of the places the first days leave it open.
    open: f64,
}

impl Choice {
    /// Those that take the least time among those that are close enough.
    pub(super) fn new(
        occluders: &Occluders,
        days: &[Day<'_>],
        tiles: &Tiles,
        tolerance: f64,
        is_wanted: impl Fn() -> bool + Sync,
    ) -> Option<Self> {
        if days.len() < 4 || tolerance.is_nan() || tolerance <= 0.0 || tiles.is_empty() {
            return Some(Self::default());
        }
        let count = (tiles.len() / OF).clamp(*TILES.start(), *TILES.end());
        let compared = Compared::new(occluders, days, tiles.spread(count), is_wanted)?;
        let mut best = Self {
            cost: days.len() as f64,
            ..Self::default()
        };
        let turning = turning(days);
        for count in counts(days.len()) {
            for shift in SHIFTS {
                let which = evenly(&turning, count, shift);
                // More days never take less time than these.
                if which.len() as f64 >= best.cost {
                    continue;
                }
                let more = evenly(&turning, MORE * count, shift);
                let mut steps = vec![Taken::some(days, &which)];
                if 2 * more.len() <= days.len() {
                    steps.push(Taken::some(days, &more));
                }
                let choice = compared.with(steps, tolerance);
                let is_close = choice.error.most <= MARGIN * tolerance && choice.open <= OPEN;
                if is_close && choice.cost < best.cost {
                    best = choice;
                }
            }
        }
        Some(best)
    }
}

/// How many steps are tried, from few: each by an eighth more than the one before, up to half of all days.
fn counts(all: usize) -> impl Iterator<Item = usize> {
    std::iter::successors(Some(5), |count| Some(count + (count / 8).max(1)))
        .take_while(move |count| 2 * count <= all)
}

/// What every day gives, at some places.
struct Compared {
    tiles: Tiles,
    /// By day the seconds of each place.
    by_day: Vec<Vec<f64>>,
    /// All days together.
    all: Vec<f64>,
    /// How long the sun is up.
    up: f64,
}

impl Compared {
    fn new(
        occluders: &Occluders,
        days: &[Day<'_>],
        tiles: Tiles,
        is_wanted: impl Fn() -> bool + Sync,
    ) -> Option<Self> {
        let seconds = |day: &Day<'_>| {
            let exact = is_wanted().then(|| Exact::new(occluders, day.sheets))?;
            Some(exact.seconds_of(&tiles, 0..tiles.len()))
        };
        let by_day: Option<Vec<Vec<f64>>> = days.par_iter().map(seconds).collect();
        let by_day = by_day?;
        let mut all = vec![0.0; tiles.places().len()];
        for day in &by_day {
            for (all, seconds) in all.iter_mut().zip(day) {
                *all += seconds;
            }
        }
        Some(Self {
            tiles,
            by_day,
            all,
            up: days.iter().map(|day| day.seconds).sum(),
        })
    }

    /// How it is with these days.
    fn with(&self, steps: Vec<Vec<Taken>>, tolerance: f64) -> Choice {
        let (mut most, mut sum, mut measured, mut open) = (0.0_f64, 0.0, 0, 0);
        for tile in 0..self.tiles.len() {
            let places = self.tiles.range(tile..tile + 1);
            let tells = |taken: &Vec<Taken>| {
                measured += taken.len() * places.len();
                places
                    .clone()
                    .all(|place| is_known(self.question(taken, place), tolerance * self.up))
            };
            let found = steps.iter().position(tells);
            if found != Some(0) {
                open += places.len();
            }
            let Some(taken) = found.map(|step| &steps[step]) else {
                measured += self.by_day.len() * places.len();
                continue;
            };
            for place in places {
                let seconds = taken
                    .iter()
                    .map(|own| own.times * self.by_day[own.day][place]);
                let off = (seconds.sum::<f64>() - self.all[place]).abs() / self.up;
                most = most.max(off);
                sum += off;
            }
        }
        let places = self.all.len();
        Choice {
            cost: measured as f64 / places as f64,
            open: open as f64 / places as f64,
            steps,
            error: Difference {
                places,
                most,
                mean: sum / places as f64,
            },
        }
    }

    /// How many seconds are in question at a place.
    fn question(&self, taken: &[Taken], place: usize) -> f64 {
        let at = |own: &Taken| self.by_day[own.day][place];
        let squares = taken
            .windows(2)
            .map(|pair| pair[1].unknown(at(&pair[0]), at(&pair[1])).powi(2));
        squares.sum::<f64>().sqrt()
    }
}
