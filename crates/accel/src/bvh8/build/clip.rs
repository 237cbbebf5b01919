//! The parts of a triangle on both sides of a plane, as boxes.
//!
//! A hit counts if its point lies near its triangle (see [`TraversalRay`](crate::TraversalRay)), and
//! rays find it through any box that holds the nearest point of the triangle. So the boxes of all
//! parts must cover the triangle for sure: what is computed is rounded outward by a single's last
//! place, which is far more than double precision rounds.

use super::item::Item;

/// The corners of a triangle.
pub(super) type Triangle = [[f64; 3]; 3];

/// What of a triangle lies within the box of an item, below and above a plane across an axis. `None`
/// where there is nothing for sure.
///
/// The plane cuts the box. Without a triangle, of the box itself.
pub(super) fn split(
    item: &Item,
    triangle: Option<&Triangle>,
    axis: usize,
    plane: f32,
) -> [Option<Item>; 2] {
    let (mut below, mut above) = (*item, *item);
    below.lanes[axis + 4] = -plane;
    above.lanes[axis] = plane;
    let Some(triangle) = triangle else {
        return [Some(below), Some(above)];
    };
    let parts = sides(triangle, axis, f64::from(plane));
    match [common(&below, &parts[0]), common(&above, &parts[1])] {
        // Rounding has the last word on a triangle that only touches the box: leave it in both.
        [None, None] => [Some(below), Some(above)],
        parts => parts,
    }
}

/// The boxes of both parts of a triangle, in double precision: lower corner, upper corner.
fn sides(triangle: &Triangle, axis: usize, plane: f64) -> [[[f64; 3]; 2]; 2] {
    let mut sides = [[[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]]; 2];
    let mut add = |side: usize, point: &[f64; 3]| {
        for k in 0..3 {
            sides[side][0][k] = sides[side][0][k].min(point[k]);
            sides[side][1][k] = sides[side][1][k].max(point[k]);
        }
    };
    for corner in 0..3 {
        let (a, b) = (&triangle[corner], &triangle[(corner + 1) % 3]);
        if a[axis] <= plane {
            add(0, a);
        }
        if a[axis] >= plane {
            add(1, a);
        }
        if (a[axis] < plane) != (b[axis] < plane) && a[axis] != plane && b[axis] != plane {
            // From the same end whichever way the edge is walked.
            let (a, b) = if a[axis] < b[axis] { (a, b) } else { (b, a) };
            let part = (plane - a[axis]) / (b[axis] - a[axis]);
            let mut point: [f64; 3] = std::array::from_fn(|k| a[k] + (b[k] - a[k]) * part);
            point[axis] = plane;
            add(0, &point);
            add(1, &point);
        }
    }
    sides
}

/// What a box has in common with another one that is rounded outward.
fn common(item: &Item, [lower, upper]: &[[f64; 3]; 2]) -> Option<Item> {
    let mut common = *item;
    for k in 0..3 {
        let low = (lower[k] as f32).next_down().max(item.lanes[k]);
        let high = (upper[k] as f32).next_up().min(-item.lanes[k + 4]);
        if !(low <= high) {
            return None;
        }
        (common.lanes[k], common.lanes[k + 4]) = (low, -high);
    }
    Some(common)
}
