//! Commands in Markdown files exist: subcommands, flags, packages, examples.
//!
//! A word in capitals (`NAME`) stands for something that the reader puts there, and whatever follows
//! an ellipsis is left to the reader too.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use anyhow::{Context, Result, bail};
use cargo_metadata::{Metadata, TargetKind};
use clap::CommandFactory;

use crate::cargo::{self, Executables};
use crate::{Cli, links};

/// The commands of cargo that pages may use: all of them come with a toolchain.
const CARGO: [&str; 14] = [
    "add", "bench", "build", "check", "clean", "clippy", "doc", "fmt", "install", "metadata",
    "run", "test", "tree", "update",
];

/// Checks all commands.
///
/// # Errors
/// One message with every command that is wrong.
pub(crate) fn run(executables: &Executables) -> Result<()> {
    let mut manual = Manual::new(&cargo::metadata()?, executables);
    let mut findings = Vec::new();
    let mut count = 0;
    for (file, page) in links::pages()? {
        for command in &page.commands {
            count += 1;
            if let Err(wrong) = manual.check(&command.text) {
                let (file, line) = (file.display(), command.line);
                findings.push(format!("{file}:{line}: `{}`: {wrong:#}", command.text));
            }
        }
    }
    if !findings.is_empty() {
        bail!("{}", findings.join("\n"));
    }
    println!("{count} commands in pages exist");
    Ok(())
}

/// What there is to call.
struct Manual<'a> {
    packages: BTreeSet<String>,
    binaries: BTreeSet<String>,
    examples: BTreeSet<String>,
    executables: &'a Executables,
    /// The help of `ombra` by subcommand, asked for once each.
    help: BTreeMap<String, String>,
}

impl<'a> Manual<'a> {
    fn new(metadata: &Metadata, executables: &'a Executables) -> Self {
        let packages = metadata.workspace_packages();
        let targets = |kind: &TargetKind| {
            let all = packages.iter().flat_map(|package| &package.targets);
            let chosen = all.filter(|target| target.kind.contains(kind));
            chosen.map(|target| target.name.clone()).collect()
        };
        Self {
            packages: packages
                .iter()
                .map(|package| package.name.to_string())
                .collect(),
            binaries: targets(&TargetKind::Bin),
            examples: targets(&TargetKind::Example),
            executables,
            help: BTreeMap::new(),
        }
    }

    fn check(&mut self, command: &str) -> Result<()> {
        let known = |word: &&str| *word != "…" && *word != "...";
        let words: Vec<_> = command.split(' ').take_while(known).collect();
        match words.as_slice() {
            ["cargo", "xtask", rest @ ..] => xtask(rest),
            ["cargo", rest @ ..] => self.cargo(rest),
            ["ombra", rest @ ..] => self.ombra(rest),
            _ => Ok(()),
        }
    }

    fn cargo(&mut self, words: &[&str]) -> Result<()> {
        let split = words.iter().position(|word| *word == "--");
        let (ours, theirs) = words.split_at(split.unwrap_or(words.len()));
        let Some(subcommand) = ours.iter().find(|word| !word.starts_with(['+', '-'])) else {
            return Ok(());
        };
        if !CARGO.contains(subcommand) {
            bail!("cargo has no command \"{subcommand}\"");
        }
        for pair in ours.windows(2) {
            let (kind, known) = match pair[0] {
                "-p" | "--package" => ("package", &self.packages),
                "--bin" => ("binary", &self.binaries),
                "--example" => ("example", &self.examples),
                _ => continue,
            };
            if !is_placeholder(pair[1]) && !known.contains(pair[1]) {
                bail!("there is no {kind} \"{}\"", pair[1]);
            }
        }
        let elsewhere = |word: &&str| matches!(*word, "-p" | "--package" | "--example");
        let runs_ombra = *subcommand == "run" && !ours.iter().any(elsewhere);
        match theirs {
            [_, rest @ ..] if runs_ombra => self.ombra(rest),
            _ => Ok(()),
        }
    }

    fn ombra(&mut self, words: &[&str]) -> Result<()> {
        let mut subcommand = match words.first() {
            Some(word) if is_subcommand(word) => (*word).to_owned(),
            _ => String::new(),
        };
        // A command may have commands of its own.
        if let [first, second, ..] = words
            && subcommand == *first
            && has_command(self.help_of(&subcommand)?, second)
        {
            subcommand = format!("{first} {second}");
        }
        let help = self.help_of(&subcommand)?;
        for word in words.iter().filter(|word| word.starts_with("--")) {
            let flag = word.split_once('=').map_or(*word, |(flag, _)| flag);
            let ends = |c: char| !(c.is_alphanumeric() || c == '-');
            if !help.split(ends).any(|there| there == flag) {
                bail!("`ombra {subcommand} --help` does not know {flag}");
            }
        }
        Ok(())
    }

