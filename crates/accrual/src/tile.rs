//! Sixteen places that lie near one another.

use ombra_geometry::Point3;

/// How many places a tile has.
pub(crate) const PLACES: usize = 16;

/// Places that are looked at together, and the box around them.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Tile {
    /// By axis the coordinates, in local metres.
    pub(crate) at: [[f32; PLACES]; 3],
    pub(crate) least: [f32; 3],
    pub(crate) most: [f32; 3],
    /// How many places there are.
    pub(crate) count: usize,
}

impl Tile {
    /// Of up to sixteen places; where there are fewer, or one is nowhere, another one is there several times.
    pub(crate) fn new(places: &[Point3]) -> Self {
        let known = places.iter().rev().find(|place| is_somewhere(place));
        let known = known.map_or([0.0; 3], |place| place.to_array());
        let place = |k: usize| match places.get(k) {
            Some(place) if is_somewhere(place) => place.to_array(),
            _ => known,
        };
        let at: [[f32; 3]; PLACES] = std::array::from_fn(place);
        let at = [0, 1, 2].map(|axis| at.map(|place| place[axis]));
        let least = at.map(|of: [f32; PLACES]| of.into_iter().fold(f32::INFINITY, f32::min));
        let most = at.map(|of| of.into_iter().fold(f32::NEG_INFINITY, f32::max));
        Self {
            at,
            least,
            most,
            count: places.len(),
        }
    }

    /// The box around all of some tiles.
    pub(crate) fn around(tiles: &[Self]) -> [[f32; 3]; 2] {
        let nothing = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
        tiles.iter().fold(nothing, |[least, most], tile| {
            [
                [0, 1, 2].map(|k| least[k].min(tile.least[k])),
                [0, 1, 2].map(|k| most[k].max(tile.most[k])),
            ]
        })
    }

    /// The longest side of that box.
    pub(crate) fn length(tiles: &[Self]) -> f32 {
        let [least, most] = Self::around(tiles);
        (0..3).map(|k| most[k] - least[k]).fold(0.0, f32::max)
    }
}

/// Whether a place has coordinates.
pub(crate) fn is_somewhere(place: &Point3) -> bool {
    place.to_array().iter().all(|x| x.is_finite())
}
