//! Courtyards put into their outlines.

/// A ring of corners, which repeats the first.
type Ring = Vec<[f64; 2]>;

/// A relation is worth so many looks at sides and boxes, and [`LOOKS_EACH`] more for each of its corners. Real ones
/// need far fewer; where boxes of very many outlines lie over one another, no grid helps.
const LOOKS: usize = 100_000_000;
const LOOKS_EACH: usize = 1000;

/// Cells may list so many outlines each, on average.
const MOST_LISTED: usize = 8;

/// Outlines with their courtyards: each a list of rings, the outer one first. Returns how many courtyards lie in
/// none of the outlines.
pub(super) fn polygons(outer: Vec<Ring>, inner: Vec<Ring>) -> (Vec<Vec<Ring>>, usize) {
    let corners: usize = outer.iter().chain(&inner).map(Vec::len).sum();
    let grid = Cells::new(&outer);
    let mut looks = LOOKS + LOOKS_EACH * corners;
    let mut polygons: Vec<_> = outer.into_iter().map(|ring| vec![ring]).collect();
    let mut stray = 0;
    for ring in inner {
        let owner = grid.near(&ring, &mut looks).into_iter().find(|&index| {
            let outline = &polygons[index as usize][0];
            is_around(outline, &grid.boxes[index as usize], &ring, &mut looks)
        });
        match owner {
            Some(owner) => polygons[owner as usize].push(ring),
            None => stray += 1,
        }
    }
    (polygons, stray)
}

/// Whether an outline goes around a ring; no, when there are no looks left.
fn is_around(outline: &Ring, bounds: &Bounds, ring: &Ring, looks: &mut usize) -> bool {
    // Rings may touch, so that one corner alone decides nothing.
    let mut asked = [0, 0];
    for &p in ring {
        let is_near = bounds.contains(p);
        let cost = if is_near { 1 + outline.len() } else { 1 };
        let Some(left) = looks.checked_sub(cost) else {
            return false;
        };
        *looks = left;
        if is_near {
            asked[0] += usize::from(is_inside(outline, p));
            asked[1] += 1;
        }
        if asked[1] == 8 {
            break;
        }
    }
    asked[1] > 0 && 2 * asked[0] >= asked[1]
}

/// Whether a ray to the east meets the ring an odd number of times.
fn is_inside(ring: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    ring.windows(2).fold(false, |inside, edge| {
        let [a, b] = [edge[0], edge[1]];
        if (a[1] > y) == (b[1] > y) {
            return inside;
        }
        let at = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        inside ^ (x < at)
    })
}

#[derive(Clone, Copy)]
struct Bounds {
    low: [f64; 2],
    high: [f64; 2],
}

impl Bounds {
    fn of<'a>(corners: impl IntoIterator<Item = &'a [f64; 2]>) -> Self {
        let nothing = Self {
            low: [f64::INFINITY; 2],
            high: [f64::NEG_INFINITY; 2],
        };
        corners.into_iter().fold(nothing, |all, p| Self {
            low: [0, 1].map(|k| all.low[k].min(p[k])),
            high: [0, 1].map(|k| all.high[k].max(p[k])),
        })
    }

    fn contains(&self, p: [f64; 2]) -> bool {
        (0..2).all(|k| self.low[k] <= p[k] && p[k] <= self.high[k])
    }
}

/// A grid of square-ish cells, about as many as there are outlines, each with a list of those whose boxes it meets.
struct Cells {
    boxes: Vec<Bounds>,
    all: Bounds,
    /// Columns, and as many rows.
    side: usize,
    listed: Vec<Vec<u32>>,
}

impl Cells {
    fn new(outer: &[Ring]) -> Self {
        let boxes: Vec<Bounds> = outer.iter().map(Bounds::of).collect();
        let mut cells = Self {
            all: Bounds::of(outer.iter().flatten()),
            side: (outer.len() as f64).sqrt().ceil().max(1.0) as usize,
            boxes,
            listed: Vec::new(),
        };
        // Fewer cells where large boxes would be listed too often.
        while cells.side > 1 && cells.listings() > MOST_LISTED * cells.boxes.len() {
            cells.side /= 2;
        }
        cells.listed = vec![Vec::new(); cells.side * cells.side];
        for (index, bounds) in cells.boxes.iter().enumerate() {
            let [low, high] = [bounds.low, bounds.high].map(|p| cells.cell(p));
            for row in low[1]..=high[1] {
                for column in low[0]..=high[0] {
                    cells.listed[row * cells.side + column].push(index as u32);
                }
            }
        }
        cells
    }

