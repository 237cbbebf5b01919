//! What is read of files made here, and of broken ones.

mod masks;
mod written;

use ombra_city::Crs;

use super::*;
use crate::city::tests::outside_data;

/// `None` where the file is not there.
fn bad(name: &str) -> Option<Result<Elevation, String>> {
    let path = outside_data(&format!("bad/{name}"))?;
    Some(
        read_elevation(path, None, &Limits::default()).map_err(|error| {
            let text = error.to_string();
            assert!(text.contains(name) && !text.contains('\n'), "{text}");
            text
        }),
    )
}

#[test]
fn broken_files_are_answered_as_their_list_asks() {
    for (name, told) in [
        (
            "huge_dims.tif",
            "image is 2147483647x2147483647 pixels, over the limit of 268435456 pixels",
        ),
        (
            "truncated.tif",
            "TIFF: the file is cut off: strip 9 of 200 would end at byte 65576, and the file has 60000 bytes",
        ),
        ("all_nodata.tif", "no pixel has a height"),
    ] {
        if let Some(read) = bad(name) {
            let error = read.unwrap_err();
            assert!(error.contains(told), "{error}");
        }
    }
}

#[test]
fn degrees_become_metres() {
    let Some(read) = bad("geographic_dsm.tif") else {
        return;
    };
    let field = read.unwrap().field;
    let extent = field.extent(&field.origin().unwrap());
    let [east, north] = [0, 1].map(|k| extent.high[k] - extent.low[k]);
    // 15 pixels of 1e-5 degrees, at 40.71 degrees north.
    assert!(
        (east - 12.67).abs() < 0.02 && (north - 16.66).abs() < 0.02,
        "{east} {north}"
    );
}

#[test]
fn real_models_have_the_numbers_that_are_known_of_them() {
    let Some(path) = outside_data("city/dsm_athens/DSM.tif") else {
        return;
    };
    let field = read_elevation(&path, None, &Limits::default())
        .unwrap()
        .field;
    assert_eq!((field.size(), field.blank()), ([400, 400], 0));
    assert_eq!(field.crs().name(), "EPSG:2100");
    let [low, high] = field.range();
    assert!(
        (108.5..109.5).contains(&low) && (174.0..174.5).contains(&high),
        "{low} {high}"
    );
    assert_eq!(field.on_map([0, 0]), [476_800.5, 4_206_249.5]);
    let info = elevation_info(&path).unwrap();
    assert_eq!(info.sample, "64-bit floating-point numbers");
    let [wide, high] = info.pixel.unwrap();
    // The grid's metres are short by 0.0004 at its middle.
    assert!(
        (wide - 1.0).abs() < 5e-4 && (high - 1.0).abs() < 5e-4,
        "{wide} {high}"
    );
    assert!(info.findings.is_empty());
}

#[test]
fn what_is_no_tiff_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let told = |content: &[u8]| {
        let path = folder.path().join("a.tif");
        std::fs::write(&path, content).unwrap();
        let read = read_elevation(&path, None, &Limits::default());
        read.unwrap_err().to_string()
    };
    assert!(told(b"").contains("empty"));
    assert!(told(b"hello").contains("heights as GeoTIFF"));
    for head in [
        &b"II*\0"[..],
        b"MM\0*",
        b"II+\0",
        b"II*\0\xff\xff\xff\xff",
        b"II*\0\x08\0\0\0\0\0",
    ] {
        assert!(told(head).contains("a.tif: TIFF: "), "{}", told(head));
    }
    let error = read_elevation("none.tif", Some(&Crs::wgs84()), &Limits::default());
    assert!(
        error
            .unwrap_err()
            .to_string()
            .contains("none.tif: cannot be opened")
    );
}
