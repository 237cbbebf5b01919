//! What was found, as tables in Markdown.

use std::fmt::{self, Write as _};

use super::answers::MOST_JUDGED;
use super::{BuildRecord, Report, SpeedRecord};

impl Report {
    /// All tables.
    #[must_use]
    pub fn tables(&self) -> String {
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = self.write(&mut text);
        text
    }

    fn write(&self, text: &mut String) -> fmt::Result {
        let machine = &self.machine;
        let (cpu, threads, commit) = (&machine.cpu, machine.threads, &machine.commit);
        write!(text, "{cpu} ({threads} threads), ombra {commit}")?;
        for peer in &self.peers {
            write!(text, ", {} {}", peer.name, peer.version)?;
        }
        writeln!(text)?;
        for line in &self.skipped {
            writeln!(text, "\n{line}")?;
        }
        for scene in names(self.builds.iter().map(|build| &build.scene)) {
            let triangles = self.builds.iter().find(|build| build.scene == *scene);
            let triangles = triangles.map_or(0, |build| build.triangles);
            writeln!(text, "\n## {scene}, {triangles} triangles")?;
            self.speeds(text, scene)?;
            self.builds(text, scene)?;
            self.answers(text, scene)?;
        }
        self.over_all_scenes(text)
    }

    fn speeds(&self, text: &mut String, scene: &str) -> fmt::Result {
        let here = || self.records.iter().filter(|record| record.scene == scene);
        for threads in numbers(here().map(|record| record.threads)) {
            let cells = || here().filter(|record| record.threads == threads);
            if cells().all(|record| record.mrays.is_none()) {
                continue;
            }
            let works = names(cells().map(|record| &record.workload));
            let clock = match (threads, self.thread_clock) {
                (1, true) => "time of the thread",
                _ => "time on the wall",
            };
            writeln!(
                text,
                "\n### {scene}, {}: Mrays/s ± half of what the middle half of the rounds spans ({clock})\n",
                count(threads, "thread")
            )?;
            head(text, "contestant", &works)?;
            let rows = names(cells().map(|record| &record.contestant));
            for who in &rows {
                write!(text, "| {who} |")?;
                for cell in cells().filter(|record| record.contestant == **who) {
                    write!(text, " {} |", speed(cell))?;
                }
                writeln!(text)?;
            }
            let base = base_name(cells());
            writeln!(
                text,
                "\n### {scene}, {}: over the best of {base} that takes single rays, and over the best of {base}\n",
                count(threads, "thread")
            )?;
            let columns: Vec<_> = works.iter().map(|work| **work).chain(["mean"]).collect();
            head(text, "contestant", &columns)?;
            for who in &rows {
                let own: Vec<_> = cells().filter(|r| r.contestant == **who).collect();
                write!(text, "| {who} |")?;
                for cell in &own {
                    write!(text, " {} |", pair(cell.over_single, cell.over_best))?;
                }
                writeln!(text, " {} |", means(&own))?;
            }
        }
        Ok(())
    }

    fn builds(&self, text: &mut String, scene: &str) -> fmt::Result {
        let here = || self.builds.iter().filter(|build| build.scene == scene);
        let Some(first) = here().next() else {
            return Ok(());
        };
        let threads = numbers(here().map(|build| build.threads));
        writeln!(
            text,
            "\n### {scene}: builds, M triangles/s (over {}), and bytes a triangle\n",
            first.engine
        )?;
        let speeds = threads.iter().map(|&n| count(n, "thread"));
        let bytes = ["own", "with the mesh", "peak, told", "peak, seen"].map(str::to_owned);
        let columns: Vec<_> = speeds.chain(bytes).collect();
        head(text, "engine", &columns)?;
        for engine in names(here().map(|build| &build.engine)) {
            let own: Vec<_> = here().filter(|build| build.engine == *engine).collect();
            write!(text, "| {engine} |")?;
            for build in &own {
                let (speed, spread) = (build.mtriangles, half_span(&build.seconds));
                write!(text, " {speed:.2} ±{spread:.0} % ({:.2}) |", build.ratio)?;
            }
            let Some(last) = own.last() else { continue };
            let peak = |of: fn(&BuildRecord) -> Option<u64>| own.iter().filter_map(|b| of(b)).max();
            let all = last.own_bytes.zip(last.mesh_bytes).map(|(a, b)| a + b);
            let each = |bytes: Option<u64>| {
                bytes.map_or_else(
                    || "–".to_owned(),
                    |bytes| format!("{:.1}", bytes as f64 / last.triangles.max(1) as f64),
                )
            };
            writeln!(
                text,
                " {} | {} | {} | {} |",
                each(last.own_bytes),
                each(all),
                each(peak(|build| build.peak_bytes_told)),
                each(peak(|build| build.peak_bytes_seen)),
            )?;
        }
        Ok(())
    }

