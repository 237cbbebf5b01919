//! The area that is studied: polygons on the ground.

use crate::crs::Crs;
use crate::origin::Origin;
use crate::polygon::edges;

/// Sides longer than this, in metres, are cut: a straight side on the map is a little bent on the ground, by 5 mm
/// in so much.
const STRAIGHT: f64 = 500.0;

/// Into so many pieces at most.
const MOST_PIECES: f64 = 1000.0;

/// Sides with all their pieces, at most: 700 MB. No area has so many, but a hostile ring of far corners would.
const MOST_SIDES: usize = 1 << 24;

/// Strips of an area may list so many sides each, on average.
const MOST_PER_SIDE: usize = 8;

/// Polygons in local metres that bound what is studied. A place is in the area if it is in any of them; of
/// two that share a side, one has the places on it.
///
/// Rings may cross themselves: what they go around an odd number of times is in.
#[derive(Clone, Debug)]
pub struct StudyArea {
    /// Sides in the order of their polygons.
    sides: Vec<Side>,
    bounds: [[f64; 2]; 2],
    /// The area is cut into strips from south to north, and so are its sides listed: where each strip's begin in
    /// `listed`; one more than there are strips.
    starts: Vec<u32>,
    listed: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Side {
    low: [f64; 2],
    high: [f64; 2],
    polygon: u32,
}

/// Why polygons are no area.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// Coordinates that do not belong to the reference system, or far from the city.
    #[error("polygon {polygon}: {x}, {y} is no place of {crs} near the city")]
    Outside {
        /// Which polygon, from 0.
        polygon: usize,
        /// First coordinate.
        x: f64,
        /// Second coordinate.
        y: f64,
        /// The system's name.
        crs: String,
    },
    /// Nothing is enclosed.
    #[error("encloses nothing: a ring needs three corners that do not lie on one line")]
    Empty,
    /// More sides than memory is spent on.
    #[error(
        "more than {MOST_SIDES} sides, those longer than {STRAIGHT} m counted for each {STRAIGHT} m"
    )]
    Large,
}

impl StudyArea {
    /// Of polygons in a reference system: rings, the outer one first, whether or not they repeat their
    /// first corner.
    ///
    /// # Errors
    /// When a corner is nowhere, or no polygon encloses anything.
    pub fn new(
        origin: &Origin,
        crs: &Crs,
        polygons: &[Vec<Vec<[f64; 2]>>],
    ) -> Result<Self, StudyError> {
        let (mut sides, mut count) = (Vec::new(), 0_usize);
        let origin = origin.on_map(crs.clone());
        for (index, rings) in polygons.iter().enumerate() {
            let local = |[x, y]: [f64; 2]| {
                let local = origin.to_local([x, y]);
                let outside = || StudyError::Outside {
                    polygon: index,
                    x,
                    y,
                    crs: crs.name().to_owned(),
                };
                local
                    .iter()
                    .all(|x| x.is_finite())
                    .then_some(local)
                    .ok_or_else(outside)
            };
            // Counted before any is made.
            for (a, b) in rings.iter().flat_map(|ring| edges(ring.iter().copied())) {
                count += pieces(local(a)?, local(b)?) as usize;
                if count > MOST_SIDES {
                    return Err(StudyError::Large);
                }
            }
            for ring in rings {
                for (a, b) in edges(ring.iter().copied()).filter(|(a, b)| a != b) {
                    let mut from = local(a)?;
                    let to = local(b)?;
                    let pieces = pieces(from, to);
                    for piece in 1..=pieces as u32 {
                        let u = f64::from(piece) / pieces;
                        let next = local([0, 1].map(|k| a[k] + u * (b[k] - a[k])))?;
                        sides.push(Side::between(from, next, index as u32));
                        from = next;
                    }
                }
            }
        }
        // What lies level is never crossed by a ray to the east.
        sides.retain(|side| side.low[1] < side.high[1]);
        Self::of(sides)
    }

