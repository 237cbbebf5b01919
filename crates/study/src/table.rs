//! The study as a text for terminals.

use std::fmt::Write as _;

use crate::numbers::{bytes, counted, percent, seconds, short};
use crate::{Measured, SceneReport, Spread, Study};

impl Study {
    /// For people, as lines of text.
    #[must_use]
    pub fn table(&self) -> String {
        let mut text = String::new();
        let threads: Vec<_> = self.threads.iter().map(usize::to_string).collect();
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "{}; {}, {} threads; medians ± half of what is between the quartiles",
            self.machine.cpu,
            counted(self.rounds as u64, "round"),
            threads.join(" and "),
        );
        for scene in &self.scenes {
            let _ = writeln!(
                text,
                "\n{}: {}",
                scene.scene,
                counted(scene.primitives as u64, "primitive")
            );
            self.costs(&mut text, scene);
            self.counts(&mut text, scene);
            for &threads in &self.threads {
                speeds(&mut text, scene, threads);
            }
        }
        self.ropes(&mut text);
        for note in self.notes() {
            let _ = writeln!(text, "{note}");
        }
        text
    }

    fn costs(&self, text: &mut String, scene: &SceneReport) {
        let mut heads = vec![
            "structure".to_owned(),
            "bytes".to_owned(),
            "a primitive".to_owned(),
        ];
        heads.extend(
            self.threads
                .iter()
                .map(|threads| format!("built, {threads} thr")),
        );
        let mut rows = vec![heads];
        for report in &scene.structures {
            let mut row = vec![
                report.structure.to_owned(),
                bytes(report.bytes as f64),
                short(report.bytes_per_primitive),
            ];
            let builds = self.threads.iter().map(|&threads| report.build(threads));
            row.extend(builds.map(|spread| said(spread, seconds)));
            rows.push(row);
        }
        aligned(text, &rows);
    }

    fn counts(&self, text: &mut String, scene: &SceneReport) {
        let kinds = || scene.workloads.iter().filter(|set| set.rays > 0);
        let heads = kinds().map(|set| set.workload.name().to_owned());
        let mut rows = vec![
            std::iter::once("nodes + tests a ray".to_owned())
                .chain(heads)
                .collect(),
        ];
        for report in &scene.structures {
            let cost = |measured: &Measured| {
                let [nodes, tests] = [measured.cost.nodes_visited, measured.cost.tests_made]
                    .map(|count| short(count.mean));
                format!("{nodes} + {tests}")
            };
            let cells =
                kinds().map(|set| report.measured(set.workload).map_or("–".to_owned(), cost));
            rows.push(
                std::iter::once(report.structure.to_owned())
                    .chain(cells)
                    .collect(),
            );
        }
        aligned(text, &rows);
    }

    fn ropes(&self, text: &mut String) {
        let Some(santos) = &self.santos else {
            return;
        };
        let _ = writeln!(
            text,
            "\nropes against boxes: Santos and others, 2014, on a GPU +13 % to +71 %, memory up to 9 times"
        );
        let mut rows = vec![
            ["scene", "rays", "speed", "memory", ""]
                .map(str::to_owned)
                .to_vec(),
        ];
        for pair in &santos.pairs {
            rows.push(vec![
                pair.scene.clone(),
                pair.workload.to_string(),
                percent(pair.speed),
                format!("{} ×", short(pair.memory)),
                pair.verdict.words().to_owned(),
            ]);
        }
        aligned(text, &rows);
        let _ = writeln!(text, "in the mean {}\n", percent(santos.speed));
    }
}

fn speeds(text: &mut String, scene: &SceneReport, threads: usize) {
    if !scene.is_timed(threads) {
        return;
    }
    let kinds = || scene.workloads.iter().filter(|set| set.rays > 0);
    let subsets = scene.subsets();
    let heads = kinds().map(|set| set.workload.name().to_owned());
    let first = format!("Mrays/s, {threads} thr");
    let mut rows = vec![std::iter::once(first).chain(heads).collect()];
    for report in &scene.structures {
        let cell = |set: &crate::RaySet| {
            let speed = report.measured(set.workload).and_then(|m| m.speed(threads));
            let fewer = subsets
                .iter()
                .any(|s| (s.0, s.1) == (report.structure, set.workload));
            let mark = if fewer { "*" } else { "" };
            said(speed, |rate| short(rate / 1e6)) + mark
        };
        rows.push(
            std::iter::once(report.structure.to_owned())
                .chain(kinds().map(cell))
                .collect(),
        );
    }
    aligned(text, &rows);
}

fn said(spread: Option<Spread>, say: fn(f64) -> String) -> String {
    spread.map_or("–".to_owned(), |spread| {
        format!(
            "{} ± {:.0} %",
            say(spread.median),
            spread.relative() * 100.0
        )
    })
}

/// Appends rows, the first column to the left, the others to the right, and an empty line before.
fn aligned(text: &mut String, rows: &[Vec<String>]) {
    let columns = rows.first().map_or(0, Vec::len);
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    text.push('\n');
    for row in rows {
        let mut line = String::new();
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            let _ = match column {
                0 => write!(line, "{cell:<width$}"),
                _ => write!(line, "  {cell:>width$}"),
            };
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
}
