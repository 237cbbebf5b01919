//! `ombra minray`: the minimal ray tracing contest, from its scenes to its scores.

mod render;
mod verify;

use std::path::Path;
use std::process::ExitCode;

use anyhow::bail;
use ombra::accel::StructureKind;
use ombra::builtin::{self, Builtin, BuiltinKind};
use ombra::formats::minray::{Contest, ContestPicture, read_contest};
use ombra::pipeline::Cpu;
use ombra::render::{Settings, Watch};
use ombra::scene::World;

use crate::args::MinrayCommand;
use crate::interrupt;

pub(crate) fn run(command: &MinrayCommand) -> anyhow::Result<ExitCode> {
    match command {
        MinrayCommand::Render(args) => render::run(args),
        MinrayCommand::Verify(args) => verify::run(args),
    }
}

/// The scene of that name: a `ray.h`, or one of those that come with ombra.
fn contest(scene: &str) -> anyhow::Result<Contest> {
    if let Some(contest) = scenes()
        .find(|builtin| scene == builtin.name || scene == short_name(builtin))
        .and_then(Builtin::contest)
    {
        return Ok(contest?);
    }
    if Path::new(scene).exists() {
        return Ok(read_contest(scene)?);
    }
    let known: Vec<_> = scenes().map(short_name).collect();
    bail!(
        "{scene}: no such file, and no scene of the contest of that name (there are: {})",
        known.join(", ")
    )
}

/// The contest's own scenes.
fn scenes() -> impl Iterator<Item = &'static Builtin> {
    let all = builtin::ALL.iter();
    all.filter(|builtin| builtin.kind == BuiltinKind::Contest)
}

/// What the contest calls one of its scenes.
fn short_name(builtin: &Builtin) -> &'static str {
    let of_contest = builtin.name.strip_prefix("minray:");
    of_contest.unwrap_or(crate::args::FIRST_OF_CONTEST)
}

/// Renders a scene of the contest; `None` if it was interrupted.
fn picture(contest: &Contest) -> anyhow::Result<Option<ContestPicture>> {
    let stop = interrupt::watch(true)?;
    let settings = contest.picture().settings(Settings::default());
    settings.validate()?;
    let world = World::build(contest.scene(), StructureKind::default())?;
    let camera = ombra::camera(&world, settings.aspect());
    let watch = Watch {
        stop: Some(&stop),
        ..Watch::default()
    };
    let cpu = Cpu::all_threads();
    let rendering = ombra::render::render(&world, &camera, &settings, &cpu, watch)?;
    let light = rendering.raw();
    let whole = !rendering.stopped;
    Ok(whole.then(|| ContestPicture::from_light(contest.size, contest.size, &light)))
}
