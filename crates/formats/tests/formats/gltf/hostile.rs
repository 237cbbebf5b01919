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
