//! Ctrl-C in the middle.

#![cfg(unix)]

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use crate::ombra;

/// Runs what takes minutes and presses Ctrl-C; gives what was said, and how long it took to stop.
pub(crate) fn interrupted(folder: &Path, arguments: &[&str]) -> (Output, Duration) {
    let child = ombra(folder, arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // Long enough to have begun, on any machine.
    std::thread::sleep(Duration::from_secs(3));
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(sent.success());
    let begun = Instant::now();
    let output = child.wait_with_output().unwrap();
    (output, begun.elapsed())
}

#[test]
fn ctrl_c_keeps_what_is_done_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let long = [
        "render", "whitted", "-o", "a.png", "--size", "400x300", "--spp", "100000",
    ];
    let (output, stopping) = interrupted(folder.path(), &long);
    assert!(stopping < Duration::from_secs(20), "it stops soon");
    let talk = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{talk}");
    assert!(talk.contains("interrupted at"), "{talk}");
    let picture = std::fs::read(folder.path().join("a.png")).unwrap();
    assert!(picture.starts_with(b"\x89PNG"));
}
