//! Files of every kind that is read, written here.

use std::io::Cursor;

use ombra_city::{Crs, Grid, Origin};
use tiff::encoder::colortype::{ColorType, Gray8, Gray16, Gray32Float, Gray64Float, GrayI16, RGB8};
use tiff::encoder::{Compression, Predictor, TiffEncoder, TiffValue};
use tiff::tags::Tag;

use super::super::*;
use crate::raster::{Raster, Unit, write_geotiff};

/// What stands in a file besides its numbers.
#[derive(Clone)]
struct Head {
    scale: Option<[f64; 3]>,
    tie_points: Vec<f64>,
    transformation: Vec<f64>,
    keys: Vec<[u16; 4]>,
    texts: &'static str,
    no_data: Option<&'static str>,
}

impl Default for Head {
    fn default() -> Self {
        Self {
            scale: Some([2.0, 2.0, 0.0]),
            tie_points: vec![0.0, 0.0, 0.0, 500_000.0, 5_800_000.0, 0.0],
            transformation: Vec::new(),
            keys: vec![[1024, 0, 1, 1], [1025, 0, 1, 1], [3072, 0, 1, 32633]],
            texts: "",
            no_data: None,
        }
    }
}

/// A file of 3 by 2 pixels.
fn file<C: ColorType>(
    head: &Head,
    compression: Compression,
    predictor: Predictor,
    numbers: &[C::Inner],
) -> Vec<u8>
where
    [C::Inner]: TiffValue,
{
    let mut bytes = Vec::new();
    let encoder = TiffEncoder::new(Cursor::new(&mut bytes)).unwrap();
    let mut encoder = encoder
        .with_compression(compression)
        .with_predictor(predictor);
    let mut image = encoder.new_image::<C>(3, 2).unwrap();
    let directory = image.encoder();
    if let Some(scale) = head.scale {
        directory
            .write_tag(Tag::ModelPixelScaleTag, &scale[..])
            .unwrap();
    }
    for (tag, numbers) in [
        (Tag::ModelTiepointTag, &head.tie_points),
        (Tag::ModelTransformationTag, &head.transformation),
    ] {
        if !numbers.is_empty() {
            directory.write_tag(tag, &numbers[..]).unwrap();
        }
    }
    let first = [1, 1, 0, head.keys.len() as u16];
    let keys: Vec<u16> = [first]
        .iter()
        .chain(&head.keys)
        .flatten()
        .copied()
        .collect();
    directory
        .write_tag(Tag::GeoKeyDirectoryTag, &keys[..])
        .unwrap();
    if !head.texts.is_empty() {
        directory
            .write_tag(Tag::GeoAsciiParamsTag, head.texts)
            .unwrap();
    }
    if let Some(no_data) = head.no_data {
        directory.write_tag(Tag::GdalNodata, no_data).unwrap();
    }
    image.write_data(numbers).unwrap();
    bytes
}

fn floats(head: &Head, numbers: &[f32]) -> Vec<u8> {
    file::<Gray32Float>(head, Compression::Uncompressed, Predictor::None, numbers)
}

fn heights(bytes: &[u8]) -> Vec<f32> {
    let read = parse(bytes, None, &Limits::default()).unwrap();
    let pixels = (0..2).flat_map(|row| (0..3).map(move |column| [column, row]));
    pixels.map(|pixel| read.field.at(pixel)).collect()
}

fn told(bytes: &[u8]) -> String {
    parse(bytes, None, &Limits::default())
        .unwrap_err()
        .to_string()
}

#[test]
fn a_flat_strip_may_be_packed_as_far_as_its_packing_goes() {
    for (packed, compression) in [
        ("LZW", Compression::Lzw),
        (
            "Deflate",
            Compression::Deflate(tiff::encoder::DeflateLevel::Best),
        ),
        ("PackBits", Compression::Packbits),
    ] {
        let mut bytes = Vec::new();
        let encoder = TiffEncoder::new(Cursor::new(&mut bytes)).unwrap();
        let mut encoder = encoder.with_compression(compression);
        let mut image = encoder.new_image::<Gray32Float>(2048, 2048).unwrap();
        image.rows_per_strip(2048).unwrap();
        let directory = image.encoder();
        let scale = [2.0, 2.0, 0.0];
        (directory.write_tag(Tag::ModelPixelScaleTag, &scale[..])).unwrap();
        let tie_points = [0.0, 0.0, 0.0, 500_000.0, 5_800_000.0, 0.0];
        (directory.write_tag(Tag::ModelTiepointTag, &tie_points[..])).unwrap();
        let keys = [1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32633_u16];
        (directory.write_tag(Tag::GeoKeyDirectoryTag, &keys[..])).unwrap();
        image.write_data(&vec![0.0; 2048 * 2048]).unwrap();
        let read = parse(&bytes, None, &Limits::default());
        let field = read.unwrap_or_else(|error| panic!("{packed}: {error}"));
        assert_eq!(field.field.at([2047, 2047]), 0.0);
    }
}

