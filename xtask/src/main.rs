//! What the house checks about itself: `cargo xtask test` is everything that CI runs.
//!
//! One file a task. None of them imports a crate of ombra, so that the checks build in seconds and
//! run on a tree that does not compile.

mod aarch64;
mod bench;
mod cargo;
mod commands;
mod deny;
mod examples;
mod formula;
mod layers;
mod licences;
mod links;
mod markdown;
mod members;
mod pictures;
mod site;
mod test;
mod words;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// The upkeep of the checkout.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    task: Task,
}

#[derive(Debug, Subcommand)]
enum Task {
    /// Run everything that CI runs, quick checks first; stop at the first that fails
    Test,
    /// Check who imports whom against the table in xtask/src/layers.rs
    Layers,
    /// Check dependencies with cargo-deny: bans, licences, sources, advisories
    Deny,
    /// Build the website in target/docs and check the pages: links lead somewhere, formulas can be
    /// set, commands exist, and those that make pictures work
    Docs,
    /// Compile everything for AArch64, where kernels have instructions of their own
    Aarch64,
    /// Get what benches need that is not built here
    Bench(bench::Options),
    /// Check what all crates share, the licence files, and the words that files may not hold
    House,
    /// Render the committed pictures of README.md and docs/ again
    Pictures(pictures::Options),
}

fn docs() -> anyhow::Result<()> {
    links::run()?;
    site::run()?;
    let executables = cargo::executables()?;
    commands::run(&executables)?;
    pictures::check(&executables)
}

fn main() -> ExitCode {
    let done = match Cli::parse().task {
        Task::Test => return test::run(),
        Task::Layers => layers::run(),
        Task::Deny => deny::run(),
        Task::Docs => docs(),
        Task::Aarch64 => aarch64::run(),
        Task::Bench(options) => bench::run(options),
        Task::House => members::run()
            .and_then(|()| licences::run())
            .and_then(|()| words::run()),
        Task::Pictures(options) => pictures::run(&options),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {error:#}");
            ExitCode::FAILURE
        }
    }
}
