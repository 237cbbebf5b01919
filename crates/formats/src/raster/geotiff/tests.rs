//! What is written is read back by the crate `tiff`, which shares no code with the writer.

use std::io::Cursor;

use ombra_city::{Crs, Grid, Origin};
use tiff::decoder::{Decoder, DecodingResult};
use tiff::tags::Tag;

use super::*;
use crate::raster::Unit;

const METADATA: Tag = Tag::Unknown(42112);

fn origin() -> Origin {
    Origin::new(Crs::wgs84(), [4.361_99, 52.010_7]).unwrap()
}

fn grid(width: u32, height: u32) -> Grid {
    Grid {
        corner: [-120.5, -80.25],
        cell: 0.5,
        width,
        height,
    }
}

/// Minutes that rise to the south-east, with a building in the north-west.
fn minutes(grid: Grid) -> Vec<f32> {
    let at = |i: u32| (i % grid.width, i / grid.width);
    let value = |(x, y): (u32, u32)| {
        if x < 5 && y < 3 {
            // A NaN of no usual kind.
            f32::from_bits(0xffc0_1234)
        } else {
            x as f32 + 0.125 * y as f32
        }
    };
    (0..grid.width * grid.height).map(at).map(value).collect()
}

fn written(grid: Grid, values: &[f32], metadata: &[(String, String)]) -> Vec<u8> {
    let origin = origin();
    let raster = Raster::new(&origin, grid, Unit::Minutes, values).unwrap();
    let name = "time in shadow";
    encoded(&[Band { name, raster }], metadata).unwrap()
}

fn decoder(file: &[u8]) -> Decoder<Cursor<&[u8]>> {
    Decoder::new(Cursor::new(file)).unwrap()
}

fn image(decoder: &mut Decoder<Cursor<&[u8]>>) -> Vec<f32> {
    match decoder.read_image().unwrap() {
        DecodingResult::F32(values) => values,
        other => panic!("{other:?}"),
    }
}

/// The same numbers, or NaN in both.
fn assert_same(found: &[f32], expected: &[f32]) {
    assert_eq!(found.len(), expected.len());
    for (i, (f, e)) in found.iter().zip(expected).enumerate() {
        assert!(f == e || f.is_nan() && e.is_nan(), "{i}: {f}, not {e}");
    }
}

#[test]
fn values_come_back_at_every_size() {
    for (width, height) in [(1, 1), (40, 30), (256, 256), (257, 1), (1, 600), (700, 530)] {
        let grid = grid(width, height);
        let values = minutes(grid);
        let file = written(grid, &values, &[]);
        let mut decoder = decoder(&file);
        assert_eq!(decoder.dimensions().unwrap(), (width, height));
        assert_same(&image(&mut decoder), &values);
        let overviews = f64::from(width.max(height)) / 256.0;
        assert_eq!(
            f64::from(images_after(&mut decoder)),
            overviews.log2().ceil().max(0.0)
        );
    }
}

fn images_after(decoder: &mut Decoder<Cursor<&[u8]>>) -> u32 {
    let mut count = 0;
    while decoder.more_images() {
        decoder.next_image().unwrap();
        count += 1;
    }
    count
}

#[test]
fn overviews_are_means_of_what_has_a_number() {
    let grid = grid(700, 530);
    let values = minutes(grid);
    let file = written(grid, &values, &[]);
    let mut decoder = decoder(&file);
    for factor in [2_usize, 4] {
        decoder.next_image().unwrap();
        let (width, height) = decoder.dimensions().unwrap();
        assert_eq!(width, 700_u32.div_ceil(factor as u32));
        assert_eq!(height, 530_u32.div_ceil(factor as u32));
        assert_eq!(decoder.get_tag_u32(Tag::NewSubfileType).unwrap(), 1);
        let found = image(&mut decoder);
        for (x, y) in [(0, 0), (2, 1), (3, 1), (100, 50), (174, 132)] {
            let mut cells: Vec<f32> = Vec::new();
            for row in values.chunks(700).skip(factor * y).take(factor) {
                cells.extend(row.iter().skip(factor * x).take(factor));
            }
            cells.retain(|v| !v.is_nan());
            let mean = cells.iter().sum::<f32>() / cells.len() as f32;
            let found = found[y * width as usize + x];
            let is_blank = cells.is_empty() && found.is_nan();
            assert!(is_blank || (found - mean).abs() < 1e-3, "{found}, {mean}");
        }
    }
    assert!(!decoder.more_images());
}

