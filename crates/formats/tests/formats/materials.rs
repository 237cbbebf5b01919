//! What materials files come out as.

use std::path::PathBuf;

use ombra_formats::{
    Assets, ImageBuffer, Limits, Metadata, Model, read_model, read_model_bytes, write_image,
};
use ombra_scene::{Material, Rgb, Texture};

use super::{Folder, findings, read_in};

const MODEL: &str = "mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";

fn material(statements: &str) -> Material {
    try_material(statements).unwrap_or_else(|error| panic!("{error}"))
}

fn try_material(statements: &str) -> Result<Material, String> {
    let library = format!("newmtl m\n{statements}");
    let folder = Folder::with(&[
        ("model.obj", MODEL.as_bytes()),
        ("model.mtl", library.as_bytes()),
    ]);
    read_in(&folder, "model.obj").map(|mut model| model.materials.remove(0))
}

const COLOURS: &str = "Ka 0.1 0.1 0.1\nKd 0.5 0.25 0\nKs 0.9 0.8 0.7\nNs 50\nNi 1.33\n";

#[test]
fn the_illumination_models_are_whitteds_materials() {
    let with = |model: &str| material(&format!("{COLOURS}illum {model}\n"));
    let (kd, ks) = (Rgb::new(0.5, 0.25, 0.0), Rgb::new(0.9, 0.8, 0.7));
    for model in ["0", "1"] {
        let diffuse = with(model);
        assert_eq!(
            diffuse,
            Material {
                shininess: 50.0,
                ..Material::matt("m", kd)
            }
        );
    }
    let phong = with("2");
    assert_eq!((phong.specular, phong.shininess), (ks, 50.0));
    assert!(phong.reflection.is_black() && phong.transmission.is_black());
    let mirror = with("3");
    assert_eq!((mirror.reflection, mirror.fresnel), (ks, false));
    let glass = with("4");
    assert_eq!(
        (glass.transmission, glass.index_of_refraction),
        (Rgb::WHITE, 1.33)
    );
    assert!(glass.fresnel);
    let fresnel_mirror = with("5");
    assert_eq!(
        (fresnel_mirror.reflection, fresnel_mirror.fresnel),
        (ks, true)
    );
    let refraction = with("6");
    assert_eq!(
        (refraction.transmission, refraction.fresnel),
        (Rgb::WHITE, false)
    );
    let fresnel_refraction = with("7");
    assert_eq!(
        (
            fresnel_refraction.index_of_refraction,
            fresnel_refraction.fresnel
        ),
        (1.33, true)
    );
}

#[test]
fn without_illum_the_highlight_decides() {
    assert_eq!(
        material("Kd 1 0 0\n"),
        Material::matt("m", Rgb::new(1.0, 0.0, 0.0))
    );
    assert_eq!(material("Kd 1 0 0\nKs 0.5\n").specular, Rgb::grey(0.5));
    assert_eq!(
        material(""),
        Material {
            name: "m".to_owned(),
            ..Material::default()
        }
    );
}

#[test]
fn opacity_and_filters_let_light_through() {
    for statement in ["d 0.25", "Tr 0.75", "d -halo 0.25"] {
        let thin = material(&format!("Kd 1 1 1\n{statement}\n"));
        assert_eq!(thin.transmission, Rgb::grey(0.75), "{statement}");
        assert_eq!(thin.diffuse, Texture::Constant(Rgb::grey(0.25)));
        assert_eq!(thin.index_of_refraction, 1.0);
    }
    let filtered = material("illum 6\nTf 0.5 0.6 0.7\nNi 1.5\n");
    assert_eq!(filtered.transmission, Rgb::new(0.5, 0.6, 0.7));
    assert_eq!(material("Ke 3 2 1\n").emission, Rgb::new(3.0, 2.0, 1.0));
    // Exporters write a white filter for what is opaque.
    assert!(material("illum 2\nTf 1 1 1\nd 1\n").transmission.is_black());
}

#[test]
fn faults_in_a_materials_file_are_named_with_its_line() {
    for (statements, expected) in [
        ("Kd 1 0\n", "model.mtl:2: Kd has 1 number, but needs 2"),
        (
            "Kd 1 0 nan\n",
            "model.mtl:2: Kd is \"nan\"; a finite number is needed",
        ),
        (
            "illum 11\n",
            "model.mtl:2: \"11\" found where an illumination model from 0 to 10",
        ),
        ("\nNs\n", "model.mtl:3: Ns has 0 numbers, but needs 1"),
    ] {
        let error = try_material(statements).unwrap_err();
        assert!(error.starts_with(expected), "{error}");
    }
    let folder = Folder::with(&[
        ("model.obj", MODEL.as_bytes()),
        ("model.mtl", b"Kd 1 1 1\n"),
    ]);
    let error = read_in(&folder, "model.obj").unwrap_err();
    assert_eq!(
        error,
        "model.mtl:1: \"Kd\" found where newmtl NAME is expected"
    );
}

