//! Memory against speed: what is paid for what.

use super::figure as framed;
use crate::numbers::{list, percent, short};
use crate::plot::{Dot, Scale, Scatter};
use crate::{SceneReport, Study};

/// A structure that is slower than the fastest by more than this would press all others into a
/// corner of the plot; the sentence names it.
pub(super) const TOO_SLOW: f64 = 30.0;

/// A structure as it stands in the plot.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) name: &'static str,
    pub(super) memory: f64,
    pub(super) speed: f64,
}

pub(super) fn figure(study: &Study, scene: &SceneReport) -> String {
    let few = study.fewest_threads();
    let place = |report: &crate::StructureReport| {
        Some(Place {
            name: report.structure,
            memory: report.bytes_per_primitive,
            speed: report.speed(few)? / 1e6,
        })
    };
    let places: Vec<_> = scene.structures.iter().filter_map(place).collect();
    if places.is_empty() {
        return String::new();
    }
    let (shown, slow) = split(&places);
    let scatter = scatter(
        &shown,
        "Memory against speed",
        ["bytes a primitive", "Mrays/s"],
    );
    let says = sentence(&shown, &slow, "Mrays/s");
    framed(&scatter.draw().finish(&says), &says)
}

/// What is shown, and what is too slow for it.
pub(super) fn split(places: &[Place]) -> (Vec<Place>, Vec<Place>) {
    let best = places.iter().map(|place| place.speed).fold(0.0, f64::max);
    let fits = |place: &Place| place.speed * TOO_SLOW >= best && place.memory > 0.0;
    places.iter().copied().partition(fits)
}

pub(super) fn scatter<'a>(shown: &[Place], title: &'a str, axes: [&'a str; 2]) -> Scatter<'a> {
    Scatter {
        title,
        axes,
        scales: [
            Scale::log(shown.iter().map(|place| place.memory)),
            Scale::linear(shown.iter().map(|place| place.speed)),
        ],
        dots: shown
            .iter()
            .map(|place| Dot {
                name: place.name,
                at: [place.memory, place.speed],
            })
            .collect(),
        front: front(shown).iter().map(|place| place.name).collect(),
    }
}

/// Those that none beats on both sides, the smallest first.
fn front(places: &[Place]) -> Vec<Place> {
    let mut sorted = places.to_vec();
    sorted.sort_by(|a, b| {
        a.memory
            .total_cmp(&b.memory)
            .then(b.speed.total_cmp(&a.speed))
    });
    let mut best = 0.0;
    sorted.retain(|place| {
        let ahead = place.speed > best;
        best = place.speed.max(best);
        ahead
    });
    sorted
}

/// `unit` is said after a speed.
pub(super) fn sentence(shown: &[Place], slow: &[Place], unit: &str) -> String {
    let front = front(shown);
    let names: Vec<_> = front.iter().map(|place| place.name).collect();
    let mut text = match names.as_slice() {
        [] => String::new(),
        [one] => format!("None is smaller than {one}, and none faster."),
        _ => format!(
            "Whoever is to the upper left is better. None is both smaller and faster than {} (dashed line).",
            list(&names)
        ),
    };
    if let [small, .., fast] = front.as_slice() {
        text += &format!(
            " From one end of that line to the other, from {} to {}, memory grows {} times and speed {} times.",
            small.name,
            fast.name,
            short(fast.memory / small.memory),
            short(fast.speed / small.speed),
        );
    }
    let largest = shown.iter().max_by(|a, b| a.memory.total_cmp(&b.memory));
    let fastest = shown.iter().max_by(|a, b| a.speed.total_cmp(&b.speed));
    if let (Some(largest), Some(fastest)) = (largest, fastest)
        && largest.name != fastest.name
    {
        text += &format!(
            " {} takes the most memory, {} times that of the fastest, {}, for {} of its speed.",
            largest.name,
            short(largest.memory / fastest.memory),
            fastest.name,
            percent_of(largest.speed / fastest.speed),
        );
    }
    if !slow.is_empty() {
        let names = slow
            .iter()
            .map(|place| format!("{} ({} {unit})", place.name, short(place.speed)));
        text += &format!(
            " Too slow for this plot: {}.",
            list(&names.collect::<Vec<_>>())
        );
    }
    text
}

/// "83 %"; where it is more than all, "+12 %" over it.
fn percent_of(ratio: f64) -> String {
    if ratio > 1.0 {
        percent(ratio)
    } else {
        format!("{:.0} %", ratio * 100.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_holds_whom_none_beats_on_both_sides() {
        let place = |name, memory, speed| Place {
            name,
            memory,
            speed,
        };
        let places = [
            place("large", 90.0, 2.0),
            place("small", 10.0, 1.0),
            place("fast", 50.0, 3.0),
            place("beaten", 20.0, 0.9),
            place("slow", 5.0, 0.01),
        ];
        let (shown, slow) = split(&places);
        assert_eq!(slow.len(), 1);
        let names: Vec<_> = front(&shown).iter().map(|place| place.name).collect();
        assert_eq!(names, ["small", "fast"]);
        let says = sentence(&shown, &slow, "Mrays/s");
        for said in [
            "small and fast",
            "large takes the most memory, 1.80 times",
            "67 %",
            "slow (0.010",
        ] {
            assert!(says.contains(said), "{said}: {says}");
        }
    }
}
