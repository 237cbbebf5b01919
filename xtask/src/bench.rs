//! What benches need that is not built here.

use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};

use crate::cargo;

/// The wheel that carries Embree, with the hash that it must have.
const WHEEL: &str = "xtask/embree.txt";

/// Where the program looks for it.
const PEERS: &str = "target/peers";

/// The folder of the wheel that holds the library and what it needs beside it.
const LIBRARIES: &str = "embreex.libs";

/// What to do for benches.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct Options {
    /// Fetch the shared library of Embree from PyPI to target/peers, for `ombra bench --against embree`
    #[arg(long, required = true)]
    setup: bool,
}

/// Fetches Embree, unless it is there.
///
/// # Errors
/// When it is not made for this machine, or cannot be fetched.
pub(crate) fn run(options: Options) -> Result<()> {
    ensure!(options.setup, "there is nothing to do but --setup");
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        bail!("Embree is fetched for Linux on x86-64 only");
    }
    let peers = cargo::root().join(PEERS);
    let libraries = peers.join(LIBRARIES);
    if !libraries.is_dir() {
        fetch(&peers)?;
    }
    ensure!(
        libraries.is_dir(),
        "the wheel has no folder {LIBRARIES}: {}",
        peers.display()
    );
    println!("Embree is in {PEERS}/{LIBRARIES}");
    Ok(())
}

/// Fetches the wheel and unpacks it. pip compares the hash.
fn fetch(peers: &Path) -> Result<()> {
    std::fs::create_dir_all(peers).with_context(|| format!("cannot make {}", peers.display()))?;
    let wheels = peers.join("wheels");
    let mut download = python(
        "-m pip download --quiet --no-deps --only-binary :all: --require-hashes \
         --implementation cp --python-version 3.11 --platform manylinux_2_28_x86_64",
    );
    download.args(["-r", WHEEL, "-d"]).arg(&wheels);
    cargo::run(&mut download).context("cannot fetch Embree's wheel from PyPI")?;
    let entries = wheels.read_dir()?.flatten().map(|entry| entry.path());
    let wheel = entries
        .into_iter()
        .find(|path| path.extension().is_some_and(|ending| ending == "whl"));
    let wheel = wheel.context("pip left no wheel")?;
    // A wheel is a zip file.
    let unpacked = peers.join("unpacked");
    let mut unzip = python("-m zipfile -e");
    cargo::run(unzip.arg(wheel).arg(&unpacked))?;
    // Moved last, so that what is there is all there.
    std::fs::rename(unpacked.join(LIBRARIES), peers.join(LIBRARIES))
        .context("the wheel is packed in another way than was expected")?;
    std::fs::remove_dir_all(unpacked).context("cannot clean up")
}

fn python(arguments: &str) -> Command {
    let mut command = cargo::command("python3");
    command.args(arguments.split_whitespace());
    command
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wheel_that_is_fetched_is_the_one_that_the_program_names() {
        let root = cargo::root();
        let fetched = std::fs::read_to_string(root.join(WHEEL)).unwrap();
        let library = root.join("bench/src/against/embree/library.rs");
        let named = std::fs::read_to_string(library).unwrap();
        let name = named.split('"').find(|text| text.starts_with("embreex "));
        let pinned = name.unwrap().replace(' ', "==");
        assert!(fetched.contains(&pinned), "{pinned}");
        assert!(fetched.contains("--hash=sha256:"));
    }
}
