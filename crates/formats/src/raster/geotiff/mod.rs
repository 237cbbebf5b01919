//! GeoTIFF (OGC 19-008r4), laid out as a cloud-optimised one (OGC 21-026).
//!
//! Written by hand over `flate2`: the crate `tiff` writes neither tiles nor this predictor, and
//! `geotiff-writer`, which writes both, has no place for the metadata that reruns a job. There is one
//! kind of file to write:
//!
//! - one or several bands of 32-bit floating-point numbers, pixel by pixel, NaN for no data, in tiles of 256 × 256, packed with
//!   Deflate after the floating-point predictor;
//! - overviews of half, a quarter, … the size until one tile holds all;
//! - all directories first, then the tiles, smallest overview first, so that a viewer at the other end
//!   of a network reads the head and then only what it shows.
//!
//! The same raster gives the same bytes: nothing tells the time.

mod directory;
mod geo_keys;
mod metadata;
mod tile;

#[cfg(test)]
mod tests;

use std::path::Path;

use super::Raster;
use super::cells::{Blank, Cells};
use crate::error::{Fault, FormatError};
use crate::image::write_error;
use crate::whole::write_whole;
use directory::{Directory, Value};

/// What GDAL looks for after the header, to know that the file is laid out for clouds. The number is
/// the length of what follows its line.
const GHOST: &str = "GDAL_STRUCTURAL_METADATA_SIZE=000140 bytes\n\
    LAYOUT=IFDS_BEFORE_DATA\n\
    BLOCK_ORDER=ROW_MAJOR\n\
    BLOCK_LEADER=SIZE_AS_UINT4\n\
    BLOCK_TRAILER=LAST_4_BYTES_REPEATED\n\
    KNOWN_INCOMPATIBLE_EDITION=NO\n ";
const HEADER: usize = 8;

/// Writes a raster as a cloud-optimised GeoTIFF, in the city's local metres: a transverse Mercator
/// projection about its origin on WGS 84, which the file describes.
///
/// `metadata` are names and values that say how the numbers came about; GIS programs show them.
/// Control characters that XML cannot hold become U+FFFD, and GDAL shows no empty values. The file is put in its place when it is
/// whole, and its bytes depend on the arguments alone.
///
/// # Errors
/// When the folder does not exist or cannot be written into, or the file would be larger than 4 GiB.
pub fn write_geotiff(
    path: impl AsRef<Path>,
    raster: &Raster<'_>,
    metadata: &[(String, String)],
) -> Result<(), FormatError> {
    let band = Band {
        name: "time in shadow",
        raster: *raster,
    };
    write_geotiff_bands(path, &[band], metadata)
}

/// A raster among several over the same grid.
#[derive(Clone, Copy, Debug)]
pub struct Band<'a> {
    /// What GIS programs call it.
    pub name: &'a str,
    /// Its numbers.
    pub raster: Raster<'a>,
}

