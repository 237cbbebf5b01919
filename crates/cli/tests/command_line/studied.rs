//! `study`: every structure on the same rays.

use std::fs;

use serde_json::Value;

use crate::{fail, run, succeed};

#[test]
fn a_small_study_prints_a_table_and_writes_a_page() {
    let folder = tempfile::tempdir().unwrap();
    let command = [
        "study",
        "--smoke",
        "--size",
        "12",
        "--rounds",
        "1",
        "-o",
        "study.html",
    ];
    let text = succeed(folder.path(), &command);
    for name in [
        "study:hills",
        "study:city",
        "study:stadium",
        "teapot",
        "card",
    ] {
        assert!(text.contains(&format!("\n{name}: ")), "{name}: {text}");
    }
    for words in [
        "kd-short-stack",
        "Mrays/s, 1 thr",
        "ropes against boxes",
        "a primitive",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let page = fs::read_to_string(folder.path().join("study.html")).unwrap();
    assert!(page.starts_with("<!doctype html>") && page.contains("id=\"santos\""));
    assert!(!page.contains("http:") && !page.contains("https:") && !page.contains("<script"));
    let files: Vec<_> = fs::read_dir(folder.path()).unwrap().collect();
    assert_eq!(files.len(), 1, "nothing else is left: {files:?}");
}

#[test]
fn json_holds_every_number_and_the_chosen_structures_in_their_order() {
    let folder = tempfile::tempdir().unwrap();
    let command = [
        "study",
        "cornell",
        "--accel",
        "kd-ropes,bvh,Bvh",
        "--size",
        "8x6",
        "--rounds",
        "2",
        "--threads",
        "2,1",
        "--json",
        "--quiet",
        "-o",
        "study.svg",
    ];
    let report: Value = serde_json::from_str(&succeed(folder.path(), &command)).unwrap();
    assert_eq!(report["size"], serde_json::json!([8, 6]));
    assert_eq!(report["threads"], serde_json::json!([1, 2]));
    assert_eq!(report["interrupted"], false);
    let structures = report["scenes"][0]["structures"].as_array().unwrap();
    let names: Vec<_> = structures
        .iter()
        .map(|s| s["structure"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["kd-ropes", "bvh"]);
    for structure in structures {
        assert_eq!(structure["workloads"].as_array().unwrap().len(), 4);
        for measured in structure["workloads"].as_array().unwrap() {
            assert_eq!(measured["differences"], 0);
            let speed = &measured["speeds"][1]["rays_per_second"];
            assert_eq!(speed["rounds"], 2, "{measured}");
            assert!(speed["median"].as_f64().unwrap() > 0.0);
        }
    }
    assert_eq!(report["santos"]["pairs"].as_array().unwrap().len(), 4);
    let drawing = fs::read_to_string(folder.path().join("study.svg")).unwrap();
    assert!(drawing.starts_with("<svg xmlns="));
}

#[test]
fn what_cannot_be_studied_is_said_at_once() {
    let folder = tempfile::tempdir().unwrap();
    for wrong in [
        &["study", "--accel", "no-such"][..],
        &["study", "--size", "0"],
        &["study", "--size", "4096"],
        &["study", "--threads", "1,x"],
        &["study", "-o", "page.png"],
    ] {
        fail(folder.path(), wrong, 2);
    }
    for (wrong, said) in [
        (&["study", "no-such-scene"][..], "no-such-scene"),
        (&["study", "study:nowhere"], "study:city"),
        (&["study", "-o", "no/such/page.html"], "no/such/page.html"),
    ] {
        let talk = fail(folder.path(), wrong, 1);
        assert!(talk.contains(said), "{wrong:?}: {talk}");
    }
    let quiet = [
        "study", "cornell", "--size", "4", "--rounds", "0", "--quiet",
    ];
    let output = run(folder.path(), &quiet);
    assert!(output.status.success() && output.stderr.is_empty());
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_what_is_measured_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let long = [
        "study",
        "card",
        "--size",
        "64",
        "--rounds",
        "1000",
        "-o",
        "study.html",
    ];
    let (output, _) = crate::interrupted::interrupted(folder.path(), &long);
    let talk = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{talk}");
    assert!(talk.contains("kept what was measured"), "{talk}");
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(
        text.contains("interrupted") && text.contains("kd-ropes"),
        "{text}"
    );
    let page = fs::read_to_string(folder.path().join("study.html")).unwrap();
    assert!(page.contains("was interrupted"));
}
