//! What was found, for people.

use std::fmt::{self, Write as _};

use super::report::{JobRecord, Ratio, Report};
use crate::contest::Spread;

impl Report {
    /// As Markdown.
    #[must_use]
    pub fn tables(&self) -> String {
        let mut text = String::new();
        self.write(&mut text)
            .expect("writing to memory does not fail");
        text
    }

    fn write(&self, text: &mut String) -> fmt::Result {
        let machine = &self.machine;
        writeln!(
            text,
            "{} ({} threads), {}, {}; one ray a minute by {}; {} rounds, in turns, on {}\n",
            machine.cpu,
            machine.threads,
            machine.target,
            machine.commit,
            self.rays,
            self.rounds,
            if self.thread_clock {
                "the clock of the thread"
            } else {
                "the wall's clock"
            }
        )?;
        if let Some(missing) = &self.missing {
            writeln!(text, "**Without Embree**: {missing}\n")?;
        }
        for city in &self.cities {
            writeln!(
                text,
                "## {}: {} buildings, {} polygons, made ready in {:.2} s\n",
                city.city, city.buildings, city.polygons, city.build_seconds
            )?;
            self.jobs(text, &city.city)?;
            self.own(text, &city.city)?;
            self.what_if(text, &city.city)?;
        }
        Ok(())
    }

    fn jobs(&self, text: &mut String, city: &str) -> fmt::Result {
        let jobs: Vec<&JobRecord> = self.jobs.iter().filter(|job| job.city == city).collect();
        let Some(first) = jobs.first() else {
            return writeln!(text, "No place to ask for.\n");
        };
        write!(text, "| µs a place | places | rays |")?;
        for timed in &first.times {
            write!(text, " {} |", timed.contestant)?;
        }
        let heads = [
            "over single, packets",
            "of the best rounds",
            "mean shadow, s",
            "one a minute is off by, mean, most, s",
        ];
        let columns = 3 + first.times.len() + heads.len();
        writeln!(
            text,
            " {} |\n|{}",
            heads.join(" | "),
            "---|".repeat(columns)
        )?;
        for job in jobs {
            write!(text, "| {} | {} | {} |", job.job, job.places, job.rays)?;
            for timed in &job.times {
                write!(text, " {} |", micros(timed.micros))?;
            }
            let pair = |of: fn(&Ratio) -> f64| {
                let word = |ratio: &Option<Ratio>| {
                    ratio
                        .as_ref()
                        .map_or_else(|| "–".to_owned(), |ratio| times(of(ratio)))
                };
                format!("{}, {}", word(&job.over_single), word(&job.over_packets))
            };
            writeln!(
                text,
                " {} | {} | {:.0} | {:.1}, {:.0} |",
                pair(|ratio| ratio.of_medians),
                pair(|ratio| ratio.of_best),
                job.mean_seconds,
                job.sampling.mean,
                job.sampling.most
            )?;
        }
        writeln!(text)
    }

    fn own(&self, text: &mut String, city: &str) -> fmt::Result {
        let mut all = self.own.iter().filter(|own| own.city == city).peekable();
        if all.peek().is_none() {
            return Ok(());
        }
        let heads = "| exact, µs a place | way | time | times as quick | of the best rounds |";
        writeln!(text, "{heads}\n|---|---|---|---|---|")?;
        for own in all {
            let word = |of: fn(&Ratio) -> f64| {
                (own.speed.as_ref())
                    .map_or_else(|| "–".to_owned(), |ratio| format!("{:.2}", of(ratio)))
            };
            writeln!(
                text,
                "| {} | {} | {} | {} | {} |",
                own.job,
                own.way,
                micros(own.micros),
                word(|ratio| ratio.of_medians),
                word(|ratio| ratio.of_best)
            )?;
        }
        writeln!(text)
    }
}

impl Report {
    fn what_if(&self, text: &mut String, city: &str) -> fmt::Result {
        let mut all = self
            .what_if
            .iter()
            .filter(|own| own.city == city)
            .peekable();
        if all.peek().is_none() {
            return Ok(());
        }
        let heads = "| what if one building were a tower | cells | places | change | measured again | all, s | again, s | share |";
        writeln!(text, "{heads}\n|---|---|---|---|---|---|---|---|")?;
        for own in all {
            writeln!(
                text,
                "| {} | {} m | {} | {} | {} | {:.2} | {:.3} | {:.1} % |",
                own.job,
                own.cell,
                own.places,
                own.changed,
                own.again,
                own.full_seconds,
                own.again_seconds,
                100.0 * own.share()
            )?;
        }
        writeln!(text)
    }
}

/// The median, and how far the quartiles spread.
fn micros(spread: Option<Spread>) -> String {
    spread.map_or_else(
        || "–".to_owned(),
        |s| {
            let around = 50.0 * (s.upper_quartile - s.lower_quartile) / s.median;
            let digits = if s.median < 10.0 { 3 } else { 1 };
            format!("{:.digits$} ±{around:.0} %", s.median)
        },
    )
}

fn times(ratio: f64) -> String {
    if ratio < 10.0 {
        format!("{ratio:.1}×")
    } else {
        format!("{ratio:.0}×")
    }
}