/// The same with several bands, one at least, all over the grid of the first.
///
/// # Errors
/// As those of [`write_geotiff`]; and when there is no band, or one has another grid.
pub fn write_geotiff_bands(
    path: impl AsRef<Path>,
    bands: &[Band<'_>],
    metadata: &[(String, String)],
) -> Result<(), FormatError> {
    let path = path.as_ref();
    let content = encoded(bands, metadata).map_err(|e| e.in_file(path))?;
    write_whole(path, &content)
}

/// A raster at one size, packed.
struct Level {
    width: u32,
    height: u32,
    tiles: Vec<Vec<u8>>,
}

fn encoded(bands: &[Band<'_>], metadata: &[(String, String)]) -> Result<Vec<u8>, FormatError> {
    let grid = bands.first().map(|band| band.raster.grid());
    let is_one_grid = bands.iter().all(|band| Some(band.raster.grid()) == grid);
    if bands.is_empty() || !is_one_grid {
        let message = "needs one band at least, and all over the same grid".to_owned();
        let format = "GeoTIFF";
        return Err(FormatError::file(Fault::Image { format, message }));
    }
    let levels = levels(bands)?;

    // The directories name the places of the tiles, which come after them: measured first.
    let nowhere = levels.iter().map(|l| vec![0; l.tiles.len()]).collect();
    let directories = directories(bands, metadata, &levels, nowhere);
    let front = (HEADER + GHOST.len()).next_multiple_of(2);
    let front = front + directories.iter().map(Directory::len).sum::<usize>();
    let places = places(&levels, front)?;
    let directories = self::directories(bands, metadata, &levels, places);

    let mut file = Vec::new();
    file.extend_from_slice(b"II\x2a\0");
    let first = (HEADER + GHOST.len()).next_multiple_of(2);
    file.extend_from_slice(&(first as u32).to_le_bytes());
    file.extend_from_slice(GHOST.as_bytes());
    file.resize(first, 0);
    for (i, directory) in directories.iter().enumerate() {
        let at = file.len() as u32;
        directory.encode(at, i + 1 == directories.len(), &mut file);
    }
    debug_assert_eq!(file.len(), front);
    for tile in levels.iter().rev().flat_map(|level| &level.tiles) {
        file.extend_from_slice(&(tile.len() as u32).to_le_bytes());
        file.extend_from_slice(tile);
        file.extend_from_slice(&tile[tile.len() - 4..]);
    }
    Ok(file)
}

/// The raster itself and its overviews, from the largest to the smallest.
fn levels(bands: &[Band<'_>]) -> Result<Vec<Level>, FormatError> {
    let all: Vec<Cells<'_>> = bands.iter().map(|band| band.raster.cells()).collect();
    let packed = |cells: &[Cells<'_>]| {
        Ok(Level {
            width: cells[0].width as u32,
            height: cells[0].height as u32,
            tiles: tile::packed_tiles(cells).map_err(write_error)?,
        })
    };
    let mut levels = vec![packed(&all)?];
    let mut factor = 1;
    while all[0].width.max(all[0].height).div_ceil(factor) > tile::SIDE {
        factor *= 2;
        let means = all.iter().map(|cells| cells.means(factor, Blank::IfAllAre));
        levels.push(packed(&means.collect::<Vec<_>>())?);
    }
    Ok(levels)
}

/// Where the tiles of each level begin, the smallest level first, each after a word with its length
/// and before one that repeats its end.
fn places(levels: &[Level], front: usize) -> Result<Vec<Vec<u32>>, FormatError> {
    let mut at = front as u64;
    let mut places = Vec::new();
    for level in levels.iter().rev() {
        let mut of_level = Vec::with_capacity(level.tiles.len());
        for tile in &level.tiles {
            of_level.push((at + 4) as u32);
            at += tile.len() as u64 + 8;
        }
        places.push(of_level);
    }
    if u32::try_from(at).is_err() {
        let message =
            format!("would be {at} bytes, but holds no more than 4 GiB; use larger cells");
        let format = "GeoTIFF";
        return Err(FormatError::file(Fault::Image { format, message }));
    }
    places.reverse();
    Ok(places)
}

fn directories(
    bands: &[Band<'_>],
    metadata: &[(String, String)],
    levels: &[Level],
    places: Vec<Vec<u32>>,
) -> Vec<Directory> {
    let with_places = levels.iter().zip(places).enumerate();
    with_places
        .map(|(i, (level, places))| {
            let mut directory = image_directory(level, places, i > 0, bands.len());
            if i == 0 {
                geo_keys::add_to(&mut directory, &bands[0].raster);
                let xml = metadata::to_xml(bands, metadata);
                directory.add(42112, Value::Ascii(xml));
            }
            directory
        })
        .collect()
}

/// How a level's numbers are stored.
fn image_directory(level: &Level, places: Vec<u32>, is_overview: bool, bands: usize) -> Directory {
    let lengths = level.tiles.iter().map(|t| t.len() as u32).collect();
    let side = tile::SIDE as u16;
    let mut directory = Directory::default();
    for (tag, value) in [
        (254, Value::Longs(vec![u32::from(is_overview)])),
        (256, Value::Longs(vec![level.width])),
        (257, Value::Longs(vec![level.height])),
        (258, Value::Shorts(vec![32; bands])), // bits a sample
        (259, Value::Shorts(vec![8])),         // Deflate
        (262, Value::Shorts(vec![1])),         // more is brighter
        (277, Value::Shorts(vec![bands as u16])), // samples a pixel
        (284, Value::Shorts(vec![1])),         // chunky
        (317, Value::Shorts(vec![3])),         // floating-point predictor
        (322, Value::Shorts(vec![side])),
        (323, Value::Shorts(vec![side])),
        (324, Value::Longs(places)),
        (325, Value::Longs(lengths)),
        (339, Value::Shorts(vec![3; bands])), // floating-point numbers
        (42113, Value::Ascii("nan".to_owned())), // GDAL_NODATA
    ] {
        directory.add(tag, value);
    }
    if bands > 1 {
        // What comes behind the first sample is no colour.
        directory.add(338, Value::Shorts(vec![0; bands - 1]));
    }
    directory
}
