//! `ombra scenes` and `ombra structures`: what there is, with a line each.

use std::io::{self, Write as _};
use std::process::ExitCode;

use ombra::accel::StructureKind;
use serde::Serialize;

use crate::args::ListArgs;

#[derive(Serialize)]
struct Entry {
    name: &'static str,
    description: &'static str,
    default: bool,
}

pub(crate) fn scenes(args: &ListArgs) -> anyhow::Result<ExitCode> {
    let first = ombra::builtin::DEFAULT;
    let entries = ombra::builtin::ALL.iter().map(|scene| Entry {
        name: scene.name,
        description: scene.line,
        default: scene.name == first,
    });
    print(&entries.collect::<Vec<_>>(), args)
}

pub(crate) fn structures(args: &ListArgs) -> anyhow::Result<ExitCode> {
    let entries = StructureKind::ALL.iter().map(|&kind| Entry {
        name: kind.name(),
        description: kind.line(),
        default: kind == StructureKind::default(),
    });
    print(&entries.collect::<Vec<_>>(), args)
}

fn print(entries: &[Entry], args: &ListArgs) -> anyhow::Result<ExitCode> {
    let mut out = io::stdout().lock();
    if args.json {
        writeln!(out, "{}", serde_json::to_string_pretty(entries)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    let width = entries
        .iter()
        .map(|entry| entry.name.len())
        .max()
        .unwrap_or(0);
    for Entry {
        name,
        description,
        default,
    } in entries
    {
        let mark = if *default { " (default)" } else { "" };
        writeln!(out, "{name:width$}  {description}{mark}")?;
    }
    Ok(ExitCode::SUCCESS)
}
