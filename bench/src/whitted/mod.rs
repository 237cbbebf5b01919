//! Whitted's ray tracer: what do ray programs cost over a loop written by hand?
//!
//! Both contestants shade with the same functions and trace against the same structure; only who
//! calls whom differs.

mod hand_written;
mod programs;
mod shading;

use ombra_pipeline::Cpu;

use crate::contest::{Contestant, Spread, compare, times};
use crate::record::Record;
use crate::scenes::{self, Stage};
use crate::{Bench, Settings};

/// Programs over a hand-written loop.
pub const BENCH: Bench = Bench {
    name: "whitted",
    line: "Whitted's ray tracer on ray programs, over the same written as a plain loop",
    run,
};

/// How deep reflections go.
const MAX_DEPTH: u32 = 5;

/// A picture, its numbers as bits, so that equal means the same.
type Picture = Vec<[u32; 3]>;

/// The first one is what the others are measured by.
fn contestants(stage: &Stage) -> Vec<Contestant<'_, Picture>> {
    vec![
        Contestant::new("hand-written", || hand_written::picture(stage)),
        Contestant::new("programs", || programs::picture(stage).0),
    ]
}

fn run(settings: &Settings) -> anyhow::Result<Vec<Record>> {
    let mut records = Vec::new();
    for (job, stage) in scenes::all(settings)? {
        let contestants = contestants(&stage);
        let rays = programs::picture(&stage).1;
        let mut expected = None;
        for &threads in &settings.threads {
            let cpu = Cpu::with_threads(threads)?;
            let answer = cpu.install(|| compare(&contestants))?;
            let expected = expected.get_or_insert_with(|| answer.clone());
            anyhow::ensure!(
                *expected == answer,
                "{threads} threads give another picture"
            );
            let times = cpu.install(|| times(&contestants, settings.rounds));
            let least = |seconds: &[f64]| Spread::of(seconds).map(|spread| spread.least);
            for (contestant, seconds) in contestants.iter().zip(&times) {
                let pair = least(seconds).zip(least(&times[0]));
                records.push(Record {
                    ratio_of_least: pair.map(|(own, base)| own / base),
                    bench: BENCH.name,
                    job: job.to_owned(),
                    contestant: contestant.name,
                    threads: cpu.threads(),
                    rays,
                    rounds: settings.rounds,
                    seconds: Spread::of(seconds),
                    ratio: Spread::of_ratios(seconds, &times[0]),
                });
            }
        }
    }
    Ok(records)
}