    fn of(sides: Vec<Side>) -> Result<Self, StudyError> {
        let nothing = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        let bounds = sides.iter().fold(nothing, |[low, high], side| {
            let x = [side.low[0], side.high[0]];
            [
                [low[0].min(x[0].min(x[1])), low[1].min(side.low[1])],
                [high[0].max(x[0].max(x[1])), high[1].max(side.high[1])],
            ]
        });
        if !(bounds[0][0] < bounds[1][0] && bounds[0][1] < bounds[1][1]) {
            return Err(StudyError::Empty);
        }
        let mut area = Self {
            sides,
            bounds,
            starts: Vec::new(),
            listed: Vec::new(),
        };
        // Fewer strips where long sides would be listed too often.
        let mut strips = area.sides.len();
        while strips > 1 && area.listings(strips) > MOST_PER_SIDE * area.sides.len() {
            strips /= 2;
        }
        area.list(strips);
        Ok(area)
    }

    fn strip(&self, y: f64, strips: usize) -> usize {
        let [[_, south], [_, north]] = self.bounds;
        let at = (y - south) / (north - south) * strips as f64;
        (at as usize).min(strips - 1)
    }

    fn strips_of(&self, side: &Side, strips: usize) -> std::ops::RangeInclusive<usize> {
        self.strip(side.low[1], strips)..=self.strip(side.high[1], strips)
    }

    fn listings(&self, strips: usize) -> usize {
        let of = |side| self.strips_of(side, strips).count();
        self.sides.iter().map(of).sum()
    }

    /// Counted first, then put in place, so that each strip's sides keep their order.
    fn list(&mut self, strips: usize) {
        let mut starts = vec![0_u32; strips + 1];
        for side in &self.sides {
            for strip in self.strips_of(side, strips) {
                starts[strip + 1] += 1;
            }
        }
        for strip in 1..=strips {
            starts[strip] += starts[strip - 1];
        }
        let mut next = starts.clone();
        let mut listed = vec![0; starts[strips] as usize];
        for (index, side) in self.sides.iter().enumerate() {
            for strip in self.strips_of(side, strips) {
                listed[next[strip] as usize] = index as u32;
                next[strip] += 1;
            }
        }
        self.starts = starts;
        self.listed = listed;
    }

    /// The least box around it: its lowest and its highest corner, local metres.
    #[must_use]
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        self.bounds
    }

    /// Whether a place (local metres) lies in the area.
    #[must_use]
    pub fn contains(&self, place: [f64; 2]) -> bool {
        let [low, high] = self.bounds;
        if !(0..2).all(|k| low[k] <= place[k] && place[k] <= high[k]) {
            return false;
        }
        let strip = self.strip(place[1], self.starts.len() - 1);
        let listed = self.starts[strip] as usize..self.starts[strip + 1] as usize;
        let (mut polygon, mut is_in) = (0, false);
        for &side in &self.listed[listed] {
            let side = &self.sides[side as usize];
            if side.polygon != polygon {
                if is_in {
                    return true;
                }
                polygon = side.polygon;
            }
            is_in ^= side.is_east_of(place);
        }
        is_in
    }
}

/// Into how many pieces a side is cut: at least one.
fn pieces(from: [f64; 2], to: [f64; 2]) -> f64 {
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    (length / STRAIGHT).ceil().clamp(1.0, MOST_PIECES)
}

impl Side {
    fn between(a: [f64; 2], b: [f64; 2], polygon: u32) -> Self {
        let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) };
        Self { low, high, polygon }
    }

    /// Whether a ray to the east meets it. Half open, so that corners count once.
    fn is_east_of(&self, [x, y]: [f64; 2]) -> bool {
        let Self { low, high, .. } = self;
        if (low[1] > y) == (high[1] > y) {
            return false;
        }
        x < low[0] + (y - low[1]) / (high[1] - low[1]) * (high[0] - low[0])
    }
}

#[cfg(test)]
mod tests;
