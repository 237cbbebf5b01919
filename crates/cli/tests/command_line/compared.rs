//! `compare`: both loops over one scene.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::{fail, run, succeed};

const SMALL: [&str; 2] = ["--size", "240x150"];
const ONE: [&str; 2] = ["--spp", "1"];

fn numbers(folder: &Path, scene: &str, more: &[&str]) -> Value {
    let command = [&["compare", scene, "--json", "--quiet"], &SMALL[..], more].concat();
    serde_json::from_str(&succeed(folder, &command)).unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn both_see_the_same_in_built_in_scenes() {
    let folder = tempfile::tempdir().unwrap();
    for scene in ["teapot", "cornell", "shapes", "whitted"] {
        // Not in the middle of pixels: the walls of the square box would meet exactly there.
        let report = numbers(folder.path(), scene, &["-o", scene, "--spp", "4"]);
        let seen = &report["visibility"];
        assert!(seen["share"].as_f64().unwrap() >= 0.999, "{scene}: {seen}");
        assert_eq!(seen["differing_elsewhere"], 0, "{scene}: {seen}");
        let shading = &report["shading"];
        let (equal, pixels) = (&shading["within_one"], &shading["pixels"]);
        let share = equal.as_f64().unwrap() / pixels.as_f64().unwrap();
        assert!(share >= 0.995, "{scene}: {shading}");
        for rows in ["resolutions", "primitives"] {
            assert_eq!(report[rows].as_array().unwrap().len(), 3, "{scene}");
        }
    }
}

#[test]
fn where_an_edge_runs_through_the_middle_of_pixels_either_side_may_be_seen() {
    let folder = tempfile::tempdir().unwrap();
    // The walls of the box meet in lines at 45 degrees through the middle of a square picture.
    let square = [
        "compare", "cornell", "--json", "--size", "200x200", "--spp", "1",
    ];
    let report: Value = serde_json::from_str(&succeed(folder.path(), &square)).unwrap();
    let seen = &report["visibility"];
    assert!(seen["share"].as_f64().unwrap() >= 0.99, "{seen}");
    assert_eq!(seen["differing_elsewhere"], 0, "{seen}");
}

#[test]
fn pictures_and_a_page_that_needs_nothing_else_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let text = succeed(
        folder.path(),
        &[&["compare", "teapot"], &SMALL[..], &ONE].concat(),
    );
    for words in [
        "the same primitive is seen in",
        "coverage tests",
        "intersection tests",
    ] {
        assert!(text.contains(words), "{text}");
    }
    assert_eq!(names(folder.path()), ["teapot-compared"]);
    let results = folder.path().join("teapot-compared");
    let files = ["difference.png", "index.html", "raster.png", "whitted.png"];
    assert_eq!(names(&results), files);
    let page = fs::read_to_string(results.join("index.html")).unwrap();
    assert_eq!(page.matches("src=\"data:image/png;base64,").count(), 3);
    assert_eq!(
        page.matches("src=").count(),
        3,
        "nothing comes from elsewhere"
    );
    for elsewhere in ["http:", "https:", "@import", "<link", "fetch("] {
        assert!(!page.contains(elsewhere), "{elsewhere}");
    }
    for needed in [
        "type=\"range\"",
        "<label for=\"wipe\">",
        "name=\"viewport\"",
        "lang=\"en\"",
        "alt=\"",
    ] {
        assert!(page.contains(needed), "{needed}");
    }
    // Again into the same folder: the files are replaced, and they are the same.
    let raster = fs::read(results.join("raster.png")).unwrap();
    let more = ["-o", "teapot-compared", "--threads", "1", "--spp", "1"];
    numbers(folder.path(), "teapot", &more);
    assert_eq!(names(&results), files);
    assert!(raster == fs::read(results.join("raster.png")).unwrap());
}

#[test]
fn the_numbers_do_not_depend_on_the_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let with = |threads| {
        let mut report = numbers(
            folder.path(),
            "shapes",
            &["--threads", threads, "--spp", "2"],
        );
        let fields = report.as_object_mut().unwrap();
        fields.remove("seconds");
        fields.remove("threads");
        report
    };
    assert_eq!(with("1"), with("5"));
}

#[test]
fn a_crop_of_one_pixel_is_compared() {
    let folder = tempfile::tempdir().unwrap();
    let report = numbers(
        folder.path(),
        "cornell",
        &["--crop", "120,75,121,76", "--spp", "1"],
    );
    assert_eq!(report["visibility"]["pixels"], 1);
    assert_eq!(
        (&report["width"], &report["height"]),
        (&1.into(), &1.into())
    );
}

#[test]
fn what_cannot_be_compared_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let panorama = "[camera]\nposition = [0, 0, 0]\nlook_at = [0, 0, 1]\n\
                    projection.panorama = {}\n\
                    [[objects]]\nshape.sphere = { centre = [0, 0, 2], radius = 1 }\n";
    fs::write(folder.path().join("around.toml"), panorama).unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    let failing: &[(&[&str], &str)] = &[
        (&["compare", "around.toml"], "cannot be rasterized"),
        (&["compare", "no-such-scene"], "no-such-scene"),
        (
            &["compare", "whitted", "-o", "no/such/folder"],
            "no/such/folder",
        ),
        (&["compare", "whitted", "-o", "file"], "file"),
        (&["compare", "whitted", "--crop", "0,0,9999,1"], "9999"),
        (
            &[
                "render",
                "around.toml",
                "-o",
                "a.png",
                "--integrator",
                "raster",
            ],
            "cannot be rasterized",
        ),
    ];
    for (arguments, said) in failing {
        let talk = fail(folder.path(), arguments, 1);
        assert!(talk.contains(said), "{arguments:?}: {talk}");
    }
    fail(folder.path(), &["compare"], 2);
    fail(folder.path(), &["compare", "whitted", "--spp", "0"], 2);
    assert_eq!(names(folder.path()), ["around.toml", "file"]);
}

#[test]
fn a_lens_is_noted_unless_nobody_wants_to_hear() {
    let folder = tempfile::tempdir().unwrap();
    let lens = "[camera]\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\n\
                projection.thin-lens = { fov = 40, lens_radius = 0.1, focus_distance = 5 }\n\
                [[objects]]\nshape.sphere = { centre = [0, 0, 0], radius = 1 }\n";
    fs::write(folder.path().join("lens.toml"), lens).unwrap();
    let render = [
        "render",
        "lens.toml",
        "-o",
        "a.png",
        "--integrator",
        "raster",
    ];
    let render = [&render[..], &SMALL].concat();
    let talk = String::from_utf8(run(folder.path(), &render).stderr).unwrap();
    assert!(talk.contains("middle of the lens"), "{talk}");
    assert!(
        talk.contains("rasterized in") && talk.contains("without rays"),
        "{talk}"
    );
    let output = run(folder.path(), &[&render[..], &["--quiet"]].concat());
    assert!(output.status.success() && output.stderr.is_empty());
    let compare = ["compare", "lens.toml", "--size", "40x30", "--spp", "1"];
    let talk = String::from_utf8(run(folder.path(), &compare).stderr).unwrap();
    assert!(talk.contains("middle of the lens"), "{talk}");
}

#[cfg(unix)]
#[test]
fn ctrl_c_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let long = ["compare", "whitted", "--size", "600x400", "--spp", "100000"];
    let (output, _) = crate::interrupted::interrupted(folder.path(), &long);
    let talk = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{talk}");
    assert!(talk.contains("nothing written"), "{talk}");
    assert!(names(folder.path()).is_empty(), "the folder is gone again");
}