#[test]
fn parts_come_one_a_material_in_the_order_of_use() {
    let text = "mtllib a.mtl b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 4\nusemtl red one\n\
        f 1 2 3\nusemtl blue\nf 2 3 4\nusemtl red one\nf 3 4 1\n";
    let folder = Folder::with(&[
        ("model.obj", text.as_bytes()),
        ("a.mtl", b"newmtl red one\nKd 1 0 0\nmap_Ks x.png\n"),
        (
            "b.mtl",
            b"newmtl blue\nKd 0 0 1\nnewmtl unused\nmap_Kd huge.png\n",
        ),
    ]);
    let model = read_in(&folder, "model.obj").unwrap();
    let shape = |m: &Model| -> Vec<_> {
        let parts = m.parts.iter();
        parts
            .map(|p| {
                (
                    p.name.clone(),
                    p.mesh.triangles().len(),
                    p.mesh.positions().len(),
                )
            })
            .collect()
    };
    assert_eq!(
        shape(&model),
        [
            ("default".into(), 1, 3),
            ("red one".into(), 2, 4),
            ("blue".into(), 1, 3)
        ]
    );
    assert_eq!(
        model.materials[2],
        Material::matt("blue", Rgb::new(0.0, 0.0, 1.0))
    );
    assert_eq!(
        findings(&model),
        ["a.mtl: line 3: keyword \"map_Ks\" not used"]
    );
}

#[test]
fn what_is_missing_or_lies_outside_is_told_and_never_opened() {
    let folder = Folder::with(&[("model.obj", MODEL.as_bytes())]);
    let model = read_in(&folder, "model.obj").unwrap();
    assert_eq!(
        findings(&model),
        [
            "materials file model.mtl not found: default grey used",
            "line 5: material \"m\" is not defined: default grey used"
        ]
    );
    for name in ["../secret.mtl", "/etc/passwd"] {
        let text = MODEL.replace("model.mtl", name);
        let folder = Folder::with(&[("model.obj", text.as_bytes())]);
        let model = read_in(&folder, "model.obj").unwrap();
        assert_eq!(
            findings(&model)[0],
            format!("materials file {name} lies outside the model's folder: not opened")
        );
    }
}

#[test]
fn a_texture_is_linear_and_tinted_by_kd() {
    let folder = Folder::with(&[
        ("model.obj", MODEL.as_bytes()),
        (
            "model.mtl",
            b"newmtl m\nKd 0.5 0.5 0.5\nmap_Kd -s 2 2 -clamp on my wood.png\n",
        ),
    ]);
    let half = ImageBuffer::new(1, 1, vec![Rgb::grey(0.5)]).unwrap();
    write_image(folder.path("my wood.png"), &half, &Metadata::default()).unwrap();
    let model = read_in(&folder, "model.obj").unwrap();
    let colour = model.materials[0].diffuse.average();
    assert!((colour.r - 0.25).abs() < 2e-3, "{colour:?}");
    assert_eq!(
        findings(&model),
        [
            "map option \"-s\" not used",
            "map option \"-clamp\" not used"
        ]
    );
    // Textures are counted together.
    let limits = Limits {
        image_pixels: 1,
        ..Limits::default()
    };
    let error = read_model(folder.path("model.obj"), &limits).unwrap_err();
    assert!(
        error.to_string().contains("over the limit of 0 pixels"),
        "{error}"
    );
}

#[test]
fn a_model_in_memory_finds_its_materials_there_and_nowhere_else() {
    const OBJ: &[u8] = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
    const MTL: &[u8] = b"newmtl red\nKd 1 0 0\nmap_Kd t.tga\n";
    let pixel = b"\0\0\x02\0\0\0\0\0\0\0\0\0\x01\0\x01\0\x18\0\xff\xff\xff";
    let limits = Limits::default();
    let files = [("a.mtl", MTL), ("t.tga", pixel.as_slice())];
    let model = read_model_bytes("a.obj", OBJ, &Assets::Embedded(&files), &limits).unwrap();
    assert_eq!(
        model.materials[0].diffuse.average(),
        Rgb::new(1.0, 0.0, 0.0)
    );
    assert_eq!(model.files, ["a.obj", "a.mtl", "t.tga"].map(PathBuf::from));
    assert_eq!(findings(&model), [""; 0]);
    // A file of that name in the current folder is not it.
    let folder = Folder::with(&[("a.mtl", MTL)]);
    let name = folder.path("a.obj");
    let model = read_model_bytes(name, OBJ, &Assets::Embedded(&[]), &limits).unwrap();
    assert_eq!(
        findings(&model),
        [
            "materials file a.mtl not found: default grey used",
            "line 5: material \"red\" is not defined: default grey used",
        ]
    );
}
