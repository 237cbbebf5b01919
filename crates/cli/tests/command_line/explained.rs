//! `explain`: the tree in words, as JSON, as a drawing, as a model, and where two part.

use std::path::Path;

use serde_json::Value;

use crate::{fail, outside_data, run, succeed};

const SMALL: [&str; 2] = ["--size", "60x40"];

fn explain(folder: &Path, more: &[&str]) -> String {
    succeed(
        folder,
        &[&["explain", "whitted"], &SMALL[..], more].concat(),
    )
}

fn tree(folder: &Path, more: &[&str]) -> Value {
    serde_json::from_str(&explain(folder, &[more, &["--json"]].concat())).unwrap()
}

/// A pixel of a PFM file, which has its lowest row first.
fn pixel(pfm: &[u8], x: usize, y: usize) -> [f32; 3] {
    let pixels = &pfm[pfm.len() - 60 * 40 * 12..];
    let at = ((39 - y) * 60 + x) * 12;
    [0, 4, 8].map(|channel| {
        let bytes = pixels[at + channel..at + channel + 4].try_into().unwrap();
        f32::from_le_bytes(bytes)
    })
}

fn colour(value: &Value) -> [f32; 3] {
    [0, 1, 2].map(|channel| value[channel].as_f64().unwrap() as f32)
}

#[test]
fn the_tree_tells_of_the_pixel_that_render_gives() {
    let folder = tempfile::tempdir().unwrap();
    for (integrator, spp) in [("whitted", "3"), ("ao", "4"), ("cost", "1")] {
        let options = ["--spp", spp, "--integrator", integrator, "--seed", "5"];
        let render = [&["render", "whitted", "-o", "a.pfm"], &SMALL[..], &options].concat();
        succeed(folder.path(), &render);
        let pfm = std::fs::read(folder.path().join("a.pfm")).unwrap();
        for (x, y) in [(0, 0), (22, 21), (40, 20), (59, 39)] {
            let place = format!("{x},{y}");
            let tree = tree(
                folder.path(),
                &[&["--pixel", &place], &options[..]].concat(),
            );
            assert_eq!(
                colour(&tree["colour"]),
                pixel(&pfm, x, y),
                "{integrator} {place}"
            );
            let samples = tree["samples"].as_array().unwrap();
            assert_eq!(samples.len().to_string(), spp);
            for ray in samples
                .iter()
                .flat_map(|sample| sample["rays"].as_array().unwrap())
            {
                for field in ["kind", "origin", "direction", "weight", "radiance", "end"] {
                    assert!(!ray[field].is_null(), "{field} in {ray}");
                }
            }
        }
    }
}

#[test]
fn the_text_can_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let text = explain(folder.path(), &["--pixel", "18,22"]);
    for said in [
        "camera ray: meets \"bubble, outside\"",
        "transmitted ray, bounce 1",
        "reflected ray, bounce 1",
        "goes through",
        "the pixel is",
    ] {
        assert!(text.contains(said), "no {said} in {text}");
    }
    let one = explain(
        folder.path(),
        &["--pixel", "18,22", "--spp", "3", "--sample", "2"],
    );
    assert!(
        one.contains("sample 2:") && !one.contains("sample 1:"),
        "{one}"
    );
    // What is too long is cut, and says so.
    let many = explain(folder.path(), &["--pixel", "18,22", "--spp", "64"]);
    assert!(
        many.lines().count() < 4000,
        "{} lines",
        many.lines().count()
    );
    assert!(many.contains("left out"), "{many}");
}

#[test]
fn the_drawing_is_well_formed() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "[[objects]]\nname = \"a <ball> & \\\"more\\\"\"\nshape.sphere = { centre = [0, 0, 0], radius = 1 }\n\
                 [[objects]]\nname = \"ground\"\nshape.plane = { point = [0, -1, 0], normal = [0, 1, 0] }\n";
    std::fs::write(folder.path().join("odd.toml"), scene).unwrap();
    for scene in ["whitted", "cornell", "shapes", "teapot", "odd.toml"] {
        for place in ["30,22", "0,0", "59,39"] {
            let options = ["--pixel", place, "--size", "60x40", "--svg", "a.svg"];
            succeed(folder.path(), &[&["explain", scene], &options[..]].concat());
            let svg = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
            assert!(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""));
            assert!(svg.contains("Plan") && svg.contains("Section"), "{svg}");
            assert!(
                !svg.contains("NaN") && !svg.contains("inf"),
                "{scene} {place}"
            );
            well_formed(&svg);
        }
    }
    let svg = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(svg.contains("a &lt;ball&gt; &amp; &quot;more&quot;") || !svg.contains("<ball>"));
}

