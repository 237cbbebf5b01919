//! What is said of broken files, and what they may not cost.

use std::fmt::Write as _;

use ombra_formats::{Limits, parse_gltf, read_gltf};
use ombra_geometry::triangle::TriangleTest;

use super::{Doc, bytes, findings, glb};
use crate::{Folder, outside_data};

fn error_in(folder: &Folder, name: &str) -> String {
    let error = read_gltf(
        folder.path(name),
        TriangleTest::default(),
        &Limits::default(),
    );
    let text = error.expect_err("broken").to_string();
    assert!(!text.contains('\n'), "{text}");
    let prefix = format!("{}/", folder.path("").display()).replace("//", "/");
    text.replace(&prefix, "")
        .replace(&format!("{}", folder.path("").display()), "HERE/")
}

#[test]
fn a_key_without_end_is_told_by_its_beginning() {
    let text = format!("{{\"{}\":[1,]}}", "key ".repeat(4000));
    let folder = Folder::with(&[("key.gltf", text.as_bytes())]);
    let error = error_in(&folder, "key.gltf");
    assert!(error.starts_with("key.gltf: key key "), "{error}");
    assert!(error.len() < 1000, "{} bytes", error.len());
}

#[test]
fn containers_that_are_cut_empty_or_something_else_are_refused() {
    let whole = Doc::triangle("", "").glb();
    let mut other = whole.clone();
    other[3] = b'X';
    let cut = &whole[..whole.len() * 6 / 10];
    let folder = Folder::with(&[
        ("empty.glb", b""),
        ("magic.glb", &other),
        ("cut.glb", cut),
        ("empty.gltf", b""),
        ("text.gltf", b"no JSON"),
    ]);
    assert_eq!(
        error_in(&folder, "empty.glb"),
        "empty.glb: file is empty (0 bytes)"
    );
    assert_eq!(
        error_in(&folder, "empty.gltf"),
        "empty.gltf: file is empty (0 bytes)"
    );
    let error = error_in(&folder, "magic.glb");
    assert!(
        error.starts_with("magic.glb: byte 0: \"glTX\" found where \"glTF\""),
        "{error}"
    );
    assert_eq!(
        error_in(&folder, "cut.glb"),
        format!(
            "cut.glb: GLB header: the file should have {} bytes, but has only {}: it was cut",
            whole.len(),
            cut.len()
        )
    );
    assert!(error_in(&folder, "text.gltf").starts_with("text.gltf: JSON: expected ident"));
}

#[test]
fn buffers_that_are_not_there_or_elsewhere_are_named() {
    let doc = Doc::triangle("", "");
    let (missing, buffer) = doc.gltf_beside("not_there.bin");
    let (climbing, _) = doc.gltf_beside("../../../etc/passwd");
    let (absolute, _) = doc.gltf_beside("/etc/passwd");
    let (escaped, _) = doc.gltf_beside("..%2f..%2fetc%2fpasswd");
    let (broken, _) = doc.gltf_beside("data:application/octet-stream;base64,@@@@not base64");
    let (present, _) = doc.gltf_beside("a%20b.bin");
    let (short, _) = doc.gltf_beside("short.bin");
    let folder = Folder::with(&[
        ("missing.gltf", missing.as_bytes()),
        ("climbing.gltf", climbing.as_bytes()),
        ("absolute.gltf", absolute.as_bytes()),
        ("escaped.gltf", escaped.as_bytes()),
        ("broken.gltf", broken.as_bytes()),
        ("present.gltf", present.as_bytes()),
        ("short.gltf", short.as_bytes()),
        ("a b.bin", buffer),
        ("short.bin", &buffer[..10]),
    ]);
    let missing = error_in(&folder, "missing.gltf");
    assert!(
        missing.starts_with(
            "missing.gltf: buffers[0].uri: \"not_there.bin\" is not there (looked in "
        ),
        "{missing}"
    );
    for (name, uri) in [
        ("climbing", "../../../etc/passwd"),
        ("absolute", "/etc/passwd"),
        ("escaped", "../../etc/passwd"),
    ] {
        let expected = format!(
            "{name}.gltf: buffers[0].uri: \"{uri}\" leads out of the folder of the file: not opened"
        );
        assert_eq!(error_in(&folder, &format!("{name}.gltf")), expected);
    }
    let error = error_in(&folder, "broken.gltf");
    assert!(
        error.contains("buffers[0].uri: the data URI cannot be decoded as base64"),
        "{error}"
    );
    assert_eq!(
        error_in(&folder, "short.gltf"),
        "short.gltf: buffers[0].byteLength: is 39, but short.bin has only 10 bytes"
    );
    let file = read_gltf(
        folder.path("present.gltf"),
        TriangleTest::default(),
        &Limits::default(),
    );
    assert_eq!(file.unwrap().files[1], folder.path("a b.bin"));
    let in_memory = parse_gltf(
        present.as_bytes(),
        TriangleTest::default(),
        &Limits::default(),
    );
    let error = in_memory.unwrap_err().to_string();
    assert!(error.contains("only data URIs can be read here"), "{error}");
}

