use std::fs;
use std::path::Path;

use ombra_city::Crs;

use super::*;
use crate::raster::{MapStyle, Raster, Scale, Shades, Unit};

const GRID: Grid = Grid {
    corner: [-200.0, -150.0],
    cell: 2.0,
    width: 200,
    height: 150,
};

fn midtown() -> Origin {
    Origin::new(Crs::wgs84(), [-73.987_774, 40.749_785]).unwrap()
}

/// A number of its own for neighbouring cells, and a building.
fn minutes() -> Vec<f32> {
    let cell = |cell: u32| [cell % GRID.width, cell / GRID.width];
    (0..GRID.count() as u32)
        .map(|index| match cell(index) {
            [40..60, 50..90] => f32::NAN,
            [column, row] => ((column * 37 + row * 101) % 541) as f32 + 0.4,
        })
        .collect()
}

/// As the published data are read: column and row of the pixel are whole.
fn published(folder: &Path, [longitude, latitude]: [f64; 2], zoom: u8) -> i16 {
    let count = 2.0_f64.powi(zoom.into());
    let latitude = latitude.to_radians();
    let x = (longitude + 180.0) / 360.0 * count;
    let ln = (latitude.tan() + 1.0 / latitude.cos()).ln();
    let y = (1.0 - ln / std::f64::consts::PI) / 2.0 * count;
    let path = format!("{zoom}/{}/{}.bin", x.floor(), y.floor());
    let bytes = fs::read(folder.join(path)).unwrap();
    assert_eq!(bytes.len(), 2 * 256 * 256);
    let pixel = [x, y].map(|k| (256.0 * k.fract()).floor() as usize);
    let at = 2 * (pixel[1] * 256 + pixel[0]);
    i16::from_le_bytes([bytes[at], bytes[at + 1]])
}

#[test]
fn a_number_that_is_read_as_published_data_are_is_that_of_the_cell_there() {
    let (origin, values) = (midtown(), minutes());
    let raster = Raster::new(&origin, GRID, Unit::Minutes, &values).unwrap();
    let set = TileSet::new(&origin, &GRID, Some(19)).unwrap();
    let base = tempfile::tempdir().unwrap();
    let folder = base.path().join("tiles");
    let shades = Shades::new(&values, &MapStyle::default());
    set.write(&folder, &raster, &shades, "test", &[]).unwrap();
    assert!(folder.join("17").is_dir());
    // Pixels are 0.9 m wide at zoom 17: the middle of a cell of 2 m is in one whose own middle is in the cell.
    for zoom in [17, 19] {
        let mut none = 0;
        for cell in 0..GRID.count() as u32 {
            let centre = GRID.centre(cell % GRID.width, cell / GRID.width);
            let found = published(&folder, origin.to_geographic(centre), zoom);
            let minutes = values[cell as usize];
            if minutes.is_nan() {
                none += 1;
                assert_eq!(found, -1, "{cell}");
            } else {
                assert_eq!(found, minutes.round() as i16, "{cell} at {zoom}");
            }
        }
        assert_eq!(none, 20 * 40);
    }
    let beside = origin.to_geographic([-201.5, 0.0]);
    assert_eq!(published(&folder, beside, 17), -1);
}

#[test]
fn pictures_have_the_colours_of_the_map_and_are_transparent_where_nothing_was_measured() {
    let (origin, values) = (midtown(), minutes());
    let raster = Raster::new(&origin, GRID, Unit::Minutes, &values).unwrap();
    let set = TileSet::new(&origin, &GRID, None).unwrap();
    let base = tempfile::tempdir().unwrap();
    let folder = base.path().join("tiles");
    let shades = Shades::new(&values, &MapStyle::default());
    let metadata = [("when".to_owned(), "2026-12-21".to_owned())];
    set.write(&folder, &raster, &shades, "Midtown", &metadata)
        .unwrap();
    let [first, last] = set.zooms();
    assert_eq!(last, 17);
    let about: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.join("tiles.json")).unwrap()).unwrap();
    assert_eq!(
        (&about["tilejson"], &about["maxzoom"]),
        (&"3.0.0".into(), &17.into())
    );
    assert_eq!(about["ombra"]["when"], "2026-12-21");
    assert_eq!(about["numbers"]["none"], -1);
    let mut files = 0;
    for zoom in first..=last {
        for tile in set.tiles(zoom) {
            let path =
                |ending| folder.join(format!("{zoom}/{}/{}.{ending}", tile.at[0], tile.at[1]));
            let picture = image::open(path("png")).unwrap().to_rgba8();
            let numbers = fs::read(path("bin")).unwrap();
            for (pixel, number) in picture.pixels().zip(numbers.chunks(2)) {
                let number = i16::from_le_bytes([number[0], number[1]]);
                let [r, g, b, opacity] = pixel.0;
                assert_eq!(opacity, if number < 0 { 0 } else { 255 });
                if number >= 0 {
                    assert_eq!([r, g, b], shades.colour(f32::from(number) + 0.4));
                }
            }
            files += 1;
        }
    }
    assert_eq!(files, set.count());
    assert_eq!(set.tiles(first).len(), 1, "one tile shows all");
    assert!(set.tiles(first + 1).len() > 1);
}

