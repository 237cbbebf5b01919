//! Whether everything compiles for AArch64, where the kernels have instructions of their own.
//!
//! It is compiled and not run. What is made of those instructions is run by the tests on any machine,
//! through a twin of them.

use std::process::Command;
use std::time::Duration;

use anyhow::Result;

use crate::cargo;

/// What is compiled for.
const TARGET: &str = "aarch64-unknown-linux-gnu";

/// How long the standard library for it may take to arrive.
const FETCH_LIMIT: Duration = Duration::from_secs(300);

/// Runs clippy, which looks at all that `cargo check` does, for the target; fetches what that needs
/// where it is missing. To check needs no linker and no library of the target's.
///
/// # Errors
/// When something does not compile, or clippy finds something.
pub(crate) fn run() -> Result<()> {
    if !is_installed() {
        println!("installing the standard library for {TARGET}");
        let mut add = cargo::command("rustup");
        add.args(["target", "add", TARGET]);
        if !cargo::succeeds_within(&mut add, FETCH_LIMIT) || !is_installed() {
            println!(
                "{TARGET}: SKIPPED, its standard library is not here and `rustup target add \
                 {TARGET}` does not work: there is no rustup, or no network"
            );
            return Ok(());
        }
    }
    let mut clippy = cargo::cargo("clippy --workspace --target");
    cargo::run(clippy.args([TARGET, "--", "-D", "warnings"]))
}

/// Whether the compiler has a standard library for the target.
fn is_installed() -> bool {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    has_standard_library(cargo::command(rustc).args(["--target", TARGET]))
}

/// The same of a compiler that was told a target.
fn has_standard_library(rustc: &mut Command) -> bool {
    let Ok(output) = rustc.args(["--print", "target-libdir"]).output() else {
        return false;
    };
    let folder = String::from_utf8_lossy(&output.stdout);
    let files = std::fs::read_dir(folder.trim());
    files.is_ok_and(|mut files| {
        files.any(|file| {
            file.is_ok_and(|file| file.file_name().as_encoded_bytes().starts_with(b"libstd-"))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_target_without_a_standard_library_is_told_from_one_that_has_it() {
        assert!(has_standard_library(&mut cargo::command("rustc")));
        let mut none = cargo::command("rustc");
        assert!(!has_standard_library(
            none.args(["--target", "no-such-target"])
        ));
        assert!(!has_standard_library(&mut cargo::command(
            "no-such-program"
        )));
    }
}
