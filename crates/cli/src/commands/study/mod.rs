//! `ombra study`: every structure on the same rays.

mod args;

use std::io::{self, Write as _};
use std::path::Path;
use std::process::ExitCode;

use anyhow::Context as _;
use ombra::formats::{can_write_whole, write_whole};
use ombra_study::{DEFAULT_SCENES, Settings, Study, Subject, Watch, study};

use super::Talk;
use crate::interrupt;
use crate::progress::Jobs;
use args::Format;
pub(crate) use args::StudyArgs;

pub(crate) fn run(args: &StudyArgs) -> anyhow::Result<ExitCode> {
    let talk = Talk { quiet: args.quiet };
    for alias in args.accel.iter().filter_map(|accel| accel.alias) {
        talk.say(&alias.to_string());
    }
    let settings = args.settings();
    if let Some(path) = &args.output {
        can_write_whole(path)?;
    }
    let stop = interrupt::watch(args.quiet)?;
    let subjects = load(args, &settings, &talk)?;
    let jobs = Jobs::unless(args.quiet);
    let progress = |progress: ombra_study::Progress<'_>| {
        jobs.update(progress.done, progress.total, progress.doing);
    };
    let watch = Watch {
        stop: Some(&stop),
        progress: Some(&progress),
    };
    let found = study(subjects, &settings, &watch);
    jobs.finish();
    let found = found?;
    if found.interrupted && found.scenes.is_empty() {
        talk.say("interrupted before there was anything to keep; nothing written");
        return Ok(ExitCode::from(interrupt::EXIT_CODE));
    }
    let text = if args.json {
        serde_json::to_string_pretty(&found)? + "\n"
    } else {
        found.table()
    };
    // Before the page: who only reads the text should not wait, and who reads no further still gets it.
    let printed = io::stdout().write_all(text.as_bytes());
    if let Some(path) = &args.output {
        write(path, &found)?;
        talk.say(&path.display().to_string());
    }
    printed?;
    if found.interrupted {
        talk.say("interrupted; kept what was measured until then");
        return Ok(ExitCode::from(interrupt::EXIT_CODE));
    }
    Ok(ExitCode::SUCCESS)
}

fn load(args: &StudyArgs, settings: &Settings, talk: &Talk) -> anyhow::Result<Vec<Subject>> {
    let names: Vec<&str> = if args.scenes.is_empty() {
        DEFAULT_SCENES.to_vec()
    } else {
        args.scenes.iter().map(String::as_str).collect()
    };
    let mut subjects = Vec::with_capacity(names.len());
    for name in names {
        let subject = Subject::load(name, settings)?;
        for finding in &subject.findings {
            talk.say(&format!("{name}: {finding}"));
        }
        if subject.scene.objects.is_empty() {
            talk.say(&format!("{name}: no objects; rays have nothing to hit"));
        }
        subjects.push(subject);
    }
    Ok(subjects)
}

fn write(path: &Path, found: &Study) -> anyhow::Result<()> {
    let content = match Format::of(path) {
        Some(Format::Drawing) => found.drawing().context(
            "nothing to draw: the plot sets structures against bvh, and these were not both on the clock",
        )?,
        _ => found.page(),
    };
    Ok(write_whole(path, content.as_bytes())?)
}
