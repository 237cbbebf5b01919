//! Interrupted, and gone on with.

#![cfg(unix)]

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use super::json;
use crate::{fail, ombra, succeed};

/// Starts a job that takes some seconds and presses Ctrl-C after one; gives its days if it was interrupted in the
/// middle. Quick machines get more days.
fn interrupted(folder: &Path, output: &str) -> &'static str {
    for days in [
        "2026-01-01..2026-03-31",
        "2026",
        "2024-01-01..2027-12-31",
        "2010-01-01..2029-12-31",
    ] {
        let all = job(days, output);
        let mut child = ombra(
            folder,
            &[&["shadows"], &all[..], &["--quiet", "--threads", "2"]].concat(),
        )
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
        std::thread::sleep(Duration::from_millis(1500));
        let sent = Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .status();
        assert!(sent.is_ok());
        let code = child.wait().unwrap().code();
        if code == Some(130) && folder.join(format!("{output}.partial")).exists() {
            return days;
        }
    }
    panic!("too quick, or too slow to have begun");
}

fn job<'a>(days: &'a str, output: &'a str) -> [&'a str; 7] {
    ["demo", "--date", days, "--cell", "4", "-o", output]
}

#[test]
fn what_was_interrupted_goes_on_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let days = interrupted(folder.path(), "a.tif");
    assert!(path("a.tif").is_file(), "what was done is there");
    let partial = std::fs::read(path("a.tif.partial")).unwrap();

    let all = [
        &["shadows"],
        &job(days, "a.tif")[..],
        &["--resume", "--quiet"],
    ]
    .concat();
    // Of another job, or broken, it is refused and kept.
    for (more, told) in [
        (
            &["--solar-time", "10:00-12:00"][..],
            "another time (begun as",
        ),
        (&["--method", "sampled"], "another method (begun as"),
        (
            &["--on", "ground", "--min-altitude", "3"],
            "another time (begun as",
        ),
    ] {
        let talk = fail(folder.path(), &[&all[..], more].concat(), 1);
        assert!(
            talk.contains(told) && talk.contains("begun as: ombra shadows demo --date"),
            "{talk}"
        );
    }
    let mut broken = partial.clone();
    *broken.last_mut().unwrap() ^= 1;
    std::fs::write(path("a.tif.partial"), &broken).unwrap();
    let talk = fail(folder.path(), &all, 1);
    assert!(talk.contains("a.tif.partial: broken"), "{talk}");

    std::fs::write(path("a.tif.partial"), &partial).unwrap();
    let told = json(folder.path(), &all[1..all.len() - 1]);
    assert!(told["resumed"].as_u64().unwrap() > 0, "{told}");
    assert_eq!(told["done"], told["places"]);
    assert!(!path("a.tif.partial").exists());
    let resumed = std::fs::read(path("a.tif")).unwrap();

    succeed(
        folder.path(),
        &[&["shadows"], &job(days, "a.tif")[..], &["--threads", "1"]].concat(),
    );
    assert!(
        std::fs::read(path("a.tif")).unwrap() == resumed,
        "the same bytes"
    );
}

#[test]
fn nothing_to_go_on_from_begins_anew_and_what_is_not_ours_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let quick = [
        "demo",
        "--date",
        "2026-12-21",
        "--cell",
        "20",
        "-o",
        "a.parquet",
    ];
    let told = json(folder.path(), &[&quick[..], &["--resume"]].concat());
    assert_eq!(told["resumed"], 0);
    let partial = folder.path().join("a.parquet.partial");
    std::fs::write(&partial, "mine").unwrap();
    for more in [&["--resume"][..], &[]] {
        let talk = fail(
            folder.path(),
            &[&["shadows", "--quiet"], &quick[..], more].concat(),
            1,
        );
        assert!(talk.contains("none of ombra's files"), "{talk}");
    }
    assert_eq!(std::fs::read(&partial).unwrap(), b"mine");
}