const NUMBERS: [f32; 6] = [1.0, 2.0, 3.0, 4.0, 5.0, 60.0];

#[test]
fn every_kind_of_number_and_packing_is_read() {
    let head = Head::default();
    for (packed, compression) in [
        ("none", Compression::Uncompressed),
        ("LZW", Compression::Lzw),
        (
            "Deflate",
            Compression::Deflate(tiff::encoder::DeflateLevel::Fast),
        ),
        ("PackBits", Compression::Packbits),
    ] {
        let none = Predictor::None;
        let all = [
            file::<Gray32Float>(&head, compression, none, &NUMBERS),
            file::<Gray64Float>(&head, compression, none, &NUMBERS.map(f64::from)),
            file::<GrayI16>(&head, compression, none, &NUMBERS.map(|z| z as i16)),
            file::<Gray16>(&head, compression, none, &NUMBERS.map(|z| z as u16)),
            file::<Gray8>(&head, compression, none, &NUMBERS.map(|z| z as u8)),
            file::<Gray16>(
                &head,
                compression,
                Predictor::Horizontal,
                &NUMBERS.map(|z| z as u16),
            ),
        ];
        for (k, bytes) in all.iter().enumerate() {
            assert_eq!(heights(bytes), NUMBERS, "{k}, {packed}");
        }
    }
}

#[test]
fn what_has_no_height_is_blank() {
    let head = |no_data| Head {
        no_data: Some(no_data),
        ..Head::default()
    };
    let blank = |bytes: &[u8]| {
        heights(bytes)
            .iter()
            .map(|z| z.is_nan())
            .collect::<Vec<_>>()
    };
    let numbers = [-9999.0, 1.0, f32::NAN, f32::INFINITY, -3.402_823_5e38, 9.0];
    assert_eq!(
        blank(&floats(&head("-9999"), &numbers)),
        [true, false, true, true, true, false]
    );
    // A number in decimals that single precision does not have.
    let lowest = floats(
        &head("-3.40282346600000016e+38"),
        &[-3.402_823_5e38, 0.1, 0.0, 1.0, 2.0, 3.0],
    );
    assert_eq!(blank(&lowest), [true, false, false, false, false, false]);
    let tenth = floats(&head("0.1"), &[0.1, 0.2, 0.0, 1.0, 2.0, 3.0]);
    assert!(blank(&tenth)[0]);
    let zero = file::<Gray8>(
        &head("0"),
        Compression::Lzw,
        Predictor::None,
        &[0, 1, 2, 3, 4, 0],
    );
    assert_eq!(blank(&zero), [true, false, false, false, false, true]);
    // Nobody says that it stands for none, but it cannot be a height.
    let read = parse(
        &floats(&Head::default(), &numbers),
        None,
        &Limits::default(),
    )
    .unwrap();
    assert_eq!(read.field.blank(), 4);
    assert_eq!(read.findings.len(), 1);
    assert!(
        read.findings[0].to_string().contains("cannot be (-9999 m)"),
        "{:?}",
        read.findings
    );
}

#[test]
fn pixels_are_where_their_tags_put_them() {
    let middle = |head: &Head| {
        let read = parse(&floats(head, &NUMBERS), None, &Limits::default()).unwrap();
        [read.field.on_map([0, 0]), read.field.on_map([2, 1])]
    };
    let area = Head::default();
    assert_eq!(
        middle(&area),
        [[500_001.0, 5_799_999.0], [500_005.0, 5_799_997.0]]
    );
    let mut point = area.clone();
    point.keys[1][3] = 2;
    assert_eq!(
        middle(&point),
        [[500_000.0, 5_800_000.0], [500_004.0, 5_799_998.0]]
    );
    let tied_elsewhere = Head {
        tie_points: vec![3.0, 2.0, 0.0, 500_006.0, 5_799_996.0, 0.0],
        ..area.clone()
    };
    assert_eq!(middle(&tied_elsewhere), middle(&area));
    let mut rows = vec![0.0; 16];
    (rows[0], rows[3], rows[5], rows[7], rows[15]) = (2.0, 500_000.0, -2.0, 5_800_000.0, 1.0);
    let transformed = Head {
        scale: None,
        tie_points: Vec::new(),
        transformation: rows,
        ..area.clone()
    };
    assert_eq!(middle(&transformed), middle(&area));
    for head in [
        Head {
            scale: None,
            ..area.clone()
        },
        Head {
            tie_points: Vec::new(),
            ..area.clone()
        },
    ] {
        assert!(told(&floats(&head, &NUMBERS)).contains("does not say where"));
    }
    let many = Head {
        scale: None,
        tie_points: vec![0.0; 24],
        ..area.clone()
    };
    assert!(told(&floats(&many, &NUMBERS)).contains("straighten"));
    let flat = Head {
        scale: Some([0.0, 2.0, 0.0]),
        ..area
    };
    assert!(told(&floats(&flat, &NUMBERS)).contains("no size"));
}

