//! Web Mercator (EPSG:3857), as tiles of web maps divide it: at zoom z the world is a square of 2^z by 2^z tiles, counted from the
//! north-west.

/// Pixels on the side of a tile.
pub(super) const SIDE: u32 = 256;

/// The northern and southern ends of the square, in degrees.
pub(super) const LATITUDE: f64 = 85.051_128;

/// Metres on the ground of a pixel at zoom 0 on the equator.
pub(super) const PIXEL: f64 = 2.0 * std::f64::consts::PI * 6_378_137.0 / SIDE as f64;

/// A tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tile {
    pub(super) zoom: u8,
    /// From the west, and from the north.
    pub(super) at: [u32; 2],
}

/// Shares of the square from its north-west corner, 0 to 1.
pub(super) fn to_square([longitude, latitude]: [f64; 2]) -> [f64; 2] {
    let north = latitude.to_radians().tan().asinh() / std::f64::consts::PI;
    [(longitude + 180.0) / 360.0, (1.0 - north) / 2.0]
}

/// Longitude and latitude.
pub(super) fn to_degrees([x, y]: [f64; 2]) -> [f64; 2] {
    let north = (std::f64::consts::PI * (1.0 - 2.0 * y)).sinh();
    [360.0 * x - 180.0, north.atan().to_degrees()]
}

impl Tile {
    /// Longitude and latitude of a place in it, in pixels from its north-west corner.
    pub(super) fn degrees(self, pixel: [f64; 2]) -> [f64; 2] {
        let count = f64::from(1_u32 << self.zoom);
        to_degrees([0, 1].map(|k| (f64::from(self.at[k]) + pixel[k] / f64::from(SIDE)) / count))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_back_leads_to_the_same_place() {
        assert_eq!(to_square([-180.0, 0.0]), [0.0, 0.5]);
        let [_, top] = to_square([0.0, LATITUDE]);
        assert!(top.abs() < 1e-7, "{top}");
        for place in [[-73.987_774, 40.749_785], [4.36, -52.01], [0.0, 0.0]] {
            let back = to_degrees(to_square(place));
            assert!(
                (0..2).all(|k| (back[k] - place[k]).abs() < 1e-12),
                "{back:?}"
            );
        }
    }

    #[test]
    fn the_tile_of_a_place_is_the_one_that_is_known() {
        // By the formula that OpenStreetMap's wiki gives, reckoned apart: 38598.6447, 49263.4348.
        let [x, y] = to_square([-73.985_656, 40.748_433]).map(|share| share * f64::from(1 << 17));
        let tile = Tile {
            zoom: 17,
            at: [x as u32, y as u32],
        };
        assert_eq!(tile.at, [38_598, 49_263]);
        let corner = tile.degrees([0.0; 2]);
        let [u, v] = to_square(corner).map(|share| share * f64::from(1 << 17));
        assert!((u - 38_598.0).abs() < 1e-6 && (v - 49_263.0).abs() < 1e-6);
    }
}
