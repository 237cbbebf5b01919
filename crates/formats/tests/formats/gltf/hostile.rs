//! The reader never panics, whatever the bytes, and takes no more memory than they are worth.

use ombra_formats::{GltfFile, Limits, parse_gltf};
use ombra_geometry::triangle::TriangleTest;
use proptest::prelude::*;

use super::Doc;

/// A bit of everything.
fn rich() -> Doc {
    let mut doc = Doc::triangle(
        r#", "material": 0, "mode": 4"#,
        r#", "materials": [{"alphaMode": "BLEND", "emissiveFactor": [1, 1, 1],
             "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 0.5], "metallicFactor": 0},
             "extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.5},
                            "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 1}}}],
           "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "aspectRatio": 1.5}}],
           "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 2}]}},
           "scene": 0, "scenes": [{"nodes": [0, 2]}]"#,
    );
    doc.rest = doc.rest.replace(
        r#"[{"mesh": 0}]"#,
        r#"[{"mesh": 0, "children": [1], "scale": [1, 2, 3]},
            {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}}},
            {"camera": 0, "rotation": [0, 0, 0, 1],
             "extensions": {"KHR_lights_punctual": {"light": 0}}}]"#,
    );
    let indices = doc.view(&[0, 2], "");
    let values = doc.view(&super::bytes(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]), "");
    doc.raw_accessor(&format!(
        r#""componentType": 5126, "count": 3, "type": "VEC3", "sparse": {{"count": 2,
           "indices": {{"bufferView": {indices}, "componentType": 5121}},
           "values": {{"bufferView": {values}}}}}"#
    ));
    doc
}

fn check(bytes: &[u8]) -> Result<(), TestCaseError> {
    let read = parse_gltf(bytes, TriangleTest::default(), &Limits::default());
    match read {
        Ok(GltfFile { scene, .. }) => {
            prop_assert!(scene.validate().is_ok());
            prop_assert!(scene.objects.len() <= 1 << 20);
        }
        Err(error) => prop_assert!(!error.to_string().contains('\n')),
    }
    Ok(())
}

/// Digits, since most of what is telling in a document is numbers.
fn change() -> impl Strategy<Value = (usize, u8)> {
    let telling = prop::sample::select(&b"0123456789-.e[]{}\",:"[..]);
    (any::<usize>(), prop_oneof![3 => telling, 1 => any::<u8>()])
}

#[test]
fn the_document_is_read_when_nothing_is_changed() {
    let file = rich().read();
    assert_eq!((file.scene.objects.len(), file.scene.lights.len()), (4, 1));
    assert!(file.scene.camera.is_some());
}

/// Nodes that each place a mesh of which nothing is shown 200,000 times, by an accessor without bytes.
#[test]
fn placements_of_nothing_are_charged_too() {
    let spread = r#"{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing":
        {"attributes": {"TRANSLATION": 1}}}}"#;
    let flat = spread.replace(r#""mesh""#, r#""scale": [0, 0, 0], "mesh""#);
    let lines = r#"{"attributes": {"POSITION": 0}, "mode": 1}"#;
    for (node, primitives, count) in [
        (spread, "", 200_000),
        (spread, r#"{"attributes": {}}"#, 100_000),
        (spread, lines, 100_000),
        (&flat, lines, 100_000),
    ] {
        let nodes = vec![node; 700].join(",");
        let mut doc = Doc::new(&format!(
            r#""nodes": [{nodes}], "meshes": [{{"primitives": [{primitives}]}}]"#
        ));
        doc.floats(&[0.0; 9], "VEC3");
        doc.raw_accessor(&format!(
            r#""componentType": 5126, "count": {count}, "type": "VEC3""#
        ));
        let error = doc.error();
        assert!(
            error.contains("more than a file of this size is trusted with"),
            "{error}"
        );
    }
}

/// Files of many gigabytes without content: to read them whole would take too long.
#[cfg(unix)]
#[test]
fn files_are_read_as_far_as_they_are_needed() {
    use crate::Folder;
    use ombra_formats::read_gltf;

    let mut doc = Doc::triangle(r#", "material": 0"#, "");
    doc.rest += r#", "materials": [{"emissiveTexture": {"index": 0}, "emissiveFactor": [1, 1, 1]}],
        "textures": [{"source": 0}], "images": [{"uri": "a.png"}]"#;
    let (text, buffer) = doc.gltf_beside("a.bin");
    let folder = Folder::with(&[("a.gltf", text.as_bytes()), ("a.bin", buffer)]);
    let lengthen = |name| {
        let path = folder.path(name);
        let mut options = std::fs::File::options();
        let file = options.append(true).create(true).open(path).unwrap();
        file.set_len(1 << 36).unwrap();
    };
    let limits = Limits {
        image_pixels: 4,
        ..Limits::default()
    };
    let read = || read_gltf(folder.path("a.gltf"), TriangleTest::default(), &limits);
    lengthen("a.bin");
    assert_eq!(read().unwrap().info.triangles, 1);
    lengthen("a.png");
    let error = read().unwrap_err().to_string();
    let said = r#"images[0].uri: "a.png" has more than 16777248 bytes"#;
    assert!(error.contains(said), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn documents_that_are_changed_and_cut(
        changes in prop::collection::vec(change(), 1..5),
        cut in prop::option::weighted(0.2, 0..3000_usize),
    ) {
        let doc = rich();
        for mut bytes in [doc.gltf().into_bytes(), doc.glb()] {
            for (at, byte) in &changes {
                let at = at % bytes.len();
                bytes[at] = *byte;
            }
            if let Some(cut) = cut {
                bytes.truncate(cut);
            }
            check(&bytes)?;
        }
    }

    /// Only numbers change, so that the document stays one.
    #[test]
    fn numbers_that_are_changed(
        changes in prop::collection::vec((any::<usize>(), prop::sample::select(&b"0123456789"[..])), 1..8),
    ) {
        let mut bytes = rich().gltf().into_bytes();
        // The data URI is left alone.
        let from = bytes.windows(12).position(|w| w == b"\"bufferViews").unwrap();
        let digits: Vec<usize> = (from..bytes.len()).filter(|&i| bytes[i].is_ascii_digit()).collect();
        for (at, digit) in changes {
            bytes[digits[at % digits.len()]] = digit;
        }
        check(&bytes)?;
    }
}
