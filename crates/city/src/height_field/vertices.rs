//! The middles of pixels in local metres.

use ombra_geometry::Point3;

use super::lattice::Lattice;
use super::{HeightField, MOST_PIXELS};
use crate::draft::FARTHEST;
use crate::error::CityError;
use crate::extent::Extent;
use crate::origin::Origin;

/// Between nodes of a lattice lie so many metres at most.
const LATTICE: f64 = 50.0;

/// The middles of a rectangle of pixels in local metres.
pub(crate) struct Vertices {
    /// The first of them: column and row.
    pub(crate) first: [u32; 2],
    /// Columns and rows.
    pub(crate) size: [u32; 2],
    /// Row by row. Not finite where there is no height, or the pixel is too far off.
    pub(crate) points: Vec<Point3>,
}

impl Vertices {
    /// Of the pixels that lie in an extent and some around it.
    pub(crate) fn new(
        field: &HeightField,
        origin: &Origin,
        extent: Extent,
    ) -> Result<Self, CityError> {
        let origin = origin.on_map(field.crs.clone());
        let (first, size) = pixels(field, &origin, extent);
        let count = u64::from(size[0]) * u64::from(size[1]);
        if count > MOST_PIXELS {
            return Err(CityError::ManyPixels {
                width: size[0],
                height: size[1],
            });
        }
        let lattice = Lattice::new(size, step(field, &origin, first), |pixel| {
            let pixel = [0, 1].map(|k| pixel[k] + f64::from(first[k]));
            origin.to_local(field.map_from_pixel.apply(pixel))
        });
        let mut points = Vec::with_capacity(count as usize);
        for row in 0..size[1] {
            for column in 0..size[0] {
                let [x, y] = lattice.at([column, row]);
                let z = field.at([first[0] + column, first[1] + row]);
                let is_near = x.abs().max(y.abs()) <= FARTHEST;
                let z = if is_near { z } else { f32::NAN };
                points.push(Point3::new(x as f32, y as f32, z));
            }
        }
        Ok(Self {
            first,
            size,
            points,
        })
    }

    /// For each of them the height of another field there, metres; NaN where it has none.
    pub(crate) fn heights_of(
        &self,
        other: &HeightField,
        field: &HeightField,
        origin: &Origin,
    ) -> Vec<f32> {
        let (from, to) = (
            origin.on_map(field.crs.clone()),
            origin.on_map(other.crs.clone()),
        );
        let on_map = |pixel: [f64; 2]| {
            let pixel = [0, 1].map(|k| pixel[k] + f64::from(self.first[k]));
            let map = field.map_from_pixel.apply(pixel);
            let map = if field.crs == other.crs {
                map
            } else {
                to.to_map(from.to_local(map))
            };
            other.map_from_pixel.invert(map)
        };
        let lattice = Lattice::new(self.size, step(field, &from, self.first), on_map);
        let [width, height] = self.size;
        (0..height)
            .flat_map(|row| (0..width).map(move |column| [column, row]))
            .map(|pixel| {
                let found = other.height_at_pixel(lattice.at(pixel));
                found.map_or(f32::NAN, |z| z as f32)
            })
            .collect()
    }
}

/// Pixels between the nodes of a lattice.
fn step(field: &HeightField, origin: &Origin, first: [u32; 2]) -> u32 {
    let at = |du: f64, dv: f64| {
        let pixel = [f64::from(first[0]) + du, f64::from(first[1]) + dv];
        origin.to_local(field.map_from_pixel.apply(pixel))
    };
    let [a, b, c] = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)];
    let length = |b: [f64; 2]| (b[0] - a[0]).hypot(b[1] - a[1]);
    // NaN, too, makes it 1.
    (LATTICE / length(b).max(length(c))).clamp(1.0, 64.0) as u32
}

/// The first pixel and how many there are that an extent of local metres may need.
fn pixels(field: &HeightField, origin: &Origin, extent: Extent) -> ([u32; 2], [u32; 2]) {
    let all = ([0; 2], field.size());
    let farthest = Extent {
        low: [-FARTHEST; 2],
        high: [FARTHEST; 2],
    };
    let own = field.extent(origin);
    let within = extent.intersection(farthest).intersection(own);
    if within == own {
        return all;
    }
    if (0..2).any(|k| within.low[k] > within.high[k]) {
        return ([0; 2], [0; 2]);
    }
    let mut rim = within.rim();
    let pixels = rim.try_fold(Extent::NOWHERE, |around, place| {
        let pixel = field.map_from_pixel.invert(origin.to_map(place));
        let is_somewhere = pixel.iter().all(|x| x.is_finite());
        is_somewhere.then(|| around.with(pixel))
    });
    let Some(pixels) = pixels else {
        return all;
    };
    // What bends between the places of the rim, and a pixel for the triangles that reach in.
    let bent = 2.0 + 1e-3 * (pixels.high[0] - pixels.low[0]).max(pixels.high[1] - pixels.low[1]);
    let pixels = pixels.widened(bent);
    let size = field.size();
    let first = [0, 1].map(|k| pixels.low[k].floor().clamp(0.0, f64::from(size[k])) as u32);
    let end = [0, 1].map(|k| (pixels.high[k].ceil() + 1.0).clamp(0.0, f64::from(size[k])) as u32);
    (first, [0, 1].map(|k| end[k].saturating_sub(first[k])))
}
