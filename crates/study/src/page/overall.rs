//! All scenes together, each structure by the binary hierarchy that courses teach.

use super::figure as framed;
use super::trade::{Place, scatter, sentence, split};
use crate::family::Family;
use crate::numbers::{list, percent, short};
use crate::plot::{Mark, Strip, Svg};
use crate::santos::BOXES;
use crate::spread::geometric_mean;
use crate::{SceneReport, Study, Workload};

/// No structure at all: what it depends on is the number of primitives, which is no news.
const FORCE: &str = "brute-force";

/// A structure over all scenes.
struct Overall {
    name: &'static str,
    /// Speed over that of `bvh`, for each scene and kind of rays.
    ratios: Vec<f64>,
    speed: f64,
    memory: Option<f64>,
}

pub(super) fn section(study: &Study) -> String {
    let all = overall(study);
    if all.is_empty() {
        return String::new();
    }
    let mut text = "<section aria-labelledby=\"all\">\n<h2 id=\"all\">All scenes</h2>\n".to_owned();
    let says = strip_sentence(&all);
    text += &framed(&strip(&all).draw(&says), &says);
    if let Some((svg, says)) = memory_and_speed(&all) {
        text += &framed(&svg.finish(&says), &says);
    }
    text + "</section>\n"
}

pub(super) fn drawing(study: &Study) -> Option<String> {
    let (svg, says) = memory_and_speed(&overall(study))?;
    Some(svg.alone(&says))
}

/// All but those that were not measured where the default was; none if that was not measured.
fn overall(study: &Study) -> Vec<Overall> {
    let few = study.fewest_threads();
    let base = BOXES;
    let one = |name: &'static str| {
        let scenes = || study.timed_scenes();
        let of_scene = |scene: &SceneReport| -> Vec<f64> {
            let ratio = |workload: Workload| {
                let speed = |name| scene.get(name)?.measured(workload)?.speed(few);
                Some(speed(name)?.median / speed(base)?.median)
            };
            Workload::ALL.into_iter().filter_map(ratio).collect()
        };
        let ratios: Vec<f64> = scenes().flat_map(of_scene).collect();
        let memory = scenes().filter_map(|scene| {
            Some(scene.get(name)?.bytes as f64 / scene.get(base)?.bytes as f64)
        });
        Some(Overall {
            name,
            speed: geometric_mean(ratios.iter().copied())?,
            ratios,
            memory: geometric_mean(memory),
        })
    };
    study.structures().into_iter().filter_map(one).collect()
}

fn strip(all: &[Overall]) -> Strip<'static> {
    let best = all.iter().map(|one| one.speed).fold(0.0, f64::max);
    let shown = all
        .iter()
        .filter(|one| one.speed * super::trade::TOO_SLOW >= best);
    let mark = |one: &Overall| {
        let range = range(&one.ratios);
        Mark {
            name: one.name.to_owned(),
            class: Family::of(one.name).class(),
            middle: one.speed,
            range,
            said: format!(
                "{} ({} to {})",
                short(one.speed),
                short(range[0]),
                short(range[1])
            ),
            begins: false,
        }
    };
    Strip {
        title: "Speed over that of bvh, by structure",
        axis: "rays a second over those of bvh: geometric mean, and from the worst to the best of scenes and rays",
        marks: shown.map(mark).collect(),
        band: None,
    }
}

fn range(ratios: &[f64]) -> [f64; 2] {
    [
        ratios.iter().copied().fold(f64::INFINITY, f64::min),
        ratios.iter().copied().fold(0.0, f64::max),
    ]
}

fn strip_sentence(all: &[Overall]) -> String {
    let mut ranked: Vec<_> = all.iter().collect();
    ranked.sort_by(|a, b| b.speed.total_cmp(&a.speed));
    let base = BOXES;
    let first = ranked[0];
    let mut text = format!("Over all scenes and rays {} is the fastest", first.name);
    if first.name != base {
        text += &format!(", {} over {base}", percent(first.speed));
    }
    let next: Vec<_> = (ranked.iter().skip(1).take(3))
        .map(|one| {
            format!(
                "{} ({} of its speed)",
                one.name,
                of(one.speed / first.speed)
            )
        })
        .collect();
    if !next.is_empty() {
        text += &format!(", then come {}", list(&next));
    }
    text += ".";
    // Who changes places the most from scene to scene.
    let wide = |one: &&&Overall| {
        let [least, most] = range(&one.ratios);
        most / least
    };
    let moody = ranked.iter().filter(|one| one.name != FORCE);
    let moody = moody.max_by(|a, b| wide(a).total_cmp(&wide(b)));
    if let Some(one) = moody
        && wide(&one) > 2.0
    {
        let [least, most] = range(&one.ratios);
        text += &format!(
            " {} depends the most on scene and rays: from {} to {} times the speed of {base}.",
            one.name,
            short(least),
            short(most)
        );
    }
    let ahead: Vec<_> = (ranked.iter())
        .filter(|one| one.name != base && one.ratios.iter().any(|&ratio| ratio > 1.05))
        .map(|one| {
            let times = one.ratios.iter().filter(|&&ratio| ratio > 1.05).count();
            format!("{} ({times} of {})", one.name, one.ratios.len())
        })
        .collect();
    if !ahead.is_empty() {
        text += &format!(
            " Somewhere, by more than 5 %, {base} is beaten by {}.",
            list(&ahead)
        );
    }
    text
}

fn of(ratio: f64) -> String {
    format!("{:.0} %", ratio * 100.0)
}

fn memory_and_speed(all: &[Overall]) -> Option<(Svg, String)> {
    let place = |one: &Overall| {
        Some(Place {
            name: one.name,
            memory: one.memory?,
            speed: one.speed,
        })
    };
    let places: Vec<_> = all.iter().filter_map(place).collect();
    let (shown, slow) = split(&places);
    let axes = ["bytes over those of bvh", "rays a second over those of bvh"];
    let scatter = scatter(&shown, "Memory against speed, over all scenes", axes);
    (!shown.is_empty()).then(|| {
        (
            scatter.draw(),
            sentence(&shown, &slow, "of the speed of bvh"),
        )
    })
}