#[test]
fn a_reference_system_without_a_code_is_to_be_named() {
    let named = Head {
        keys: vec![[1024, 0, 1, 1], [1026, 34737, 9, 0], [3072, 0, 1, 32767]],
        texts: "Our town|",
        ..Head::default()
    };
    let bytes = floats(&named, &NUMBERS);
    let error = told(&bytes);
    assert!(
        error.contains("by its EPSG code (it says \"Our town\"); name that"),
        "{error}"
    );
    let crs = Crs::from_epsg(25833).unwrap();
    let read = parse(&bytes, Some(&crs), &Limits::default()).unwrap();
    assert_eq!(read.field.crs().name(), "EPSG:25833");
    let unknown = Head {
        keys: vec![[3072, 0, 1, 1]],
        ..Head::default()
    };
    assert!(told(&floats(&unknown, &NUMBERS)).contains("EPSG:1"));
}

#[test]
fn feet_become_metres() {
    let mut head = Head::default();
    head.keys.push([4099, 0, 1, 9002]);
    let read = heights(&floats(&head, &NUMBERS));
    assert!((read[5] - 18.288).abs() < 1e-5, "{read:?}");
}

#[test]
fn bands_and_sizes_that_are_no_heights_are_told() {
    let none = Predictor::None;
    let rgb = file::<RGB8>(&Head::default(), Compression::Lzw, none, &[7; 18]);
    assert!(told(&rgb).contains("has 3 bands"));
    let limits = Limits {
        raster_pixels: 5,
        ..Limits::default()
    };
    let error = parse(&floats(&Head::default(), &NUMBERS), None, &limits).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("3x2 pixels, over the limit of 5"),
        "{error}"
    );
}

#[test]
fn a_file_that_is_cut_anywhere_is_told() {
    let whole = file::<Gray32Float>(
        &Head::default(),
        Compression::Lzw,
        Predictor::None,
        &NUMBERS,
    );
    for end in 4..whole.len() {
        assert!(
            parse(&whole[..end], None, &Limits::default()).is_err(),
            "{end}"
        );
    }
}

#[test]
fn a_file_with_any_byte_changed_is_read_or_told() {
    let whole = file::<Gray32Float>(
        &Head::default(),
        Compression::Lzw,
        Predictor::None,
        &NUMBERS,
    );
    let limits = Limits {
        raster_pixels: 1 << 16,
        ..Limits::default()
    };
    let mut read = 0;
    for at in 0..whole.len() {
        for change in [0x01, 0x80, 0xff] {
            let mut bytes = whole.clone();
            bytes[at] ^= change;
            if let Ok(found) = parse(&bytes, None, &limits) {
                assert!(found.field.size()[0] > 0);
                read += 1;
            }
        }
    }
    assert!(read > 0 && read < 3 * whole.len());
}

/// Tiles, Deflate and the predictor for floating-point numbers, over 256 pixels wide, with overviews.
#[test]
fn what_this_program_writes_is_read() {
    let origin = Origin::new(Crs::from_epsg(25833).unwrap(), [390_000.0, 5_820_000.0]).unwrap();
    let grid = Grid {
        corner: [-150.0, -140.0],
        cell: 1.0,
        width: 300,
        height: 270,
    };
    let value = |k: usize| {
        if k == 77 {
            f32::NAN
        } else {
            (k % 300) as f32 + 0.25
        }
    };
    let values: Vec<f32> = (0..grid.count()).map(value).collect();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.tif");
    let raster = Raster::new(&origin, grid, Unit::Minutes, &values).unwrap();
    write_geotiff(&path, &raster, &[]).unwrap();
    let local = format!(
        "+proj=tmerc +lat_0={} +lon_0={} +datum=WGS84 +units=m",
        origin.latitude(),
        origin.longitude()
    );
    let crs = Crs::parse(&local).unwrap();
    let field = read_elevation(&path, Some(&crs), &Limits::default())
        .unwrap()
        .field;
    assert_eq!((field.size(), field.blank()), ([300, 270], 1));
    assert_eq!(field.on_map([0, 0]), [-149.5, 129.5]);
    for at in [[0, 0], [255, 255], [256, 256], [299, 269]] {
        assert_eq!(field.at(at), at[0] as f32 + 0.25);
    }
    let info = elevation_info(&path).unwrap();
    assert_eq!(
        (info.more_images, info.crs, info.compression.as_str()),
        (1, None, "Deflate")
    );
    assert!(
        info.findings[0]
            .message
            .contains("Local transverse Mercator"),
        "{:?}",
        info.findings
    );
}
