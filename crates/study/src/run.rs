//! All scenes, one after the other.

use ombra::LoadError;
use ombra::accel::StructureKind;
use ombra::pipeline::Cpu;
use ombra::scene::SceneError;

use crate::contest::{Contest, steps};
use crate::santos::Santos;
use crate::watch::Steps;
use crate::{Machine, Settings, Study, Subject, Watch, Workload};

/// Why there is no study.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// Two structures give different answers: times would mean nothing.
    #[error(
        "{scene}: \"{structure}\" answers {differences} of {rays} {workload} rays unlike \
         \"{reference}\"; one of the two is wrong, and their times mean nothing"
    )]
    AnswersDiffer {
        /// In which scene.
        scene: String,
        /// Who answers differently.
        structure: StructureKind,
        /// From whom.
        reference: StructureKind,
        /// To what rays.
        workload: Workload,
        /// How many of them.
        differences: usize,
        /// Of how many.
        rays: usize,
    },
    /// A scene cannot be loaded.
    #[error(transparent)]
    Load(LoadError),
    /// A generated scene cannot be made.
    #[error("{0}")]
    Scene(String),
    /// A scene does not fit together.
    #[error(transparent)]
    Description(#[from] SceneError),
    /// The operating system gives no threads.
    #[error("cannot start {0} threads")]
    Threads(usize),
}

/// Measures. A study that is stopped holds what was measured until then.
///
/// # Errors
/// When two structures give different answers, a scene does not fit together, or there are no
/// threads.
pub fn study(
    subjects: Vec<Subject>,
    settings: &Settings,
    watch: &Watch<'_>,
) -> Result<Study, StudyError> {
    let cpus = cpus(&settings.threads)?;
    let total = subjects.len() as u64 * steps(settings, cpus.len());
    let mut steps = Steps::new(watch, total);
    let mut scenes = Vec::with_capacity(subjects.len());
    for subject in &subjects {
        scenes.extend(Contest::run(subject, settings, &cpus, &mut steps)?);
    }
    let mut study = Study {
        format: 1,
        ombra: env!("CARGO_PKG_VERSION"),
        machine: Machine::this(),
        size: settings.size,
        rounds: settings.rounds,
        threads: cpus.iter().map(Cpu::threads).collect(),
        seed: settings.seed,
        interrupted: steps.is_stopped(),
        scenes,
        santos: None,
    };
    study.santos = Santos::of(&study);
    Ok(study)
}

/// Threads by their number, the fewest first, each number once.
fn cpus(threads: &[usize]) -> Result<Vec<Cpu>, StudyError> {
    let one =
        |&threads: &usize| Cpu::with_threads(threads).map_err(|_| StudyError::Threads(threads));
    let wanted: &[usize] = if threads.is_empty() { &[1] } else { threads };
    let mut cpus = wanted.iter().map(one).collect::<Result<Vec<_>, _>>()?;
    cpus.sort_by_key(Cpu::threads);
    cpus.dedup_by_key(|cpu| cpu.threads());
    Ok(cpus)
}
