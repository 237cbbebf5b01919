//! What is wrong is said once, clearly, with the right exit code.

use crate::{fail, outside_data, run};

#[test]
fn wrong_usage_is_exit_code_2() {
    let folder = tempfile::tempdir().unwrap();
    let wrong: &[&[&str]] = &[
        &["no-such-command"],
        &["render"],
        &["render", "whitted"],
        &["render", "whitted", "-o", "a.png", "--size", "0x10"],
        &["render", "whitted", "-o", "a.png", "--size", "65537x1"],
        &["render", "whitted", "-o", "a.png", "--max-depth", "129"],
        &["render", "whitted", "-o", "a.png", "--spp", "0"],
        &["render", "whitted", "-o", "a.png", "--spp", "many"],
        &["render", "whitted", "-o", "a.png", "--integrator", "magic"],
        &["render", "whitted", "-o", "a.png", "--accel", "magic"],
        &[
            "render",
            "whitted",
            "-o",
            "a.png",
            "--triangle-test",
            "magic",
        ],
        &["render", "whitted", "-o", "a.png", "--device", "toaster"],
        &["render", "whitted", "-o", "a.png", "--crop", "5,5,5,9"],
        &["render", "whitted", "-o", "a.png", "--no-such-flag"],
    ];
    for arguments in wrong {
        fail(folder.path(), arguments, 2);
    }
    let unknown = ["render", "whitted", "-o", "a.png", "--accel", "magic"];
    let talk = fail(folder.path(), &unknown, 2);
    assert!(talk.contains("kd-ropes"), "the names are listed: {talk}");
    let talk = fail(folder.path(), &["render", "whitted", "-o", "a.jpeg"], 2);
    assert!(talk.contains("png, exr, pfm, ppm"), "endings, too: {talk}");
    assert_eq!(
        std::fs::read_dir(folder.path()).unwrap().count(),
        0,
        "nothing was written"
    );
}

#[test]
fn failure_is_exit_code_1_and_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let failing: &[(&[&str], &str)] = &[
        (&["render", "no-such-scene", "-o", "a.png"], "whitted"),
        (
            &["render", "whitted", "-o", "no/such/folder/a.png"],
            "folder",
        ),
        (
            &["render", "whitted", "-o", "a.png", "--device", "gpu"],
            "--device cpu",
        ),
        (
            &[
                "render",
                "whitted",
                "-o",
                "a.png",
                "--crop",
                "0,0,9999,9999",
            ],
            "9999",
        ),
        (&["render", ".", "-o", "a.png"], "."),
        (&["info", "no-such-file.obj"], "no-such-file.obj"),
    ];
    for (arguments, said) in failing {
        let talk = fail(folder.path(), arguments, 1);
        assert!(talk.contains(said), "{arguments:?}: {talk}");
    }
    assert_eq!(
        std::fs::read_dir(folder.path()).unwrap().count(),
        0,
        "nothing was written"
    );
}

#[test]
fn a_wrong_scene_file_is_told_by_line() {
    let folder = tempfile::tempdir().unwrap();
    let wrong = [
        ("lights = 3", ":1: "),
        (
            "\n[[objects]]\nshape.sphere = { centre = [0, 0, 0] }",
            "radius",
        ),
        ("\n[[objects]]\nshape.blob = { centre = [0, 0, 0] }", "blob"),
        (
            "\n[[objects]]\nmaterial = \"gold\"\nshape.sphere = { centre = [0, 0, 0], radius = 1 }",
            "gold",
        ),
        ("\n[[objects]]\nmesh.file = \"../secret.obj\"", "outside"),
        ("\n[[objects]]\nmesh.file = \"missing.obj\"", "missing.obj"),
        ("[picture]\nsize = [0, 5]", "size"),
        (
            "[camera]\nposition = [0, 0, 0]\nlook_at = [0, 0, 0]",
            "direction",
        ),
    ];
    for (text, said) in wrong {
        std::fs::write(folder.path().join("wrong.toml"), text).unwrap();
        let talk = fail(folder.path(), &["render", "wrong.toml", "-o", "a.png"], 1);
        assert!(
            talk.contains("wrong.toml:") && talk.contains(said),
            "{text:?}: {talk}"
        );
    }
}

#[test]
fn broken_models_end_in_one_line_and_no_picture() {
    let Some(data) = outside_data() else { return };
    let folder = tempfile::tempdir().unwrap();
    for (file, said) in [
        ("nan_vertices.obj", "2"),
        ("index_beyond.obj", "5"),
        ("wrong_counts.ply", "vertex"),
        ("huge_counts.ply", "too short"),
        ("bomb.ply.gz", "bomb.ply.gz"),
        ("texture_bomb.png", "texture_bomb.png"),
        ("bad_base64.gltf", "base64"),
        ("bad_magic.glb", "glTF"),
        ("cyclic_nodes.glb", "cycle"),
        ("empty.glb", "empty"),
        ("huge_counts.glb", "48000000000"),
        ("index_past_vertices.glb", "9999"),
        ("missing_bin.gltf", "not_there.bin"),
        ("path_traversal.gltf", "not opened"),
        ("truncated.glb", "25756"),
    ] {
        let path = data.join("bad").join(file);
        let path = path.to_str().unwrap();
        let talk = fail(
            folder.path(),
            &["render", path, "-o", "a.png", "--size", "8x8"],
            1,
        );
        assert!(talk.contains(file) && talk.contains(said), "{file}: {talk}");
        assert!(!folder.path().join("a.png").exists(), "{file}");
    }
}

#[test]
fn degenerate_triangles_are_left_out_and_counted() {
    let Some(data) = outside_data() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = data.join("bad/zero_area.obj");
    let path = path.to_str().unwrap();
    let output = run(
        folder.path(),
        &["render", path, "-o", "a.png", "--size", "8x8"],
    );
    let talk = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{talk}");
    assert!(talk.contains("3 degenerate triangles"), "{talk}");
}