    /// What `ombra SUBCOMMAND --help` says, asked for once.
    fn help_of(&mut self, subcommand: &str) -> Result<&str> {
        if !self.help.contains_key(subcommand) {
            let help = help(self.executables, subcommand)?;
            self.help.insert(subcommand.to_owned(), help);
        }
        Ok(&self.help[subcommand])
    }
}

/// Whether a help lists a command.
fn has_command(help: &str, command: &str) -> bool {
    let (_, after) = help.split_once("Commands:\n").unwrap_or_default();
    let lines = after.lines().take_while(|line| !line.is_empty());
    let named = |line: &str| {
        line.strip_prefix("  ")?
            .split(' ')
            .next()
            .map(str::to_owned)
    };
    lines.filter_map(named).any(|name| name == command)
}

/// Whether a word stands for something else, as `NAME` and `<FILE>` do.
fn is_placeholder(word: &str) -> bool {
    let open = |c: char| c.is_uppercase() || c == '<' || c == '$';
    word.contains(open)
}

/// Whether the first word of a call of `ombra` is a command: neither a flag nor a file.
fn is_subcommand(word: &str) -> bool {
    !word.starts_with('-') && !word.contains(['.', '/']) && !is_placeholder(word)
}

/// What `ombra SUBCOMMAND --help` says.
fn help(executables: &Executables, subcommand: &str) -> Result<String> {
    let ombra = executables.binaries.get("ombra");
    let ombra = ombra.context("the workspace builds no binary \"ombra\"")?;
    let output = Command::new(ombra)
        .args(subcommand.split_whitespace().chain(["--help"]))
        .output()
        .context("cannot start ombra")?;
    if !output.status.success() {
        bail!("ombra has no command \"{subcommand}\"");
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Checks a call of `cargo xtask` against its own definition.
fn xtask(words: &[&str]) -> Result<()> {
    let words = std::iter::once("cargo xtask").chain(words.iter().copied());
    match Cli::command().try_get_matches_from(words) {
        Err(error) if error.use_stderr() => bail!("{}", error.kind()),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn manual(executables: &Executables) -> Manual<'_> {
        let names = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect();
        let help = "Usage: ombra render [--spp <N>] [--max-depth=<N>]";
        let nested =
            "Commands:\n  query  Answers\n         render shadows\n\nOptions:\n  --date <DAYS>";
        Manual {
            packages: names(&["ombra-accel"]),
            binaries: names(&["ombra"]),
            examples: names(&["01_ray_triangle"]),
            executables,
            help: BTreeMap::from([
                ("render".to_owned(), help.to_owned()),
                ("shadows".to_owned(), nested.to_owned()),
                ("shadows query".to_owned(), "--building <ID>".to_owned()),
            ]),
        }
    }

    #[test]
    fn commands_that_exist_pass() {
        for command in [
            "cargo run --release",
            "cargo xtask test",
            "cargo xtask --help",
            "cargo +nightly test -p ombra-accel -- --ignored",
            "cargo test -p ombra-NAME",
            "cargo run --example 01_ray_triangle",
            "cargo run --release -- render --spp 4",
            "ombra render FILE.obj --max-depth=3",
            "ombra render … --whatever",
            "ombra shadows render --date 2026",
            "ombra shadows query a.parquet --building 1",
        ] {
            let executables = Executables::default();
            let answer = manual(&executables).check(command);
            assert!(answer.is_ok(), "{command}: {answer:?}");
        }
    }

    #[test]
    fn commands_that_do_not_exist_are_refused() {
        for (command, reason) in [
            ("cargo frobnicate", "cargo has no command \"frobnicate\""),
            ("cargo xtask frobnicate", "unrecognized subcommand"),
            (
                "cargo test -p ombra-attic",
                "there is no package \"ombra-attic\"",
            ),
            (
                "cargo run --example 99_all",
                "there is no example \"99_all\"",
            ),
            (
                "ombra render --sp 4",
                "`ombra render --help` does not know --sp",
            ),
            (
                "cargo run -- render --max",
                "`ombra render --help` does not know --max",
            ),
            (
                "ombra shadows query a.parquet --date 2026",
                "`ombra shadows query --help` does not know --date",
            ),
            (
                "ombra shadows a.geojson --building 1",
                "`ombra shadows --help` does not know --building",
            ),
            (
                "ombra frobnicate",
                "the workspace builds no binary \"ombra\"",
            ),
        ] {
            let executables = Executables::default();
            let answer = manual(&executables).check(command).unwrap_err().to_string();
            assert!(answer.contains(reason), "{command}: {answer}");
        }
    }
}
