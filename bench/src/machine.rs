//! On what a record was taken.

use std::fs;
use std::process::Command;

use serde::Serialize;

/// The machine and the state of the code.
#[derive(Clone, Debug, Serialize)]
pub struct Machine {
    /// The processor's name, as far as the system tells.
    pub cpu: String,
    /// How many threads it runs at a time.
    pub threads: usize,
    /// Operating system and instruction set.
    pub target: String,
    /// The commit, "-dirty" if files differ from it; "unknown" outside of a repository.
    pub commit: String,
}

impl Machine {
    /// This one.
    #[must_use]
    pub fn this() -> Self {
        Self {
            cpu: cpu().unwrap_or_else(|| "unknown".to_owned()),
            threads: std::thread::available_parallelism().map_or(1, usize::from),
            target: format!("{}-{}", std::env::consts::OS, std::env::consts::ARCH),
            commit: commit().unwrap_or_else(|| "unknown".to_owned()),
        }
    }
}

fn cpu() -> Option<String> {
    let text = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

fn commit() -> Option<String> {
    let output = Command::new("git")
        .args(["describe", "--always", "--dirty", "--abbrev=12"])
        .output()
        .ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    (output.status.success() && !text.is_empty()).then(|| text.trim().to_owned())
}
