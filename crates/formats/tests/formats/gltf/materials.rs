//! Materials and textures.

use std::io::Cursor;

use image::{ImageFormat, Rgb as Pixel, RgbImage, Rgba, RgbaImage};
use ombra_formats::{GltfFile, Limits, parse_gltf, read_gltf};
use ombra_geometry::Point3;
use ombra_geometry::triangle::TriangleTest;
use ombra_scene::{Filter, Material, PictureTexture, Rgb, Texture, Wrap};

use super::{Doc, findings};
use crate::Folder;

/// The material of a triangle, and the notes on it, from its JSON.
fn material(json: &str) -> (Material, Vec<String>) {
    let file = document(json).read();
    (only(&file), findings(&file))
}

fn document(json: &str) -> Doc {
    let mut doc = Doc::triangle(r#", "material": 0"#, &format!(r#", "materials": [{json}]"#));
    doc.rest = doc
        .rest
        .replace(r#""POSITION": 0"#, r#""POSITION": 0, "TEXCOORD_0": 2"#);
    doc.floats(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0], "VEC2");
    doc
}

fn only(file: &GltfFile) -> Material {
    file.scene.materials[file.scene.objects[0].material.index()].clone()
}

/// Red and green above, blue and white below; the opacity of each from the left.
fn four_pixels(alpha: [u8; 4]) -> Vec<u8> {
    let [a, b, c, d] = alpha;
    let pixels = [
        [255, 0, 0, a],
        [0, 255, 0, b],
        [0, 0, 255, c],
        [255, 255, 255, d],
    ];
    let image = RgbaImage::from_fn(2, 2, |x, y| Rgba(pixels[(2 * y + x) as usize]));
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// The same with a texture 0 of those pixels, sampled as `sampler` says.
fn textured(json: &str, alpha: [u8; 4], sampler: &str) -> Doc {
    let mut doc = document(json);
    let view = doc.view(&four_pixels(alpha), "");
    doc.rest += &format!(
        r#", "textures": [{{"source": 0, "sampler": 0}}], "samplers": [{{{sampler}}}],
           "images": [{{"bufferView": {view}, "mimeType": "image/png"}}]"#
    );
    doc
}

const BASE: &str =
    r#""pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}"#;

fn picture(material: &Material) -> &PictureTexture {
    match &material.diffuse {
        Texture::Picture(picture) => picture,
        other => panic!("{other:?} is no picture"),
    }
}

#[test]
fn a_dielectric_is_matt_with_a_highlight() {
    let (material, notes) = material(
        r#"{"name": "clay", "pbrMetallicRoughness":
           {"baseColorFactor": [0.5, 0.25, 0.125, 1], "metallicFactor": 0, "roughnessFactor": 0.5}}"#,
    );
    assert_eq!(material.name, "clay");
    assert_eq!(
        material.diffuse,
        Texture::Constant(Rgb::new(0.5, 0.25, 0.125))
    );
    assert!(
        (material.shininess - 7.5).abs() < 1e-4,
        "(2 / 0.25² − 2) / 4"
    );
    assert!((material.specular.g - 0.04 * 9.5 / 2.0).abs() < 1e-4);
    assert!(material.reflection.is_black() && material.one_sided);
    assert_eq!(notes, [""; 0]);
}

#[test]
fn metal_is_a_mirror_by_its_smoothness() {
    let (material, _) = material(
        r#"{"doubleSided": true, "pbrMetallicRoughness":
           {"baseColorFactor": [0.8, 0.4, 0.2, 1], "roughnessFactor": 0.5}}"#,
    );
    assert_eq!(material.reflection, Rgb::new(0.8, 0.4, 0.2) * 0.25);
    assert_eq!(
        material.diffuse,
        Texture::Constant(Rgb::new(0.8, 0.4, 0.2) * 0.75)
    );
    assert!(!material.one_sided);
}

#[test]
fn without_a_material_a_mesh_is_white() {
    let scene = Doc::triangle("", "").read().scene;
    assert_eq!(scene.materials[0].diffuse, Texture::Constant(Rgb::WHITE));
}