/// Every tag is closed in its order, every attribute quoted, every `&` the begin of a known entity.
fn well_formed(xml: &str) {
    let mut open = Vec::new();
    let mut rest = xml;
    while let Some(begin) = rest.find('<') {
        entities(&rest[..begin]);
        let end = rest[begin..].find('>').expect("a tag ends") + begin;
        let tag = &rest[begin + 1..end];
        rest = &rest[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "closed in order");
            continue;
        }
        let (body, closed) = match tag.strip_suffix('/') {
            Some(body) => (body, true),
            None => (tag, false),
        };
        let (name, attributes) = body.split_once(' ').unwrap_or((body, ""));
        assert!(name.chars().all(char::is_alphanumeric), "{tag}");
        let mut parts = attributes.split('"');
        while let Some(before) = parts.next() {
            let Some(value) = parts.next() else {
                assert!(before.trim().is_empty(), "{tag}");
                break;
            };
            let key = before
                .trim()
                .strip_suffix('=')
                .expect("an attribute has a value");
            assert!(
                !key.is_empty() && !key.contains(char::is_whitespace),
                "{tag}"
            );
            entities(value);
        }
        if !closed {
            open.push(name);
        }
    }
    assert!(open.is_empty() && rest.trim().is_empty(), "{open:?} {rest}");
}

fn entities(text: &str) {
    for after in text.split('&').skip(1) {
        let known = ["amp;", "lt;", "gt;", "quot;"];
        assert!(known.iter().any(|name| after.starts_with(name)), "&{after}");
    }
}

