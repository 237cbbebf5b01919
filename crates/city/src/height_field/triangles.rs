//! Triangles between the middles of pixels, those of one plane joined.

use ombra_geometry::Point3;

use super::Vertices;

/// Middles of pixels that lie so near to a plane, in metres, are in it.
const FLAT: f32 = 1e-3;

/// Joined rectangles are at most so many pixels wide: what is straight on a map is bent in local metres,
/// over 64 m by less than a tenth of a millimetre.
const WIDEST: usize = 64;

/// Triangles of a surface, counter-clockwise as seen from above.
#[derive(Debug, Default)]
pub(crate) struct Triangles {
    /// Of the ground.
    pub(crate) ground: Vec<[Point3; 3]>,
    /// Of what stands on it: with a corner that is raised.
    pub(crate) raised: Vec<[Point3; 3]>,
}

/// The corners of a cell go round it, the one of the least column and row first: triangles of them. Of four
/// the diagonal is the one whose ends differ less in height; of three there is one triangle.
fn cut([a, b, c, d]: [f32; 4]) -> [Option<[usize; 3]>; 2] {
    match [a, b, c, d].map(f32::is_finite) {
        [true, true, true, true] if (a - c).abs() <= (b - d).abs() => {
            [Some([0, 1, 2]), Some([0, 2, 3])]
        }
        [true, true, true, true] => [Some([0, 1, 3]), Some([1, 2, 3])],
        [false, true, true, true] => [Some([1, 2, 3]), None],
        [true, false, true, true] => [Some([0, 2, 3]), None],
        [true, true, false, true] => [Some([0, 1, 3]), None],
        [true, true, true, false] => [Some([0, 1, 2]), None],
        _ => [None, None],
    }
}

/// The height at a place of a cell, its sides counted as 1.
pub(super) fn height_in_cell(corners: [f32; 4], [u, v]: [f64; 2]) -> Option<f64> {
    const AT: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    cut(corners).into_iter().flatten().find_map(|triangle| {
        let [a, b, c] = triangle.map(|k| AT[k]);
        // Half a square is twice 1/2 large, and runs the same way round.
        let part =
            |p: [f64; 2], q: [f64; 2]| (q[0] - p[0]) * (v - p[1]) - (q[1] - p[1]) * (u - p[0]);
        let weights = [part(b, c), part(c, a), part(a, b)];
        let is_in = weights.iter().all(|&w| w >= -1e-5);
        let heights = triangle.map(|k| f64::from(corners[k]));
        is_in.then(|| (0..3).map(|k| weights[k] * heights[k]).sum())
    })
}

/// The triangles between all vertices; `is_raised` tells it of each, and is empty where nothing is.
pub(crate) fn triangles(vertices: &Vertices, is_raised: &[bool]) -> Triangles {
    let [width, height] = vertices.size.map(|n| n as usize);
    let mut found = Triangles::default();
    if width < 2 || height < 2 {
        return found;
    }
    let cells = Cells {
        points: &vertices.points,
        is_raised,
        width,
    };
    let mut is_done = vec![false; (width - 1) * (height - 1)];
    for row in 0..height - 1 {
        for column in 0..width - 1 {
            if is_done[row * (width - 1) + column] {
                continue;
            }
            let raised = cells.is_raised(column, row);
            let to = if raised {
                &mut found.raised
            } else {
                &mut found.ground
            };
            let is_free = |c: usize, r: usize| {
                c < width - 1
                    && r < height - 1
                    && !is_done[r * (width - 1) + c]
                    && cells.is_raised(c, r) == raised
            };
            let [across, down] = cells.flat(column, row, is_free);
            for done in is_done.chunks_mut(width - 1).skip(row).take(down) {
                done[column..column + across].fill(true);
            }
            let corners = cells.corners([column, row], [across, down]);
            for triangle in cut(corners.map(|p| p.z)).into_iter().flatten() {
                to.extend(turned_up(triangle.map(|k| corners[k])));
            }
        }
    }
    found
}

struct Cells<'a> {
    points: &'a [Point3],
    is_raised: &'a [bool],
    width: usize,
}

