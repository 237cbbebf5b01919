//! Rays a second, by the kind of ray.

use super::super::numbers::{list, percent, rate, short};
use crate::html::escaped;
use crate::plot::{Bar, Bars};
use crate::{SceneReport, Study, Workload};

pub(super) fn figure(study: &Study, scene: &SceneReport) -> String {
    let few = study.fewest_threads();
    if !scene.is_timed(few) {
        return "<p>No round was on the clock.</p>\n".to_owned();
    }
    let subsets = scene.subsets();
    let mut text = "<figure>\n<div class=\"panels\">\n".to_owned();
    for set in scene.workloads.iter().filter(|set| set.rays > 0) {
        let workload = set.workload;
        let bar = |report: &crate::StructureReport| {
            let speed = |threads| report.measured(workload)?.speed(threads);
            let fewer = subsets
                .iter()
                .any(|s| (s.0, s.1) == (report.structure, workload));
            Bar {
                name: report.structure,
                few: speed(few),
                many: study.more_threads().and_then(speed),
                note: if fewer { " *" } else { "" },
            }
        };
        let title = match study.more_threads() {
            Some(many) => format!("{workload} rays: Mrays/s on {few} | {many} threads"),
            None => format!("{workload} rays: Mrays/s on {few} thr"),
        };
        let title = format!("{}{}", title[..1].to_uppercase(), &title[1..]);
        let bars = Bars {
            title: &title,
            bars: scene.structures.iter().map(bar).collect(),
            say: |rate| short(rate / 1e6),
        };
        text += &bars.draw(&fastest(scene, workload, few).unwrap_or_default());
    }
    let says = escaped(&sentence(study, scene));
    text + &format!("</div>\n<figcaption>{says}</figcaption>\n</figure>\n")
}

/// "Primary rays: bvh is the fastest with 3.2 Mrays/s".
fn fastest(scene: &SceneReport, workload: Workload, threads: usize) -> Option<String> {
    let (name, speed) = best(scene, workload, threads)?;
    Some(format!(
        "{workload} rays: {name} is the fastest with {}",
        rate(speed)
    ))
}

fn best(scene: &SceneReport, workload: Workload, threads: usize) -> Option<(&'static str, f64)> {
    let speeds = scene.structures.iter().filter_map(|report| {
        let speed = report.measured(workload)?.speed(threads)?;
        Some((report.structure, speed.median))
    });
    speeds.max_by(|a, b| a.1.total_cmp(&b.1))
}

fn sentence(study: &Study, scene: &SceneReport) -> String {
    let few = study.fewest_threads();
    let mut winners: Vec<(&str, Vec<String>)> = Vec::new();
    for workload in Workload::ALL {
        let Some((name, speed)) = best(scene, workload, few) else {
            continue;
        };
        let said = format!("{workload} rays ({})", rate(speed));
        match winners.iter_mut().find(|(winner, _)| *winner == name) {
            Some((_, workloads)) => workloads.push(said),
            None => winners.push((name, vec![said])),
        }
    }
    let winners = winners
        .iter()
        .map(|(name, for_what)| format!("{name} for {}", list(for_what)));
    let on = if few == 1 {
        "On one thread".to_owned()
    } else {
        format!("On {few} threads")
    };
    let mut text = format!(
        "{on} the fastest is {}.",
        winners.collect::<Vec<_>>().join("; ")
    );
    let mut ranked: Vec<_> = scene
        .structures
        .iter()
        .filter_map(|report| Some((report.structure, report.speed(few)?)))
        .collect();
    ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
    if let [(first, best), rest @ .., (last, worst)] = ranked.as_slice() {
        let next: Vec<_> = (rest.iter().take(2))
            .map(|(name, speed)| format!("{name} ({})", percent(speed / best)))
            .collect();
        text += &format!(" All kinds together, {first} is first");
        if !next.is_empty() {
            text += &format!(", then {}", list(&next));
        }
        text += &format!(
            "; {last} is last and takes {} times as long.",
            short(best / worst)
        );
    }
    text += &threads_gain(study, scene);
    if !scene.subsets().is_empty() {
        text += " Where a * stands only some of the rays were asked.";
    }
    text
}

/// What more threads bring.
fn threads_gain(study: &Study, scene: &SceneReport) -> String {
    let few = study.fewest_threads();
    let Some(many) = study.more_threads() else {
        return String::new();
    };
    let gains = scene
        .structures
        .iter()
        .filter_map(|r| Some(r.speed(many)? / r.speed(few)?));
    let gains: Vec<f64> = gains.collect();
    let (least, most) = (
        gains.iter().copied().fold(f64::INFINITY, f64::min),
        gains.iter().copied().fold(0.0, f64::max),
    );
    if gains.is_empty() {
        return String::new();
    }
    // Rays share nothing, so threads of an idle machine should bring nearly their number.
    let busy = if most < 1.3 && many >= 2 * few {
        ", as on a machine that is busy with something else"
    } else {
        ""
    };
    let (least, most) = (short(least), short(most));
    format!(" {many} threads answer {least} to {most} times as many rays a second{busy}.")
}
