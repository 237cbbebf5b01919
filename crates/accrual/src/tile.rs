//! Sixteen places that lie near one another.

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
}

impl Tile {
    /// Of up to sixteen places; where there are fewer, the last one is there several times.
    pub(crate) fn new(places: &[[f32; 3]]) -> Self {
        let place = |k: usize| places[k.min(places.len() - 1)];
        let at = [0, 1, 2].map(|axis| std::array::from_fn(|k| place(k)[axis]));
        let least = at.map(|of: [f32; PLACES]| of.into_iter().fold(f32::INFINITY, f32::min));
        let most = at.map(|of| of.into_iter().fold(f32::NEG_INFINITY, f32::max));
        Self { at, least, most }
    }
}
