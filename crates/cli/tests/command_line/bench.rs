//! `bench`: little is traced here, and no number is looked at.

use crate::{fail, run, succeed};

#[test]
fn parts_of_ombra_are_listed_and_compared() {
    let folder = tempfile::tempdir().unwrap();
    let listed = succeed(folder.path(), &["bench", "--list"]);
    assert!(listed.starts_with("whitted "), "{listed}");
    let few = ["--rounds", "0", "--size", "16", "--detail", "4"];
    let arguments = [&["bench", "whitted"], &few[..]].concat();
    assert!(succeed(folder.path(), &arguments).contains("same answer"));
    let json = succeed(folder.path(), &[&arguments[..], &["--json"]].concat());
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["records"][0]["bench"], "whitted");
    let talk = fail(folder.path(), &["bench", "no-such"], 2);
    assert!(talk.contains("--list"), "{talk}");
}

#[test]
fn ombra_is_held_against_itself_and_the_record_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let smoke = ["bench", "--against", "ombra", "--smoke", "--threads", "1"];
    let tables = succeed(folder.path(), &smoke);
    assert!(tables.contains("## interior, "), "{tables}");
    let kept = [&smoke[..], &["--json", "--quiet", "--record", "kept"]].concat();
    let output = run(folder.path(), &kept);
    assert!(output.status.success() && output.stderr.is_empty());
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["records"][0]["bench"], "against");
    let machines: Vec<_> = std::fs::read_dir(folder.path().join("kept"))
        .unwrap()
        .collect();
    assert_eq!(machines.len(), 1);
    let files = std::fs::read_dir(machines[0].as_ref().unwrap().path()).unwrap();
    assert_eq!(files.count(), 2);
}

#[test]
fn a_peer_that_is_unknown_is_wrong_usage_and_one_that_is_not_there_a_failure() {
    let folder = tempfile::tempdir().unwrap();
    let talk = fail(folder.path(), &["bench", "--against", "no-such"], 2);
    assert!(talk.contains("embree"), "{talk}");
    fail(folder.path(), &["bench", "--smoke"], 2);
    fail(folder.path(), &["bench", "whitted", "--smoke"], 2);
    fail(
        folder.path(),
        &["bench", "whitted", "--against", "ombra"],
        2,
    );
    let here = ["bench", "--against", "embree", "--embree", "."];
    let talk = fail(folder.path(), &here, 1);
    for part in ["cargo xtask bench --setup", "--embree", "OMBRA_EMBREE"] {
        assert!(talk.contains(part), "{talk}");
    }
    let scene = ["bench", "--against", "ombra", "--scenes", "no-such"];
    let talk = fail(folder.path(), &[&scene[..], &["--quiet"]].concat(), 1);
    assert!(talk.contains("interior, dragon, city"), "{talk}");
}