#[test]
fn numbers_of_a_change_may_be_negative_and_long_ones_have_no_numbers() {
    let origin = midtown();
    let grid = Grid {
        width: 2,
        height: 1,
        ..GRID
    };
    let base = tempfile::tempdir().unwrap();
    let folder = base.path().join("tiles");
    let set = TileSet::new(&origin, &grid, None).unwrap();
    let style = MapStyle {
        scale: Scale::Change,
        ..MapStyle::default()
    };
    let written = |values: &[f32], style: &MapStyle| {
        let raster = Raster::new(&origin, grid, Unit::Minutes, values).unwrap();
        let shades = Shades::new(values, style);
        set.write(&folder, &raster, &shades, "", &[]).unwrap();
    };
    let at = |column| origin.to_geographic(grid.centre(column, 0));
    written(&[-60.0, f32::NAN], &style);
    let read = [0, 1].map(|column| published(&folder, at(column), 17));
    assert_eq!(read, [-60, i16::MIN]);
    written(&[40_000.0, 1.0], &MapStyle::default());
    let about = fs::read_to_string(folder.join("tiles.json")).unwrap();
    assert!(!about.contains("int16"));
    let has_numbers = |zoom: &Path| {
        let columns = fs::read_dir(zoom).unwrap();
        let files = columns.flat_map(|column| fs::read_dir(column.unwrap().path()).unwrap());
        files
            .into_iter()
            .any(|file| file.unwrap().path().extension().unwrap() == "bin")
    };
    assert!(!has_numbers(&folder.join("17")));
}

#[test]
fn zooms_follow_the_cells_and_there_are_not_too_many_tiles() {
    let zooms = |cell: f64, max_zoom| {
        let grid = Grid { cell, ..GRID };
        TileSet::new(&midtown(), &grid, max_zoom).map(|set| set.zooms()[1])
    };
    assert_eq!(zooms(50.0, None).unwrap(), 17);
    assert_eq!(zooms(1.0, None).unwrap(), 17);
    assert_eq!(zooms(0.5, None).unwrap(), 18);
    assert_eq!(zooms(0.5, Some(14)).unwrap(), 14);
    let error = zooms(2000.0, None).unwrap_err().to_string();
    assert!(error.contains("smaller zoom"), "{error}");
    let polar = Origin::new(Crs::wgs84(), [0.0, 86.0]).unwrap();
    assert!(TileSet::new(&polar, &GRID, None).is_err());
    // Across the antimeridian there are as many as elsewhere.
    let fiji = Origin::new(Crs::wgs84(), [180.0, -17.0]).unwrap();
    let set = TileSet::new(&fiji, &GRID, Some(17)).unwrap();
    assert!(set.count_at(17) < 12, "{}", set.count_at(17));
    let columns: Vec<u32> = set.tiles(17).iter().map(|tile| tile.at[0]).collect();
    assert!(columns.contains(&0) && columns.contains(&((1 << 17) - 1)));
}

#[test]
fn no_tile_is_there_twice_at_an_end_of_the_map() {
    for (bounds, expected) in [
        // Across the antimeridian, where the only tile of zoom 0 is east and west of it.
        ([[0.999, 0.5], [1.001, 0.5001]], [1, 2, 2]),
        // Down to the southern end, and a little beyond it.
        ([[0.3, 0.9], [0.3, 1.0]], [1, 1, 1]),
        ([[0.3, -1e-9], [0.3, 0.1]], [1, 1, 1]),
        // All around.
        ([[0.25, 0.3], [1.25, 0.3]], [1, 2, 4]),
    ] {
        let set = TileSet {
            bounds,
            zooms: [0, 2],
        };
        for (zoom, count) in (0..).zip(expected) {
            let tiles = set.tiles(zoom);
            let own: std::collections::HashSet<[u32; 2]> =
                tiles.iter().map(|tile| tile.at).collect();
            assert_eq!(own.len(), count, "{bounds:?} at {zoom}");
            assert_eq!((tiles.len(), set.count_at(zoom)), (count, count as u64));
            assert!(own.iter().flatten().all(|&k| k < 1 << zoom));
        }
    }
}
