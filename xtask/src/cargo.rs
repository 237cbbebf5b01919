//! Calls of cargo and git, and where the checkout is.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail, ensure};
use cargo_metadata::{Message, Metadata, MetadataCommand, TargetKind};

/// The root of the checkout.
pub(crate) fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The cargo that runs this.
fn program() -> OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// A command that runs in the root of the checkout.
pub(crate) fn command(program: impl AsRef<std::ffi::OsStr>) -> Command {
    let mut command = Command::new(program);
    command.current_dir(root());
    command
}

/// `cargo` with arguments, in the root of the checkout.
pub(crate) fn cargo(arguments: &str) -> Command {
    let mut command = command(program());
    command.args(arguments.split_whitespace());
    command
}

/// Runs a command to its end, its output going where ours goes.
///
/// # Errors
/// When it cannot be started, or ends in failure; the message holds the command.
pub(crate) fn run(command: &mut Command) -> Result<()> {
    let line = line(command);
    let status = command
        .status()
        .with_context(|| format!("cannot start `{line}`"))?;
    ensure!(status.success(), "`{line}` failed ({status})");
    Ok(())
}

/// Whether a command ends well in time. It is stopped if it does not end.
pub(crate) fn succeeds_within(command: &mut Command, limit: Duration) -> bool {
    let quiet = command.stdout(Stdio::null()).stderr(Stdio::null());
    let Ok(mut child) = quiet.spawn() else {
        return false;
    };
    let start = Instant::now();
    while start.elapsed() < limit {
        match child.try_wait() {
            Ok(Some(status)) => return status.success(),
            Ok(None) => std::thread::sleep(Duration::from_millis(50)),
            Err(_) => break,
        }
    }
    // Already gone, or stopped now: either way there is nothing left to do about it.
    let _ = child.kill();
    let _ = child.wait();
    false
}

/// A command as a person would type it.
fn line(command: &Command) -> String {
    let name = Path::new(command.get_program())
        .file_stem()
        .unwrap_or(command.get_program())
        .to_string_lossy()
        .into_owned();
    let words = command.get_args().map(|word| word.to_string_lossy());
    std::iter::once(name.into())
        .chain(words)
        .collect::<Vec<_>>()
        .join(" ")
}

/// What cargo knows of the workspace.
///
/// # Errors
/// When a manifest is wrong.
pub(crate) fn metadata() -> Result<Metadata> {
    MetadataCommand::new()
        .cargo_path(program())
        .current_dir(root())
        .no_deps()
        .exec()
        .context("`cargo metadata` failed")
}

/// The files that git tracks or would track, relative to the root, whose names end in one of
/// `endings`.
///
/// # Errors
/// When git fails.
pub(crate) fn tracked(endings: &[&str]) -> Result<Vec<PathBuf>> {
    let output = command("git")
        .args([
            "ls-files",
            "-z",
            "--cached",
            "--others",
            "--exclude-standard",
        ])
        .output()
        .context("cannot start `git ls-files`")?;
    ensure!(
        output.status.success(),
        "`git ls-files` failed: {}",
        String::from_utf8_lossy(&output.stderr).trim()
    );
    let mut files: Vec<_> = String::from_utf8(output.stdout)?
        .split_terminator('\0')
        .filter(|name| endings.iter().any(|ending| name.ends_with(ending)))
        .map(PathBuf::from)
        // Deleted, but not yet in the index.
        .filter(|name| root().join(name).is_file())
        .collect();
    files.sort();
    files.dedup();
    Ok(files)
}

/// Programs that the workspace builds, by name.
#[derive(Debug, Default)]
pub(crate) struct Executables {
    /// Binaries.
    pub(crate) binaries: BTreeMap<String, PathBuf>,
    /// Examples.
    pub(crate) examples: BTreeMap<String, PathBuf>,
}

/// Builds all binaries and examples, exactly as `cargo test` would, so that nothing is compiled
/// twice.
///
/// # Errors
/// When the build fails.
pub(crate) fn executables() -> Result<Executables> {
    let arguments = "build --workspace --bins --examples --profile test \
                     --message-format json-render-diagnostics";
    let mut build = cargo(arguments);
    let mut child = build.stdout(Stdio::piped()).spawn()?;
    let output = child.stdout.take().context("cargo has no output")?;
    let mut found = Executables::default();
    for message in Message::parse_stream(BufReader::new(output)) {
        let Message::CompilerArtifact(artifact) = message? else {
            continue;
        };
        let Some(path) = artifact.executable else {
            continue;
        };
        let programs = match artifact.target.kind.first() {
            Some(TargetKind::Bin) => &mut found.binaries,
            Some(TargetKind::Example) => &mut found.examples,
            _ => continue,
        };
        programs.insert(artifact.target.name, path.into());
    }
    if !child.wait()?.success() {
        bail!("`{}` failed", line(&build));
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_is_shown_as_it_would_be_typed() {
        assert_eq!(line(&cargo("fmt --all --check")), "cargo fmt --all --check");
    }

    #[test]
    fn a_failing_command_is_named_in_the_message() {
        let message = run(cargo("--no-such-flag").stderr(Stdio::null())).unwrap_err();
        assert!(
            message
                .to_string()
                .contains("`cargo --no-such-flag` failed")
        );
    }

    #[test]
    fn tracked_files_are_those_of_the_checkout() {
        let manifests = tracked(&["Cargo.toml"]).unwrap();
        assert!(manifests.contains(&PathBuf::from("xtask/Cargo.toml")));
        assert!(manifests.iter().all(|file| file.ends_with("Cargo.toml")));
    }

    #[test]
    fn a_command_that_hangs_is_stopped() {
        let mut listen = cargo("--version");
        assert!(succeeds_within(&mut listen, Duration::from_secs(60)));
        assert!(!succeeds_within(&mut cargo("--version"), Duration::ZERO));
        assert!(!succeeds_within(
            &mut cargo("--no-such-flag"),
            Duration::from_secs(60)
        ));
    }
}
