//! One scene: all structures built, their answers compared, their steps counted, their times taken
//! in turns.

use std::time::Instant;

use ombra::accel::{Statistics, StructureKind};
use ombra::geometry::Ray;
use ombra::pipeline::Cpu;
use ombra::scene::{Scene, World};

use crate::asked::{self, Answers};
use crate::rays;
use crate::report::{Build, Cost, Measured, RaySet, SceneReport, Speed, StructureReport};
use crate::run::StudyError;
use crate::watch::Steps;
use crate::{Distribution, Settings, Spread, Subject, Workload};

/// How many nodes and tests one job may take; with more it gets fewer rays. A few seconds.
const AFFORDABLE: u64 = 100_000_000;

/// The same for testing everything, which would take most of the time of a study otherwise and does
/// not need many rays to show what it costs: about a tenth of a second.
const AFFORDABLE_BY_FORCE: u64 = 2_000_000;

/// How many rays are tried to see what one costs.
const TRIED: usize = 64;

/// Once building one structure has taken so many seconds on the clock, it is not built again.
const BUILD_SECONDS: f64 = 10.0;

/// The rays of one kind, and what all must answer.
struct Job {
    workload: Workload,
    rays: Vec<Ray>,
    answers: Answers,
}

/// A structure and what was measured of it.
struct Contestant {
    kind: StructureKind,
    world: World,
    /// Seconds, by thread setting and round.
    builds: Vec<Vec<f64>>,
    tasks: Vec<Task>,
}

/// A contestant's part in a job.
struct Task {
    /// Its own rays, where it gets fewer.
    fewer: Option<Vec<Ray>>,
    cost: Cost,
    /// Seconds, by thread setting and round.
    times: Vec<Vec<f64>>,
}

impl Task {
    fn rays<'a>(&'a self, job: &'a Job) -> &'a [Ray] {
        self.fewer.as_deref().unwrap_or(&job.rays)
    }
}

/// One scene with all who take part.
pub(crate) struct Contest<'a> {
    subject: &'a Subject,
    cpus: &'a [Cpu],
    jobs: Vec<Job>,
    primitives: usize,
    contestants: Vec<Contestant>,
}

/// How many jobs a scene is, for who looks on.
pub(crate) fn steps(settings: &Settings, cpus: usize) -> u64 {
    let kinds = settings.kinds.len();
    let timed = settings.rounds * cpus * kinds * (1 + Workload::ALL.len());
    (1 + kinds + timed) as u64
}

impl<'a> Contest<'a> {
    /// Runs it all, or as much as there is time for. `None` if there was none.
    pub(crate) fn run(
        subject: &'a Subject,
        settings: &Settings,
        cpus: &'a [Cpu],
        steps: &mut Steps<'_>,
    ) -> Result<Option<SceneReport>, StudyError> {
        let name = &subject.name;
        if !steps.next(|| format!("{name}: making rays")) {
            return Ok(None);
        }
        let all = &cpus[cpus.len() - 1];
        let mut contest = Self::new(subject, settings, cpus, all)?;
        for &kind in &settings.kinds {
            if !steps.next(|| format!("{name}: counting the steps of {kind}")) {
                break;
            }
            contest.enter(kind, all)?;
        }
        for round in 0..settings.rounds {
            contest.round(round, settings.rounds, steps)?;
        }
        Ok((!contest.contestants.is_empty()).then(|| contest.report()))
    }

    /// Rays and answers come from the default structure, whether it takes part or not.
    fn new(
        subject: &'a Subject,
        settings: &Settings,
        cpus: &'a [Cpu],
        all: &Cpu,
    ) -> Result<Self, StudyError> {
        let world = build(&subject.scene, StructureKind::default(), all)?;
        let rays = rays::all(&world, settings.size, settings.seed);
        let jobs = Workload::ALL.into_iter().zip(rays).map(|(workload, rays)| {
            let mut answers = Answers::places(workload.asks_any(), rays.len());
            all.install(|| asked::time(&world, &rays, &mut answers));
            Job {
                workload,
                rays,
                answers,
            }
        });
        Ok(Self {
            subject,
            cpus,
            jobs: jobs.collect(),
            primitives: world.primitives(),
            contestants: Vec::new(),
        })
    }

    /// Lets a structure take part: its answers are compared, alone and in batches, and its steps are
    /// counted.
    fn enter(&mut self, kind: StructureKind, cpu: &Cpu) -> Result<(), StudyError> {
        let world = build(&self.subject.scene, kind, cpu)?;
        let mut tasks = Vec::with_capacity(self.jobs.len());
        for job in &self.jobs {
            let any = job.workload.asks_any();
            let chosen = affordable(kind, &world, job, cpu);
            let fewer = (chosen.len() < job.rays.len())
                .then(|| chosen.iter().map(|&i| job.rays[i]).collect::<Vec<_>>());
            let rays = fewer.as_deref().unwrap_or(&job.rays);
            let (alone, costs) = cpu.install(|| asked::count(&world, rays, any));
            let mut together = Answers::places(any, rays.len());
            cpu.install(|| asked::time(&world, rays, &mut together));
            for answers in [&alone, &together] {
                let differences = answers.differences(&job.answers, chosen.iter().copied());
                if differences > 0 {
                    return Err(StudyError::AnswersDiffer {
                        scene: self.subject.name.clone(),
                        structure: kind,
                        reference: StructureKind::default(),
                        workload: job.workload,
                        differences,
                        rays: rays.len(),
                    });
                }
            }
            let of = |count: fn(&Statistics) -> u64| Distribution::of(costs.iter().map(count));
            let cost = Cost {
                nodes_visited: of(|cost| cost.nodes_visited),
                tests_made: of(|cost| cost.tests_made),
            };
            tasks.push(Task {
                fewer,
                cost,
                times: vec![Vec::new(); self.cpus.len()],
            });
        }
        self.contestants.push(Contestant {
            kind,
            world,
            builds: vec![Vec::new(); self.cpus.len()],
            tasks,
        });
        Ok(())
    }

