use std::path::PathBuf;

use ombra_city::{Crs, Grid, Origin};

use super::*;
use crate::image::Metadata;

fn picture(width: u32, height: u32, cell: f64, values: &[f32], style: &MapStyle) -> ImageBuffer {
    let origin = Origin::new(Crs::wgs84(), [4.36, 52.01]).unwrap();
    let grid = Grid {
        corner: [0.0, 0.0],
        cell,
        width,
        height,
    };
    let raster = Raster::new(&origin, grid, Unit::Minutes, values).unwrap();
    map_picture(&raster, style)
}

/// Blocks of houses and the shadow that they throw to the north.
fn blocks(width: u32, height: u32, cell: f64) -> Vec<f32> {
    let at = |i: u32| [i % width, i / width].map(|v| (f64::from(v) + 0.5) * cell);
    let house = |x: f64, y: f64| {
        let (block, street) = (90.0, 38.0);
        let (bx, by) = ((x / block).floor(), (y / block).floor());
        let (ix, iy) = (x - bx * block, y - by * block);
        let tall = 8.0 + 30.0 * (bx * 12.9898 + by * 78.233).sin().abs();
        let yard = (56.0..72.0).contains(&ix) && (54.0..76.0).contains(&iy);
        let is_park = tall < 12.0;
        (ix > street && iy > street && !yard && !is_park, tall)
    };
    let value = |[x, y]: [f64; 2]| {
        if house(x, y).0 {
            return f32::NAN;
        }
        // Minutes in which a ray to the sun meets a house, sun in the south from -60° to 60°.
        let mut minutes = 0.0_f64;
        for step in 0..48 {
            let azimuth = (f64::from(step) * 2.5 - 60.0).to_radians();
            let altitude = 0.62 * azimuth.cos() + 0.02;
            let blocked = (1..40).any(|i| {
                let d = f64::from(i) * 2.0;
                let (is_house, tall) = house(x + d * azimuth.sin(), y + d * azimuth.cos());
                is_house && tall > d * altitude.tan()
            });
            minutes += if blocked { 9.7 } else { 0.0 };
        }
        minutes as f32
    };
    (0..width * height).map(at).map(value).collect()
}

fn style() -> MapStyle {
    MapStyle {
        title: "Shadow in winter".to_owned(),
        subtitle: "21 December 2026, sunrise + 90 min to sunset - 90 min, Delft".to_owned(),
        footer: "ombra 0.1.0, exact method: error at most 1 s a place. The sun is a point; no \
                 refraction. Heights: LoD2."
            .to_owned(),
        unit: Unit::Minutes,
        max: None,
        ..MapStyle::default()
    }
}

#[test]
fn the_picture_is_wide_enough_and_not_too_large() {
    for (width, height) in [
        (1, 1),
        (40, 30),
        (30, 40),
        (900, 20),
        (2241, 7),
        (5000, 3000),
    ] {
        let values = vec![7.0; width as usize * height as usize];
        let picture = picture(width, height, 1.0, &values, &style());
        assert!((900..=2400).contains(&picture.width()), "{width}x{height}");
        assert!(picture.height() <= 2800, "{width}x{height}");
    }
    for (width, height) in [(1, 3000), (3000, 1)] {
        let values = vec![7.0; 3000];
        let picture = picture(width, height, 1.0, &values, &style());
        assert!((900..=2400).contains(&picture.width()), "{width}x{height}");
    }
}

#[test]
fn colours_are_those_of_the_values_and_north_is_up() {
    let none = MapStyle {
        max: Some(100.0),
        ..MapStyle::default()
    };
    // North: sun and a building; south: half and full shadow.
    let values = [0.0, f32::NAN, 50.0, 1000.0];
    let picture = picture(2, 2, 5.0, &values, &none);
    let cell = LEAST / 2;
    let at = |column: u32, row: u32| {
        let x = MARGIN + column * cell + cell / 2;
        let y = MARGIN + row * cell + cell / 2;
        let pixel = picture.pixels()[(y * picture.width() + x) as usize];
        pixel.to_srgb().map(|v| (v * 255.0).round() as u8)
    };
    assert_eq!(at(0, 0), ramp::colour(0.0));
    assert_eq!(at(1, 0), ground::Empty::Building.colour());
    assert_eq!(at(0, 1), ramp::colour(0.5));
    assert_eq!(at(1, 1), ramp::colour(1.0));
}

