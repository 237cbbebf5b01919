//! Pictures there and back.

use ombra_formats::{
    FileInfo, ImageBuffer, ImageFormat, Limits, Metadata, OutputFile, inspect, read_image,
    read_texture, write_image,
};
use ombra_scene::Rgb;
use proptest::prelude::*;

use super::Folder;

fn picture() -> ImageBuffer {
    let pixels = (0..6)
        .map(|i| Rgb::new(i as f32 / 5.0, 0.25, 3.0 - i as f32))
        .collect();
    ImageBuffer::new(3, 2, pixels).unwrap()
}

fn metadata() -> Metadata {
    Metadata {
        command: Some("ombra render \"a scene\"\n".to_owned()),
        version: Some("ombra 0.1.0".to_owned()),
        scene_hash: Some("0123abcd".to_owned()),
        seed: Some(u64::MAX),
        seconds: Some(1.5),
    }
}

fn there_and_back(name: &str, image: &ImageBuffer) -> ImageBuffer {
    let folder = Folder::with(&[]);
    let path = folder.path(name);
    write_image(&path, image, &metadata()).unwrap();
    let left: Vec<_> = std::fs::read_dir(folder.0.path()).unwrap().collect();
    assert_eq!(left.len(), 1, "nothing is left beside the picture");
    read_image(path, &Limits::default()).unwrap()
}

#[test]
fn exr_and_pfm_keep_every_bit() {
    let mut pixels = picture().pixels().to_vec();
    pixels[1] = Rgb::new(f32::INFINITY, -1e-30, f32::MAX);
    let image = ImageBuffer::new(3, 2, pixels).unwrap();
    assert_eq!(image.non_finite(), 1);
    assert_eq!(there_and_back("a.pfm", &image), image);
    let image = image
        .with_channel("A", vec![0.5; 6])
        .and_then(|i| i.with_channel("depth.Z", (0..6).map(|i| i as f32).collect()))
        .unwrap();
    assert_eq!(there_and_back("a.EXR", &image), image);
}

#[test]
fn nan_stays_nan_in_floating_point_and_is_black_on_screens() {
    let image = ImageBuffer::new(1, 1, vec![Rgb::grey(f32::NAN)]).unwrap();
    assert_eq!(image.non_finite(), 1);
    for name in ["a.exr", "a.pfm"] {
        assert!(there_and_back(name, &image).pixels()[0].r.is_nan());
    }
    for name in ["a.png", "a.ppm"] {
        assert_eq!(there_and_back(name, &image).pixels()[0], Rgb::BLACK);
    }
}

#[test]
fn png_and_ppm_keep_what_a_screen_shows() {
    for name in ["a.png", "a.ppm"] {
        let image = picture();
        let once = there_and_back(name, &image);
        for (before, after) in image.pixels().iter().zip(once.pixels()) {
            let (before, after) = (before.to_srgb(), after.to_srgb());
            for i in 0..3 {
                assert!((before[i] - after[i]).abs() <= 0.5001 / 255.0);
            }
        }
        assert_eq!(
            there_and_back(name, &once),
            once,
            "the second time changes nothing"
        );
    }
}

#[test]
fn the_same_picture_is_the_same_bytes_and_says_how_it_was_made() {
    for name in ["a.png", "a.exr", "a.ppm", "a.pfm"] {
        let folder = Folder::with(&[]);
        let path = folder.path(name);
        let bytes: Vec<_> = (0..4)
            .map(|_| {
                write_image(&path, &picture(), &metadata()).unwrap();
                std::fs::read(&path).unwrap()
            })
            .collect();
        assert!(bytes.windows(2).all(|pair| pair[0] == pair[1]), "{name}");
        let FileInfo::Image(info) = inspect(&path).unwrap() else {
            panic!("{name} is a picture");
        };
        assert_eq!((info.width, info.height), (3, 2));
        assert_eq!(info.channels.len(), 3);
        if name == "a.png" || name == "a.exr" {
            let prefix = if name == "a.exr" { "ombra." } else { "" };
            let attribute = |name: &str| info.attributes[&format!("{prefix}{name}")].as_str();
            assert_eq!(attribute("command"), "ombra render \"a scene\"\\n");
            assert_eq!(attribute("version"), "ombra 0.1.0");
            assert_eq!(attribute("scene-hash"), "0123abcd");
            assert_eq!(attribute("seed"), u64::MAX.to_string());
            assert!(attribute("seconds").starts_with("1.5"));
        }
    }
}

#[test]
fn bad_places_to_write_to_are_named() {
    let folder = Folder::with(&[]);
    let error = |name: &str| {
        let path = folder.path(name);
        let error = write_image(path, &picture(), &Metadata::default()).unwrap_err();
        error.to_string()
    };
    assert!(
        error("a.gif").ends_with("cannot write a .gif file; known endings are png, exr, pfm, ppm")
    );
    assert!(error("a").contains("cannot write a file without an ending; known endings are"));
    let missing = error("no/folder/a.png");
    assert!(
        missing.ends_with("no/folder does not exist; create it first"),
        "{missing}"
    );
    std::fs::create_dir(folder.path("folder.png")).unwrap();
    assert!(error("folder.png").contains("cannot be written"));
    assert_eq!(std::fs::read_dir(folder.0.path()).unwrap().count(), 1);
}

