//! `render`: what is written, and that the same command writes the same.

use std::path::Path;

use crate::succeed;

const SMALL: [&str; 4] = ["--size", "60x40", "--spp", "3"];

fn picture(folder: &Path, out: &str, more: &[&str]) -> Vec<u8> {
    let command = [&["render", "whitted", "-o", out], &SMALL[..], more].concat();
    succeed(folder, &command);
    std::fs::read(folder.join(out)).unwrap()
}

#[test]
fn the_ending_chooses_the_format() {
    let folder = tempfile::tempdir().unwrap();
    let starts: [(&str, &[u8]); 4] = [
        ("a.png", b"\x89PNG"),
        ("a.exr", b"\x76\x2f\x31\x01"),
        ("a.pfm", b"PF"),
        ("a.ppm", b"P6"),
    ];
    for (out, magic) in starts {
        assert!(picture(folder.path(), out, &[]).starts_with(magic), "{out}");
    }
    assert_eq!(
        std::fs::read_dir(folder.path()).unwrap().count(),
        4,
        "nothing else is left"
    );
}

#[test]
fn the_same_command_gives_the_same_bytes_at_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    for integrator in ["whitted", "raster", "ao", "normals", "depth", "cost"] {
        for out in ["a.png", "a.pfm"] {
            let with = |threads| {
                let more = ["--integrator", integrator, "--threads", threads];
                picture(folder.path(), out, &more)
            };
            let one = with("1");
            assert!(one == with("2"), "{integrator}, {out}");
            assert!(one == with("7"), "{integrator}, {out}");
        }
    }
}

/// A white square of two triangles, as a strip, in front of a camera.
const GLTF: &str = r#"{"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0.5, 0.5, 3]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 5}]}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.4, "aspectRatio": 2, "znear": 0.1}}],
    "accessors": [{"bufferView": 0, "componentType": 5121, "count": 4, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 15, "byteStride": 4}],
    "buffers": [{"byteLength": 15, "uri": "data:;base64,AAAAAAEAAAAAAQAAAQEA"}]}"#;

#[test]
fn gltf_files_are_rendered_and_told_of() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("square.gltf"), GLTF).unwrap();
    let command = ["render", "square.gltf", "-o", "a.ppm", "--spp", "1"];
    succeed(folder.path(), &command);
    let picture = std::fs::read(folder.path().join("a.ppm")).unwrap();
    let header = picture.windows(9).any(|w| w == b"\n1080 540");
    assert!(header, "the camera says how wide its picture is");
    let pixel =
        |x: usize, y: usize| &picture[picture.len() - 1080 * 540 * 3 + 3 * (1080 * y + x)..][..3];
    assert!(pixel(540, 270)[0] > 200, "{:?}", pixel(540, 270));
    assert_ne!(pixel(540, 270), pixel(5, 5));
    let info = succeed(folder.path(), &["info", "square.gltf", "--json"]);
    let info: serde_json::Value = serde_json::from_str(&info).unwrap();
    assert_eq!(
        (&info["kind"], &info["triangles"]),
        (&"gltf".into(), &2.into())
    );
    assert_eq!((&info["cameras"], &info["nodes"]), (&1.into(), &2.into()));
    let words = succeed(folder.path(), &["info", "square.gltf"]);
    assert!(
        words.contains("format      glTF 2.0") && words.contains("triangles   2"),
        "{words}"
    );
}

#[test]
fn names_in_any_script_are_good_names() {
    let folder = tempfile::tempdir().unwrap();
    for out in ["日本.exr", "a b.png"] {
        assert!(!picture(folder.path(), out, &[]).is_empty());
    }
    let info = succeed(folder.path(), &["info", "日本.exr", "--json"]);
    let info: serde_json::Value = serde_json::from_str(&info).unwrap();
    for attribute in ["command", "version", "scene-hash", "seed", "seconds"] {
        let name = format!("ombra.{attribute}");
        assert!(info["attributes"][&name].is_string(), "{name} in {info}");
    }
}

#[test]
fn quiet_is_silent() {
    let folder = tempfile::tempdir().unwrap();
    let command = [&["render", "whitted", "-o", "a.png", "--quiet"], &SMALL[..]].concat();
    let output = crate::run(folder.path(), &command);
    assert!(output.status.success());
    assert!(
        output.stdout.is_empty() && output.stderr.is_empty(),
        "{output:?}"
    );
}

#[test]
fn a_legacy_name_is_explained() {
    let folder = tempfile::tempdir().unwrap();
    let command = [
        &["render", "whitted", "-o", "a.png", "--accel", "Lbvh"],
        &SMALL[..],
    ]
    .concat();
    let output = crate::run(folder.path(), &command);
    let talk = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success() && talk.contains("bvh-lbvh"),
        "{talk}"
    );
}

#[test]
fn another_seed_gives_another_picture() {
    let folder = tempfile::tempdir().unwrap();
    let with = |seed| {
        picture(
            folder.path(),
            "a.ppm",
            &["--integrator", "ao", "--seed", seed],
        )
    };
    assert_ne!(with("1"), with("2"));
}

#[test]
fn every_structure_gives_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let names = succeed(folder.path(), &["structures", "--json"]);
    let names: Vec<serde_json::Value> = serde_json::from_str(&names).unwrap();
    let reference = picture(folder.path(), "a.ppm", &["--accel", "brute-force"]);
    for name in names.iter().map(|entry| entry["name"].as_str().unwrap()) {
        assert!(
            reference == picture(folder.path(), "a.ppm", &["--accel", name]),
            "{name}"
        );
    }
}

#[test]
fn a_crop_is_a_part_of_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let whole = picture(folder.path(), "whole.ppm", &[]);
    let part = picture(folder.path(), "part.ppm", &["--crop", "10,20,30,25"]);
    let pixels = |ppm: &[u8], count: usize| ppm[ppm.len() - 3 * count..].to_vec();
    let (whole, part) = (pixels(&whole, 60 * 40), pixels(&part, 20 * 5));
    for y in 0..5 {
        let from = ((20 + y) * 60 + 10) * 3;
        assert_eq!(
            part[y * 60..(y + 1) * 60],
            whole[from..from + 60],
            "row {y}"
        );
    }
}

#[test]
fn statistics_are_json_on_standard_output() {
    let folder = tempfile::tempdir().unwrap();
    let command = [&["render", "whitted", "-o", "a.png", "--json"], &SMALL[..]].concat();
    let statistics: serde_json::Value =
        serde_json::from_str(&succeed(folder.path(), &command)).unwrap();
    for key in [
        "seconds",
        "rays",
        "rays_per_second",
        "build_seconds",
        "bytes",
    ] {
        assert!(
            statistics[key].as_f64().unwrap() > 0.0,
            "{key} in {statistics}"
        );
    }
    assert!(statistics["rays"].as_u64().unwrap() >= 60 * 40 * 3);
    assert_eq!(statistics["interrupted"], false);
}

#[test]
fn a_model_without_camera_or_light_can_be_seen() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    std::fs::write(folder.path().join("some.obj"), obj).unwrap();
    for up in ["x", "y", "z"] {
        let command = ["render", "some.obj", "-o", "a.ppm", "--up", up];
        succeed(folder.path(), &[&command, &SMALL[..]].concat());
        let ppm = std::fs::read(folder.path().join("a.ppm")).unwrap();
        let pixels = &ppm[ppm.len() - 60 * 40 * 3..];
        let corner = &pixels[..3];
        let different = pixels.chunks(3).filter(|pixel| *pixel != corner).count();
        assert!(
            different > 60 * 40 / 10,
            "{different} pixels show something with {up} up"
        );
    }
}
