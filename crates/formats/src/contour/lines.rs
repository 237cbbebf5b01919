//! From numbers to lines.

use std::collections::{HashMap, HashSet};

use arrayvec::ArrayVec;
use ombra_city::Grid;

/// A line along which the numbers of a grid have one value.
#[derive(Clone, Debug, PartialEq)]
pub struct ContourLine {
    /// That value.
    pub level: f32,
    /// Metres east and north of the origin, two at least. Higher numbers lie to the left of the way, so a ring around
    /// a hill goes counterclockwise.
    pub points: Vec<[f64; 2]>,
    /// Whether it is a ring: its first point is its last one, too, and stands in the list twice.
    pub is_closed: bool,
}

/// The lines of some levels through a grid of numbers, one a cell, row by row from the **north**: level after level, each in the order in
/// which its lines are met from the north-west.
///
/// A number counts for the middle of its cell. Between four neighbours the surface is bilinear, which settles which corners go together where two
/// opposite ones are high (the asymptotic decider: Nielson, Hamann, "The asymptotic decider", 1991). What equals the level lies on its
/// high side: a level that is the least number of all has no line, nor has one beyond the range, or NaN.
///
/// NaN says that a cell has no number. **A line ends there**: where three of four neighbours have a number, on the straight line between
/// the two that are opposite, else on the side of the square. So it ends as well at the edge of the grid, half a cell inside of it.
///
/// # Panics
/// If there is not one number a cell.
#[must_use]
pub fn contour_lines(grid: &Grid, values: &[f32], levels: &[f32]) -> Vec<ContourLine> {
    assert_eq!(values.len(), grid.count(), "one number a cell");
    let field = Field { grid, values };
    levels
        .iter()
        .flat_map(|&level| field.lines(level))
        .collect()
}

/// The numbers, and where they are.
struct Field<'a> {
    grid: &'a Grid,
    values: &'a [f32],
}

/// Two cells, of which the line of a level passes between the middles: the one that comes first in the grid, and the other.
type Edge = [usize; 2];

/// A part of a line within one square, from edge to edge.
type Part = [Edge; 2];

