//! Scene files and what they refer to.

use ombra_formats::scene::{SceneFile, read_scene};
use ombra_formats::{ImageBuffer, Limits, Metadata, write_image};
use ombra_geometry::triangle::TriangleTest;
use ombra_scene::{Rgb, Texture};

use super::Folder;

const TRIANGLE: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\n";

fn try_scene(folder: &Folder, text: &str, limits: &Limits) -> Result<SceneFile, String> {
    std::fs::write(folder.path("a.toml"), text).unwrap();
    read_scene(folder.path("a.toml"), TriangleTest::default(), limits).map_err(|error| {
        let text = error.to_string();
        assert!(!text.contains('\n'), "an error is one line: {text}");
        let prefix = format!("{}/", folder.0.path().display());
        text.strip_prefix(&prefix).unwrap_or(&text).to_owned()
    })
}

fn wrong(text: &str) -> String {
    let folder = Folder::with(&[("broken.obj", b"v 0 0 0\nf 1 2 3\n")]);
    try_scene(&folder, text, &Limits::default()).unwrap_err()
}

fn folder_with_texture() -> Folder {
    let folder = Folder::with(&[]);
    let image = ImageBuffer::new(2, 2, vec![Rgb::WHITE; 4]).unwrap();
    write_image(folder.path("wood.png"), &image, &Metadata::default()).unwrap();
    folder
}

#[test]
fn a_model_that_is_placed_often_is_loaded_once() {
    let folder = Folder::with(&[("t.obj", TRIANGLE)]);
    let text = "[materials.red]\ndiffuse = [1, 0, 0]\n\
        [[objects]]\nmaterial = \"red\"\nmesh.file = \"t.obj\"\n\
        [[objects]]\nmesh.file = \"t.obj\"\n\
        [[objects]]\nmesh.file = \"t.obj\"\n";
    let file = try_scene(&folder, text, &Limits::default()).unwrap();
    let scene = &file.scene;
    scene.validate().unwrap();
    assert_eq!((scene.geometries.len(), scene.objects.len()), (1, 3));
    let materials: Vec<_> = scene.objects.iter().map(|o| o.material.0).collect();
    assert_eq!(materials, [0, 1, 1]);
    let findings: Vec<_> = file.findings.iter().map(ToString::to_string).collect();
    assert_eq!(
        findings,
        ["t.obj: 1 degenerate triangle (area zero) ignored"]
    );
}

#[test]
fn a_texture_is_loaded_once_and_all_have_one_limit() {
    let folder = folder_with_texture();
    let limits = Limits {
        image_pixels: 7,
        ..Limits::default()
    };
    let material = |name, file| format!("[materials.{name}]\ndiffuse = {{ image = \"{file}\" }}\n");
    let text = material("a", "wood.png") + &material("b", "wood.png");
    let file = try_scene(&folder, &text, &limits).unwrap();
    let images: Vec<_> = (file.scene.materials.iter())
        .map(|material| match &material.diffuse {
            Texture::Picture(picture) => std::sync::Arc::as_ptr(&picture.image),
            other => panic!("{other:?} is no picture"),
        })
        .collect();
    assert_eq!(images[0], images[1]);
    std::fs::copy(folder.path("wood.png"), folder.path("oak.png")).unwrap();
    let text = material("a", "wood.png") + &material("b", "oak.png");
    assert_eq!(
        try_scene(&folder, &text, &limits).unwrap_err(),
        "oak.png: image is 2x2 pixels, over the limit of 3 pixels"
    );
}

#[test]
fn pictures_that_nobody_can_render_are_refused_with_their_line() {
    for (line, message) in [
        ("size = [0, 1]", "size is [0, 1]; 1 to 65536 pixels"),
        ("size = [9, 65537]", "size is [9, 65537]; 1 to 65536 pixels"),
        ("spp = 0", "spp is 0; 1 to 16777216 samples"),
        ("spp = 16777217", "spp is 16777217; 1 to 16777216 samples"),
    ] {
        let error = wrong(&format!("# a scene\n[picture]\n{line}\n"));
        assert!(
            error.starts_with(&format!("a.toml:3: {message}")),
            "{error}"
        );
    }
}

