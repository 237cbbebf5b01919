//! Which pixels a convex polygon covers: edge functions with the top-left rule.

use std::ops::Range;

use super::predicate::edge_function;
use crate::Crop;

/// A triangle clipped at one plane has four corners at most.
const MOST_CORNERS: usize = 4;

/// A convex polygon in the picture, in pixels from its upper left corner.
///
/// A point is in it if it is on the right of all edges, walked in the order of the corners (clockwise
/// to the eye, as y runs down). A point exactly on an edge belongs to it if the edge is a left one or
/// a horizontal one at the top: the rule by which a point on an edge that two polygons share belongs
/// to one of them, and never to both (Pineda, "A Parallel Algorithm for Polygon Rasterization",
/// SIGGRAPH 1988, has the edge functions; the rule is that of Direct3D).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Outline {
    corners: [[f64; 2]; MOST_CORNERS],
    count: usize,
}

/// Pixels in columns and rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Cells {
    pub(super) columns: Range<u32>,
    pub(super) rows: Range<u32>,
}

impl Cells {
    /// Those whose samples may lie in a box, within an extent. A sample lies in the middle of its
    /// pixel or, if not `centred`, anywhere in it.
    pub(super) fn around(low: [f64; 2], high: [f64; 2], extent: &Crop, centred: bool) -> Self {
        Self {
            columns: pixels([low[0], high[0]], extent.x0..extent.x1, centred),
            rows: pixels([low[1], high[1]], extent.y0..extent.y1, centred),
        }
    }

    pub(super) fn count(&self) -> u64 {
        self.columns.len() as u64 * self.rows.len() as u64
    }
}

/// Along one axis, the pixels whose samples may lie between two numbers.
fn pixels([low, high]: [f64; 2], within: Range<u32>, centred: bool) -> Range<u32> {
    let (first, end) = if centred {
        ((low - 0.5).ceil(), (high - 0.5).floor() + 1.0)
    } else {
        // A sample may be rounded up to where the next pixel begins.
        (low.ceil() - 1.0, high.floor() + 1.0)
    };
    // Conversions of numbers that are out of range give the nearest one that is not.
    let first = (first as u32).clamp(within.start, within.end);
    first..(end as u32).clamp(first, within.end)
}

/// Of no more columns than these all are looked at: to find fewer would take longer.
const FEW: usize = 4;

/// What rounding may add to the place where an edge crosses a row, as a part of the coordinates of
/// its ends: two differences, a quotient, a product and a sum round by half of it each, and the
/// difference of the ends is at most twice the larger of them.
const CROSSING_ROUNDING: f64 = 8.0 * f64::EPSILON;

impl Outline {
    /// From corners in either order; `None` if they have no area or are too many.
    pub(super) fn new(corners: &[[f64; 2]]) -> Option<Self> {
        let count = corners.len();
        if count > MOST_CORNERS {
            return None;
        }
        let fan = (2..count).map(|i| edge_function(corners[0], corners[i - 1], corners[i]));
        let turn = fan.fold(0.0, |sum, turn| if sum == 0.0 { turn } else { sum });
        let mut own = [[0.0; 2]; MOST_CORNERS];
        own[..count].copy_from_slice(corners);
        if turn < 0.0 {
            own[..count].reverse();
        }
        (turn != 0.0 && !turn.is_nan()).then_some(Self {
            corners: own,
            count,
        })
    }

    /// Whether the polygon covers a point.
    #[inline]
    pub(super) fn covers(&self, p: [f64; 2]) -> bool {
        (0..self.count).all(|i| {
            let (a, b) = (self.corners[i], self.corners[(i + 1) % self.count]);
            let side = edge_function(a, b, p);
            side > 0.0 || side == 0.0 && is_top_or_left(a, b)
        })
    }

    /// Those of a row of its [`cells`](Self::cells) that it may cover: between the ends of what is
    /// left of its edges in the row. Of a long thin polygon that is little of its box.
    pub(super) fn columns(&self, row: u32, cells: &Cells, centred: bool) -> Range<u32> {
        if cells.columns.len() <= FEW {
            return cells.columns.clone();
        }
        let row = f64::from(row);
        let [top, bottom] = if centred {
            [row + 0.5; 2]
        } else {
            [row, row + 1.0]
        };
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 0..self.count {
            let (a, b) = (self.corners[i], self.corners[(i + 1) % self.count]);
            let (a, b) = if a[1] <= b[1] { (a, b) } else { (b, a) };
            if b[1] < top || a[1] > bottom {
                continue;
            }
            let [left, right] = [a[0].min(b[0]), a[0].max(b[0])];
            let slack = CROSSING_ROUNDING * left.abs().max(right.abs());
            let at = |y: f64| {
                let part = (y - a[1]) / (b[1] - a[1]);
                (a[0] + (b[0] - a[0]) * part).clamp(left, right)
            };
            let from = if a[1] < top { at(top) } else { a[0] };
            let to = if b[1] > bottom { at(bottom) } else { b[0] };
            low = low.min(from.min(to) - slack);
            high = high.max(from.max(to) + slack);
        }
        pixels([low, high], cells.columns.clone(), centred)
    }

    /// The box of pixels that it may cover.
    pub(super) fn cells(&self, extent: &Crop, centred: bool) -> Cells {
        let corners = &self.corners[..self.count];
        let end = |of: fn(f64, f64) -> f64, start: f64| {
            [0, 1].map(|i| corners.iter().map(|c| c[i]).fold(start, of))
        };
        let (low, high) = (
            end(f64::min, f64::INFINITY),
            end(f64::max, f64::NEG_INFINITY),
        );
        Cells::around(low, high, extent, centred)
    }
}

