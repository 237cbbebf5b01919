//! Lights, and what shines.

use ombra_scene::light::Falloff;
use ombra_scene::{Light, Rgb};

use super::{Doc, findings};
use ombra_geometry::{Point3, Vector3};
use std::f32::consts::{FRAC_1_PI, PI};

/// A big triangle in the xy plane, and a node with a light in front of it.
fn lit(light: &str, node: &str) -> Doc {
    let mut doc = Doc::triangle(
        "",
        &format!(
            r#", "extensionsUsed": ["KHR_lights_punctual"],
               "extensions": {{"KHR_lights_punctual": {{"lights": [{light}]}}}}"#
        ),
    );
    let nodes = format!(
        r#"[{{"mesh": 0}}, {{{node}, "extensions": {{"KHR_lights_punctual": {{"light": 0}}}}}}]"#
    );
    doc.rest = doc.rest.replace(r#"[{"mesh": 0}]"#, &nodes);
    doc
}

fn close(a: Rgb, b: Rgb) {
    let off = a.to_array().into_iter().zip(b.to_array());
    assert!(
        off.into_iter().all(|(a, b)| (a - b).abs() < 1e-5),
        "{a:?} {b:?}"
    );
}

#[test]
fn lights_shine_along_their_node_and_fall_off() {
    let light = format!(r#"{{"type": "directional", "color": [1, 0.5, 0], "intensity": {PI}}}"#);
    let file = lit(&light, r#""translation": [0, 0, 5]"#).read();
    match &file.scene.lights[..] {
        [
            Light::Directional {
                direction,
                intensity,
            },
        ] => {
            assert_eq!(*direction, -Vector3::Z);
            close(*intensity, Rgb::new(1.0, 0.5, 0.0));
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(findings(&file), [""; 0]);
    let file = lit(
        r#"{"type": "point", "intensity": 2}"#,
        r#""translation": [0.3, 0.3, 1]"#,
    )
    .read();
    match &file.scene.lights[..] {
        [
            Light::Point {
                position,
                intensity,
                falloff,
            },
        ] => {
            assert_eq!(*position, Point3::new(0.3, 0.3, 1.0));
            assert_eq!(*falloff, Falloff::InverseSquare);
            close(*intensity, Rgb::grey(2.0 * FRAC_1_PI));
        }
        other => panic!("{other:?}"),
    }
    let spot = r#"{"type": "spot", "intensity": 2, "range": 9,
                   "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}}"#;
    let file = lit(spot, r#""translation": [0.3, 0.3, 1]"#).read();
    match &file.scene.lights[..] {
        [
            Light::Spot {
                direction,
                inner,
                outer,
                falloff,
                ..
            },
        ] => {
            assert_eq!(*direction, -Vector3::Z);
            assert_eq!(*falloff, Falloff::InverseSquareWithin { range: 9.0 });
            assert!((inner.radians() - 0.25).abs() < 1e-6 && (outer.radians() - 0.5).abs() < 1e-6);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_is_too_bright_or_too_dark_to_be_seen_is_scaled() {
    for watts in [1e-4, 1e5] {
        let light = format!(r#"{{"type": "directional", "intensity": {watts}}}"#);
        let file = lit(&light, r#""translation": [0, 0, 5]"#).read();
        match &file.scene.lights[..] {
            [Light::Directional { intensity, .. }] => close(*intensity, Rgb::grey(0.6)),
            other => panic!("{other:?}"),
        }
        assert!(
            findings(&file)[0].starts_with("lights: scaled by "),
            "{:?}",
            findings(&file)
        );
    }
}

#[test]
fn what_shines_lights_a_file_without_lights() {
    let lamp = r#", "materials": [{"emissiveFactor": [1, 1, 1], "extensions":
        {"KHR_materials_emissive_strength": {"emissiveStrength": 10}}}]"#;
    let mut doc = Doc::triangle(r#", "material": 0"#, lamp);
    doc.rest = doc.rest.replace(
        r#"[{"mesh": 0}]"#,
        r#"[{"mesh": 0, "scale": [2, 1, 1]}, {"mesh": 1, "translation": [0, 0, 1]}]"#,
    );
    doc.rest = doc
        .rest
        .replace(r#"", "material": 0}]}]"#, r#""material": 0}]}]"#);
    doc.rest = doc.rest.replacen(
        r#""material": 0}]}"#,
        r#""material": 0}]}, {"primitives": [{"attributes": {"POSITION": 0}}]}"#,
        1,
    );
    let file = doc.read();
    match &file.scene.lights[..] {
        [
            Light::Spot {
                position,
                direction,
                outer,
                intensity,
                ..
            },
        ] => {
            assert_eq!(*direction, Vector3::Z);
            assert!((outer.degrees() - 90.0).abs() < 1e-4);
            assert!((*position - Point3::new(2.0 / 3.0, 1.0 / 3.0, 0.0)).length() < 0.01);
            // Radiance 10 over an area of 1.
            let factor = intensity.r * PI / 10.0;
            assert!(factor > 0.1 && factor < 10.0, "{factor}");
        }
        other => panic!("{other:?}"),
    }
    let lamp = &file.scene.materials[file.scene.objects[0].material.index()];
    assert!(lamp.is_light_source());
    assert!(findings(&file)[0].contains("1 made at what shines"));
}

#[test]
fn a_lamp_lets_no_light_through_and_has_a_finite_one() {
    let lamp = r#", "materials": [{"emissiveFactor": [1e30, 1, 1], "extensions":
        {"KHR_materials_transmission": {"transmissionFactor": 0.5}}}]"#;
    let mut doc = Doc::triangle(r#", "material": 0"#, lamp);
    assert!(doc.read().scene.materials[0].is_light_source());
    let large = r#"[{"mesh": 0, "scale": [1e9, 1e9, 1]}]"#;
    doc.rest = doc.rest.replace(r#"[{"mesh": 0}]"#, large);
    let error = doc.error();
    let said = "materials[0].emissiveFactor: [1e30, 1.0, 1.0] over the area of";
    assert!(error.starts_with(said), "{error}");
}

#[test]
fn lights_that_are_none_are_named() {
    for (light, said) in [
        (
            r#"{"type": "lamp"}"#,
            "extensions.KHR_lights_punctual.lights[0].type: unknown variant `lamp`",
        ),
        (
            r#"{"type": "point", "intensity": -1}"#,
            "extensions.KHR_lights_punctual.lights[0].intensity: is -1;",
        ),
        (
            r#"{"type": "point", "color": [1e30, 0, 0], "intensity": 1e30}"#,
            "extensions.KHR_lights_punctual.lights[0].intensity: is 1",
        ),
        (
            r#"{"type": "spot", "spot": {"innerConeAngle": 1, "outerConeAngle": 0.5}}"#,
            "extensions.KHR_lights_punctual.lights[0].spot: innerConeAngle is 1",
        ),
    ] {
        let error = lit(light, r#""name": "sun""#).error();
        assert!(error.starts_with(said), "{error}");
    }
    let mut doc = lit("", r#""name": "sun""#);
    doc.rest += "";
    assert!(
        doc.error()
            .starts_with("nodes[1].extensions.KHR_lights_punctual.light: refers to lights[0]")
    );
}
