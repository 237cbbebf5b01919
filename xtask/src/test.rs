//! Everything that CI runs, in order, the quick checks first.
//!
//! Time is compiling, so everything is compiled once: `clippy` and `doc` share one set of
//! metadata, `aarch64` makes its own for another processor; binaries, examples and tests share one
//! set of libraries in the test profile. No flags are passed through `RUSTFLAGS`, which would compile
//! all dependencies again.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use anyhow::{Context, Result};

use crate::cargo::{self, Executables};
use crate::{
    aarch64, commands, deny, examples, layers, licences, links, members, pictures, site, words,
};

/// What earlier steps leave to later ones.
#[derive(Default)]
struct Found {
    executables: Executables,
}

/// One step: its name and what it does.
type Step = (&'static str, fn(&mut Found) -> Result<()>);

/// All of them.
const STEPS: &[Step] = &[
    ("format", |_| {
        cargo::run(&mut cargo::cargo("fmt --all --check"))
    }),
    ("layers", |_| layers::run()),
    ("members", |_| members::run()),
    ("licences", |_| licences::run()),
    ("words", |_| words::run()),
    ("links", |_| links::run()),
    ("site", |_| site::run()),
    ("deny", |_| deny::run()),
    ("clippy", |_| {
        cargo::run(&mut cargo::cargo(
            "clippy --workspace --all-targets -- -D warnings",
        ))
    }),
    ("aarch64", |_| aarch64::run()),
    ("doc", |_| {
        let mut doc = cargo::cargo("doc --workspace --no-deps");
        cargo::run(doc.env("RUSTDOCFLAGS", "-D warnings"))
    }),
    ("build", |found| {
        found.executables = cargo::executables()?;
        Ok(())
    }),
    ("test", |_| {
        cargo::run(&mut cargo::cargo("test --workspace"))
    }),
    ("examples", |found| examples::run(&found.executables)),
    ("commands", |found| commands::run(&found.executables)),
    ("pictures", |found| pictures::check(&found.executables)),
];

/// Runs all steps, or all up to the first that fails.
pub(crate) fn run() -> ExitCode {
    let start = Instant::now();
    let mut found = Found::default();
    let mut times = Vec::new();
    for (index, (name, step)) in STEPS.iter().enumerate() {
        println!("==> {name} ({} of {})", index + 1, STEPS.len());
        let begun = Instant::now();
        if let Err(error) = step(&mut found).with_context(|| format!("{name} failed")) {
            eprintln!("{error:#}");
            eprintln!("xtask: {index} passed, 1 failed");
            return ExitCode::FAILURE;
        }
        times.push(begun.elapsed());
    }
    println!("{}", summary(&times, start.elapsed()));
    ExitCode::SUCCESS
}

/// The time of each step, and how many there were.
fn summary(times: &[Duration], total: Duration) -> String {
    let mut text = String::new();
    for ((name, _), time) in STEPS.iter().zip(times) {
        text += &format!("{name:>10} {:7.1} s\n", time.as_secs_f64());
    }
    text += &format!("{:>10} {:7.1} s\n", "total", total.as_secs_f64());
    text + &format!("xtask: {} passed, 0 failed", times.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_summary_ends_with_the_count() {
        let text = summary(&[Duration::from_millis(1500); 2], Duration::from_secs(3));
        assert_eq!(
            text,
            "    format     1.5 s\n    layers     1.5 s\n     total     3.0 s\nxtask: 2 passed, 0 failed"
        );
    }

    #[test]
    fn steps_have_names_of_their_own() {
        for (index, (name, _)) in STEPS.iter().enumerate() {
            assert!(
                STEPS[..index].iter().all(|(other, _)| other != name),
                "{name}"
            );
        }
    }
}
