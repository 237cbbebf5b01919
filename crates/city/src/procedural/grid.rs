//! From the metres of the street grid to local metres.

use super::lots::{Lot, Rectangle};
use crate::building::{Part, Prism};
use crate::polygon::Polygon;

/// Cosine and sine of 29°, by which avenues are turned from north toward east. Written out, since the
/// functions differ in the last digit from machine to machine.
const TURN: [f64; 2] = [0.874_619_707_139_395_8, 0.484_809_620_246_337];

/// A turned street grid about the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    middle: [f64; 2],
}

impl Grid {
    pub(super) const fn new(middle: [f64; 2]) -> Self {
        Self { middle }
    }

    /// With the middle of all lots in the origin.
    pub(super) fn around(lots: &[Lot]) -> Self {
        let all = lots.iter().map(|lot| lot.whole);
        let whole = all.reduce(|a, b| Rectangle {
            low: [0, 1].map(|k| a.low[k].min(b.low[k])),
            high: [0, 1].map(|k| a.high[k].max(b.high[k])),
        });
        Self::new(whole.map_or([0.0; 2], |whole| whole.middle()))
    }

    /// Metres east and north of a place in the grid.
    pub(super) fn local(&self, place: [f64; 2]) -> [f32; 2] {
        let [x, y] = [0, 1].map(|k| place[k] - self.middle[k]);
        let [cos, sin] = TURN;
        [(x * cos + y * sin) as f32, (y * cos - x * sin) as f32]
    }

    /// A prism from the ground up, over an outline that runs counter-clockwise.
    pub(super) fn prism(&self, outline: &[[f64; 2]], top: f64) -> Part {
        Part::Prism(Prism {
            outline: Polygon {
                outer: outline.iter().map(|&place| self.local(place)).collect(),
                holes: Vec::new(),
            },
            base: 0.0,
            top: top as f32,
        })
    }
}
