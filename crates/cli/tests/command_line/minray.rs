//! `ombra minray`: the contest's pictures and its rules.

use crate::{fail, run, succeed};

#[test]
fn a_picture_of_its_own_is_accepted() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for scene in ["test1", "test2", "minray:test3"] {
        let picture = succeed(folder, &["minray", "render", scene]);
        std::fs::write(folder.join("a.ap"), &picture).unwrap();
        let score = succeed(folder, &["minray", "verify", "a.ap", "--scene", scene]);
        assert!(score.starts_with("accepted"), "{score}");
        assert!(score.contains("largest difference 0,"), "{score}");
        assert_eq!(
            succeed(folder, &["minray", "render", scene, "-o", "b.ap"]),
            ""
        );
        assert_eq!(
            std::fs::read_to_string(folder.join("b.ap")).unwrap(),
            picture
        );
    }
    assert!(succeed(folder, &["minray", "render"]).starts_with("32 32\n"));
}

#[test]
fn a_picture_that_is_off_is_rejected_and_told_where() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let picture = succeed(folder, &["minray", "render"]);
    // The pixel at column 3 of row 1, after the line with the size.
    let mut lines: Vec<_> = picture.lines().map(str::to_owned).collect();
    let number = 1 + 32 + 3;
    let mut pixel: Vec<i32> = lines[number]
        .split(' ')
        .map(|n| n.parse().unwrap())
        .collect();
    pixel[2] += 11;
    lines[number] = format!("{} {} {}", pixel[0], pixel[1], pixel[2]);
    std::fs::write(folder.join("a.ap"), lines.join("\n")).unwrap();
    let output = run(folder, &["minray", "verify", "a.ap"]);
    assert_eq!(output.status.code(), Some(1));
    let score = String::from_utf8(output.stdout).unwrap();
    assert!(
        score.starts_with("rejected: scene test1, 1 of 1024 pixels"),
        "{score}"
    );
    let json = run(folder, &["minray", "verify", "a.ap", "--json"]);
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(json["accepted"], false);
    assert_eq!(json["worst"][0]["x"], 3);
    assert_eq!(json["worst"][0]["y"], 1);
    assert_eq!(json["worst"][0]["difference"], 11.0);
}

#[test]
fn a_scene_of_ones_own_is_rendered() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let scene = "#define DEPTH 1\n#define SIZE 3\n#define AOV 40\n#define NSPHERE 0\n\
        AMBIENT = {1, .5, 0};\nSPHERE = {};\n";
    std::fs::write(folder.join("ray.h"), scene).unwrap();
    let picture = succeed(folder, &["minray", "render", "ray.h"]);
    assert_eq!(picture, format!("3 3\n{}", "255 128 0\n".repeat(9)));
}

#[test]
fn what_is_wrong_is_said_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("ray.h"), "#define DEPTH 1\n#define SIZE x\n").unwrap();
    let talk = fail(folder, &["minray", "render", "ray.h"], 1);
    assert!(talk.contains("ray.h:2: SIZE is \"x\""), "{talk}");
    let talk = fail(folder, &["minray", "render", "test9"], 1);
    assert!(talk.contains("test1, test2, test3"), "{talk}");
    std::fs::write(folder.join("a.ap"), "2 2\n1 2 3\n").unwrap();
    let talk = fail(folder, &["minray", "verify", "a.ap"], 1);
    assert!(talk.contains("a.ap:2: "), "{talk}");
    std::fs::write(folder.join("a.ap"), "1 1\n1 2 3\n").unwrap();
    let talk = fail(folder, &["minray", "verify", "a.ap"], 1);
    assert!(talk.contains("1x1") && talk.contains("32x32"), "{talk}");
    fail(folder, &["minray", "verify"], 2);
    fail(folder, &["minray"], 2);
}