#[cfg(unix)]
#[test]
fn a_picture_can_be_read_by_others_as_any_new_file() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::with(&[("plain", b"")]);
    write_image(folder.path("a.png"), &picture(), &Metadata::default()).unwrap();
    let mode = |name| {
        std::fs::metadata(folder.path(name))
            .unwrap()
            .permissions()
            .mode()
    };
    assert_eq!(mode("a.png"), mode("plain"));
}

#[test]
fn pictures_need_all_their_pixels() {
    assert!(ImageBuffer::new(0, 0, vec![]).is_err());
    assert!(ImageBuffer::new(2, 2, vec![Rgb::BLACK; 3]).is_err());
    assert!(picture().with_channel("A", vec![0.0; 5]).is_err());
}

#[test]
fn large_pictures_are_refused_by_their_headers() {
    let folder = Folder::with(&[
        ("a.pfm", b"PF\n100000 100000\n-1\n"),
        ("a.ppm", b"P6 # c\n4294967295 4294967295 255\n"),
        ("b.ppm", b"P6 1000 1000 255\n"),
        ("c.ppm", b"P6 2 2 70000\n"),
        ("c.pfm", b"PF 2 2 0\n"),
        ("a.png", b"not a picture"),
        ("a.exr", b"not a picture"),
    ]);
    let error = |name| {
        read_image(folder.path(name), &Limits::default())
            .unwrap_err()
            .to_string()
    };
    assert!(error("a.pfm").contains("image is 100000x100000 pixels, over the limit"));
    assert!(error("a.ppm").contains("image is 4294967295x4294967295 pixels, over the limit"));
    assert!(error("b.ppm").contains("file too short: 1000 rows of pixels"));
    assert!(error("c.ppm").contains("\"70000\" found where a largest value"));
    assert!(error("c.pfm").contains("\"0\" found where a scale other than 0"));
    assert!(error("a.png").contains("a.png: "));
    assert!(error("a.exr").contains("a.exr: EXR: "));
    let tiny = Limits {
        image_pixels: 5,
        ..Limits::default()
    };
    for name in ["t.png", "t.exr", "t.pfm", "t.ppm"] {
        write_image(folder.path(name), &picture(), &Metadata::default()).unwrap();
        let error = read_image(folder.path(name), &tiny)
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("image is 3x2 pixels, over the limit of 5 pixels"),
            "{error}"
        );
    }
    assert!(read_texture(folder.path("t.png"), &tiny).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_floating_point_picture_comes_back_from_exr_and_pfm(
        width in 1..20_u32,
        pixels in prop::collection::vec(prop::array::uniform3(-1e9_f32..1e9), 1..200),
    ) {
        let height = (pixels.len() as u32).div_ceil(width);
        let mut pixels: Vec<Rgb> = pixels.into_iter().map(Rgb::from).collect();
        pixels.resize((width * height) as usize, Rgb::WHITE);
        let image = ImageBuffer::new(width, height, pixels).unwrap();
        prop_assert_eq!(&there_and_back("a.exr", &image), &image);
        prop_assert_eq!(&there_and_back("a.pfm", &image), &image);
    }
}

#[test]
fn what_is_wrong_with_an_output_is_known_before_the_picture_is_made() {
    let folder = Folder::with(&[]);
    std::fs::create_dir(folder.path("folder.png")).unwrap();
    for (name, wrong) in [
        ("nowhere/a.png", "does not exist; create it first"),
        ("a.gif", "known endings are png"),
        ("folder.png", "cannot be written: is a directory"),
    ] {
        let error = OutputFile::create(folder.path(name)).unwrap_err();
        assert!(error.to_string().contains(wrong), "{error}");
        assert!(error.path().unwrap().ends_with(name));
    }
}

#[test]
fn an_output_that_is_given_up_leaves_everything_as_it_was() {
    let folder = Folder::with(&[("a.png", b"before")]);
    let output = OutputFile::create(folder.path("a.png")).unwrap();
    assert_eq!(output.format(), ImageFormat::Png);
    drop(output);
    assert_eq!(std::fs::read(folder.path("a.png")).unwrap(), b"before");
    assert_eq!(std::fs::read_dir(folder.0.path()).unwrap().count(), 1);
}

#[test]
fn exr_files_take_text_in_any_script() {
    let folder = Folder::with(&[]);
    let path = folder.path("a.exr");
    let image = picture().with_channel("深.Z", vec![1.0; 6]).unwrap();
    let metadata = Metadata {
        command: Some("ombra render café.toml -o 日本.exr".to_owned()),
        ..Metadata::default()
    };
    write_image(&path, &image, &metadata).unwrap();
    let FileInfo::Image(info) = inspect(&path).unwrap() else {
        panic!("an EXR file is a picture");
    };
    let command = &info.attributes["ombra.command"];
    assert_eq!(command, r"ombra render café.toml -o \u{65e5}\u{672c}.exr");
    assert!(info.channels.contains(&r"\u{6df1}.Z".to_owned()));
}
