//! What a structure costs before the first ray: building, and memory.

use crate::html::escaped;
use crate::numbers::{bytes, grouped, rate, seconds, short};
use crate::plot::{Bar, Bars};
use crate::{SceneReport, Spread, StructureReport, Study};

pub(super) fn figure(study: &Study, scene: &SceneReport) -> String {
    let few = study.fewest_threads();
    let building = |report: &StructureReport| Bar {
        name: report.structure,
        few: report.build(few),
        many: study.more_threads().and_then(|many| report.build(many)),
        note: "",
    };
    let holding = |report: &StructureReport| Bar {
        name: report.structure,
        few: Spread::of(&[report.bytes_per_primitive]),
        many: None,
        note: "",
    };
    let title = match study.more_threads() {
        Some(many) => format!("Building on {few} | {many} threads"),
        None => format!("Building on {few} thr"),
    };
    let built = Bars {
        title: &title,
        bars: scene.structures.iter().map(building).collect(),
        say: seconds,
    };
    let held = Bars {
        title: "Bytes a primitive",
        bars: scene.structures.iter().map(holding).collect(),
        say: short,
    };
    let says = [build_sentence(study, scene), memory_sentence(scene)];
    let mut text = "<figure>\n<div class=\"panels\">\n".to_owned();
    if scene
        .structures
        .iter()
        .any(|report| report.build(few).is_some())
    {
        text += &built.draw(&says[0]);
    }
    text += &held.draw(&says[1]);
    let says = escaped(&says.join(" "));
    text + &format!("</div>\n<figcaption>{says}</figcaption>\n</figure>\n")
}

fn build_sentence(study: &Study, scene: &SceneReport) -> String {
    let few = study.fewest_threads();
    let mut built: Vec<_> = (scene.structures.iter())
        .filter(|report| report.structure != "brute-force")
        .filter_map(|report| Some((report, report.build(few)?.median)))
        .collect();
    built.sort_by(|a, b| a.1.total_cmp(&b.1));
    let [(quick, least), .., (slow, most)] = built.as_slice() else {
        return String::new();
    };
    let mut text = format!(
        "{} is built in {}, the quickest; {} takes {}, {} times as long.",
        quick.structure,
        seconds(*least),
        slow.structure,
        seconds(*most),
        short(most / least),
    );
    // When the fastest structure has made up for its building.
    let speeds = built
        .iter()
        .filter_map(|(report, build)| Some((report, build, report.speed(few)?)));
    let fastest = speeds.clone().max_by(|a, b| a.2.total_cmp(&b.2));
    let first = speeds.clone().next();
    if let (Some((fastest, its_build, its_speed)), Some((first, build, speed))) = (fastest, first)
        && fastest.structure != first.structure
    {
        let rays = (its_build - build) / (1.0 / speed - 1.0 / its_speed);
        text += &format!(
            " The fastest on rays, {}, has made up for its longer building against {} after {} rays ({} against {}).",
            fastest.structure,
            first.structure,
            count(rays),
            rate(its_speed),
            rate(speed),
        );
    } else if let Some((fastest, ..)) = fastest {
        text += &format!(" {} is the fastest on rays as well.", fastest.structure);
    }
    text
}

fn memory_sentence(scene: &SceneReport) -> String {
    let mut held: Vec<_> = (scene.structures.iter())
        .filter(|report| report.structure != "brute-force")
        .collect();
    held.sort_by_key(|report| report.bytes);
    let [small, .., large] = held.as_slice() else {
        return String::new();
    };
    format!(
        "{} is the smallest with {} ({} bytes a primitive), {} the largest with {} ({}).",
        small.structure,
        bytes(small.bytes as f64),
        short(small.bytes_per_primitive),
        large.structure,
        bytes(large.bytes as f64),
        short(large.bytes_per_primitive),
    )
}

/// A number of things so large that its digits mean little.
fn count(number: f64) -> String {
    match () {
        () if number >= 1e9 => format!("{} thousand million", short(number / 1e9)),
        () if number >= 1e6 => format!("{} million", short(number / 1e6)),
        () => grouped(number.max(0.0).round() as u64),
    }
}