#[test]
fn the_head_comes_first_and_the_smallest_overview_next() {
    let grid = grid(700, 530);
    let file = written(grid, &minutes(grid), &[]);
    let mut decoder = decoder(&file);
    let mut firsts = Vec::new();
    let mut directories = Vec::new();
    loop {
        let offsets = decoder.get_tag_u32_vec(Tag::TileOffsets).unwrap();
        let lengths = decoder.get_tag_u32_vec(Tag::TileByteCounts).unwrap();
        for (&at, &length) in offsets.iter().zip(&lengths) {
            let (at, end) = (at as usize, (at + length) as usize);
            assert_eq!(file[at - 4..at], length.to_le_bytes());
            assert_eq!(file[end..end + 4], file[end - 4..end]);
        }
        assert!(offsets.is_sorted());
        firsts.push(u64::from(offsets[0]));
        directories.push(decoder.ifd_pointer().unwrap().0);
        if !decoder.more_images() {
            break;
        }
        decoder.next_image().unwrap();
    }
    assert_eq!(firsts.len(), 3);
    assert!(directories.is_sorted() && directories[2] < firsts[2]);
    assert!(firsts.is_sorted_by(|a, b| a > b), "{firsts:?}");
    let ghost = std::str::from_utf8(&file[8..]).map_or_else(|e| e.valid_up_to(), str::len);
    assert!(ghost >= GHOST.len());
    let size: usize = GHOST[30..36].parse().unwrap();
    assert_eq!(GHOST.len(), 43 + size);
}

/// The projection that the keys describe, reckoned anew, puts the corners where the origin does.
#[test]
fn keys_put_the_corners_where_the_origin_puts_them() {
    let grid = grid(40, 30);
    let file = written(grid, &minutes(grid), &[]);
    let mut decoder = decoder(&file);
    let scale = decoder.get_tag_f64_vec(Tag::ModelPixelScaleTag).unwrap();
    let tie = decoder.get_tag_f64_vec(Tag::ModelTiepointTag).unwrap();
    let doubles = decoder.get_tag_f64_vec(Tag::GeoDoubleParamsTag).unwrap();
    let texts = decoder
        .get_tag_ascii_string(Tag::GeoAsciiParamsTag)
        .unwrap();
    let keys = decoder.get_tag_u16_vec(Tag::GeoKeyDirectoryTag).unwrap();
    assert_eq!(keys[..4], [1, 1, 0, (keys.len() / 4 - 1) as u16]);
    let key = |wanted: u16| keys[4..].chunks(4).find(|k| k[0] == wanted).unwrap();
    let double = |wanted| doubles[usize::from(key(wanted)[3])];
    for (wanted, value) in [(1024, 1), (1025, 1), (2048, 4326), (3075, 1), (3076, 9001)] {
        assert_eq!(key(wanted)[1..], [0, 1, value]);
    }
    let [_, _, length, at] = key(3073) else {
        panic!()
    };
    let name = &texts[usize::from(*at)..usize::from(at + length)];
    assert!(name.contains("52.010700, 4.361990") && name.ends_with('|'));

    let definition = format!(
        "+proj=tmerc +lat_0={} +lon_0={} +k={} +x_0={} +y_0={} +datum=WGS84 +units=m",
        double(3081),
        double(3080),
        double(3092),
        double(3082),
        double(3083)
    );
    let origin = origin();
    for (column, row) in [(0.0, 0.0), (40.0, 0.0), (0.0, 30.0), (40.0, 30.0)] {
        let place = [
            tie[3] + (column - tie[0]) * scale[0],
            tie[4] - (row - tie[1]) * scale[1],
        ];
        let there = Origin::new(Crs::parse(&definition).unwrap(), place).unwrap();
        let local = [-120.5 + 0.5 * column, -80.25 + 0.5 * (30.0 - row)];
        let [longitude, latitude] = origin.to_map(local);
        assert!((there.longitude() - longitude).abs() < 1e-10);
        assert!((there.latitude() - latitude).abs() < 1e-10);
    }
}