#[test]
fn a_texture_is_the_right_way_up_and_multiplied() {
    let json = r#"{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0,
                   "baseColorFactor": [0.5, 0.5, 0.5, 1]}}"#;
    let material = only(&textured(json, [255; 4], r#""magFilter": 9728"#).read());
    // glTF's (0.25, 0.25) is the upper left pixel; v is turned when the mesh is read.
    let at = |u, v: f32| material.diffuse_at(Point3::ORIGIN, [u, 1.0 - v]);
    assert_eq!(at(0.25, 0.25), Rgb::new(0.5, 0.0, 0.0));
    assert_eq!(at(0.75, 0.25), Rgb::new(0.0, 0.5, 0.0));
    assert_eq!(at(0.25, 0.75), Rgb::new(0.0, 0.0, 0.5));
    assert_eq!(at(0.25, 1.25), Rgb::new(0.5, 0.0, 0.0), "repeated");
}

#[test]
fn samplers_wrap_and_filter() {
    let json = format!("{{{BASE}}}");
    for (sampler, wrap, filter) in [
        ("", [Wrap::Repeat; 2], Filter::Linear),
        (
            r#""wrapS": 33071, "wrapT": 33648, "magFilter": 9729"#,
            [Wrap::Clamp, Wrap::Mirror],
            Filter::Linear,
        ),
        (
            r#""wrapS": 33648, "wrapT": 10497, "magFilter": 9728"#,
            [Wrap::Mirror, Wrap::Repeat],
            Filter::Nearest,
        ),
    ] {
        let material = only(&textured(&json, [255; 4], sampler).read());
        let picture = picture(&material);
        assert_eq!((picture.wrap, picture.filter), (wrap, filter));
    }
    let error = textured(&json, [255; 4], r#""wrapS": 1"#).error();
    assert!(
        error.starts_with(
            "materials[0].pbrMetallicRoughness.baseColorTexture: wrapS of its sampler: is 1;"
        ),
        "{error}"
    );
}

#[test]
fn a_texture_may_be_laid_out_by_another_set_and_moved() {
    let json = r#"{"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorTexture": {"index": 0,
        "texCoord": 1, "extensions": {"KHR_texture_transform": {"offset": [0.5, 0]}}}}}"#;
    let mut doc = textured(json, [255; 4], r#""magFilter": 9728"#);
    doc.rest = doc
        .rest
        .replace(r#""TEXCOORD_0": 2"#, r#""TEXCOORD_0": 2, "TEXCOORD_1": 3"#);
    doc.floats(&[0.25, 0.25, 0.25, 0.25, 0.25, 0.25], "VEC2");
    let file = doc.read();
    assert_eq!(super::mesh(&file, 0).uvs().unwrap()[0], [0.25, 0.75]);
    let seen = only(&file).diffuse_at(Point3::ORIGIN, [0.25, 0.75]);
    assert_eq!(seen, Rgb::new(0.0, 1.0, 0.0));
}

#[test]
fn metal_and_roughness_may_come_from_a_texture() {
    let json = r#"{"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}}}"#;
    let file = textured(json, [255; 4], "").read();
    // Half of the four pixels have green and half have blue.
    let roughness = 0.5_f32;
    let material = only(&file);
    assert!((material.reflection.r - 0.5 * (1.0 - roughness).powi(2)).abs() < 1e-5);
    assert!(findings(&file)[0].ends_with("of metallicRoughnessTexture the mean is used"));
}

#[test]
fn opacity_below_the_cutoff_is_a_hole() {
    let json = format!(r#"{{"alphaMode": "MASK", "alphaCutoff": 0.25, {BASE}}}"#);
    let json = json.replace(
        r#""metallicFactor""#,
        r#""baseColorFactor": [1, 1, 1, 0.5], "metallicFactor""#,
    );
    let material = only(&textured(&json, [255, 0, 128, 100], r#""magFilter": 9728"#).read());
    let cutout = material.cutout.as_ref().unwrap();
    let is_there = |u, v| cutout.picture.alpha_at([u, v]) >= cutout.cutoff;
    assert!(is_there(0.25, 0.75) && !is_there(0.75, 0.75));
    assert!(is_there(0.25, 0.25) && !is_there(0.75, 0.25));
    let clear =
        r#"{"alphaMode": "MASK", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.4]}}"#;
    let file = document(clear).read();
    assert!(file.scene.objects.is_empty());
    assert!(findings(&file)[0].contains("all clear"));
    let opaque = clear.replace("MASK", "OPAQUE");
    assert_eq!(document(&opaque).read().scene.objects.len(), 1);
}

#[test]
fn blended_opacity_lets_light_through_unbent() {
    let (material, _) = material(
        r#"{"alphaMode": "BLEND", "pbrMetallicRoughness":
           {"baseColorFactor": [1, 0.5, 0, 0.25], "metallicFactor": 0}}"#,
    );
    assert_eq!(material.transmission, Rgb::grey(0.75));
    assert_eq!(material.index_of_refraction, 1.0);
    assert_eq!(
        material.diffuse,
        Texture::Constant(Rgb::new(0.25, 0.125, 0.0))
    );
    let json = format!(r#"{{"alphaMode": "BLEND", {BASE}}}"#);
    let leaf = only(&textured(&json, [255, 0, 255, 255], "").read());
    assert!(leaf.cutout.is_some() && leaf.transmission.is_black());
}

#[test]
fn transmission_is_glass_with_a_volume_and_a_sheet_without() {
    let json = |volume: &str| {
        format!(
            r#"{{"pbrMetallicRoughness": {{"metallicFactor": 0, "roughnessFactor": 0}}, "extensions":
               {{"KHR_materials_transmission": {{"transmissionFactor": 0.75}},
                 "KHR_materials_ior": {{"ior": 1.3}}{volume}}}}}"#
        )
    };
    let (sheet, _) = material(&json(""));
    assert_eq!((sheet.index_of_refraction, sheet.one_sided), (1.0, true));
    assert_eq!(sheet.transmission, Rgb::grey(0.75));
    assert_eq!(sheet.diffuse, Texture::Constant(Rgb::grey(0.25)));
    let (glass, notes) = material(&json(
        r#", "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 2,
            "attenuationColor": [0.25, 1, 0]}"#,
    ));
    assert_eq!(
        (glass.index_of_refraction, glass.one_sided, glass.fresnel),
        (1.3, false, true)
    );
    let left = glass.left_after(4.0);
    assert!(
        (left.r - 0.0625).abs() < 1e-6 && left.g == 1.0 && left.b < 1e-6,
        "{left:?}"
    );
    assert_eq!(notes, [""; 0]);
}

#[test]
fn light_of_its_own_has_a_strength_and_a_picture() {
    let json = r#"{"emissiveFactor": [1, 0.5, 0], "emissiveTexture": {"index": 0}, "extensions":
        {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}}"#;
    let material = only(&textured(json, [255; 4], r#""magFilter": 9728"#).read());
    assert_eq!(material.emission_at([0.25, 0.75]), Rgb::new(4.0, 0.0, 0.0));
    assert_eq!(material.emission_at([0.25, 0.25]), Rgb::BLACK);
    let unlit = format!(r#"{{{BASE}, "extensions": {{"KHR_materials_unlit": {{}}}}}}"#);
    let unlit = only(&textured(&unlit, [255; 4], r#""magFilter": 9728"#).read());
    assert!(unlit.is_light_source());
    assert_eq!(unlit.emission_at([0.75, 0.75]), Rgb::new(0.0, 1.0, 0.0));
}

#[test]
fn pictures_may_lie_beside_the_file_or_in_it() {
    let mut doc = document(&format!("{{{BASE}}}"));
    doc.rest += r#", "textures": [{"source": 0}], "images": [{"uri": "a%20b.jpg"}]"#;
    let mut jpeg = Cursor::new(Vec::new());
    let image = RgbImage::from_pixel(8, 8, Pixel([255, 255, 255]));
    image.write_to(&mut jpeg, ImageFormat::Jpeg).unwrap();
    let jpeg = jpeg.into_inner();
    let folder = Folder::with(&[("x.glb", &doc.glb()), ("a b.jpg", &jpeg)]);
    let read = || {
        read_gltf(
            folder.path("x.glb"),
            TriangleTest::default(),
            &Limits::default(),
        )
    };
    let file = read().unwrap();
    assert_eq!(file.files, [folder.path("x.glb"), folder.path("a b.jpg")]);
    assert!(picture(&only(&file)).average().r > 0.99);
    std::fs::remove_file(folder.path("a b.jpg")).unwrap();
    assert_eq!(
        findings(&read().unwrap()),
        ["texture a b.jpg not found: plain colour used"]
    );
    let in_memory = doc.read();
    assert_eq!(
        findings(&in_memory),
        ["texture a b.jpg not found: plain colour used"]
    );
    let climbing = doc.gltf().replace("a%20b.jpg", "%2e%2e/secret.png");
    std::fs::write(folder.path("y.gltf"), climbing).unwrap();
    let file = read_gltf(
        folder.path("y.gltf"),
        TriangleTest::default(),
        &Limits::default(),
    );
    let outside = "texture ../secret.png lies outside the model's folder: not opened";
    assert_eq!(findings(&file.unwrap()), [outside]);
}

#[test]
fn pictures_have_one_limit_and_broken_ones_are_named() {
    let doc = textured(&format!("{{{BASE}}}"), [255; 4], "");
    let limits = Limits {
        image_pixels: 3,
        ..Limits::default()
    };
    let error = parse_gltf(&doc.glb(), TriangleTest::default(), &limits).unwrap_err();
    let expected = "images[0]: image is 2x2 pixels, over the limit of 3 pixels";
    assert_eq!(error.to_string(), expected);
    let mut doc = document(&format!("{{{BASE}}}"));
    let view = doc.view(b"\x89PNG\r\n\x1a\nno picture", "");
    doc.rest +=
        &format!(r#", "textures": [{{"source": 0}}], "images": [{{"bufferView": {view}}}]"#);
    assert!(
        doc.error().starts_with("images[0]: PNG: "),
        "{}",
        doc.error()
    );
}

#[test]
fn numbers_out_of_range_and_textures_that_are_not_there_are_named() {
    for (json, said) in [
        (
            r#"{"emissiveFactor": [1, -1, 0]}"#,
            "materials[0].emissiveFactor: is [1.0, -1.0, 0.0];",
        ),
        (
            r#"{"emissiveFactor": [1e30, 0, 0], "extensions":
                {"KHR_materials_emissive_strength": {"emissiveStrength": 1e30}}}"#,
            "materials[0].emissiveFactor: is [1e30, 0.0, 0.0], which times the emissiveStrength",
        ),
        (
            r#"{"alphaMode": "MASK", "alphaCutoff": -1}"#,
            "materials[0].alphaCutoff: is -1;",
        ),
        (
            r#"{"pbrMetallicRoughness": {"baseColorTexture": {"index": 3}}}"#,
            "materials[0].pbrMetallicRoughness.baseColorTexture.index: refers to textures[3], but there are none",
        ),
        (
            r#"{"alphaMode": "SOFT"}"#,
            "materials[0].alphaMode: unknown variant `SOFT`",
        ),
        (
            r#"{"extensions": {"KHR_materials_ior": {"ior": 0.5}}}"#,
            "materials[0].extensions.KHR_materials_ior.ior: is 0.5; 1 or more, or 0, is right",
        ),
    ] {
        let error = document(json).error();
        assert!(error.starts_with(said), "{error}");
    }
    let doc = Doc::triangle(r#", "material": 4"#, "");
    assert_eq!(
        doc.error(),
        "meshes[0].primitives[0].material: refers to materials[4], but there are none"
    );
}