#[cfg(unix)]
#[test]
fn a_link_out_of_the_folder_is_not_followed() {
    let doc = Doc::triangle("", "");
    let (text, buffer) = doc.gltf_beside("a.bin");
    let outside = Folder::with(&[("secret.bin", buffer)]);
    let folder = Folder::with(&[("a.gltf", text.as_bytes())]);
    std::os::unix::fs::symlink(outside.path("secret.bin"), folder.path("a.bin")).unwrap();
    assert!(error_in(&folder, "a.gltf").contains("leads out of the folder"));
}

#[test]
fn counts_that_a_file_cannot_hold_are_refused() {
    let whole = |from: &str, to: &str| {
        let doc = Doc::triangle("", "");
        let text = doc.gltf();
        assert!(text.contains(from), "{from}");
        let read = parse_gltf(
            text.replacen(from, to, 1).as_bytes(),
            TriangleTest::default(),
            &Limits::default(),
        );
        read.unwrap_err().to_string()
    };
    assert_eq!(
        whole(r#""byteLength": 39"#, r#""byteLength": 48000000000"#),
        "buffers[0].byteLength: is 48000000000, but the data URI has only 39 bytes"
    );
    assert_eq!(
        whole(r#""byteLength": 36"#, r#""byteLength": 48000000000"#),
        "bufferViews[0]: bytes 0 to 48000000000 of buffers[0], which has only 39"
    );
    assert_eq!(
        whole(
            r#""count": 3, "type": "VEC3""#,
            r#""count": 4000000000, "type": "VEC3""#
        ),
        "accessors[0]: 4000000000 elements need bytes 0 to 48000000000 of its bufferView, which has \
         only 36"
    );
    let most = u64::MAX;
    let error = whole(
        r#""count": 3, "type": "VEC3""#,
        &format!(r#""count": {most}, "type": "VEC3""#),
    );
    assert!(error.contains("elements need bytes"), "{error}");
    let error = whole(r#""byteOffset": 0"#, &format!(r#""byteOffset": {most}"#));
    assert!(error.starts_with("bufferViews[0]: bytes "), "{error}");
}

#[test]
fn zeros_are_not_made_for_a_count() {
    let mut doc = Doc::new(
        r#""nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]"#,
    );
    doc.raw_accessor(r#""componentType": 5126, "count": 4000000000, "type": "VEC3""#);
    let error = parse_gltf(
        doc.gltf().as_bytes(),
        TriangleTest::default(),
        &Limits::default(),
    );
    let error = error.unwrap_err().to_string();
    assert!(
        error
            .starts_with("meshes[0].primitives[0]: makes 1333333333 triangles, which is more than"),
        "{error}"
    );
    let mut doc = Doc::triangle("", "");
    doc.rest = doc.rest.replace(
        r#"{"mesh": 0}"#,
        r#"{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}}}"#,
    );
    doc.raw_accessor(r#""componentType": 5126, "count": 4000000000, "type": "VEC3""#);
    assert!(
        doc.error().contains("4000000000 placements are more than"),
        "{}",
        doc.error()
    );
}

#[test]
fn what_is_named_again_and_again_has_an_end() {
    // 2000 nodes that all place a mesh of 2000 primitives would be 4 million objects.
    let mut doc = Doc::triangle("", "");
    let primitive = r#"{"attributes": {"POSITION": 0}}"#;
    let nodes = vec![r#"{"mesh": 0}"#; 2000].join(",");
    let primitives = vec![primitive; 2000].join(",");
    doc.rest = format!(r#""nodes": [{nodes}], "meshes": [{{"primitives": [{primitives}]}}]"#);
    let error = parse_gltf(
        doc.gltf().as_bytes(),
        TriangleTest::default(),
        &Limits::default(),
    );
    let error = error.unwrap_err().to_string();
    assert!(
        error.contains("places more than a file of this size is trusted with"),
        "{error}"
    );
}

#[test]
fn indices_past_the_vertices_and_attributes_of_another_length_are_named() {
    let mut doc = Doc::triangle("", "");
    doc.rest = doc.rest.replace(r#""indices": 1"#, r#""indices": 2"#);
    let indices: Vec<u8> = [0_u16, 1, 9999]
        .iter()
        .flat_map(|i| i.to_le_bytes())
        .collect();
    doc.accessor(
        &indices,
        r#""componentType": 5123, "count": 3, "type": "SCALAR""#,
    );
    assert_eq!(
        doc.error(),
        "meshes[0].primitives[0].indices: index 9999, but there are only 3 vertices (0 to 2)"
    );
    let mut doc = Doc::triangle("", "");
    doc.rest = doc
        .rest
        .replace(r#""POSITION": 0"#, r#""POSITION": 0, "NORMAL": 2"#);
    doc.floats(&[0.0, 0.0, 1.0], "VEC3");
    assert_eq!(
        doc.error(),
        "meshes[0].primitives[0].attributes.NORMAL: has 1 elements (accessors[2]), but POSITION has \
         3; one for each is right"
    );
    for (from, to, said) in [
        (
            r#""POSITION": 0"#,
            r#""POSITION": 7"#,
            "refers to accessors[7], but there are only 2 (0 to 1)",
        ),
        (
            r#""POSITION": 0"#,
            r#""POSITION": 1"#,
            "accessors[1].type: is \"SCALAR\", but",
        ),
        (
            r#""indices": 1"#,
            r#""indices": 0"#,
            "accessors[0].componentType: is 5126, but",
        ),
        (
            r#""mesh": 0"#,
            r#""mesh": 5"#,
            "nodes[0].mesh: refers to meshes[5], but there is only meshes[0]",
        ),
    ] {
        let mut doc = Doc::triangle("", "");
        doc.rest = doc.rest.replacen(from, to, 1);
        assert!(doc.error().contains(said), "{}", doc.error());
    }
}

#[test]
fn sparse_indices_ascend_within_the_count() {
    for (indices, said) in [
        (
            [1, 3],
            "accessors[0].sparse.indices: index 3, but the accessor has only 3 elements",
        ),
        (
            [2, 1],
            "accessors[0].sparse.indices: index 1 does not come after",
        ),
    ] {
        let mut doc = Doc::new(
            r#""nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]"#,
        );
        let indices = doc.view(&indices, "");
        let values = doc.view(&bytes(&[0.0; 6]), "");
        doc.raw_accessor(&format!(
            r#""componentType": 5126, "count": 3, "type": "VEC3", "sparse": {{"count": 2,
               "indices": {{"bufferView": {indices}, "componentType": 5121}},
               "values": {{"bufferView": {values}}}}}"#
        ));
        assert!(doc.error().starts_with(said), "{}", doc.error());
    }
}

#[test]
fn corners_that_are_not_finite_cost_their_triangles() {
    let mut doc = Doc::triangle("", "");
    doc.rest = doc
        .rest
        .replace(r#""meshes": [{"#, r#""meshes": [{"name": "hull", "#);
    doc.rest = doc.rest.replace(r#""POSITION": 0"#, r#""POSITION": 2"#);
    doc.floats(
        &[f32::NAN, 0.0, 0.0, 1.0, f32::INFINITY, 0.0, 0.0, 1.0, 0.0],
        "VEC3",
    );
    assert_eq!(
        findings(&doc.read()),
        [
            "meshes[0].primitives[0]: 1 triangle of \"hull\" with a corner that is not finite (NaN \
             or infinite) left out",
            "no triangle; nothing of it can be seen"
        ]
    );
}

#[test]
fn extensions_are_refused_if_required_and_noted_if_used() {
    let doc = |required: &str| {
        Doc::triangle(
            "",
            &format!(
                r#", "extensionsUsed": ["KHR_draco_mesh_compression", "KHR_materials_unlit"]{required}"#
            ),
        )
    };
    let file = doc("").read();
    assert_eq!(
        findings(&file),
        ["extensionsUsed: \"KHR_draco_mesh_compression\" is not read"]
    );
    let error = doc(r#", "extensionsRequired": ["KHR_draco_mesh_compression"]"#).error();
    assert!(
        error.starts_with(
            "extensionsRequired: needs \"KHR_draco_mesh_compression\", which is not read"
        ),
        "{error}"
    );
}

#[test]
fn what_moves_is_shown_at_rest() {
    let doc = Doc::triangle(
        r#", "targets": [{"POSITION": 0}]"#,
        r#", "animations": [{"channels": [], "samplers": []}], "skins": [{"joints": [0]}]"#,
    );
    assert_eq!(
        findings(&doc.read()),
        [
            "meshes[0].primitives[0]: morph targets are not used",
            "animations: are not used: everything is shown at rest (2 times)"
        ]
    );
}

#[test]
fn a_chain_of_nodes_that_meets_itself_is_no_tree() {
    let mut doc = Doc::triangle("", "");
    doc.rest = doc.rest.replace(
        r#"[{"mesh": 0}]"#,
        r#"[{"children": [1]}, {"children": [0], "mesh": 0}], "scenes": [{"nodes": [0]}]"#,
    );
    assert!(
        doc.error().contains("nodes[0] -> nodes[1] -> nodes[0]"),
        "{}",
        doc.error()
    );
    let mut long = String::new();
    for i in 1..50_000 {
        let _ = write!(long, r#"{{"children": [{i}]}},"#);
    }
    doc.rest = format!(r#""nodes": [{long} {{"children": [0]}}]"#);
    let json = format!(r#"{{"asset": {{"version": "2.0"}}, {}}}"#, doc.rest);
    let read = parse_gltf(
        &glb(json.as_bytes(), b""),
        TriangleTest::default(),
        &Limits::default(),
    );
    assert!(read.unwrap_err().to_string().len() < 400);
}

#[test]
fn the_broken_files_from_outside_are_refused_or_reported() {
    for (name, expected) in [
        (
            "bad_base64.gltf",
            "buffers[0].uri: the data URI cannot be decoded as base64",
        ),
        ("bad_magic.glb", "byte 0: \"glTX\" found where \"glTF\""),
        ("cyclic_nodes.glb", "nodes[0] -> nodes[1] -> nodes[0]"),
        ("empty.glb", "file is empty (0 bytes)"),
        (
            "huge_counts.glb",
            "buffers[0].byteLength: is 48000000000, but the BIN chunk has only 44",
        ),
        (
            "index_past_vertices.glb",
            "meshes[0].primitives[0].indices: index 9999, but there are only 3",
        ),
        (
            "missing_bin.gltf",
            "\"not_there.bin\" is not there (looked in ",
        ),
        (
            "path_traversal.gltf",
            "leads out of the folder of the file: not opened",
        ),
        (
            "truncated.glb",
            "the file should have 25756 bytes, but has only 15453",
        ),
    ] {
        let Some(path) = outside_data(&format!("bad/{name}")) else {
            continue;
        };
        let read = read_gltf(path, TriangleTest::default(), &Limits::default());
        let error = read.expect_err(name).to_string();
        assert!(error.contains(expected) && error.contains(name), "{error}");
    }
    if let Some(path) = outside_data("bad/nan_positions.glb") {
        let file = read_gltf(path, TriangleTest::default(), &Limits::default()).unwrap();
        assert!(findings(&file)[0].contains("1 triangle with a corner that is not finite"));
    }
}