#[test]
fn metadata_and_no_data_are_told() {
    let grid = grid(3, 2);
    let entries = [("command".to_owned(), "ombra shadows \"a & b\"".to_owned())];
    let file = written(grid, &minutes(grid), &entries);
    let mut decoder = decoder(&file);
    let xml = decoder.get_tag_ascii_string(METADATA).unwrap();
    assert!(
        xml.contains(
            "<Item name=\"command\">ombra shadows &amp;quot;a &amp;amp; b&amp;quot;</Item>"
        )
    );
    assert_eq!(
        decoder.get_tag_ascii_string(Tag::GdalNodata).unwrap(),
        "nan"
    );
    assert!(image(&mut decoder).iter().all(|v| v.is_nan()));
}

#[test]
fn the_same_raster_is_the_same_bytes() {
    let grid = grid(300, 20);
    let values = minutes(grid);
    let usual = |v: &f32| if v.is_nan() { f32::NAN } else { *v };
    let other_nan: Vec<f32> = values.iter().map(usual).collect();
    assert_eq!(written(grid, &values, &[]), written(grid, &other_nan, &[]));
}

#[test]
fn a_folder_that_is_missing_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let origin = origin();
    let raster = Raster::new(&origin, grid(1, 1), Unit::Hours, &[1.0]).unwrap();
    let path = folder.path().join("no/such.tif");
    let error = write_geotiff(&path, &raster, &[]).unwrap_err().to_string();
    assert!(error.contains("does not exist"), "{error}");
    let path = folder.path().join("a.tif");
    write_geotiff(&path, &raster, &[]).unwrap();
    assert_eq!(image(&mut decoder(&std::fs::read(&path).unwrap())), [1.0]);
}

#[test]
fn several_bands_come_back_pixel_by_pixel_and_have_names() {
    for (width, height) in [(40, 30), (300, 270)] {
        let (grid, origin) = (grid(width, height), origin());
        let before = minutes(grid);
        let after: Vec<f32> = before.iter().map(|x| 1.5 * x).collect();
        let net: Vec<f32> = before.iter().map(|x| 2.0 - 0.25 * x).collect();
        let all = [("before", &before), ("after", &after), ("net", &net)];
        let bands = all.map(|(name, values)| Band {
            name,
            raster: Raster::new(&origin, grid, Unit::Minutes, values).unwrap(),
        });
        let file = encoded(&bands, &[]).unwrap();
        let mut decoder = decoder(&file);
        let found = image(&mut decoder);
        for (band, (_, values)) in all.iter().enumerate() {
            let own: Vec<f32> = found.iter().skip(band).step_by(3).copied().collect();
            assert_same(&own, values);
        }
        let xml = decoder.get_tag_ascii_string(METADATA).unwrap();
        let last = "<Item name=\"DESCRIPTION\" sample=\"2\" role=\"description\">net</Item>";
        assert!(xml.contains(last), "{xml}");
    }
    let (one, other) = (grid(2, 1), grid(1, 2));
    let origin = origin();
    let bands = [one, other].map(|grid| Band {
        name: "a",
        raster: Raster::new(&origin, grid, Unit::Minutes, &[1.0, 2.0]).unwrap(),
    });
    let told = encoded(&bands, &[]).unwrap_err().to_string();
    assert!(told.contains("the same grid"), "{told}");
    assert!(encoded(&[], &[]).is_err());
}
