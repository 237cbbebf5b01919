//! The binary as a person meets it: arguments in, files, words and exit codes out.

mod bad_input;
mod bench;
mod compared;
mod explained;
mod interrupted;
mod lists;
mod minray;
mod pictures;
mod shadows;
mod studied;
mod terrain;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// `ombra` with these arguments, to be run in `folder`.
fn ombra(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ombra"));
    command.current_dir(folder).args(arguments);
    command
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    ombra(folder, arguments).output().expect("the binary runs")
}

/// Runs, expects success, gives what was printed on standard output.
fn succeed(folder: &Path, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    let talk = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?} failed: {talk}");
    String::from_utf8(output.stdout).expect("output is UTF-8")
}

/// Runs, expects that exit code and one line on standard error, gives it.
fn fail(folder: &Path, arguments: &[&str], code: i32) -> String {
    let output = run(folder, arguments);
    let talk = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {talk}");
    assert!(!talk.contains("panicked"), "{arguments:?}: {talk}");
    if code == 1 {
        assert_eq!(talk.trim_end().lines().count(), 1, "{arguments:?}: {talk}");
    }
    talk
}

/// The folder of outside data; says so and gives none where it is absent.
fn outside_data() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = std::env::var_os("OMBRA_TEST_DATA").map_or(beside, PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    println!(
        "skipped: no outside data in {} (OMBRA_TEST_DATA)",
        folder.display()
    );
    None
}