/// Whether the inside is on the right of an edge in the picture, or below it.
#[inline]
fn is_top_or_left(a: [f64; 2], b: [f64; 2]) -> bool {
    b[1] < a[1] || b[1] == a[1] && b[0] > a[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many of some polygons cover a point.
    fn covering(polygons: &[Outline], p: [f64; 2]) -> usize {
        polygons.iter().filter(|polygon| polygon.covers(p)).count()
    }

    fn triangle(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Outline {
        Outline::new(&[a, b, c]).unwrap()
    }

    #[test]
    fn the_two_halves_of_a_square_cover_each_of_its_pixels_once() {
        // The diagonal and two of the sides run through the middles of pixels.
        let [a, b, c, d] = [[0.5, 0.5], [4.5, 0.5], [4.5, 4.5], [0.5, 4.5]];
        for (first, second) in [
            (triangle(a, b, c), triangle(a, c, d)),
            (triangle(c, b, a), triangle(c, d, a)),
            (triangle(a, b, d), triangle(b, c, d)),
        ] {
            for y in 0..6 {
                for x in 0..6 {
                    let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                    // Top and left belong to it, bottom and right do not.
                    let inside = x < 4 && y < 4;
                    assert_eq!(covering(&[first, second], p), usize::from(inside), "{p:?}");
                }
            }
        }
    }

    #[test]
    fn around_a_fan_nothing_is_covered_twice_or_left_out() {
        // Spokes through the middles of pixels, and the hub in one, and numbers that round.
        for hub in [[8.5, 8.5], [8.5 + 1e-13, 8.5 - 3e-14], [8.1, 7.7]] {
            for spokes in [3, 4, 5, 8, 12, 31] {
                let rim = |i: u32| {
                    let angle = std::f64::consts::TAU * f64::from(i % spokes) / f64::from(spokes);
                    [8.5 + 50.0 * angle.cos(), 8.5 + 50.0 * angle.sin()]
                };
                let fan: Vec<_> = (0..spokes)
                    .map(|i| triangle(hub, rim(i), rim(i + 1)))
                    .collect();
                for y in 0..17 {
                    for x in 0..17 {
                        let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                        assert_eq!(covering(&fan, p), 1, "{p:?}, {spokes} spokes about {hub:?}");
                    }
                }
                assert_eq!(covering(&fan, hub), 1, "the hub itself");
            }
        }
    }

    #[test]
    fn what_has_no_area_covers_nothing() {
        let (a, b) = ([0.1, 0.2], [3.3, 1.7]);
        assert_eq!(Outline::new(&[a, b, a]), None);
        assert_eq!(Outline::new(&[a, a, a]), None);
        assert_eq!(Outline::new(&[a, b]), None);
        assert_eq!(Outline::new(&[a, b, [f64::NAN, 0.0]]), None);
    }

    #[test]
    fn rows_leave_out_nothing_that_is_covered() {
        let extent = Crop::all(40, 40);
        let thin = triangle([1.3, 2.1], [38.2, 37.9], [38.9, 37.2]);
        let along = triangle([-1e9, 3.5], [1e9, 3.5], [0.0, 1e12]);
        let steep = triangle([-3e20, -1e20], [20.5, 20.5], [20.6, 20.4]);
        let corner = triangle([5.5, 5.5], [30.5, 5.5], [30.5, 5.6]);
        let cut = Outline::new(&[[2.0, 0.0], [30.0, 0.0], [33.0, 39.0], [32.0, 39.0]]).unwrap();
        for outline in [thin, along, steep, corner, cut] {
            for centred in [true, false] {
                let cells = outline.cells(&extent, centred);
                let mut tests = 0;
                for y in 0..40 {
                    let found = outline.columns(y, &cells, centred);
                    let row = if cells.rows.contains(&y) { found } else { 0..0 };
                    tests += row.len() as u64;
                    for x in 0..40 {
                        let at = |dx, dy| [f64::from(x) + dx, f64::from(y) + dy];
                        // The corner of the next pixel counts: a sample may be rounded to it.
                        let samples = [at(0.0, 0.0), at(0.9, 0.1), at(0.2, 0.7), at(1.0, 1.0)];
                        let samples = if centred {
                            &[at(0.5, 0.5)]
                        } else {
                            &samples[..]
                        };
                        let covered = samples.iter().any(|p| outline.covers(*p));
                        assert!(row.contains(&x) || !covered, "{x}, {y} of {outline:?}");
                    }
                }
                assert!(tests <= cells.count());
                if outline == thin {
                    assert!(tests < cells.count() / 8, "{tests} of {}", cells.count());
                }
            }
        }
    }

    #[test]
    fn only_pixels_that_can_be_covered_are_looked_at() {
        let extent = Crop::all(10, 10);
        let small = triangle([2.6, 3.1], [3.4, 3.2], [3.0, 3.4]);
        assert_eq!(
            small.cells(&extent, true).count(),
            0,
            "it lies between the middles"
        );
        let cells = small.cells(&extent, false);
        assert_eq!((cells.columns, cells.rows), (2..4, 3..4));
        let huge = triangle([-1e30, -1e30], [1e30, -1e30], [0.0, 1e30]);
        assert_eq!(huge.cells(&extent, true).count(), 100);
        let beside = triangle([11.0, 1.0], [15.0, 1.0], [13.0, 9.0]);
        assert_eq!(beside.cells(&extent, false).count(), 0);
        let before = triangle([-11.0, 1.0], [-15.0, 1.0], [-13.0, 9.0]);
        assert_eq!(before.cells(&extent, false).count(), 0);
    }
}
