//! `scenes`, `structures`, `info` and help.

use crate::succeed;

#[test]
fn every_built_in_scene_is_listed_and_renders() {
    let folder = tempfile::tempdir().unwrap();
    let listed = succeed(folder.path(), &["scenes", "--json"]);
    let listed: Vec<serde_json::Value> = serde_json::from_str(&listed).unwrap();
    assert!(listed.len() >= 4);
    for scene in listed {
        let name = scene["name"].as_str().unwrap();
        let out = format!("{name}.png");
        let small = ["--size", "48x32", "--spp", "1"];
        succeed(
            folder.path(),
            &[&["render", name, "-o", &out], &small[..]].concat(),
        );
        assert!(folder.path().join(out).is_file(), "{name}");
    }
}

#[test]
fn every_structure_of_the_lecture_is_listed_with_a_line() {
    let folder = tempfile::tempdir().unwrap();
    let listed = succeed(folder.path(), &["structures"]);
    for name in [
        "brute-force",
        "grid",
        "grid2",
        "octree",
        "kd-stack",
        "kd-restart",
        "kd-short-stack",
        "kd-ropes",
        "bih",
        "bvh",
        "bvh-median",
        "bvh-lbvh",
    ] {
        let line = listed
            .lines()
            .find(|line| line.split_whitespace().next() == Some(name));
        let line = line.unwrap_or_else(|| panic!("{name} is not listed"));
        assert!(line.split_whitespace().count() > 3, "{line}");
    }
}

#[test]
fn help_names_every_command() {
    let folder = tempfile::tempdir().unwrap();
    let help = succeed(folder.path(), &["--help"]);
    for command in [
        "render",
        "compare",
        "study",
        "explain",
        "minray",
        "bench",
        "info",
        "scenes",
        "structures",
    ] {
        assert!(help.contains(command), "{help}");
    }
}

#[test]
fn info_says_what_a_model_holds() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\n";
    std::fs::write(folder.path().join("some.obj"), obj).unwrap();
    let info = succeed(folder.path(), &["info", "some.obj", "--json"]);
    let info: serde_json::Value = serde_json::from_str(&info).unwrap();
    assert_eq!(info["triangles"], 2, "{info}");
    assert!(succeed(folder.path(), &["info", "some.obj"]).contains("OBJ"));
}
