//! The command line of ombra.
//!
//! Results go to standard output, talk to standard error. Exit code 0 is success, 1 failure, 2
//! wrong usage, 130 interrupted.

mod args;
mod commands;
mod interrupt;
mod preview;
mod progress;

use std::io::{self, Write as _};
use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command};

fn main() -> ExitCode {
    let outcome = match Cli::parse().command {
        None => commands::render::default_scene(),
        Some(Command::Render(args)) => commands::render::run(&args),
        Some(Command::Compare(args)) => commands::compare::run(&args),
        Some(Command::Shadows(args)) => commands::shadows::run(&args),
        Some(Command::Study(args)) => commands::study::run(&args),
        Some(Command::Minray(command)) => commands::minray::run(&command),
        Some(Command::Explain(args)) => commands::explain::run(&args),
        Some(Command::Bench(args)) => commands::bench::run(&args),
        Some(Command::Info(args)) => commands::info::run(&args),
        Some(Command::Scenes(args)) => commands::lists::scenes(&args),
        Some(Command::Structures(args)) => commands::lists::structures(&args),
    };
    match outcome {
        Ok(code) => code,
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            // Nobody is left to tell if this fails.
            let _ = writeln!(io::stderr(), "ombra: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Whether somebody like `head` has read enough of the output.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    let io = error.downcast_ref::<io::Error>();
    io.is_some_and(|io| io.kind() == io::ErrorKind::BrokenPipe)
}