impl Field<'_> {
    fn lines(&self, level: f32) -> Vec<ContourLine> {
        let parts = self.parts(level);
        // No edge is left by more than one part, or come to by more than one.
        let after: HashMap<Edge, usize> = parts.iter().map(|part| part[0]).zip(0..).collect();
        let reached: HashSet<Edge> = parts.iter().map(|part| part[1]).collect();
        let mut is_used = vec![false; parts.len()];
        let mut lines = Vec::new();
        let begins = (0..parts.len()).filter(|&part| !reached.contains(&parts[part][0]));
        // What is left after the lines that begin somewhere is rings.
        for first in begins.chain(0..parts.len()) {
            let mut next = Some(first).filter(|&part| !is_used[part]);
            let mut edges: Vec<Edge> = next.map(|part| parts[part][0]).into_iter().collect();
            while let Some(part) = next.filter(|&part| !is_used[part]) {
                is_used[part] = true;
                edges.push(parts[part][1]);
                next = after.get(&parts[part][1]).copied();
            }
            let is_closed = edges.len() > 2 && edges.first() == edges.last();
            let mut points: Vec<_> = edges
                .iter()
                .map(|edge| self.crossing(edge, level))
                .collect();
            // Where a cell has the level itself, the line meets its middle on several edges.
            points.dedup();
            if points.len() > 1 {
                lines.push(ContourLine {
                    level,
                    points,
                    is_closed,
                });
            }
        }
        lines
    }

    /// The parts within all squares between four neighbours.
    fn parts(&self, level: f32) -> Vec<Part> {
        let width = self.grid.width as usize;
        let mut parts = Vec::new();
        for north in 0..(self.grid.height as usize).saturating_sub(1) {
            for west in 0..width - 1 {
                let (north, south) = (north * width + west, (north + 1) * width + west);
                self.square([south, south + 1, north + 1, north], level, &mut parts);
            }
        }
        parts
    }

    /// The parts within a square, by its corners counterclockwise.
    fn square(&self, corners: [usize; 4], level: f32, parts: &mut Vec<Part>) {
        let known = corners
            .into_iter()
            .filter(|&corner| self.values[corner].is_finite());
        let known: ArrayVec<usize, 4> = known.collect();
        // Three of them are a triangle; along two there is no area.
        if known.len() < 3 {
            return;
        }
        let is_high = |corner: usize| self.values[corner] >= level;
        // Edges on the way around, and whether the way goes down there.
        let mut edges: ArrayVec<(Edge, bool), 4> = ArrayVec::new();
        for (index, &from) in known.iter().enumerate() {
            let to = known[(index + 1) % known.len()];
            if is_high(from) != is_high(to) {
                edges.push(([from.min(to), from.max(to)], is_high(from)));
            }
        }
        let count = edges.len();
        // From an edge that goes down to the next one that goes up, what lies between is low, and the high corners are joined.
        let step = if count == 4 && !self.joins_high(corners, level) {
            3
        } else {
            1
        };
        for (index, &(edge, goes_down)) in edges.iter().enumerate() {
            if goes_down {
                parts.push([edge, edges[(index + step) % count].0]);
            }
        }
    }

    /// Of a square with two opposite corners that are high, whether these are joined: whether the saddle between them is high.
    fn joins_high(&self, corners: [usize; 4], level: f32) -> bool {
        let [a, b, c, d] = corners.map(|corner| f64::from(self.values[corner]));
        (a * c - b * d) / (a + c - b - d) >= f64::from(level)
    }

    /// Where the line crosses between two cells of which one is high: the same for both squares that share them.
    fn crossing(&self, &[from, to]: &Edge, level: f32) -> [f64; 2] {
        let [low, high] = [from, to].map(|cell| f64::from(self.values[cell]));
        let share = (f64::from(level) - low) / (high - low);
        let [from, to] = [from, to].map(|cell| {
            let (cell, width) = (cell as u32, self.grid.width);
            self.grid.centre(cell % width, cell / width)
        });
        [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NO: f32 = f32::NAN;

    /// Cells of 2 m with the south-west one's middle at the origin; rows from the north.
    fn lines<const W: usize>(rows: &[[f32; W]], levels: &[f32]) -> Vec<ContourLine> {
        let grid = Grid {
            corner: [-1.0; 2],
            cell: 2.0,
            width: W as u32,
            height: rows.len() as u32,
        };
        contour_lines(&grid, rows.as_flattened(), levels)
    }

    fn points<const W: usize>(rows: &[[f32; W]], level: f32) -> Vec<Vec<[f64; 2]>> {
        let lines = lines(rows, &[level]);
        lines.into_iter().map(|line| line.points).collect()
    }

    #[test]
    fn where_nothing_crosses_there_is_no_line() {
        assert!(points(&[[0.0]], 0.0).is_empty());
        assert!(points(&[[0.0, 9.0]], 5.0).is_empty(), "a row has no area");
        assert!(points(&[[0.0], [9.0]], 5.0).is_empty());
        assert!(points(&[[NO; 3]; 3], 5.0).is_empty());
        let hill = [[0.0, 0.0, 0.0], [0.0, 8.0, 0.0], [0.0, 0.0, 0.0]];
        for level in [-1.0, 0.0, 8.5, f32::INFINITY, f32::NEG_INFINITY, NO] {
            assert!(points(&hill, level).is_empty(), "{level}");
        }
        assert!(points(&hill, 8.0).is_empty(), "a ring around one point");
        assert!(points(&[[7.0; 3]; 3], 7.0).is_empty(), "all on one level");
        assert!(lines(&hill, &[]).is_empty());
    }

    #[test]
    fn a_wall_has_one_line_with_its_high_side_to_the_left() {
        let rows = [[0.0, 0.0, 8.0]; 3];
        let of_wall = lines(&rows, &[2.0, 6.0]);
        assert_eq!(of_wall.len(), 2);
        // East is high: northward it would be to the right, so the line goes south.
        let line = |x: f64, level| ContourLine {
            level,
            points: vec![[x, 4.0], [x, 2.0], [x, 0.0]],
            is_closed: false,
        };
        assert_eq!(of_wall, [line(2.5, 2.0), line(3.5, 6.0)]);
        let north = points(&[[8.0, 8.0], [0.0, 0.0]], 4.0);
        assert_eq!(north, [[[0.0, 1.0], [2.0, 1.0]]]);
    }

    #[test]
    fn a_hill_has_a_ring_that_goes_counterclockwise_and_a_hollow_the_other_way() {
        let area = |line: &ContourLine| -> f64 {
            let cross = |pair: &[[f64; 2]]| pair[0][0] * pair[1][1] - pair[1][0] * pair[0][1];
            line.points.windows(2).map(cross).sum::<f64>() / 2.0
        };
        let hill = [[0.0, 0.0, 0.0], [0.0, 8.0, 0.0], [0.0, 0.0, 0.0]];
        let rings = lines(&hill, &[4.0]);
        assert_eq!(rings.len(), 1);
        assert!(rings[0].is_closed);
        assert_eq!(rings[0].points.len(), 5);
        assert_eq!(rings[0].points[0], rings[0].points[4]);
        for corner in [[1.0, 2.0], [3.0, 2.0], [2.0, 1.0], [2.0, 3.0]] {
            assert!(rings[0].points.contains(&corner), "{corner:?}");
        }
        assert_eq!(area(&rings[0]), 2.0);
        let hollow = hill.map(|row| row.map(|value| -value));
        assert_eq!(area(&lines(&hollow, &[-4.0])[0]), -2.0);
    }

    #[test]
    fn the_saddle_between_two_hills_says_whether_they_are_joined() {
        // Saddles at (a c - b d) / (a + c - b - d): 5 in both.
        let rows = [[10.0, 0.0], [0.0, 10.0]];
        let joined = points(&rows, 4.0);
        let apart = points(&rows, 6.0);
        assert_eq!(joined.len(), 2);
        assert_eq!(apart.len(), 2);
        // Joined hills leave low corners, south-west and north-east, alone.
        let is_near = |line: &[[f64; 2]], corner: [f64; 2]| {
            line.iter()
                .all(|p| (p[0] - corner[0]).hypot(p[1] - corner[1]) < 1.0)
        };
        for corner in [[0.0, 0.0], [2.0, 2.0]] {
            assert!(joined.iter().any(|line| is_near(line, corner)));
        }
        for corner in [[2.0, 0.0], [0.0, 2.0]] {
            assert!(apart.iter().any(|line| is_near(line, corner)));
        }
        // The mean of corners, 4.25, would join these; the surface has its saddle at 54 / 13 = 4.15.
        let uneven = [[9.0, 0.0], [2.0, 6.0]];
        assert!(
            points(&uneven, 4.2)
                .iter()
                .any(|line| is_near(line, [2.0, 0.0]))
        );
    }

    #[test]
    fn the_lines_of_a_cone_are_circles_to_a_fraction_of_a_cell() {
        const SIDE: u32 = 81;
        let grid = Grid {
            corner: [-40.5; 2],
            cell: 1.0,
            width: SIDE,
            height: SIDE,
        };
        let height = |[x, y]: [f64; 2]| 100.0 - x.hypot(y);
        let cells = (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| (column, row)));
        let values: Vec<f32> = cells
            .map(|(column, row)| height(grid.centre(column, row)) as f32)
            .collect();
        let lines = contour_lines(&grid, &values, &[95.0, 90.0, 70.0, 55.0]);
        let rings: Vec<bool> = lines.iter().map(|line| line.is_closed).collect();
        // The last circle, of 45 m, shows in the corners only.
        assert_eq!(rings, [true, true, true, false, false, false, false]);
        for line in &lines {
            let radius = f64::from(100.0 - line.level);
            for &[x, y] in &line.points {
                assert!((x.hypot(y) - radius).abs() < 0.03, "{x}, {y}: {radius}");
            }
        }
    }

    #[test]
    fn the_lines_of_a_plane_are_straight_through_squares_and_beside_what_has_no_number() {
        let grid = Grid {
            corner: [-3.0, 7.0],
            cell: 0.5,
            width: 20,
            height: 15,
        };
        let plane = |[x, y]: [f64; 2]| 3.0 * x - 2.0 * y;
        let mut values: Vec<f32> = (0..300)
            .map(|cell| plane(grid.centre(cell % 20, cell / 20)) as f32)
            .collect();
        let on_plane = |values: &[f32]| {
            let lines = contour_lines(&grid, values, &[-12.3]);
            for point in lines.iter().flat_map(|line| &line.points) {
                assert!((plane(*point) + 12.3).abs() < 1e-4, "{point:?}");
            }
            lines.len()
        };
        assert_eq!(on_plane(&values), 1);
        // A building in the middle of the way cuts the line in two.
        for cell in [151, 152, 171, 172] {
            values[cell] = NO;
        }
        assert_eq!(on_plane(&values), 2);
    }

    #[test]
    fn a_line_ends_where_there_is_no_number() {
        // Along y = 1 from the west; the middle column has numbers in the north only.
        let rows = [[8.0, 8.0, 8.0, 8.0], [0.0, 0.0, NO, 0.0]];
        let found = points(&rows, 4.0);
        // In the triangle beside the hole the line ends on its long side.
        assert_eq!(
            found,
            [
                vec![[0.0, 1.0], [2.0, 1.0], [3.0, 1.0]],
                vec![[5.0, 1.0], [6.0, 1.0]]
            ]
        );
        let gap = [[8.0, 8.0, NO, 8.0, 8.0], [0.0, 0.0, NO, 0.0, 0.0]];
        assert_eq!(
            points(&gap, 4.0),
            [[[0.0, 1.0], [2.0, 1.0]], [[6.0, 1.0], [8.0, 1.0]]]
        );
        // A ring that is cut is a line.
        let mut hill = [[0.0_f32; 5]; 5];
        hill[2][2] = 8.0;
        hill[2][1] = NO;
        let cut = lines(&hill, &[4.0]);
        assert_eq!((cut.len(), cut[0].is_closed), (1, false));
    }

    #[test]
    fn a_line_through_middles_of_cells_has_no_point_twice() {
        let rows = [[0.0, 4.0, 8.0]; 3];
        assert_eq!(points(&rows, 4.0), [[[2.0, 4.0], [2.0, 2.0], [2.0, 0.0]]]);
        let plateau = [[0.0, 0.0, 0.0, 0.0], [0.0, 4.0, 4.0, 0.0], [0.0; 4]];
        let rings = lines(&plateau, &[4.0]);
        for line in &rings {
            assert!(line.points.windows(2).all(|pair| pair[0] != pair[1]));
        }
    }
}
