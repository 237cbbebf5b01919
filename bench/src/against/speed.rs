//! Rays a second, and by whom they are measured.

use serde::Serialize;

use super::engine::Way;
use super::rays::Workload;
use super::trace::Contestant;
use crate::contest::Spread;

/// A contestant's speed on the rays of one kind.
#[derive(Clone, Debug, Serialize)]
pub struct SpeedRecord {
    /// Which bench.
    pub bench: &'static str,
    /// Which scene.
    pub scene: String,
    /// Of how many triangles.
    pub triangles: usize,
    /// Which rays.
    pub workload: &'static str,
    /// Whose.
    pub contestant: String,
    /// Whether it is one of those that the others are measured by.
    pub base: bool,
    /// On how many threads.
    pub threads: usize,
    /// How many rays.
    pub rays: usize,
    /// How many rounds were on the clock.
    pub rounds: usize,
    /// Seconds a round; nothing if none was on the clock.
    pub seconds: Option<Spread>,
    /// Millions of rays a second in the median round.
    pub mrays: Option<f64>,
    /// How many times the rays a second of the base's best way to ask for one ray at a time.
    pub over_single: Option<f64>,
    /// How many times the rays a second of the base's best way of any kind.
    pub over_best: Option<f64>,
}

/// The records of all contestants. The base is all that belongs to the first one's tracer, or, where
/// that is ombra, to its first structure.
pub(super) fn records(
    scene: &str,
    triangles: usize,
    work: &Workload,
    contestants: &[Contestant<'_>],
    threads: usize,
    times: &[Vec<f64>],
) -> Vec<SpeedRecord> {
    let spreads: Vec<_> = times.iter().map(|own| Spread::of(own)).collect();
    let is_base = |who: &Contestant<'_>| {
        let first = contestants[0].engine;
        match first.peer() {
            None => who.engine.name() == first.name(),
            peer => who.engine.peer() == peer,
        }
    };
    let best = |only_single: bool| {
        let all = contestants.iter().zip(&spreads);
        let counts =
            all.filter(|(who, _)| is_base(who) && (!only_single || who.way == Way::Single));
        let medians = counts.filter_map(|(_, spread)| spread.map(|spread| spread.median));
        medians.reduce(f64::min)
    };
    let (single, any) = (best(true), best(false));
    let record = |(who, seconds): (&Contestant<'_>, &Option<Spread>)| {
        let over = |base: Option<f64>| {
            let own = (*seconds)?.median;
            base.map(|base| base / own)
        };
        SpeedRecord {
            bench: "against",
            scene: scene.to_owned(),
            triangles,
            workload: work.name,
            contestant: who.name(),
            base: is_base(who),
            threads,
            rays: work.rays.len(),
            rounds: times.iter().map(Vec::len).max().unwrap_or(0),
            seconds: *seconds,
            mrays: seconds.map(|seconds| work.rays.len() as f64 / seconds.median / 1e6),
            over_single: over(single),
            over_best: over(any),
        }
    };
    contestants.iter().zip(&spreads).map(record).collect()
}
