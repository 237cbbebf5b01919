//! Pictures of moments, and models with pictures on them.

use std::path::Path;

use ombra::formats::raster::{MapStyle, Shades};
use ombra::formats::{ImageBuffer, Limits, read_image};
use serde_json::Value;

use super::{cells, read, shadows};
use crate::succeed;

/// The colours of a frame, as they are documented: nothing measured, lit, dark, newly dark, and dark no more.
const NOTHING: [u8; 3] = [186, 179, 170];
const LIT: [u8; 3] = [250, 244, 219];
const DARK: [u8; 3] = [98, 98, 120];
const NEW: [u8; 3] = [38, 84, 214];
const GONE: [u8; 3] = [236, 140, 60];

fn srgb(picture: &ImageBuffer, x: usize, y: usize) -> [u8; 3] {
    let pixel = picture.pixels()[y * picture.width() as usize + x];
    pixel.to_srgb().map(|v| (v * 255.0).round() as u8)
}

fn image(path: &Path) -> ImageBuffer {
    read_image(path, &Limits::default()).unwrap()
}

/// Cells of a row.
fn width<T>(cells: &[([f64; 2], T)]) -> usize {
    let is_first = |at: &[f64; 2]| (at[1] - cells[0].0[1]).abs() < 2e-5;
    cells.iter().take_while(|(at, _)| is_first(at)).count()
}

/// A picture of a moment.
struct Frame {
    picture: ImageBuffer,
    /// Cells of a row, and what lies above the map.
    width: usize,
    top: usize,
}

impl Frame {
    fn read(path: &Path, width: usize) -> Self {
        let picture = image(path);
        // The frame of the map stands alone at the left.
        let is_frame = |y: &usize| srgb(&picture, 39, *y) == [34, 33, 38];
        let top = (0..).find(is_frame).unwrap() + 1;
        Self {
            picture,
            width,
            top,
        }
    }

    /// Cells are enlarged by a whole number.
    fn colour(&self, cell: usize) -> [u8; 3] {
        let (column, row) = (cell % self.width, cell / self.width);
        let zoom = 820_usize.div_ceil(self.width);
        let [x, y] = [column, row].map(|k| k * zoom + zoom / 2);
        srgb(&self.picture, 40 + x, self.top + y)
    }
}

/// Each cell of a frame is held against rays in the minutes before and after it, where these are of one mind.
#[test]
fn frames_agree_with_rays() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    shadows(
        folder,
        &["--frames", "day", "--every", "2h", "--hours", "09:30-16:00"],
    );
    let frames = read(folder, "day/frames.json");
    let times: Vec<_> = frames["frames"]
        .as_array()
        .unwrap()
        .iter()
        .map(|frame| &frame["shows"])
        .collect();
    assert_eq!(times, ["10:00", "12:00", "14:00", "16:00"]);
    for (index, hours) in ["09:59-10:01", "11:59-12:01", "13:59-14:01"]
        .iter()
        .enumerate()
    {
        let rays = [
            "--hours",
            hours,
            "--method",
            "sampled",
            "--step",
            "20s",
            "-o",
            "rays.geojson",
        ];
        shadows(folder, &rays);
        let cells = cells(folder, "rays.geojson");
        let shown = Frame::read(&folder.join(format!("day/{index:04}.png")), width(&cells));
        let (mut dark, mut wrong) = (0, 0);
        for (cell, (_, minutes)) in cells.iter().enumerate() {
            let colour = shown.colour(cell);
            let expected = match minutes {
                None => NOTHING,
                Some(minutes) if *minutes > 1.99 => DARK,
                Some(minutes) if *minutes < 0.01 => LIT,
                Some(_) => continue,
            };
            dark += usize::from(colour == DARK);
            wrong += usize::from(colour != expected);
        }
        assert!(dark > 500, "{dark} at {hours}");
        assert_eq!(wrong, 0, "of {} at {hours}", cells.len());
    }
    let gif = [
        "--frames",
        "day.gif",
        "--every",
        "3h",
        "--without",
        "pavilion",
    ];
    shadows(folder, &gif);
    assert!(
        std::fs::read(folder.join("day.gif"))
            .unwrap()
            .starts_with(b"GIF89a")
    );
}

