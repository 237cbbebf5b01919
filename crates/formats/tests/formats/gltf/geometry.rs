//! From buffers to triangles.

use ombra_formats::GltfFile;
use ombra_geometry::Point3;

use super::{Doc, bytes, findings, mesh};

const SQUARE: [f32; 12] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0];

/// A mesh with these attributes, as JSON with room for accessors, and one node.
fn with(attributes: &str, more: &str) -> Doc {
    Doc::new(&format!(
        r#""nodes": [{{"mesh": 0}}],
           "meshes": [{{"primitives": [{{"attributes": {{{attributes}}}{more}}}]}}]"#
    ))
}

/// The corners of all triangles.
fn corners(file: &GltfFile) -> Vec<[[f32; 3]; 3]> {
    let mesh = mesh(file, 0);
    let count = mesh.triangles().len();
    (0..count)
        .map(|i| mesh.corners(i).map(Point3::to_array))
        .collect()
}

#[test]
fn a_document_of_nothing_is_an_empty_scene() {
    let file = Doc::default().read();
    assert!(file.scene.objects.is_empty());
    assert_eq!(findings(&file), ["no triangle; nothing of it can be seen"]);
}

#[test]
fn indices_of_every_kind_name_the_same_triangles() {
    let indices: [(u32, Vec<u8>); 3] = [
        (5121, vec![2, 1, 3, 0, 1, 2]),
        (
            5123,
            [2_u16, 1, 3, 0, 1, 2]
                .iter()
                .flat_map(|i| i.to_le_bytes())
                .collect(),
        ),
        (
            5125,
            [2_u32, 1, 3, 0, 1, 2]
                .iter()
                .flat_map(|i| i.to_le_bytes())
                .collect(),
        ),
    ];
    let expected = [
        [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    ];
    for (code, content) in indices {
        let mut doc = with(r#""POSITION": 0"#, r#", "indices": 1"#);
        doc.floats(&SQUARE, "VEC3");
        let json = format!(r#""componentType": {code}, "count": 6, "type": "SCALAR""#);
        doc.accessor(&content, &json);
        assert_eq!(corners(&doc.read()), expected, "{code}");
    }
}

#[test]
fn without_indices_the_vertices_follow_one_another() {
    let mut doc = with(r#""POSITION": 0"#, "");
    doc.floats(&SQUARE[..9], "VEC3");
    assert_eq!(corners(&doc.read()).len(), 1);
    let mut doc = with(r#""POSITION": 0"#, "");
    doc.floats(&SQUARE, "VEC3");
    let file = doc.read();
    assert_eq!(
        corners(&file).len(),
        1,
        "the fourth vertex makes no triangle"
    );
    let expected = "meshes[0].primitives[0]: vertices after the last whole triangle are left out";
    assert_eq!(findings(&file), [expected]);
}

#[test]
fn strips_and_fans_wind_like_lists() {
    let read = |mode: u32, order: &[u8]| {
        let mut doc = with(
            r#""POSITION": 0"#,
            &format!(r#", "indices": 1, "mode": {mode}"#),
        );
        doc.floats(&SQUARE, "VEC3");
        let json = format!(
            r#""componentType": 5121, "count": {}, "type": "SCALAR""#,
            order.len()
        );
        doc.accessor(order, &json);
        doc.read()
    };
    for (mode, order, triangles) in [
        (4, &[0, 1, 2, 2, 1, 3][..], 2),
        (5, &[0, 1, 2, 3], 2),
        (6, &[0, 1, 3, 2], 2),
        (5, &[0, 1], 0),
        (6, &[0], 0),
    ] {
        let file = read(mode, order);
        let total: usize = file.scene.geometries.len();
        assert_eq!(total, usize::from(triangles > 0), "{mode} {order:?}");
        if triangles > 0 {
            let mesh = mesh(&file, 0);
            assert_eq!(mesh.triangles().len(), triangles);
            assert_eq!(mesh.area(), 1.0);
            for i in 0..triangles {
                let normal = mesh.geometric_normal(i).unwrap();
                assert_eq!(normal.to_array(), [0.0, 0.0, 1.0], "{mode} {order:?}");
            }
        }
    }
}

#[test]
fn points_and_lines_are_left_out_and_said() {
    for (mode, what) in [(0, "points"), (1, "lines"), (2, "lines"), (3, "lines")] {
        let file = Doc::triangle(&format!(r#", "mode": {mode}"#), "").read();
        let expected =
            format!("meshes[0].primitives[0]: {what} are left out: only triangles are seen");
        assert_eq!(findings(&file)[0], expected);
    }
    let error = Doc::triangle(r#", "mode": 7"#, "").error();
    assert_eq!(error, "meshes[0].primitives[0].mode: is 7; 0 to 6 is right");
}

#[test]
fn strides_part_what_is_interleaved() {
    let mut packed = with(r#""POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2"#, "");
    let uvs = [0.0, 0.25, 0.5, 0.75, 1.0, 0.0];
    let normals = [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0];
    packed.floats(&SQUARE[..9], "VEC3");
    packed.floats(&normals, "VEC3");
    packed.floats(&uvs, "VEC2");
    let mut mixed = with(r#""POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2"#, "");
    let rows: Vec<f32> = (0..3)
        .flat_map(|i| {
            let (a, b) = (&SQUARE[3 * i..3 * i + 3], &normals[3 * i..3 * i + 3]);
            [a, b, &uvs[2 * i..2 * i + 2]].concat()
        })
        .collect();
    let view = mixed.view(&bytes(&rows), r#", "byteStride": 32"#);
    for (offset, kind) in [(0, "VEC3"), (12, "VEC3"), (24, "VEC2")] {
        mixed.raw_accessor(&format!(
            r#""bufferView": {view}, "byteOffset": {offset}, "componentType": 5126, "count": 3,
               "type": "{kind}""#
        ));
    }
    let (packed, mixed) = (packed.read(), mixed.read());
    assert_eq!(mesh(&packed, 0), mesh(&mixed, 0));
    let uvs = mesh(&packed, 0).uvs().unwrap();
    assert_eq!(
        uvs,
        [[0.0, 0.75], [0.5, 0.25], [1.0, 1.0]],
        "v runs upward here"
    );
}

#[test]
fn normalized_numbers_of_all_types_are_equal() {
    let small = |x: f32, most: f32| (x * most).round();
    let values = [0.0_f32, 1.0, 0.2, 0.4, 0.6, 0.8];
    let read = |code: u32, content: Vec<u8>, normalized: bool| {
        let mut doc = with(r#""POSITION": 0, "TEXCOORD_0": 1, "COLOR_0": 2"#, "");
        doc.floats(&SQUARE[..9], "VEC3");
        let normalized = if normalized {
            r#", "normalized": true"#
        } else {
            ""
        };
        for (kind, count) in [("VEC2", 3), ("VEC3", 2)] {
            let json = format!(
                r#""componentType": {code}, "count": {count}, "type": "{kind}"{normalized}"#
            );
            if count == 3 {
                doc.accessor(&content, &json);
            }
        }
        doc.floats(&[1.0, 0.5, 0.25, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0], "VEC3");
        doc.read()
    };
    let expected = read(5126, bytes(&values), false);
    let wide = |most: f32| -> Vec<u8> {
        let whole = values.map(|x| small(x, most) as u16);
        whole.iter().flat_map(|x| x.to_le_bytes()).collect()
    };
    for (code, content) in [
        (5121, values.map(|x| small(x, 255.0) as u8).to_vec()),
        (5123, wide(65535.0)),
    ] {
        let file = read(code, content, true);
        let pairs = mesh(&file, 0).uvs().unwrap().iter().flatten();
        for (a, b) in pairs.zip(mesh(&expected, 0).uvs().unwrap().iter().flatten()) {
            assert!((a - b).abs() < 1e-6, "{code}: {a} {b}");
        }
        assert_eq!(mesh(&file, 0).colours(), mesh(&expected, 0).colours());
    }
    let colours = mesh(&expected, 0).colours().unwrap();
    assert_eq!(colours[0], [1.0, 0.5, 0.25]);
}

#[test]
fn positions_may_be_whole_numbers() {
    let numbers: Vec<u8> = [0_i16, 0, 0, 0, 100, 0, 0, 0, 0, -7, 0, 0]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let mut doc = with(r#""POSITION": 0"#, "");
    doc.rest += r#", "extensionsUsed": ["KHR_mesh_quantization"],
                     "extensionsRequired": ["KHR_mesh_quantization"]"#;
    let view = doc.view(&numbers, r#", "byteStride": 8"#);
    doc.raw_accessor(&format!(
        r#""bufferView": {view}, "componentType": 5122, "count": 3, "type": "VEC3""#
    ));
    let file = doc.read();
    assert_eq!(
        corners(&file)[0][1..],
        [[100.0, 0.0, 0.0], [0.0, -7.0, 0.0]]
    );
    assert!(findings(&file).is_empty());
}

#[test]
fn sparse_numbers_stand_in_place_of_others_or_of_zeros() {
    for based in [true, false] {
        let mut doc = with(r#""POSITION": 0"#, "");
        let base = doc.view(&bytes(&SQUARE[..9]), "");
        let indices = doc.view(&[1, 2], "");
        let values = doc.view(&bytes(&[5.0, 0.0, 0.0, 0.0, 6.0, 0.0]), "");
        let base = if based {
            format!(r#""bufferView": {base}, "#)
        } else {
            String::new()
        };
        doc.raw_accessor(&format!(
            r#"{base}"componentType": 5126, "count": 3, "type": "VEC3", "sparse": {{"count": 2,
               "indices": {{"bufferView": {indices}, "componentType": 5121}},
               "values": {{"bufferView": {values}}}}}"#
        ));
        let expected = [[[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [0.0, 6.0, 0.0]]];
        assert_eq!(corners(&doc.read()), expected, "{based}");
    }
}

#[test]
fn only_vertices_that_are_used_are_kept() {
    let mut doc = with(r#""POSITION": 0"#, r#", "indices": 1"#);
    let many: Vec<f32> = (0..3000).map(|i| (i * i) as f32).collect();
    doc.floats(&many, "VEC3");
    doc.accessor(
        &[9, 3, 4],
        r#""componentType": 5121, "count": 3, "type": "SCALAR""#,
    );
    let file = doc.read();
    assert_eq!(
        (file.info.vertices, mesh(&file, 0).positions().len()),
        (3, 3)
    );
    assert!(findings(&file).is_empty());
}

#[test]
fn a_mesh_without_normals_is_flat() {
    assert!(mesh(&Doc::triangle("", "").read(), 0).normals().is_none());
}