    fn answers(&self, text: &mut String, scene: &str) -> fmt::Result {
        let here = || self.answers.iter().filter(|answer| answer.scene == scene);
        let Some(first) = here().next() else {
            return Ok(());
        };
        writeln!(
            text,
            "\n### {scene}: answers. Differing from {} in hit or miss + in t by more than 1e-4; wrong (and wrong by \
             a hair) by a check of every triangle in double precision, of the rays judged\n",
            first.contestant
        )?;
        let works = names(here().map(|answer| &answer.workload));
        head(text, "contestant", &works)?;
        for who in names(here().map(|answer| &answer.contestant)) {
            write!(text, "| {who} |")?;
            for cell in here().filter(|answer| answer.contestant == *who) {
                let (hits, distances) = (cell.other_hits, cell.other_distances);
                let (wrong, hair) = (cell.wrong, cell.wrong_by_a_hair);
                write!(
                    text,
                    " {hits} + {distances}; {wrong} ({hair}) of {} |",
                    cell.judged
                )?;
            }
            writeln!(text)?;
        }
        writeln!(text)?;
        for work in works {
            if let Some(cell) = here().find(|answer| answer.workload == *work) {
                let (rays, disputed) = (cell.rays, cell.disputed);
                let share = 100.0 * cell.hits as f64 / rays.max(1) as f64;
                let only = if disputed > MOST_JUDGED {
                    format!(", of which {MOST_JUDGED} were judged")
                } else {
                    String::new()
                };
                writeln!(
                    text,
                    "- {work}: {rays} rays, {share:.1} % hit, {disputed} disputed{only}"
                )?;
            }
        }
        for cell in here().filter(|cell| cell.changed_by_flushing.is_some_and(|n| n > 0)) {
            writeln!(
                text,
                "- {}, {}: {} answers change when denormal numbers are flushed",
                cell.contestant,
                cell.workload,
                cell.changed_by_flushing.unwrap_or(0)
            )?;
        }
        Ok(())
    }

    /// The mean over scenes and workloads, a line each.
    fn over_all_scenes(&self, text: &mut String) -> fmt::Result {
        let timed = || self.records.iter().filter(|record| record.mrays.is_some());
        if names(timed().map(|record| &record.scene)).len() < 2 {
            return Ok(());
        }
        let threads = numbers(timed().map(|record| record.threads));
        let base = base_name(timed());
        writeln!(
            text,
            "\n## All scenes: geometric mean (least) over the best of {base} that takes single rays, and over the \
             best of {base}\n"
        )?;
        let columns: Vec<_> = threads.iter().map(|&n| count(n, "thread")).collect();
        head(text, "contestant", &columns)?;
        for who in names(timed().map(|record| &record.contestant)) {
            write!(text, "| {who} |")?;
            for &threads in &threads {
                let own = timed().filter(|r| r.contestant == *who && r.threads == threads);
                write!(text, " {} |", means(&own.collect::<Vec<_>>()))?;
            }
            writeln!(text)?;
        }
        Ok(())
    }
}

/// "1.25 / 0.60".
fn pair(single: Option<f64>, best: Option<f64>) -> String {
    match (single, best) {
        (Some(single), Some(best)) => format!("{single:.2} / {best:.2}"),
        _ => "–".to_owned(),
    }
}

/// Geometric means of both ratios, each with its least.
fn means(records: &[&SpeedRecord]) -> String {
    let words = |of: fn(&SpeedRecord) -> Option<f64>| {
        let ratios: Option<Vec<f64>> = records.iter().map(|record| of(record)).collect();
        let ratios = ratios.filter(|ratios| !ratios.is_empty())?;
        let logarithms: f64 = ratios.iter().map(|ratio| ratio.ln()).sum();
        let mean = (logarithms / ratios.len() as f64).exp();
        let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
        Some(format!("{mean:.2} ({least:.2})"))
    };
    match (words(|r| r.over_single), words(|r| r.over_best)) {
        (Some(single), Some(best)) => format!("{single} / {best}"),
        _ => "–".to_owned(),
    }
}

fn speed(record: &SpeedRecord) -> String {
    match (record.mrays, &record.seconds) {
        (Some(mrays), Some(seconds)) => format!("{mrays:.2} ±{:.0} %", half_span(seconds)),
        _ => "–".to_owned(),
    }
}

/// Half the way between the quartiles, in parts of a hundred of the median.
fn half_span(spread: &crate::contest::Spread) -> f64 {
    50.0 * (spread.upper_quartile - spread.lower_quartile) / spread.median
}

/// The tracer that others are measured by: what the names of its contestants begin with.
fn base_name<'a>(mut records: impl Iterator<Item = &'a SpeedRecord>) -> &'a str {
    let first = records.find(|record| record.base);
    let name = first.map_or("", |record| record.contestant.as_str());
    let engine = name.split(',').next().unwrap_or(name);
    if engine.starts_with("ombra") {
        return engine;
    }
    engine.split(' ').next().unwrap_or(engine)
}

fn count(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

fn head(text: &mut String, first: &str, columns: &[impl fmt::Display]) -> fmt::Result {
    write!(text, "| {first} |")?;
    for column in columns {
        write!(text, " {column} |")?;
    }
    writeln!(text, "\n|---|{}", "---|".repeat(columns.len()))
}

/// Each once, in the order in which they come.
fn names<'a, T: PartialEq>(all: impl Iterator<Item = &'a T>) -> Vec<&'a T> {
    let mut once: Vec<&T> = Vec::new();
    for name in all {
        if !once.contains(&name) {
            once.push(name);
        }
    }
    once
}

/// See [`names`].
fn numbers(all: impl Iterator<Item = usize>) -> Vec<usize> {
    let all: Vec<_> = all.collect();
    names(all.iter()).into_iter().copied().collect()
}
