//! Surfaces and terrain as rasters of heights.

mod affine;
mod lattice;
mod triangles;
mod vertices;

use affine::Affine;
pub(crate) use triangles::triangles;
pub(crate) use vertices::Vertices;

use crate::crs::Crs;
use crate::error::CityError;
use crate::extent::Extent;
use crate::origin::Origin;

/// The most pixels of a height field that are made into a surface: 16,777,216, as 4096 × 4096 have. A
/// triangle takes up to 400 bytes on the way to its shadow, and there are two a pixel.
pub const MOST_PIXELS: u64 = 1 << 24;

/// Heights on a raster of a map: a digital surface model (DSM) or a digital terrain model (DEM, DTM).
///
/// A height is that of the middle of its pixel. Between the middles of four pixels lie two triangles: the
/// diagonal is the one whose ends differ less in height, so that ridges and edges of roofs are kept. So a wall
/// is as steep as one pixel is wide.
#[derive(Clone, Debug)]
pub struct HeightField {
    crs: Crs,
    width: u32,
    height: u32,
    heights: Vec<f32>,
    map_from_pixel: Affine,
    range: [f32; 2],
}

impl HeightField {
    /// Heights in metres, row by row, NaN where there is none. `map_from_pixel` are the numbers a to f of
    /// x = a·column + b·row + c, y = d·column + e·row + f, which lead to the **middle** of a pixel, counted
    /// from 0, in the coordinates of the map.
    ///
    /// # Errors
    /// When there are not as many heights as pixels, none at all or an infinite one, and when pixels have no
    /// size.
    pub fn new(
        crs: Crs,
        [width, height]: [u32; 2],
        map_from_pixel: [f64; 6],
        heights: Vec<f32>,
    ) -> Result<Self, CityError> {
        let broken = |what: String| CityError::HeightField { what };
        if u64::from(width) * u64::from(height) != heights.len() as u64 {
            let found = heights.len();
            return Err(broken(format!(
                "{width}x{height} pixels need that many heights, but there are {found}"
            )));
        }
        if heights.iter().any(|z| z.is_infinite()) {
            return Err(broken(
                "a height is infinite; NaN says that there is none".to_owned(),
            ));
        }
        let map_from_pixel = Affine::new(map_from_pixel).ok_or_else(|| {
            broken("pixels have no size, or none that is finite, on the map".to_owned())
        })?;
        let told = heights.iter().copied().filter(|z| !z.is_nan());
        let range = told.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], z| {
            [low.min(z), high.max(z)]
        });
        if range[0] > range[1] {
            return Err(broken("no pixel has a height".to_owned()));
        }
        Ok(Self {
            crs,
            width,
            height,
            heights,
            map_from_pixel,
            range,
        })
    }

    /// Columns and rows.
    #[must_use]
    pub const fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// The map's reference system.
    #[must_use]
    pub const fn crs(&self) -> &Crs {
        &self.crs
    }

    /// The lowest and the highest height, metres.
    #[must_use]
    pub const fn range(&self) -> [f32; 2] {
        self.range
    }

    /// How many pixels have no height.
    #[must_use]
    pub fn blank(&self) -> u64 {
        self.heights.iter().filter(|z| z.is_nan()).count() as u64
    }

    /// The height of a pixel, metres; NaN where it has none, or there is no such pixel.
    #[must_use]
    pub fn at(&self, [column, row]: [u32; 2]) -> f32 {
        if column >= self.width || row >= self.height {
            return f32::NAN;
        }
        self.heights[row as usize * self.width as usize + column as usize]
    }

    /// The middle of a pixel, in the coordinates of the map.
    #[must_use]
    pub fn on_map(&self, pixel: [u32; 2]) -> [f64; 2] {
        self.map_from_pixel.apply(pixel.map(f64::from))
    }

    /// Local metres about its middle.
    ///
    /// # Errors
    /// When that lies outside of the reference system.
    pub fn origin(&self) -> Result<Origin, CityError> {
        let middle = [self.width, self.height].map(|n| 0.5 * f64::from(n - 1));
        Origin::new(self.crs.clone(), self.map_from_pixel.apply(middle))
    }

    /// Where the middles of its pixels lie, in local metres of an origin.
    #[must_use]
    pub fn extent(&self, origin: &Origin) -> Extent {
        let origin = origin.on_map(self.crs.clone());
        let whole = Extent {
            low: [0.0; 2],
            high: [self.width - 1, self.height - 1].map(f64::from),
        };
        let local = (whole.rim()).map(|pixel| origin.to_local(self.map_from_pixel.apply(pixel)));
        local.fold(Extent::NOWHERE, Extent::with)
    }

    /// The height of its surface at a place of the map, metres; `None` beside it and in its holes.
    #[must_use]
    pub fn height(&self, map: [f64; 2]) -> Option<f64> {
        self.height_at_pixel(self.pixel(map))
    }

    /// A place of the map counted in pixels, from the middle of the first one.
    pub(crate) fn pixel(&self, map: [f64; 2]) -> [f64; 2] {
        self.map_from_pixel.invert(map)
    }

    /// The same at a place counted in pixels.
    pub(crate) fn height_at_pixel(&self, [u, v]: [f64; 2]) -> Option<f64> {
        // On the rim of a cell, or a hair beyond it, both cells are asked: one of them may be a hole.
        const HAIR: f64 = 1e-6;
        let cells = |x: f64| {
            let [a, b] = [x - HAIR, x + HAIR].map(f64::floor);
            [Some(a), (a != b).then_some(b)].into_iter().flatten()
        };
        let last = [self.width, self.height].map(|n| f64::from(n) - 2.0);
        cells(v).find_map(|row| {
            cells(u).find_map(|column| {
                // NaN lies in none.
                if !(0.0..=last[0]).contains(&column) || !(0.0..=last[1]).contains(&row) {
                    return None;
                }
                let [left, top] = [column as u32, row as u32];
                let corner = |du: u32, dv: u32| self.at([left + du, top + dv]);
                let corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                triangles::height_in_cell(corners, [u - column, v - row])
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(size: [u32; 2], heights: &[f32]) -> Result<HeightField, CityError> {
        let crs = Crs::from_epsg(32633).unwrap();
        let north_up = [2.0, 0.0, 500_001.0, 0.0, -2.0, 5_800_009.0];
        HeightField::new(crs, size, north_up, heights.to_vec())
    }

    #[test]
    fn what_is_no_height_field_is_told() {
        let told = |size, heights: &[f32]| field(size, heights).unwrap_err().to_string();
        assert!(told([2, 2], &[1.0; 3]).contains("there are 3"));
        assert!(told([0, 0], &[]).contains("no pixel has a height"));
        assert!(told([2, 1], &[f32::NAN; 2]).contains("no pixel has a height"));
        assert!(told([2, 1], &[0.0, f32::INFINITY]).contains("infinite"));
        let flat = |map| {
            let crs = Crs::from_epsg(32633).unwrap();
            HeightField::new(crs, [1, 1], map, vec![0.0]).unwrap_err()
        };
        for map in [
            [0.0; 6],
            [1.0, 1.0, 0.0, 1.0, 1.0, 0.0],
            [1.0, 0.0, f64::NAN, 0.0, 1.0, 0.0],
        ] {
            assert!(flat(map).to_string().contains("size"));
        }
    }

    #[test]
    fn heights_are_those_of_the_middles_and_linear_between_them() {
        let field = field([3, 2], &[0.0, 10.0, 10.0, 0.0, 10.0, f32::NAN]).unwrap();
        assert_eq!((field.range(), field.blank()), ([0.0, 10.0], 1));
        let at = |x: f64, y: f64| field.height([500_000.0 + x, 5_800_000.0 + y]);
        assert_eq!(at(1.0, 9.0), Some(0.0));
        assert_eq!(at(2.0, 8.0), Some(5.0));
        assert_eq!(at(3.0, 7.0), Some(10.0));
        assert_eq!(at(3.2, 8.8), Some(10.0), "three corners are a triangle");
        assert_eq!(at(4.9, 7.2), None, "and the fourth is a hole");
        assert_eq!(at(0.9, 9.0), None);
        assert_eq!(at(f64::NAN, 9.0), None);
    }

    #[test]
    fn one_pixel_and_one_row_have_no_surface_between_them() {
        let one = field([1, 1], &[7.0]).unwrap();
        assert_eq!(one.height([500_001.0, 5_800_009.0]), None);
        let row = field([3, 1], &[7.0; 3]).unwrap();
        assert_eq!(row.height([500_002.0, 5_800_009.0]), None);
        assert!(row.origin().is_ok());
    }
}
