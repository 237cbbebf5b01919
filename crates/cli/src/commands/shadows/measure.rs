//! The measuring itself, a part at a time, so that it shows how far it is and can be interrupted.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use ombra::accrual::{Difference, Exact, Fast, Occluders, Sampled, Tiles};
use ombra::city::Facet;
use ombra::pipeline::Cpu;
use serde::Serialize;

use super::args::{Method, ShadowsArgs};
use super::partial::Partial;
use super::when::When;
use crate::progress::Jobs;

/// What came out.
pub(super) struct Measured {
    /// Minutes by place; NaN for those that were not reached.
    pub(super) minutes: Vec<f32>,
    /// How many places were reached, and how many of them by an earlier run.
    pub(super) done: usize,
    pub(super) resumed: usize,
    /// How long it took to make everything ready, and then.
    pub(super) build_seconds: f64,
    pub(super) seconds: f64,
    /// Where some days stand for all.
    pub(super) some_days: Option<SomeDays>,
}

/// At how many places some days were compared with every day, and how far they are off, in percent of the time
/// that the sun is up.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Compared {
    pub(super) places: usize,
    pub(super) most: f64,
    pub(super) mean: f64,
}

impl From<Difference> for Compared {
    fn from(found: Difference) -> Self {
        Self {
            places: found.places,
            most: 100.0 * found.most,
            mean: 100.0 * found.mean,
        }
    }
}

/// How it was done by some of the days.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct SomeDays {
    /// How many of them; 0 if every day was measured.
    pub(super) days: usize,
    /// What came of comparing them with every day.
    pub(super) compared: Compared,
    /// At how many places more days were measured, or every day, in this run.
    pub(super) refined: usize,
}

/// Tiles are measured in blocks of so many.
const BLOCK: usize = 64;

/// How many tiles are measured at once: as many as take about as long as a part should, in whole blocks. So the same tiles are
/// always looked at together, however long a part took.
pub(super) struct Pace {
    tiles: usize,
    begun: Instant,
}

impl Pace {
    pub(super) fn new() -> Self {
        Self {
            tiles: BLOCK,
            begun: Instant::now(),
        }
    }

    /// A part begins; where it ends, if it begins at a tile and there are so many.
    pub(super) fn begin(&mut self, tile: usize, tiles: usize) -> usize {
        self.begun = Instant::now();
        tiles.min(tile + self.tiles)
    }

    /// The part is over.
    pub(super) fn end(&mut self) {
        let faster = PART / self.begun.elapsed().as_secs_f64().max(1e-6);
        let tiles = self.tiles as f64 * faster.clamp(0.5, 4.0);
        self.tiles = (tiles as usize / BLOCK).max(1) * BLOCK;
    }
}

impl Measured {
    /// Nothing is measured yet, and it took so long to make everything ready.
    pub(super) const fn begun(build_seconds: f64) -> Self {
        Self {
            minutes: Vec::new(),
            done: 0,
            resumed: 0,
            build_seconds,
            seconds: 0.0,
            some_days: None,
        }
    }

    /// It took so long, and there were so many places in all.
    pub(super) fn end(&mut self, total: usize, seconds: f64) {
        self.done = self.minutes.len();
        self.minutes.resize(total, f32::NAN);
        self.seconds = seconds;
    }
}

/// How long a part should take, in seconds: between parts progress is shown.
const PART: f64 = 0.1;

pub(super) fn measure(
    args: &ShadowsArgs,
    facets: &[Facet],
    when: &When,
    tiles: &Tiles,
    cpu: &Cpu,
    stop: &AtomicBool,
    kept: &mut Option<(Partial, Vec<f32>)>,
) -> Measured {
    let begun = Instant::now();
    match args.method {
        Method::Exact => {
            let occluders = cpu.install(|| Occluders::new(facets));
            let exact = cpu.install(|| Exact::new(&occluders, &when.sheets().concat()));
            let part = |which| cpu.install(|| exact.seconds_of(tiles, which));
            in_parts(
                args,
                when,
                tiles,
                begun.elapsed().as_secs_f64(),
                stop,
                kept,
                part,
            )
        }
        Method::Fast => {
            let occluders = cpu.install(|| Occluders::new(facets));
            let is_wanted = || !stop.load(Ordering::Relaxed);
            let tolerance = args.tolerance() / 100.0;
            let days = cpu.install(|| when.sheets());
            let fast = cpu.install(|| Fast::new(&occluders, &days, tiles, tolerance, is_wanted));
            let built = begun.elapsed().as_secs_f64();
            let Some(fast) = fast else {
                return in_parts(args, when, tiles, built, stop, kept, |_| Vec::new());
            };
            let part = |which| cpu.install(|| fast.seconds_of(tiles, which));
            let measured = in_parts(args, when, tiles, built, stop, kept, part);
            Measured {
                some_days: Some(SomeDays {
                    days: fast.days(),
                    compared: fast.error().into(),
                    refined: fast.refined(),
                }),
                ..measured
            }
        }
        Method::Sampled => {
            let sampled = cpu.install(|| Sampled::new(facets));
            let samples = cpu.install(|| when.samples(args.step()));
            let part = |which| {
                let places = &tiles.places()[tiles.range(which)];
                cpu.install(|| {
                    let mut sums = vec![0.0; places.len()];
                    for samples in &samples {
                        let seconds = sampled.seconds(samples, places);
                        sums.iter_mut()
                            .zip(seconds)
                            .for_each(|(sum, own)| *sum += own);
                    }
                    sums
                })
            };
            in_parts(
                args,
                when,
                tiles,
                begun.elapsed().as_secs_f64(),
                stop,
                kept,
                part,
            )
        }
    }
}

pub(super) fn in_parts(
    args: &ShadowsArgs,
    when: &When,
    tiles: &Tiles,
    build_seconds: f64,
    stop: &AtomicBool,
    kept: &mut Option<(Partial, Vec<f32>)>,
    part: impl Fn(std::ops::Range<usize>) -> Vec<f64>,
) -> Measured {
    let bar = Jobs::unless(args.quiet);
    let total = tiles.places().len();
    // Each of the points that stand for the sun counts by its share.
    let each_minute = 60.0 * when.suns.len() as f64;
    let mut measured = Measured::begun(build_seconds);
    if let Some((_, before)) = kept {
        measured.minutes.append(before);
    }
    measured.resumed = measured.minutes.len();
    let begun = Instant::now();
    let mut tile = tiles.before(measured.resumed);
    let mut pace = Pace::new();
    while tile < tiles.len() && !stop.load(Ordering::Relaxed) {
        let end = pace.begin(tile, tiles.len());
        let minutes = &mut measured.minutes;
        let seconds = part(tile..end).into_iter();
        minutes.extend(seconds.map(|seconds| (seconds / each_minute) as f32));
        tile = end;
        pace.end();
        if let Some((partial, _)) = kept {
            partial.keep_sometimes(minutes);
        }
        bar.update(minutes.len() as u64, total as u64, "places");
    }
    bar.finish();
    measured.end(total, begun.elapsed().as_secs_f64());
    measured
}