#[test]
fn turns_need_an_axis_and_an_angle() {
    for (turn, message) in [
        ("axis = [0, 0, 0], degrees = 5", "rotate: axis is"),
        ("axis = [inf, 0, 0], degrees = 5", "rotate: axis is"),
        ("axis = [1, 0, nan], degrees = 5", "rotate: axis is"),
        ("axis = [1, 0, 0], degrees = nan", "rotate: degrees is NaN"),
        ("axis = [1, 0, 0], degrees = inf", "rotate: degrees is inf"),
    ] {
        let error = wrong(&format!(
            "[[objects]]\nshape.sphere = {{ centre = [0, 0, 0], radius = 1 }}\n\
             transform = [{{ rotate = {{ {turn} }} }}]\n"
        ));
        assert!(
            error.starts_with(&format!("a.toml:1: {message}")),
            "{error}"
        );
    }
}

#[test]
fn files_that_are_broken_or_missing_or_outside_are_named_as_the_scene_names_them() {
    let object = |file: &str| wrong(&format!("[[objects]]\nmesh.file = \"{file}\"\n"));
    assert_eq!(
        object("broken.obj"),
        "broken.obj:2: face uses vertex 2, but only 1 is defined (1 to 1); \
         line 2: face uses vertex 3, but only 1 is defined (1 to 1)"
    );
    assert_eq!(object("none.obj"), "a.toml:1: model none.obj not found");
    assert_eq!(
        object("../x.obj"),
        "a.toml:1: model ../x.obj lies outside the scene file's folder: not opened"
    );
    assert_eq!(
        object("two\\nlines.obj"),
        "a.toml:1: model two\\nlines.obj not found"
    );
}

#[test]
fn what_is_no_text_is_named_with_its_line() {
    let folder = Folder::with(&[("a.toml", b"# one\n\xff\n")]);
    let read = read_scene(
        folder.path("a.toml"),
        TriangleTest::default(),
        &Limits::default(),
    );
    let error = read.unwrap_err().to_string();
    assert!(error.contains("a.toml:2: "), "{error}");
}

#[cfg(unix)]
#[test]
fn an_endless_scene_file_is_refused() {
    let read = read_scene("/dev/zero", TriangleTest::default(), &Limits::default());
    assert_eq!(
        read.unwrap_err().to_string(),
        "/dev/zero: scene file exceeds the limit of 16777216 bytes"
    );
}

#[test]
fn the_hash_tells_a_change_in_any_file() {
    let folder = folder_with_texture();
    let library = b"newmtl m\nmap_Kd wood.png\n";
    let model = [b"mtllib t.mtl\nusemtl m\n", TRIANGLE].concat();
    std::fs::write(folder.path("t.mtl"), library).unwrap();
    std::fs::write(folder.path("t.obj"), &model).unwrap();
    let text = "[[objects]]\nmesh.file = \"t.obj\"\n";
    let hash = || {
        let file = try_scene(&folder, text, &Limits::default());
        file.unwrap().hash
    };
    let before = hash();
    assert_eq!(before, hash());
    let image = std::fs::read(folder.path("wood.png")).unwrap();
    let all = [text.as_bytes(), &model, library, &image].concat();
    assert_eq!(before, ombra_formats::sha256::of_bytes(&all));
    for file in ["t.obj", "t.mtl"] {
        let content = std::fs::read(folder.path(file)).unwrap();
        std::fs::write(folder.path(file), [&content[..], b"# more\n"].concat()).unwrap();
        assert_ne!(before, hash(), "{file}");
        std::fs::write(folder.path(file), content).unwrap();
    }
    let image = ImageBuffer::new(2, 2, vec![Rgb::BLACK; 4]).unwrap();
    write_image(folder.path("wood.png"), &image, &Metadata::default()).unwrap();
    assert_ne!(before, hash());
}