#[test]
fn what_lies_outside_is_no_building() {
    let some = MapStyle {
        outside: [true, false, false, true].repeat(2250 * 2250 / 4),
        ..style()
    };
    // As it is, and reduced: there blocks in which most cells lie outside do.
    let values = [f32::NAN, f32::NAN, 1.0, 2.0];
    let small = picture(
        2,
        2,
        5.0,
        &values,
        &MapStyle {
            outside: some.outside[..4].to_vec(),
            ..style()
        },
    );
    assert!(small != picture(2, 2, 5.0, &values, &style()));
    let values = vec![f32::NAN; 2250 * 2250];
    let all = MapStyle {
        outside: vec![true; values.len()],
        ..style()
    };
    let large = picture(2250, 2250, 1.0, &values, &all);
    let pixel = large.pixels()[(large.height() / 2 * large.width() + large.width() / 2) as usize];
    let pixel = pixel.to_srgb().map(|v| (v * 255.0).round() as u8);
    assert_eq!(pixel, ground::Empty::Outside.colour());
}

#[test]
fn any_raster_and_any_style_make_a_picture() {
    let odd = MapStyle {
        title: "\u{0}\u{1f600} ".repeat(5000),
        subtitle: "x".repeat(100_000),
        footer: "\n".to_owned(),
        unit: Unit::Hours,
        blank: "No ground".to_owned(),
        max: Some(f32::NAN),
        ..style()
    };
    for value in [f32::NAN, 0.0, -5.0, f32::MIN_POSITIVE, f32::MAX] {
        for cell in [1e-9, 0.5, 1e12] {
            for style in [&odd, &style(), &MapStyle::default()] {
                let picture = picture(3, 2, cell, &[value; 6], style);
                assert_eq!(picture.non_finite(), 0);
            }
        }
    }
}

#[test]
fn the_same_raster_is_the_same_picture() {
    let values = blocks(40, 30, 4.0);
    let once = picture(40, 30, 4.0, &values, &style());
    assert!(once == picture(40, 30, 4.0, &values, &style()));
}

/// Writes pictures to look at: `OMBRA_LOOK=folder cargo test -p ombra-formats look -- --ignored`.
#[test]
#[ignore = "writes pictures for eyes"]
fn look() {
    let Some(folder) = std::env::var_os("OMBRA_LOOK").map(PathBuf::from) else {
        return;
    };
    let write = |name: &str, picture: &ImageBuffer| {
        crate::write_image(folder.join(name), picture, &Metadata::default()).unwrap();
    };
    let hours = MapStyle {
        unit: Unit::Hours,
        ..style()
    };
    let long = MapStyle {
        title:
            "Accumulated shadow of the planned development at Große Straße and its surroundings \
                in the winter half-year, with all of the alternatives"
                .to_owned(),
        subtitle: "Łódź, 1 October 2026 – 31 March 2027, 09:00–15:30 local time, weekdays only, \
                   ground cells of 1 m at 1.5 m above the terrain of the surface model"
            .to_owned(),
        max: Some(240.0),
        ..style()
    };
    for (name, width, height, cell, style) in [
        ("small.png", 40, 30, 4.0, &style()),
        ("middle.png", 600, 420, 0.5, &long),
        ("large.png", 2000, 1500, 0.25, &hours),
        ("tall.png", 60, 300, 1.0, &hours),
    ] {
        let values = blocks(width, height, cell);
        write(name, &picture(width, height, cell, &values, style));
    }
    write(
        "none.png",
        &picture(40, 30, 1.0, &[f32::NAN; 1200], &style()),
    );
    write("equal.png", &picture(40, 30, 1.0, &[0.0; 1200], &hours));
}