#[test]
fn where_to_write_is_looked_at_before_the_work() {
    let folder = tempfile::tempdir().unwrap();
    for option in ["--svg", "--glb"] {
        let missing = ["explain", "whitted", "--pixel", "18,22", option, "no/such"];
        let output = run(folder.path(), &[&missing[..], &SMALL].concat());
        assert_eq!(output.status.code(), Some(1), "{option}");
        assert!(output.stdout.is_empty(), "{option}: no tree was made");
        let talk = String::from_utf8_lossy(&output.stderr);
        assert!(
            talk.contains("does not exist") && talk.lines().count() == 1,
            "{talk}"
        );
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// The numbers of the title: of rays drawn, and of all.
fn drawn(folder: &Path, spp: &str) -> ([usize; 2], String, String) {
    let options = ["--pixel", "18,22", "--spp", spp, "--svg", "many.svg"];
    let command = [&["explain", "whitted"], &SMALL[..], &options].concat();
    let output = run(folder, &command);
    assert!(output.status.success(), "{output:?}");
    let svg = std::fs::read_to_string(folder.join("many.svg")).unwrap();
    let title = svg
        .split(['<', '>'])
        .find(|text| text.contains("rays drawn"));
    let title = title.unwrap().to_owned();
    let mut words = title.split(' ');
    let [drawn, all] = [0, 1].map(|nth| words.nth(nth).unwrap().parse().unwrap());
    let talk = String::from_utf8_lossy(&output.stderr).into_owned();
    ([drawn, all], title, talk)
}

#[test]
fn of_many_samples_some_rays_are_drawn_and_all_are_counted() {
    let folder = tempfile::tempdir().unwrap();
    // All camera rays weigh the same, and there are more of them than are drawn.
    let ([some, all], title, talk) = drawn(folder.path(), "256");
    assert_eq!((some, talk.as_str()), (200, ""), "{title}");
    // What is said adds up.
    let numbers = title
        .split(' ')
        .filter_map(|word| word.parse::<usize>().ok());
    assert_eq!(numbers.sum::<usize>(), 2 * all, "{title}");
    assert!(!title.contains("samples"), "{title}");

    let ([some, of_all], title, talk) = drawn(folder.path(), "4096");
    assert_eq!(some, 200, "{title}");
    assert!(of_all > 15 * all, "{title}");
    for said in [&title, &talk] {
        assert!(
            said.contains("the last ") && said.contains(" samples with "),
            "{said}"
        );
    }
    let numbers = title
        .split(' ')
        .filter_map(|word| word.parse::<usize>().ok());
    let samples = title.rsplit(' ').nth(4).unwrap().parse::<usize>().unwrap();
    assert_eq!(numbers.sum::<usize>(), 2 * of_all + samples, "{title}");
}

#[test]
fn without_rays_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    for more in [&["--json"][..], &[], &["--svg", "a.svg"]] {
        let options = [
            "explain",
            "whitted",
            "--pixel",
            "1,1",
            "--integrator",
            "raster",
        ];
        let output = run(folder.path(), &[&options[..], &SMALL, more].concat());
        assert_eq!(output.status.code(), Some(1), "{more:?}");
        assert!(output.stdout.is_empty(), "{more:?}");
        let talk = String::from_utf8_lossy(&output.stderr);
        assert!(talk.contains("traces no rays"), "{talk}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn what_glass_absorbs_is_told() {
    let Some(data) = outside_data() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let scene = data.join("render/gltf/AttenuationTest/16_volume.gltf");
    let scene = scene.to_str().unwrap();
    let options = ["--size", "320x240", "--pixel", "200,120", "--spp", "1"];
    let explained = |more: &[&str]| {
        let arguments = [&["explain", scene], &options[..], more].concat();
        succeed(folder.path(), &arguments)
    };
    let text = explained(&[]);
    assert!(text.contains("absorbed  over a way of "), "{text}");
    let tree: Value = serde_json::from_str(&explained(&["--json"])).unwrap();
    let rays = tree["samples"][0]["rays"].as_array().unwrap();
    let absorbed = rays.iter().filter(|ray| !ray["absorbed"].is_null());
    let mut count = 0;
    for ray in absorbed {
        assert_eq!(ray["met"]["side"], "back", "{ray}");
        // A direction has unit length but for rounding.
        let [way, t] = [&ray["absorbed"]["way"], &ray["met"]["t"]];
        let [way, t] = [way, t].map(|x| x.as_f64().unwrap());
        assert!((way / t - 1.0).abs() < 1e-6, "{way}, {t}");
        let left = colour(&ray["absorbed"]["left"]);
        assert!(left.iter().all(|x| (0.0..1.0).contains(x)), "{left:?}");
        count += 1;
    }
    assert!(count > 0);
}

#[test]
fn the_model_is_sound() {
    let folder = tempfile::tempdir().unwrap();
    explain(folder.path(), &["--pixel", "18,22", "--glb", "a.glb"]);
    let glb = std::fs::read(folder.path().join("a.glb")).unwrap();
    let number = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!(
        (&glb[..4], number(4), number(8)),
        (&b"glTF"[..], 2, glb.len())
    );
    let text = number(12);
    let root: Value = serde_json::from_slice(&glb[20..20 + text]).unwrap();
    let binary = number(20 + text);
    assert_eq!(28 + text + binary, glb.len());
    for view in root["bufferViews"].as_array().unwrap() {
        let end = view["byteOffset"].as_u64().unwrap() + view["byteLength"].as_u64().unwrap();
        assert!(end as usize <= binary, "{view}");
    }
    let names: Vec<_> = root["nodes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|n| &n["name"])
        .collect();
    for name in ["floor", "mirror ball", "ray 0 camera", "ray 1 transmitted"] {
        assert!(names.iter().any(|n| *n == name), "no {name} in {names:?}");
    }
}

#[test]
fn all_structures_send_the_same_rays() {
    let folder = tempfile::tempdir().unwrap();
    let options = ["--pixel", "18,22", "--spp", "2", "--diff", "this"];
    for accel in [
        "brute-force",
        "grid",
        "octree",
        "kd-ropes",
        "bih",
        "bvh-lbvh",
    ] {
        let side = format!("accel={accel}");
        let said = explain(folder.path(), &[&options[..], &[&side]].concat());
        assert!(said.contains("no difference"), "{accel}: {said}");
    }
    let everywhere = ["--diff", "accel=bvh", "accel=kd-stack"];
    assert!(explain(folder.path(), &everywhere).contains("no difference"));
}

/// Expects a difference, and gives it.
fn difference(folder: &Path, more: &[&str]) -> Value {
    let command = [&["explain", "whitted", "--json"], &SMALL[..], more].concat();
    let output = run(folder, &command);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn two_renders_part_at_a_ray() {
    let folder = tempfile::tempdir().unwrap();
    let fields = |found: &Value| -> Vec<String> {
        let values = found["values"].as_array().unwrap().iter();
        values
            .map(|value| value["field"].as_str().unwrap().to_owned())
            .collect()
    };
    let seeds = [
        "--pixel", "18,22", "--spp", "2", "--diff", "seed=7", "seed=8",
    ];
    let found = difference(folder.path(), &seeds);
    assert_eq!(
        found["path"].as_array().unwrap().len(),
        1,
        "the camera ray: {found}"
    );
    assert!(fields(&found).contains(&"direction".to_owned()), "{found}");

    let found = difference(folder.path(), &["--diff", "max-depth=1", "this"]);
    assert_eq!(fields(&found)[0], "end", "{found}");
    assert_eq!(found["path"].as_array().unwrap().len(), 3, "{found}");

    let kinds = ["--pixel", "18,22", "--diff", "integrator=normals", "this"];
    assert!(fields(&difference(folder.path(), &kinds)).contains(&"measured".to_owned()));
}

#[test]
fn a_tree_that_was_written_is_compared_with_one_of_now() {
    let folder = tempfile::tempdir().unwrap();
    let json = explain(folder.path(), &["--pixel", "18,22", "--spp", "2", "--json"]);
    std::fs::write(folder.path().join("then.json"), &json).unwrap();
    let same = explain(
        folder.path(),
        &["--spp", "2", "--diff", "then.json", "this"],
    );
    assert!(same.contains("no difference"), "{same}");
    let other = ["--spp", "2", "--diff", "then.json", "seed=3"];
    assert_eq!(difference(folder.path(), &other)["difference"], true);

    std::fs::write(folder.path().join("broken.json"), &json[..json.len() / 2]).unwrap();
    let broken = ["explain", "whitted", "--diff", "broken.json", "this"];
    let talk = fail(folder.path(), &broken, 1);
    assert!(talk.contains("broken.json"), "{talk}");

    let mut nothing: Value = serde_json::from_str(&json).unwrap();
    nothing["samples"][0]["rays"] = Value::Array(Vec::new());
    let without_rays = nothing.to_string();
    nothing["samples"] = Value::Array(Vec::new());
    for (text, what) in [(without_rays, "`rays`"), (nothing.to_string(), "`samples`")] {
        std::fs::write(folder.path().join("nothing.json"), text).unwrap();
        let arguments = ["explain", "whitted", "--diff", "nothing.json", "this"];
        let talk = fail(folder.path(), &arguments, 1);
        assert!(talk.contains(what) && talk.lines().count() == 1, "{talk}");
    }
}

#[test]
fn what_cannot_be_explained_is_wrong_usage() {
    let folder = tempfile::tempdir().unwrap();
    let wrong: &[(&[&str], &str)] = &[
        (&[], "--pixel"),
        (&["--pixel", "960,0"], "960"),
        (&["--pixel", "0,540"], "540"),
        (&["--pixel", "1"], "240,135"),
        (&["--pixel", "-1,2"], ""),
        (&["--pixel", "1,1", "--sample", "1"], "sample 1"),
        (&["--pixel", "1,1", "--integrator", "magic"], "whitted"),
        (&["--pixel", "1,1", "--diff", "this"], "2"),
        (&["--pixel", "1,1", "--diff", "this", "foo=1"], "max-depth"),
        (
            &["--pixel", "1,1", "--diff", "this", "accel=magic"],
            "kd-ropes",
        ),
        (&["--pixel", "1,1", "--diff", "this", "spp=0"], "16777216"),
        (
            &["--pixel", "1,1", "--diff", "this", "no-such.json"],
            "no-such.json",
        ),
        (
            &["--pixel", "1,1", "--diff", "this", "this", "--svg", "a.svg"],
            "--svg",
        ),
    ];
    for (arguments, said) in wrong {
        let talk = fail(
            folder.path(),
            &[&["explain", "whitted"], *arguments].concat(),
            2,
        );
        assert!(talk.contains(said), "{arguments:?}: {talk}");
        assert!(
            talk.contains("Usage: ombra explain") || !talk.contains("Usage:"),
            "{talk}"
        );
    }
    let nowhere = [
        "explain",
        "whitted",
        "--pixel",
        "1,1",
        "--svg",
        "no/such/a.svg",
    ];
    assert!(fail(folder.path(), &nowhere, 1).contains("folder"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
