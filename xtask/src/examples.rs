//! Every example runs to its end.

use std::fs;
use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::cargo::{self, Executables};

/// Runs all examples, each without arguments, in a folder of its own under `target/`.
///
/// # Errors
/// The first example that fails, with what it printed.
pub(crate) fn run(executables: &Executables) -> Result<()> {
    for (name, program) in &executables.examples {
        let folder = cargo::root().join("target/examples").join(name);
        fs::create_dir_all(&folder)?;
        let output = Command::new(program)
            .current_dir(&folder)
            .output()
            .with_context(|| format!("cannot start example {name}"))?;
        ensure!(
            output.status.success(),
            "`cargo run --example {name}` failed ({}):\n{}{}",
            output.status,
            String::from_utf8_lossy(&output.stdout),
            String::from_utf8_lossy(&output.stderr)
        );
    }
    println!("{} examples run", executables.examples.len());
    Ok(())
}
