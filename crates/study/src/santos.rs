//! What Santos and others found in 2014, and what we find.
//!
//! Santos, Teixeira, Farias, Teichrieb, Kelner, "Review and Comparative Study of Ray Traversal
//! Algorithms on a Modern GPU Architecture", WSCG 2014: of all that they compared on the graphics
//! processor of the time, a kd-tree walked along ropes was the fastest, by 13 to 71 % over their
//! bounding volume hierarchy, and took up to 9 times its memory.

use serde::Serialize;

use crate::spread::geometric_mean;
use crate::{SceneReport, StructureReport, Study, Workload};

/// The structure that was the fastest in their study.
pub(crate) const ROPES: &str = "kd-ropes";
/// What they compared it with.
pub(crate) const BOXES: &str = "bvh";
/// The same tree as the ropes', walked with a stack.
pub(crate) const STACK: &str = "kd-stack";

/// By how much ropes were faster in their study, as a ratio.
pub(crate) const THEIRS: [f64; 2] = [1.13, 1.71];
/// Up to how many times the memory they took in their study.
pub(crate) const THEIR_MEMORY: f64 = 9.0;

/// Ropes against boxes in all that was measured, on the fewest threads.
#[derive(Clone, Debug, Serialize)]
pub struct Santos {
    /// Every scene with every kind of rays.
    pub pairs: Vec<Pair>,
    /// Rays a second of ropes over those of boxes: the geometric mean over all pairs.
    pub speed: f64,
    /// Bytes of ropes over those of boxes, least and most over the scenes.
    pub memory: [f64; 2],
    /// Rays a second of ropes over those of a stack on the same tree, where that was measured: the
    /// geometric mean.
    pub speed_over_stack: Option<f64>,
    /// Nodes visited, ropes over a stack.
    pub nodes_over_stack: Option<f64>,
    /// Nodes visited, ropes over boxes.
    pub nodes: Option<f64>,
    /// Tests made, ropes over boxes.
    pub tests: Option<f64>,
}

/// One scene with one kind of rays.
#[derive(Clone, Debug, Serialize)]
pub struct Pair {
    /// Which scene.
    pub scene: String,
    /// Which rays.
    pub workload: Workload,
    /// Rays a second of ropes over those of boxes: of the medians.
    pub speed: f64,
    /// The same with the quartiles that are against ropes, and with those for them.
    pub speed_range: [f64; 2],
    /// Bytes of ropes over those of boxes.
    pub memory: f64,
    /// How that compares with theirs.
    pub verdict: Verdict,
}

/// How a ratio of speeds compares with the 13 to 71 % of 2014.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Ropes are ahead by more.
    More,
    /// Ropes are ahead by as much.
    Agrees,
    /// Ropes are ahead by less.
    Less,
    /// Boxes are ahead.
    Opposite,
}

impl Verdict {
    fn of(ratio: f64) -> Self {
        match () {
            () if ratio > THEIRS[1] => Self::More,
            () if ratio >= THEIRS[0] => Self::Agrees,
            () if ratio > 1.0 => Self::Less,
            () => Self::Opposite,
        }
    }

    /// For people.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::More => "ropes ahead, by more than theirs",
            Self::Agrees => "ropes ahead, as theirs",
            Self::Less => "ropes ahead, by less than theirs",
            Self::Opposite => "boxes ahead",
        }
    }
}

impl Santos {
    pub(crate) fn of(study: &Study) -> Option<Self> {
        let threads = study.fewest_threads();
        let pairs: Vec<Pair> = (study.scenes.iter())
            .flat_map(|scene| pairs(scene, threads))
            .collect();
        let speed = geometric_mean(pairs.iter().map(|pair| pair.speed))?;
        let memory = pairs.iter().map(|pair| pair.memory);
        let memory = [
            memory.clone().fold(f64::INFINITY, f64::min),
            memory.fold(0.0, f64::max),
        ];
        let over = |other: &str, of: &dyn Fn(&StructureReport) -> Option<f64>| {
            let ratio = |scene: &SceneReport| Some(of(scene.get(ROPES)?)? / of(scene.get(other)?)?);
            geometric_mean(study.timed_scenes().filter_map(ratio))
        };
        Some(Self {
            pairs,
            speed,
            memory,
            speed_over_stack: over(STACK, &|report| report.speed(threads)),
            nodes_over_stack: over(STACK, &|report| Some(report.steps()[0])),
            nodes: over(BOXES, &|report| Some(report.steps()[0])),
            tests: over(BOXES, &|report| Some(report.steps()[1])),
        })
    }

    /// How many pairs are so.
    pub(crate) fn count(&self, verdict: Verdict) -> usize {
        self.pairs
            .iter()
            .filter(|pair| pair.verdict == verdict)
            .count()
    }
}

fn pairs(scene: &SceneReport, threads: usize) -> Vec<Pair> {
    let (Some(ropes), Some(boxes)) = (scene.get(ROPES), scene.get(BOXES)) else {
        return Vec::new();
    };
    let pair = |workload| {
        let of = |report: &StructureReport| report.measured(workload)?.speed(threads);
        let (ropes_speed, boxes_speed) = (of(ropes)?, of(boxes)?);
        let speed = ropes_speed.median / boxes_speed.median;
        Some(Pair {
            scene: scene.scene.clone(),
            workload,
            speed,
            speed_range: [
                ropes_speed.lower_quartile / boxes_speed.upper_quartile,
                ropes_speed.upper_quartile / boxes_speed.lower_quartile,
            ],
            memory: ropes.bytes as f64 / boxes.bytes.max(1) as f64,
            verdict: Verdict::of(speed),
        })
    };
    Workload::ALL.into_iter().filter_map(pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_they_found_is_between_thirteen_and_seventy_one_percent() {
        for (ratio, verdict) in [
            (0.5, Verdict::Opposite),
            (1.0, Verdict::Opposite),
            (1.12, Verdict::Less),
            (1.13, Verdict::Agrees),
            (1.71, Verdict::Agrees),
            (1.72, Verdict::More),
        ] {
            assert_eq!(Verdict::of(ratio), verdict, "{ratio}");
        }
    }
}
