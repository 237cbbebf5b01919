use ombra_scene::Rgb;

use super::*;

fn picture(width: u32, height: u32, colour: [f32; 3]) -> ImageBuffer {
    let pixels = vec![Rgb::new(colour[0], colour[1], colour[2]); (width * height) as usize];
    ImageBuffer::new(width, height, pixels).unwrap()
}

#[test]
fn an_animation_has_its_pictures_to_the_last_bit() {
    let base = tempfile::tempdir().unwrap();
    let path = base.path().join("day.gif");
    let mut file = FrameWriter::create(&path).unwrap();
    let mut mixed = vec![Rgb::new(0.0, 0.0, 0.0); 6];
    mixed[4] = Rgb::new(0.2, 0.5, 1.0);
    let pictures = [
        ImageBuffer::new(3, 2, mixed).unwrap(),
        picture(3, 2, [1.0, 0.0, 0.3]),
    ];
    for picture in &pictures {
        let packed = file.pack(picture.clone()).unwrap();
        file.add(&packed, "").unwrap();
    }
    assert!(!path.exists());
    file.finish(&Metadata::default()).unwrap();
    let mut options = ::gif::DecodeOptions::new();
    options.set_color_output(::gif::ColorOutput::RGBA);
    let mut decoder = options
        .read_info(std::fs::File::open(&path).unwrap())
        .unwrap();
    for picture in &pictures {
        let frame = decoder.read_next_frame().unwrap().unwrap();
        assert_eq!((frame.width, frame.height, frame.delay), (3, 2, 10));
        let found: Vec<[u8; 3]> = frame.buffer.chunks(4).map(|p| [p[0], p[1], p[2]]).collect();
        assert_eq!(found.as_flattened(), picture.screen_bytes());
    }
    assert!(decoder.read_next_frame().unwrap().is_none());
    assert_eq!(std::fs::read_dir(base.path()).unwrap().count(), 1);
}

#[test]
fn no_picture_and_another_size_are_refused() {
    let base = tempfile::tempdir().unwrap();
    let path = base.path().join("day.gif");
    let file = FrameWriter::create(&path).unwrap();
    assert!(file.finish(&Metadata::default()).is_err());
    let mut file = FrameWriter::create(&path).unwrap();
    let [first, second] = [picture(3, 2, [0.0; 3]), picture(2, 3, [0.0; 3])];
    let [first, second] = [first, second].map(|picture| file.pack(picture).unwrap());
    file.add(&first, "").unwrap();
    let error = file.add(&second, "").unwrap_err().to_string();
    assert!(error.contains("2x3") && error.contains("3x2"), "{error}");
    drop(file);
    assert_eq!(std::fs::read_dir(base.path()).unwrap().count(), 0);
}

#[test]
fn a_folder_has_numbered_pictures_and_says_what_they_show() {
    let base = tempfile::tempdir().unwrap();
    let path = base.path().join("day");
    for count in [3, 2] {
        let mut folder = FrameWriter::create(&path).unwrap();
        for index in 0..count {
            let packed = folder.pack(picture(4, 4, [0.5; 3])).unwrap();
            folder.add(&packed, &format!("1{index}:00")).unwrap();
        }
        folder.finish(&Metadata::default()).unwrap();
    }
    let mut names: Vec<_> = std::fs::read_dir(&path)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, ["0000.png", "0001.png", "frames.json"]);
    let about: serde_json::Value =
        serde_json::from_slice(&std::fs::read(path.join("frames.json")).unwrap()).unwrap();
    assert_eq!(about["frames"][1]["shows"], "11:00");
}

#[test]
fn more_colours_than_an_animation_has_come_near() {
    let base = tempfile::tempdir().unwrap();
    let path = base.path().join("day.gif");
    let mut file = FrameWriter::create(&path).unwrap();
    let pixels = (0..1024).map(|k| Rgb::new((k % 32) as f32 / 31.0, (k / 32) as f32 / 31.0, 0.5));
    let picture = ImageBuffer::new(32, 32, pixels.collect()).unwrap();
    let packed = file.pack(picture.clone()).unwrap();
    file.add(&packed, "").unwrap();
    file.finish(&Metadata::default()).unwrap();
    let mut options = ::gif::DecodeOptions::new();
    options.set_color_output(::gif::ColorOutput::RGBA);
    let mut decoder = options
        .read_info(std::fs::File::open(&path).unwrap())
        .unwrap();
    let frame = decoder.read_next_frame().unwrap().unwrap();
    let found: Vec<[u8; 3]> = frame.buffer.chunks(4).map(|p| [p[0], p[1], p[2]]).collect();
    let pairs = found.as_flattened().iter().zip(picture.screen_bytes());
    let off: u32 = pairs.map(|(a, b)| u32::from(a.abs_diff(b))).sum();
    assert!(off > 0 && off < 10 * 3 * 1024, "{off}");
}
