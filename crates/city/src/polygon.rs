//! Outlines on the ground, with holes.

/// A polygon on the ground in local metres.
///
/// The outer ring runs counter-clockwise as seen from above, holes clockwise. No ring repeats its
/// first corner, has fewer than three, or crosses itself or another; rings may touch in points.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// Around all of it.
    pub outer: Vec<[f32; 2]>,
    /// Around what is not part of it: courtyards.
    pub holes: Vec<Vec<[f32; 2]>>,
}

impl Polygon {
    /// All rings, the outer one first.
    pub fn rings(&self) -> impl Iterator<Item = &[[f32; 2]]> {
        std::iter::once(&self.outer[..]).chain(self.holes.iter().map(Vec::as_slice))
    }

    /// The least box around it: its lowest and its highest corner.
    #[must_use]
    pub fn bounds(&self) -> [[f32; 2]; 2] {
        bounds(self.outer.iter().copied())
    }

    /// Its area in square metres, holes taken off.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.rings()
            .map(|ring| signed_area(ring.iter().map(|p| p.map(f64::from))))
            .sum()
    }

    /// Whether a place lies in it. Of two polygons that share an edge, one has the places on it.
    #[must_use]
    pub fn contains(&self, place: [f32; 2]) -> bool {
        let place = place.map(f64::from);
        self.rings().fold(false, |inside, ring| {
            inside ^ is_inside(ring.iter().map(|p| p.map(f64::from)), place)
        })
    }
}

/// The edges of a ring, the last one back to its start.
pub(crate) fn edges<P: Copy>(
    ring: impl Iterator<Item = P> + Clone,
) -> impl Iterator<Item = (P, P)> + Clone {
    let next = ring.clone().skip(1).chain(ring.clone().take(1));
    ring.zip(next)
}

/// Even-odd test: whether a ray from the place to the east meets the ring an odd number of times.
/// Edges are half open, so that corners count once.
pub(crate) fn is_inside(ring: impl Iterator<Item = [f64; 2]> + Clone, place: [f64; 2]) -> bool {
    let [x, y] = place;
    edges(ring).fold(false, |inside, (a, b)| {
        if (a[1] > y) == (b[1] > y) {
            return inside;
        }
        // From the lower end, so that a shared edge gives the same number to both its polygons.
        let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) };
        let at = low[0] + (y - low[1]) / (high[1] - low[1]) * (high[0] - low[0]);
        inside ^ (x < at)
    })
}

/// Twice the area is the sum of the edges' cross products (Meister 1769); reckoned about the first
/// corner, so that it keeps its digits far from the origin. Positive when counter-clockwise.
pub(crate) fn signed_area(mut ring: impl Iterator<Item = [f64; 2]>) -> f64 {
    let Some([x0, y0]) = ring.next() else {
        return 0.0;
    };
    let mut last = [0.0, 0.0];
    let mut twice = 0.0;
    for [x, y] in ring {
        let p = [x - x0, y - y0];
        twice += last[0] * p[1] - last[1] * p[0];
        last = p;
    }
    twice / 2.0
}

pub(crate) fn bounds(places: impl Iterator<Item = [f32; 2]>) -> [[f32; 2]; 2] {
    let nothing = [[f32::INFINITY; 2], [f32::NEG_INFINITY; 2]];
    places.fold(nothing, |[low, high], p| {
        [
            [low[0].min(p[0]), low[1].min(p[1])],
            [high[0].max(p[0]), high[1].max(p[1])],
        ]
    })
}