    /// One round: everybody builds, then everybody answers each kind of rays, beginning with another
    /// one each time.
    fn round(
        &mut self,
        round: usize,
        rounds: usize,
        steps: &mut Steps<'_>,
    ) -> Result<(), StudyError> {
        let count = self.contestants.len();
        for (threads, cpu) in self.cpus.iter().enumerate() {
            let name = &self.subject.name;
            let doing = |what: &str, kind: StructureKind| {
                let (round, on) = (round + 1, cpu.threads());
                format!("{name}: round {round} of {rounds}, {what}, {kind}, {on} thr")
            };
            for turn in 0..count {
                let contestant = &mut self.contestants[(round + turn) % count];
                let kind = contestant.kind;
                if !steps.next(|| doing("building", kind)) {
                    return Ok(());
                }
                let times = &mut contestant.builds[threads];
                if times.iter().sum::<f64>() > BUILD_SECONDS {
                    continue;
                }
                let scene = self.subject.scene.clone();
                let begun = Instant::now();
                let world = cpu.install(|| World::build(scene, kind))?;
                times.push(begun.elapsed().as_secs_f64());
                drop(world);
            }
            for (index, job) in self.jobs.iter().enumerate() {
                let mut answers = Answers::places(job.workload.asks_any(), job.rays.len());
                for turn in 0..count {
                    let contestant = &mut self.contestants[(round + turn) % count];
                    let kind = contestant.kind;
                    if !steps.next(|| doing(job.workload.name(), kind)) {
                        return Ok(());
                    }
                    let task = &mut contestant.tasks[index];
                    let rays = task.rays(job);
                    answers.cut(rays.len());
                    if !rays.is_empty() {
                        let world = &contestant.world;
                        let seconds = cpu.install(|| asked::time(world, rays, &mut answers));
                        task.times[threads].push(seconds);
                    }
                }
            }
        }
        Ok(())
    }

    fn report(self) -> SceneReport {
        let threads: Vec<usize> = self.cpus.iter().map(Cpu::threads).collect();
        let primitives = self.primitives;
        let structures = self.contestants.iter().map(|contestant| {
            let workloads = self.jobs.iter().zip(&contestant.tasks);
            let bytes = contestant.world.structure_bytes();
            StructureReport {
                structure: contestant.kind.name(),
                bytes,
                bytes_per_primitive: bytes as f64 / primitives.max(1) as f64,
                builds: (threads.iter().zip(&contestant.builds))
                    .map(|(&threads, times)| Build {
                        threads,
                        seconds: Spread::of(times),
                    })
                    .collect(),
                workloads: workloads
                    .map(|(job, task)| measured(job, task, &threads))
                    .collect(),
            }
        });
        SceneReport {
            scene: self.subject.name.clone(),
            line: self.subject.line,
            primitives,
            workloads: (self.jobs.iter())
                .map(|job| RaySet {
                    workload: job.workload,
                    rays: job.rays.len(),
                    hits: job.answers.hits(),
                })
                .collect(),
            structures: structures.collect(),
        }
    }
}

fn measured(job: &Job, task: &Task, threads: &[usize]) -> Measured {
    let rays = task.rays(job).len();
    let speeds = threads.iter().zip(&task.times).map(|(&threads, times)| {
        let rates: Vec<f64> = times.iter().map(|seconds| rays as f64 / seconds).collect();
        Speed {
            threads,
            rays_per_second: Spread::of(&rates),
        }
    });
    Measured {
        workload: job.workload,
        rays,
        differences: 0,
        cost: task.cost,
        speeds: speeds.collect(),
    }
}

fn build(scene: &Scene, kind: StructureKind, cpu: &Cpu) -> Result<World, StudyError> {
    Ok(cpu.install(|| World::build(scene.clone(), kind))?)
}

/// Which of a job's rays a structure gets: all, or every so many where all would take too long.
fn affordable(kind: StructureKind, world: &World, job: &Job, cpu: &Cpu) -> Vec<usize> {
    let all = job.rays.len();
    let spread = |count: usize| -> Vec<usize> { (0..count).map(|i| i * all / count).collect() };
    let tried: Vec<Ray> = spread(all.min(TRIED))
        .iter()
        .map(|&i| job.rays[i])
        .collect();
    let (_, costs) = cpu.install(|| asked::count(world, &tried, job.workload.asks_any()));
    let cost: Statistics = costs.into_iter().sum();
    let steps = (cost.nodes_visited + cost.tests_made) / tried.len().max(1) as u64;
    let affordable = match kind {
        StructureKind::BruteForce => AFFORDABLE_BY_FORCE,
        _ => AFFORDABLE,
    };
    let most = affordable / steps.max(1);
    spread(all.min(most.max(TRIED as u64) as usize))
}
