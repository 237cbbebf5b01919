//! Steps against tests: where the work of a ray is.

use super::figure as framed;
use crate::numbers::{list, short};
use crate::plot::{Dot, Scale, Scatter};
use crate::{SceneReport, StructureReport, Study};

pub(super) fn figure(study: &Study, scene: &SceneReport) -> String {
    let fits = |report: &&StructureReport| report.steps().iter().all(|&steps| steps > 0.0);
    let shown: Vec<_> = scene.structures.iter().filter(fits).collect();
    if shown.is_empty() {
        return String::new();
    }
    let of = |axis: usize| shown.iter().map(move |report| report.steps()[axis]);
    let scatter = Scatter {
        title: "Steps against tests",
        axes: ["nodes visited a ray", "tests made a ray"],
        scales: [Scale::log(of(0)), Scale::log(of(1))],
        dots: shown
            .iter()
            .map(|report| Dot {
                name: report.structure,
                at: report.steps(),
            })
            .collect(),
        front: Vec::new(),
    };
    let says = sentence(study, scene, &shown);
    framed(&scatter.draw().finish(&says), &says)
}

fn sentence(study: &Study, scene: &SceneReport, shown: &[&StructureReport]) -> String {
    let least = |axis: usize| {
        let mut sorted = shown.to_vec();
        sorted.sort_by(|a, b| a.steps()[axis].total_cmp(&b.steps()[axis]));
        let (first, last) = (sorted[0], sorted[sorted.len() - 1]);
        let [few, many] = [first, last].map(|report| report.steps()[axis]);
        [(first.structure, few), (last.structure, many)]
    };
    let [(few_nodes, nodes), (many_nodes, most_nodes)] = least(0);
    let [(few_tests, tests), (many_tests, most_tests)] = least(1);
    let mut text = format!(
        "A ray in {few_nodes} visits the fewest nodes, {}, one in {many_nodes} the most, {}; {few_tests} tests the \
         fewest primitives, {}, and {many_tests} the most, {}.",
        short(nodes),
        short(most_nodes),
        short(tests),
        short(most_tests),
    );
    text += &agreement(study, shown);
    let without: Vec<_> = (scene.structures.iter())
        .filter(|report| report.steps()[0] == 0.0)
        .map(|report| format!("{} ({} tests)", report.structure, short(report.steps()[1])))
        .collect();
    if !without.is_empty() {
        text += &format!(
            " Without nodes, and so without a place here: {}.",
            list(&without)
        );
    }
    text
}

/// What foretells time better, nodes or tests, and how well.
fn agreement(study: &Study, shown: &[&StructureReport]) -> String {
    let few = study.fewest_threads();
    let timed: Vec<_> = (shown.iter())
        .filter_map(|report| Some((report.steps(), report.speed(few)?)))
        .collect();
    let count = timed.len() * timed.len().saturating_sub(1) / 2;
    if count < 3 {
        return String::new();
    }
    // Fewer steps, more speed.
    let alike = |axis: usize| -> usize {
        let beside = |(index, (steps, speed)): (usize, &([f64; 2], f64))| {
            let others = timed[..index].iter();
            let tells = others.filter(|other| (steps[axis] < other.0[axis]) == (*speed > other.1));
            tells.count()
        };
        timed.iter().enumerate().map(beside).sum()
    };
    let [by_nodes, by_tests] = [alike(0), alike(1)];
    let [nodes, tests] = [by_nodes, by_tests].map(|alike| alike as f64 / count as f64);
    let so = match () {
        () if nodes.max(tests) < 0.65 => "neither count alone tells the order",
        () if tests > nodes => "tests tell the order better",
        () if tests < nodes => "nodes tell the order better",
        () => "both tell the order alike",
    };
    format!(
        " Of two structures the faster one is that with fewer tests in {by_tests} of {count} pairs, and that with fewer \
         nodes in {by_nodes}: {so}."
    )
}
