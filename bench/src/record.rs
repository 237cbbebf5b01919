//! What a bench found, for people and for programs.

use std::fmt;

use serde::Serialize;

use crate::contest::Spread;

/// One contestant's result in one job.
#[derive(Clone, Debug, Serialize)]
pub struct Record {
    /// Which bench.
    pub bench: &'static str,
    /// Which job of it.
    pub job: String,
    /// Who did it.
    pub contestant: &'static str,
    /// On how many threads.
    pub threads: usize,
    /// How many rays the job takes.
    pub rays: u64,
    /// How many rounds were on the clock.
    pub rounds: usize,
    /// Seconds a round; nothing if none was on the clock.
    pub seconds: Option<Spread>,
    /// Seconds over those of the first contestant, round by round.
    pub ratio: Option<Spread>,
    /// The least seconds over the least of the first contestant: what is left of the ratio where
    /// other programs disturb most rounds but not all.
    pub ratio_of_least: Option<f64>,
}

impl Record {
    /// Rays a second in the median round.
    #[must_use]
    pub fn rays_per_second(&self) -> Option<f64> {
        self.seconds
            .map(|seconds| self.rays as f64 / seconds.median)
    }
}

impl fmt::Display for Record {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (threads, job, who) = (self.threads, &self.job, self.contestant);
        write!(
            f,
            "{:<10} {job:<16} {threads:>3} thr  {who:<14}",
            self.bench
        )?;
        let (Some(seconds), Some(ratio), Some(least)) =
            (self.seconds, self.ratio, self.ratio_of_least)
        else {
            return write!(f, " same answer, {} rays", self.rays);
        };
        write!(
            f,
            " {:>9.2} ms  {:>7.3} Mrays/s  ratio {:.3} ({:.3} to {:.3}), of the least {least:.3}",
            seconds.median * 1e3,
            self.rays_per_second().unwrap_or_default() / 1e6,
            ratio.median,
            ratio.lower_quartile,
            ratio.upper_quartile,
        )
    }
}