#[test]
fn a_model_is_one_that_ombra_reads_and_the_same_for_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for on in ["ground", "roofs", "facades"] {
        let bytes = ["1", "2"].map(|threads| {
            shadows(
                folder,
                &["--on", on, "--glb", "city.glb", "--threads", threads],
            );
            std::fs::read(folder.join("city.glb")).unwrap()
        });
        assert!(bytes[0] == bytes[1], "{on}");
        let told: Value =
            serde_json::from_str(&succeed(folder, &["info", "city.glb", "--json"])).unwrap();
        assert!(told.to_string().contains("minutes on"), "{told}");
    }
}

/// Each cell of a frame of a change is held against exact minutes before and after it, where these are of one mind.
#[test]
fn frames_of_a_change_show_what_is_new_and_what_is_gone() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let change = ["--height", "church=120m", "--without", "pavilion"];
    let frames = ["--frames", "day", "--every", "2h", "--hours", "11:30-12:30"];
    shadows(folder, &[&change[..], &frames].concat());
    let around_noon = ["--hours", "11:59-12:01", "-o", "minutes.geojson"];
    shadows(folder, &[&change[..], &around_noon].concat());
    let cells = cells(folder, "minutes.geojson");
    let file = read(folder, "minutes.geojson");
    let shown = Frame::read(&folder.join("day/0000.png"), width(&cells));
    let mut seen = [0; 4];
    for (cell, feature) in file["features"].as_array().unwrap().iter().enumerate() {
        let is_dark = |key: &str| match feature["properties"][key].as_f64() {
            Some(minutes) if minutes > 1.99 => Some(true),
            Some(minutes) if minutes < 0.01 => Some(false),
            _ => None,
        };
        let (Some(before), Some(after)) = (is_dark("before"), is_dark("after")) else {
            continue;
        };
        let state = match (before, after) {
            (false, false) => 0,
            (true, true) => 1,
            (false, true) => 2,
            (true, false) => 3,
        };
        let expected = [LIT, DARK, NEW, GONE][state];
        assert_eq!(shown.colour(cell), expected, "{cell}: {feature}");
        seen[state] += 1;
    }
    // The pavilion is low: at noon its shadow is short.
    assert!(seen.iter().all(|&count| count >= 5), "{seen:?}");
}

#[test]
fn the_texture_of_the_ground_has_the_colours_of_the_minutes() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    shadows(folder, &["--glb", "city.glb", "-o", "cells.geojson"]);
    let cells = cells(folder, "cells.geojson");
    let bytes = std::fs::read(folder.join("city.glb")).unwrap();
    // A head of 12 bytes, then two chunks, each with its length and kind before it.
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let (root, binary) = (&bytes[20..20 + length], &bytes[28 + length..]);
    let root: Value = serde_json::from_slice(root).unwrap();
    assert_eq!(root["materials"][0]["name"], "minutes on the ground");
    let view = root["images"][0]["bufferView"].as_u64().unwrap() as usize;
    let part = |key: &str| root["bufferViews"][view][key].as_u64().unwrap_or(0) as usize;
    let (from, long) = (part("byteOffset"), part("byteLength"));
    std::fs::write(folder.join("ground.png"), &binary[from..from + long]).unwrap();
    let texture = image(&folder.join("ground.png"));
    assert_eq!(texture.width() as usize, width(&cells));
    assert_eq!(texture.pixels().len(), cells.len());
    let minutes = cells
        .iter()
        .map(|cell| cell.1.map_or(f32::NAN, |minutes| minutes as f32));
    let minutes: Vec<f32> = minutes.collect();
    let shades = Shades::new(&minutes, &MapStyle::default());
    let mut colours = std::collections::HashSet::new();
    let wide = width(&cells);
    for (cell, &minutes) in minutes.iter().enumerate() {
        let expected = match minutes.is_nan() {
            true => NOTHING,
            false => shades.colour(minutes),
        };
        let (column, row) = (cell % wide, cell / wide);
        let found = srgb(&texture, column, row);
        assert!(
            (0..3).all(|k| found[k].abs_diff(expected[k]) <= 1),
            "{cell}: {found:?} and {expected:?}"
        );
        colours.insert(expected);
    }
    assert!(colours.len() > 50);
}
