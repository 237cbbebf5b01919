//! What a study found: what `--json` prints, and what tables and pages are made of.

use ombra::accel::StructureKind;
use serde::Serialize;

use crate::santos::Santos;
use crate::spread::geometric_mean;
use crate::{Distribution, Machine, Spread, Workload};

/// Everything.
#[derive(Clone, Debug, Serialize)]
pub struct Study {
    /// The version of the names in here.
    pub format: u32,
    /// The version of ombra.
    pub ombra: &'static str,
    /// On what it ran.
    pub machine: Machine,
    /// Width and height of the picture that primary rays are of.
    pub size: [u32; 2],
    /// How many rounds were wanted.
    pub rounds: usize,
    /// On how many threads, the fewest first.
    pub threads: Vec<usize>,
    /// What random numbers came from.
    pub seed: u64,
    /// Whether it was stopped before the end.
    pub interrupted: bool,
    /// A scene each.
    pub scenes: Vec<SceneReport>,
    /// Ropes against boxes, as in the study of 2014; `None` unless both were measured.
    pub santos: Option<Santos>,
}

/// One scene.
#[derive(Clone, Debug, Serialize)]
pub struct SceneReport {
    /// As it was asked for.
    pub scene: String,
    /// What it is, in one line; empty for files.
    pub line: &'static str,
    /// How many primitives rays can meet.
    pub primitives: usize,
    /// The rays that all structures got.
    pub workloads: Vec<RaySet>,
    /// The structures, in the order of the list.
    pub structures: Vec<StructureReport>,
}

/// The rays of one kind.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct RaySet {
    /// Which kind.
    pub workload: Workload,
    /// How many.
    pub rays: usize,
    /// How many of them hit anything.
    pub hits: usize,
}

/// One structure in one scene.
#[derive(Clone, Debug, Serialize)]
pub struct StructureReport {
    /// Its name.
    pub structure: &'static str,
    /// Bytes of the structure alone, on both levels.
    pub bytes: usize,
    /// The same over the number of primitives.
    pub bytes_per_primitive: f64,
    /// How long building took, by the number of threads.
    pub builds: Vec<Build>,
    /// What its rays cost, by their kind.
    pub workloads: Vec<Measured>,
}

/// How long building took.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Build {
    /// On how many threads.
    pub threads: usize,
    /// Seconds; nothing where no round was on the clock.
    pub seconds: Option<Spread>,
}

/// What the rays of one kind cost in one structure.
#[derive(Clone, Debug, Serialize)]
pub struct Measured {
    /// Which kind.
    pub workload: Workload,
    /// How many rays: fewer than there are where all would take too long.
    pub rays: usize,
    /// How many answers were not those of the others: 0, or there is no report.
    pub differences: usize,
    /// What one ray does.
    pub cost: Cost,
    /// How fast rays are, by the number of threads.
    pub speeds: Vec<Speed>,
}

/// What one ray does.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Cost {
    /// Nodes visited.
    pub nodes_visited: Distribution,
    /// Primitives tested.
    pub tests_made: Distribution,
}

/// How fast rays are.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Speed {
    /// On how many threads.
    pub threads: usize,
    /// Rays a second; nothing where no round was on the clock.
    pub rays_per_second: Option<Spread>,
}

impl Study {
    /// The fewest threads that were used, to which single numbers belong.
    pub(crate) fn fewest_threads(&self) -> usize {
        self.threads.first().copied().unwrap_or(1)
    }

    /// The most, if there are more.
    pub(crate) fn more_threads(&self) -> Option<usize> {
        self.threads
            .last()
            .copied()
            .filter(|&most| most > self.fewest_threads())
    }

    /// Scenes in which something was on the clock.
    pub(crate) fn timed_scenes(&self) -> impl Iterator<Item = &SceneReport> {
        let threads = self.fewest_threads();
        self.scenes
            .iter()
            .filter(move |scene| scene.is_timed(threads))
    }

    /// The names of all structures in all scenes, in the order of the list.
    pub(crate) fn structures(&self) -> Vec<&'static str> {
        let there = |name: &&str| self.scenes.iter().any(|scene| scene.get(name).is_some());
        StructureKind::ALL
            .iter()
            .map(|kind| kind.name())
            .filter(there)
            .collect()
    }
}

impl SceneReport {
    /// One structure by name.
    pub(crate) fn get(&self, structure: &str) -> Option<&StructureReport> {
        self.structures
            .iter()
            .find(|report| report.structure == structure)
    }

    pub(crate) fn is_timed(&self, threads: usize) -> bool {
        self.structures
            .iter()
            .any(|report| report.speed(threads).is_some())
    }

    /// What was measured on fewer rays than there are: structure, kind, how many of how many.
    pub(crate) fn subsets(&self) -> Vec<(&'static str, Workload, usize, usize)> {
        let all = |workload| {
            self.workloads
                .iter()
                .find(move |set| set.workload == workload)
        };
        let mut found = Vec::new();
        for report in &self.structures {
            for measured in &report.workloads {
                if let Some(set) = all(measured.workload)
                    && measured.rays < set.rays
                {
                    found.push((report.structure, set.workload, measured.rays, set.rays));
                }
            }
        }
        found
    }
}

impl StructureReport {
    pub(crate) fn measured(&self, workload: Workload) -> Option<&Measured> {
        self.workloads
            .iter()
            .find(|measured| measured.workload == workload)
    }

    /// Seconds of building.
    pub(crate) fn build(&self, threads: usize) -> Option<Spread> {
        let build = self.builds.iter().find(|build| build.threads == threads);
        build.and_then(|build| build.seconds)
    }

    /// Rays a second over all kinds that have rays: the geometric mean, in which none counts more than
    /// another.
    pub(crate) fn speed(&self, threads: usize) -> Option<f64> {
        let speeds: Option<Vec<f64>> = self
            .workloads
            .iter()
            .filter(|measured| measured.rays > 0)
            .map(|measured| measured.speed(threads).map(|speed| speed.median))
            .collect();
        geometric_mean(speeds?)
    }

    /// The mean number of nodes and of tests of a ray, over all kinds that have rays.
    pub(crate) fn steps(&self) -> [f64; 2] {
        let with_rays = || self.workloads.iter().filter(|measured| measured.rays > 0);
        let mean = |of: fn(&Cost) -> f64| {
            let sum: f64 = with_rays().map(|measured| of(&measured.cost)).sum();
            sum / with_rays().count().max(1) as f64
        };
        [
            mean(|cost| cost.nodes_visited.mean),
            mean(|cost| cost.tests_made.mean),
        ]
    }
}

impl Measured {
    pub(crate) fn speed(&self, threads: usize) -> Option<Spread> {
        let speed = self.speeds.iter().find(|speed| speed.threads == threads);
        speed.and_then(|speed| speed.rays_per_second)
    }
}