    fn listings(&self) -> usize {
        let of = |bounds: &Bounds| {
            let [low, high] = [bounds.low, bounds.high].map(|p| self.cell(p));
            (high[0] + 1).saturating_sub(low[0]) * (high[1] + 1).saturating_sub(low[1])
        };
        self.boxes.iter().map(of).sum()
    }

    /// Column and row; at the rim for places beside it.
    fn cell(&self, p: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|k| {
            let size = self.all.high[k] - self.all.low[k];
            let at = (p[k] - self.all.low[k]) / size * self.side as f64;
            // What is no number, as in a grid without a width, is the first.
            (at as usize).min(self.side - 1)
        })
    }

    /// The outlines whose boxes may hold a corner of a ring, in their order; none, when there are no looks left.
    fn near(&self, ring: &Ring, looks: &mut usize) -> Vec<u32> {
        let cells = ring.iter().map(|&p| self.cell(p));
        let mut cells: Vec<usize> = cells.map(|[x, y]| y * self.side + x).collect();
        cells.sort_unstable();
        cells.dedup();
        let listed = |&cell: &usize| &self.listed[cell];
        let cost = cells.iter().map(|cell| listed(cell).len()).sum();
        let Some(left) = looks.checked_sub(cost) else {
            return Vec::new();
        };
        *looks = left;
        let mut found: Vec<u32> = cells.iter().flat_map(listed).copied().collect();
        found.sort_unstable();
        found.dedup();
        found
    }
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use super::*;

    fn square([x, y]: [f64; 2], size: f64) -> Ring {
        let [east, north] = [x + size, y + size];
        vec![[x, y], [east, y], [east, north], [x, north], [x, y]]
    }

    #[test]
    fn courtyards_are_of_the_outline_around_them() {
        let outer = vec![square([0.0, 0.0], 4.0), square([10.0, 10.0], 4.0)];
        let inner = vec![square([11.0, 11.0], 1.0), square([20.0, 20.0], 1.0)];
        let (found, stray) = polygons(outer, inner);
        assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [1, 2]);
        assert_eq!(stray, 1);
        assert_eq!(polygons(Vec::new(), vec![square([0.0; 2], 1.0)]).1, 1);
    }

    #[test]
    fn a_courtyard_that_touches_its_outline_and_one_in_two_outlines_find_the_first() {
        let outer = vec![
            square([50.0, 50.0], 2.0),
            square([0.0, 0.0], 9.0),
            square([1.0, 1.0], 7.0),
        ];
        let inner = vec![square([8.0, 0.0], 1.0), square([2.0, 2.0], 1.0)];
        let (found, stray) = polygons(outer, inner);
        let counts: Vec<usize> = found.iter().map(Vec::len).collect();
        assert_eq!((counts, stray), (vec![1, 3, 1], 0));
    }

    #[test]
    fn very_many_rings_take_no_hours() {
        let begun = Instant::now();
        let at = |k: u32| [f64::from(k % 400) * 3.0, f64::from(k / 400) * 3.0];
        let outer: Vec<Ring> = (0..160_000).map(|k| square(at(k), 2.0)).collect();
        let inner = (0..160_000).map(|k| square(at(k).map(|x| x + 0.5), 1.0));
        let (found, stray) = polygons(outer, inner.collect());
        assert!(stray == 0 && found.iter().all(|rings| rings.len() == 2));
        // Boxes that all lie over one another, around nothing that lies in them.
        let thin = |k: u32| {
            let a = f64::from(k) * 1e-7;
            vec![[a, 0.0], [1.0, 1.0 - a], [a, 1e-9], [a, 0.0]]
        };
        let outer: Vec<Ring> = (0..100_000).map(thin).collect();
        let inner = vec![square([0.8, 0.2], 0.01); 100_000];
        assert_eq!(polygons(outer, inner).1, 100_000);
        assert!(begun.elapsed() < Duration::from_secs(60));
    }
}