impl Cells<'_> {
    fn corners(&self, [column, row]: [usize; 2], [across, down]: [usize; 2]) -> [Point3; 4] {
        let at = |c: usize, r: usize| self.points[r * self.width + c];
        let (right, below) = (column + across, row + down);
        [
            at(column, row),
            at(right, row),
            at(right, below),
            at(column, below),
        ]
    }

    fn is_raised(&self, column: usize, row: usize) -> bool {
        let at = |c: usize, r: usize| self.is_raised.get(r * self.width + c) == Some(&true);
        at(column, row) || at(column + 1, row) || at(column + 1, row + 1) || at(column, row + 1)
    }

    /// How many cells to the right and below lie in one plane with this one: at least itself.
    fn flat(
        &self,
        column: usize,
        row: usize,
        is_free: impl Fn(usize, usize) -> bool,
    ) -> [usize; 2] {
        let [a, b, _, d] = self.corners([column, row], [1, 1]).map(|p| p.z);
        let (right, below) = (b - a, d - a);
        let is_flat = |c: usize, r: usize| {
            let plane = a + (c - column) as f32 * right + (r - row) as f32 * below;
            // NaN is not flat.
            (self.points[r * self.width + c].z - plane).abs() <= FLAT
        };
        if !is_flat(column + 1, row + 1) {
            return [1, 1];
        }
        let mut across = 1;
        while across < WIDEST
            && is_free(column + across, row)
            && is_flat(column + across + 1, row)
            && is_flat(column + across + 1, row + 1)
        {
            across += 1;
        }
        let mut down = 1;
        while down < WIDEST
            && (column..column + across).all(|c| is_free(c, row + down))
            && (column..=column + across).all(|c| is_flat(c, row + down + 1))
        {
            down += 1;
        }
        [across, down]
    }
}

/// Counter-clockwise as seen from above, whichever way the raster runs; `None` without an area.
fn turned_up([a, b, c]: [Point3; 3]) -> Option<[Point3; 3]> {
    let up = (b.wide() - a.wide()).cross(c.wide() - a.wide()).z;
    if up > 0.0 {
        Some([a, b, c])
    } else if up < 0.0 {
        Some([a, c, b])
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertices(size: [u32; 2], z: impl Fn(u32, u32) -> f32) -> Vertices {
        let rows = (0..size[1]).flat_map(|row| (0..size[0]).map(move |column| (column, row)));
        Vertices {
            first: [0, 0],
            size,
            points: rows
                .map(|(c, r)| Point3::new(c as f32, -(r as f32), z(c, r)))
                .collect(),
        }
    }

    fn area(triangles: &[[Point3; 3]]) -> f64 {
        let twice = |[a, b, c]: [Point3; 3]| (b.wide() - a.wide()).cross(c.wide() - a.wide()).z;
        triangles.iter().map(|&t| 0.5 * twice(t)).sum()
    }

    #[test]
    fn nothing_one_and_a_row_have_none() {
        for size in [[0, 0], [1, 1], [5, 1], [1, 5]] {
            let found = triangles(&vertices(size, |_, _| 1.0), &[]);
            assert!(found.ground.is_empty() && found.raised.is_empty());
        }
    }

    #[test]
    fn what_lies_in_a_plane_is_joined() {
        for plane in [[0.0, 0.0], [0.5, -0.25]] {
            let z = |c, r| 100.0 + plane[0] * c as f32 + plane[1] * r as f32;
            let found = triangles(&vertices([41, 21], z), &[]);
            assert_eq!((found.ground.len(), area(&found.ground)), (2, 800.0));
        }
        let wide = triangles(&vertices([131, 2], |_, _| 0.0), &[]);
        assert_eq!((wide.ground.len(), area(&wide.ground)), (6, 130.0));
    }

    #[test]
    fn a_block_keeps_its_form() {
        let z = |c, r| {
            if (3..7).contains(&c) && (2..5).contains(&r) {
                9.0
            } else {
                0.0
            }
        };
        let vertices = vertices([10, 8], z);
        let is_raised: Vec<bool> = vertices.points.iter().map(|p| p.z > 2.0).collect();
        let found = triangles(&vertices, &is_raised);
        // The walls are one pixel wide, and are no ground.
        assert_eq!(area(&found.raised), 5.0 * 4.0);
        assert_eq!(area(&found.ground), 63.0 - 20.0);
        assert!(found.ground.iter().flatten().all(|p| p.z == 0.0));
        let all = found.ground.len() + found.raised.len();
        assert!(all < 60, "{all} of 126 are left");
    }

    #[test]
    fn holes_stay_open_and_three_corners_are_a_triangle() {
        let z = |c, r| {
            if (c, r) == (2, 2) {
                f32::NAN
            } else {
                (c * c + 3 * r) as f32
            }
        };
        let found = triangles(&vertices([5, 5], z), &[]);
        assert_eq!(area(&found.ground), 16.0 - 4.0 + 4.0 * 0.5);
        let none = triangles(&vertices([5, 5], |_, _| f32::NAN), &[]);
        assert!(none.ground.is_empty());
    }

    #[test]
    fn the_diagonal_is_the_flatter_one() {
        assert_eq!(cut([5.0, 0.0, 5.0, 0.0])[0], Some([0, 1, 2]));
        assert_eq!(cut([0.0, 0.0, 9.0, 0.0])[0], Some([0, 1, 3]));
        let ridge = [9.0, 0.0, 9.0, 3.0];
        assert_eq!(height_in_cell(ridge, [0.5, 0.5]), Some(9.0));
        assert_eq!(height_in_cell(ridge, [1.0, 0.0]), Some(0.0));
        assert_eq!(height_in_cell([f32::NAN; 4], [0.5, 0.5]), None);
    }
}
