//! Where the cells are on Earth: GeoTIFF keys (OGC 19-008r4, section 7) of the city's local frame.

use super::directory::{Directory, Value};
use crate::raster::Raster;

const USER_DEFINED: u16 = 32767;

/// Keys whose values lie in the tag of the doubles, and in that of the texts.
const DOUBLES: u16 = 34736;
const TEXTS: u16 = 34737;

/// Adds the keys and the place of the north-west corner.
///
/// The frame has no number in a registry, so that its projection is spelt out: transverse Mercator
/// (EPSG method 9807) of scale 1 about the origin, on WGS 84. A cell is an area, not a point: the
/// corner is the outer one.
pub(super) fn add_to(directory: &mut Directory, raster: &Raster<'_>) {
    let (origin, grid) = (raster.origin(), raster.grid());
    let name = format!(
        "Local transverse Mercator at {:.6}, {:.6} (latitude, longitude)",
        origin.latitude(),
        origin.longitude()
    );
    let mut keys = Keys::default();
    keys.short(1024, 1); // GTModelType: projected
    keys.short(1025, 1); // GTRasterType: a pixel is an area
    keys.text(1026, &name); // GTCitation
    keys.short(2048, 4326); // GeodeticCRS: WGS 84
    keys.short(2054, 9102); // GeogAngularUnits: degree
    keys.short(3072, USER_DEFINED); // ProjectedCRS
    keys.text(3073, &name); // ProjectedCitation
    keys.short(3074, USER_DEFINED); // Projection
    keys.short(3075, 1); // ProjMethod: transverse Mercator
    keys.short(3076, 9001); // ProjLinearUnits: metre
    keys.double(3080, origin.longitude()); // ProjNatOriginLong
    keys.double(3081, origin.latitude()); // ProjNatOriginLat
    keys.double(3082, 0.0); // ProjFalseEasting
    keys.double(3083, 0.0); // ProjFalseNorthing
    keys.double(3092, 1.0); // ProjScaleAtNatOrigin

    let [west, north] = grid.north_west();
    directory.add(33550, Value::Doubles(vec![grid.cell, grid.cell, 0.0]));
    directory.add(33922, Value::Doubles(vec![0.0, 0.0, 0.0, west, north, 0.0]));
    directory.add(34735, Value::Shorts(keys.directory()));
    directory.add(DOUBLES, Value::Doubles(keys.doubles));
    directory.add(TEXTS, Value::Ascii(keys.texts));
}

/// Keys, to be added in rising order.
#[derive(Default)]
struct Keys {
    entries: Vec<[u16; 4]>,
    doubles: Vec<f64>,
    texts: String,
}

impl Keys {
    fn short(&mut self, key: u16, value: u16) {
        self.entries.push([key, 0, 1, value]);
    }

    fn double(&mut self, key: u16, value: f64) {
        let at = self.doubles.len() as u16;
        self.entries.push([key, DOUBLES, 1, at]);
        self.doubles.push(value);
    }

    fn text(&mut self, key: u16, text: &str) {
        let at = self.texts.len() as u16;
        self.texts += text;
        self.texts.push('|');
        let length = self.texts.len() as u16 - at;
        self.entries.push([key, TEXTS, length, at]);
    }

    /// Version 1, revision 1.0, and how many keys there are, before the keys.
    fn directory(&self) -> Vec<u16> {
        let head = [1, 1, 0, self.entries.len() as u16];
        [head]
            .iter()
            .chain(&self.entries)
            .flatten()
            .copied()
            .collect()
    }
}
