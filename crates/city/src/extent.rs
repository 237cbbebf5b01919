//! Rectangles of local metres.

/// A rectangle of local metres, its sides along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Its south-west corner: metres east and north of the origin.
    pub low: [f64; 2],
    /// Its north-east corner.
    pub high: [f64; 2],
}

impl Extent {
    /// Without an end.
    pub const EVERYWHERE: Self = Self {
        low: [f64::NEG_INFINITY; 2],
        high: [f64::INFINITY; 2],
    };

    /// Nothing, to be grown by [`with`](Self::with).
    pub const NOWHERE: Self = Self {
        low: [f64::INFINITY; 2],
        high: [f64::NEG_INFINITY; 2],
    };

    /// With a place in it. A place that is NaN changes nothing.
    #[must_use]
    pub fn with(self, place: [f64; 2]) -> Self {
        Self {
            low: [0, 1].map(|k| self.low[k].min(place[k])),
            high: [0, 1].map(|k| self.high[k].max(place[k])),
        }
    }

    /// With `metres` more on every side.
    #[must_use]
    pub fn widened(self, metres: f64) -> Self {
        Self {
            low: self.low.map(|x| x - metres),
            high: self.high.map(|x| x + metres),
        }
    }

    /// What lies in both.
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        Self {
            low: [0, 1].map(|k| self.low[k].max(other.low[k])),
            high: [0, 1].map(|k| self.high[k].min(other.high[k])),
        }
    }

    /// Its corners and so many places on each side that what bends it is seen.
    pub(crate) fn rim(self) -> impl Iterator<Item = [f64; 2]> {
        const PARTS: u32 = 16;
        let between = move |axis: usize, k: u32| {
            let t = f64::from(k) / f64::from(PARTS);
            self.low[axis] * (1.0 - t) + self.high[axis] * t
        };
        (0..=PARTS).flat_map(move |k| {
            let [x, y] = [between(0, k), between(1, k)];
            let (low, high) = (self.low, self.high);
            [[x, low[1]], [x, high[1]], [low[0], y], [high[0], y]]
        })
    }
}
