//! All numbers of a scene, folded away.

use crate::html::table;
use crate::numbers::{bytes, seconds, short};
use crate::{SceneReport, Spread, Study};

pub(super) fn details(study: &Study, scene: &SceneReport) -> String {
    let mut text = "<details><summary>The numbers</summary>\n".to_owned();
    let mut heads = vec![
        "structure".to_owned(),
        "bytes".to_owned(),
        "bytes a primitive".to_owned(),
    ];
    heads.extend(
        study
            .threads
            .iter()
            .map(|threads| format!("built on {threads} thr")),
    );
    let rows: Vec<_> = (scene.structures.iter())
        .map(|report| {
            let mut row = vec![
                report.structure.to_owned(),
                bytes(report.bytes as f64),
                short(report.bytes_per_primitive),
            ];
            let builds = study.threads.iter().map(|&threads| report.build(threads));
            row.extend(builds.map(|spread| said(spread, seconds)));
            row
        })
        .collect();
    text += &table("Memory and building", &borrowed(&heads), &rows);
    for set in scene.workloads.iter().filter(|set| set.rays > 0) {
        let mut heads: Vec<String> = vec![
            format!("{} rays", set.workload),
            "asked".to_owned(),
            "nodes a ray".to_owned(),
            "most".to_owned(),
            "tests a ray".to_owned(),
            "most".to_owned(),
        ];
        heads.extend(
            study
                .threads
                .iter()
                .map(|threads| format!("Mrays/s on {threads} thr")),
        );
        let rows = scene.structures.iter().filter_map(|report| {
            let measured = report.measured(set.workload)?;
            let cost = measured.cost;
            let mut row = vec![
                report.structure.to_owned(),
                measured.rays.to_string(),
                short(cost.nodes_visited.mean),
                cost.nodes_visited.most.to_string(),
                short(cost.tests_made.mean),
                cost.tests_made.most.to_string(),
            ];
            let speeds = study.threads.iter().map(|&threads| measured.speed(threads));
            row.extend(speeds.map(|spread| said(spread, |rate| short(rate / 1e6))));
            Some(row)
        });
        let rows: Vec<_> = rows.collect();
        text += &table(set.workload.name(), &borrowed(&heads), &rows);
    }
    text + "</details>\n"
}

/// The median and how far the quartiles are from it.
fn said(spread: Option<Spread>, say: fn(f64) -> String) -> String {
    spread.map_or("–".to_owned(), |spread| {
        format!(
            "{} ± {:.0} %",
            say(spread.median),
            spread.relative() * 100.0
        )
    })
}

fn borrowed(heads: &[String]) -> Vec<&str> {
    heads.iter().map(String::as_str).collect()
}
