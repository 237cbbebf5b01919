//! Contestants in turns, on the clock of the thread.

use std::time::Instant;

use ombra_geometry::Point3;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::against::float_mode::Flushed;
use crate::against::processor::thread_seconds;
use crate::contest::Spread;

/// The least seconds on the clock: who is quicker does it several times.
const LEAST: f64 = 0.04;

/// The most times that it does it.
const MOST: f64 = 200.0;

/// Gives the seconds in shadow of each place.
type Run<'a> = dyn Fn(&[Point3]) -> Vec<f64> + Sync + 'a;

/// One way to find the shadow time of places.
pub(super) struct Contestant<'a> {
    pub(super) name: String,
    run: Box<Run<'a>>,
}

impl<'a> Contestant<'a> {
    pub(super) fn new(
        name: impl Into<String>,
        run: impl Fn(&[Point3]) -> Vec<f64> + Sync + 'a,
    ) -> Self {
        Self {
            name: name.into(),
            run: Box::new(run),
        }
    }
}

/// What a contestant says, and how long it takes.
#[derive(Debug)]
pub(super) struct Outcome {
    /// Seconds in shadow of each place.
    pub(super) seconds: Vec<f64>,
    /// Microseconds a place.
    pub(super) micros: Option<Spread>,
}

/// Runs all of them: once for the answers, then `rounds` times on the clock of the one thread they
/// have. Each round begins with another one.
pub(super) fn contest(
    contestants: &[Contestant<'_>],
    places: &[Point3],
    rounds: usize,
) -> anyhow::Result<Vec<Outcome>> {
    let pool = ThreadPoolBuilder::new().num_threads(1).build()?;
    let run = |who: &Contestant<'_>, times: usize| {
        pool.install(|| {
            let _flushed = Flushed::on();
            let begin = thread_seconds();
            let mut answer = Vec::new();
            for _ in 0..times {
                answer = std::hint::black_box((who.run)(places));
            }
            (answer, thread_seconds() - begin)
        })
    };
    let first: Vec<_> = contestants.iter().map(|who| run(who, 1)).collect();
    let mut micros = vec![Vec::with_capacity(rounds); contestants.len()];
    for round in 0..rounds {
        for turn in 0..contestants.len() {
            let who = (round + turn) % contestants.len();
            let times = (LEAST / first[who].1).clamp(1.0, MOST).ceil();
            let (_, seconds) = run(&contestants[who], times as usize);
            micros[who].push(1e6 * seconds / times / places.len().max(1) as f64);
        }
    }
    let outcome = |((seconds, _), micros): ((Vec<f64>, f64), Vec<f64>)| Outcome {
        seconds,
        micros: Spread::of(&micros),
    };
    Ok(first.into_iter().zip(micros).map(outcome).collect())
}

/// Microseconds a place by the clock on the wall, with each of the numbers of threads in turns.
pub(super) fn by_threads(
    who: &Contestant<'_>,
    places: &[Point3],
    threads: &[usize],
    rounds: usize,
) -> anyhow::Result<Vec<Option<Spread>>> {
    let pools: Result<Vec<ThreadPool>, _> = (threads.iter())
        .map(|&count| ThreadPoolBuilder::new().num_threads(count).build())
        .collect();
    let pools = pools?;
    let run = |pool: &ThreadPool, times: usize| {
        pool.install(|| {
            let begin = Instant::now();
            for _ in 0..times {
                std::hint::black_box((who.run)(places));
            }
            begin.elapsed().as_secs_f64()
        })
    };
    // Long enough that it does not matter when a thread wakes up.
    let times = (5.0 * LEAST / run(&pools[0], 1)).clamp(1.0, MOST).ceil();
    let mut micros = vec![Vec::with_capacity(rounds); pools.len()];
    for round in 0..rounds {
        for turn in 0..pools.len() {
            let which = (round + turn) % pools.len();
            let seconds = run(&pools[which], times as usize);
            micros[which].push(1e6 * seconds / times / places.len().max(1) as f64);
        }
    }
    Ok(micros.iter().map(|micros| Spread::of(micros)).collect())
}
