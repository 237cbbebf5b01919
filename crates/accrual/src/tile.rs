//! Sixteen places that lie near one another.

use ombra_geometry::{Aabb, Point3};

/// How many places a tile has.
pub(crate) const PLACES: usize = 16;

/// Places that are looked at together, and the box around them.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Tile {
    /// By axis the coordinates, in local metres.
    pub(crate) at: [[f32; PLACES]; 3],
    pub(crate) bounds: Aabb,
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
        let all: [[f32; 3]; PLACES] = std::array::from_fn(place);
        Self {
            at: [0, 1, 2].map(|axis| all.map(|place| place[axis])),
            bounds: Aabb::around(all.map(Point3::from)),
            count: places.len(),
        }
    }

    /// The box around all of some tiles.
    pub(crate) fn around(tiles: &[Self]) -> Aabb {
        let bounds = tiles.iter().map(|tile| tile.bounds);
        bounds.fold(Aabb::EMPTY, Aabb::union)
    }

    /// The longest side of that box.
    pub(crate) fn length(tiles: &[Self]) -> f32 {
        let sides = Self::around(tiles).extent().to_array();
        sides.into_iter().fold(0.0, f32::max)
    }
}

/// Whether a place has coordinates.
pub(crate) fn is_somewhere(place: &Point3) -> bool {
    place.to_array().iter().all(|x| x.is_finite())
}
