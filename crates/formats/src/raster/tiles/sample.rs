//! From the pixels of a tile to the cells of a grid.

use ombra_city::{Crs, Origin};

use super::mercator::{SIDE, Tile};
use crate::raster::Raster;

/// Local metres are reckoned at the corners of blocks of so many pixels: in tiles of 10 km or less they are even between
/// these to a thousandth of a pixel.
const BLOCK: u32 = 16;

/// The smallest zoom at which tiles are so small.
const SMALL: u8 = 12;

/// Farther from the middle than this, in degrees, the local metres mean nothing. No grid reaches so far.
const FAR: f64 = 10.0;

/// What the pixels of tiles show.
pub(super) struct Sampler<'a> {
    raster: &'a Raster<'a>,
    /// Between degrees and local metres.
    origin: Origin,
}

impl<'a> Sampler<'a> {
    pub(super) fn new(raster: &'a Raster<'a>) -> Self {
        let origin = raster.origin().on_map(Crs::wgs84());
        Self { raster, origin }
    }

    /// Minutes of each pixel, row by row from the north-west; NaN where there are none.
    pub(super) fn minutes(&self, tile: Tile) -> Vec<f32> {
        let block = if tile.zoom >= SMALL { BLOCK } else { 1 };
        let corners = SIDE / block + 1;
        let nodes: Vec<[f64; 2]> = (0..corners * corners)
            .map(|node| {
                let pixel = [node % corners, node / corners].map(|k| f64::from(k * block));
                self.local(tile.degrees(pixel))
            })
            .collect();
        let per_value = self.raster.unit().minutes();
        (0..SIDE * SIDE)
            .map(|pixel| {
                let pixel = [pixel % SIDE, pixel / SIDE];
                let [column, row] = pixel.map(|k| k / block);
                let [u, v] = pixel.map(|k| (f64::from(k % block) + 0.5) / f64::from(block));
                let first = (row * corners + column) as usize;
                let around = [0, 1, corners as usize, corners as usize + 1];
                let [a, b, c, d] = around.map(|more| nodes[first + more]);
                let at = [0, 1].map(|k| {
                    let [north, south] = [a[k] + u * (b[k] - a[k]), c[k] + u * (d[k] - c[k])];
                    north + v * (south - north)
                });
                self.value(at) * per_value
            })
            .collect()
    }

    fn local(&self, [longitude, latitude]: [f64; 2]) -> [f64; 2] {
        let middle = [self.origin.longitude(), self.origin.latitude()];
        let east = (longitude - middle[0] + 540.0).rem_euclid(360.0) - 180.0;
        if east.abs() < FAR && (latitude - middle[1]).abs() < FAR {
            self.origin.to_local([middle[0] + east, latitude])
        } else {
            [f64::NAN; 2]
        }
    }

    /// Of the cell that a place lies in.
    fn value(&self, [x, y]: [f64; 2]) -> f32 {
        let grid = self.raster.grid();
        let [west, north] = grid.north_west();
        let [column, row] = [(x - west) / grid.cell, (north - y) / grid.cell];
        let is_within = column >= 0.0 && row >= 0.0;
        if is_within && column < f64::from(grid.width) && row < f64::from(grid.height) {
            self.raster.values()[row as usize * grid.width as usize + column as usize]
        } else {
            f32::NAN
        }
    }
}
