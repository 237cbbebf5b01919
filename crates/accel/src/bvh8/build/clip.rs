//! The parts of a triangle on both sides of a plane, as boxes.
//!
//! A hit counts if its point lies near its triangle (see [`TraversalRay`](crate::TraversalRay)), and
//! rays find it through any box that holds the nearest point of the triangle. So the boxes of all
//! parts must cover the triangle for sure: what is computed is rounded outward by a single's last
//! place, which is far more than double precision rounds.

use super::item::Item;

/// The corners of a triangle; the fourth numbers are 0.
pub(super) type Triangle = [[f64; 4]; 3];

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

/// The boxes of both parts of a triangle, in double precision: lower corner, upper corner. The
/// fourth numbers mean nothing; with them two instructions do.
fn sides(triangle: &Triangle, axis: usize, plane: f64) -> [[[f64; 4]; 2]; 2] {
    let mut sides = [[[f64::INFINITY; 4], [f64::NEG_INFINITY; 4]]; 2];
    let mut add = |side: usize, point: &[f64; 4]| {
        let [lower, upper] = &mut sides[side];
        for k in 0..4 {
            lower[k] = if point[k] < lower[k] {
                point[k]
            } else {
                lower[k]
            };
            upper[k] = if point[k] > upper[k] {
                point[k]
            } else {
                upper[k]
            };
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
        if (a[axis] < plane && b[axis] > plane) || (a[axis] > plane && b[axis] < plane) {
            // From the same end whichever way the edge is walked.
            let (a, b) = if a[axis] < b[axis] { (a, b) } else { (b, a) };
            let part = (plane - a[axis]) / (b[axis] - a[axis]);
            let mut point: [f64; 4] = std::array::from_fn(|k| a[k] + (b[k] - a[k]) * part);
            point[axis] = plane;
            add(0, &point);
            add(1, &point);
        }
    }
    sides
}

/// What a box has in common with another one that is rounded outward: by more than to the next
/// single.
fn common(item: &Item, [lower, upper]: &[[f64; 4]; 2]) -> Option<Item> {
    const PART: f64 = f32::EPSILON as f64;
    const LEAST: f64 = 2e-45;
    let mut common = *item;
    let mut some = true;
    for k in 0..3 {
        let low = (lower[k] - (lower[k].abs() * PART + LEAST)) as f32;
        let high = (upper[k] + (upper[k].abs() * PART + LEAST)) as f32;
        let (least, most) = (item.lanes[k], -item.lanes[k + 4]);
        let low = if low > least { low } else { least };
        let high = if high < most { high } else { most };
        some &= low <= high;
        (common.lanes[k], common.lanes[k + 4]) = (low, -high);
    }
    some.then_some(common)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ombra_geometry::{Aabb, Point3};

    /// Numbers in [0, 1) without a pattern.
    fn numbers() -> impl FnMut() -> f64 {
        let mut state = 1_u64;
        move || {
            state = state
                .wrapping_mul(0x5851_f42d_4c95_7f2d)
                .wrapping_add(0x1405_7b7e_f767_814f);
            (state >> 40) as f64 / 16_777_216.0
        }
    }

    #[test]
    fn every_point_of_a_triangle_lies_in_a_part() {
        let mut number = numbers();
        for size in [1e-30, 1e-6, 1.0, 1e7, 1e30] {
            for _ in 0..200 {
                let corners = [(); 3]
                    .map(|()| [number(), number(), number()].map(|x| ((x - 0.5) * size) as f32));
                let triangle = corners.map(|[x, y, z]| [x, y, z, 0.0].map(f64::from));
                let whole = Item::new(&Aabb::around(corners.map(Point3::from)), 7);
                let mut parts = vec![whole];
                for round in 0..6 {
                    let axis = round % 3;
                    let cut = |part: Item| {
                        let (low, high) = (part.lanes[axis], -part.lanes[axis + 4]);
                        let plane = low + (high - low) * 0.37;
                        if low < plane && plane < high {
                            split(&part, Some(&triangle), axis, plane)
                                .into_iter()
                                .flatten()
                                .collect()
                        } else {
                            vec![part]
                        }
                    };
                    parts = parts.into_iter().flat_map(cut).collect();
                }
                for _ in 0..50 {
                    let (a, b) = (number(), number());
                    let (a, b) = if a + b > 1.0 {
                        (1.0 - a, 1.0 - b)
                    } else {
                        (a, b)
                    };
                    let point: [f64; 3] = std::array::from_fn(|k| {
                        let [p, q, r] = triangle.map(|corner| corner[k]);
                        p + (q - p) * a + (r - p) * b
                    });
                    // The point itself is rounded.
                    let slack = 1e-12 * size;
                    let holds = |part: &Item| {
                        (0..3).all(|k| {
                            f64::from(part.lanes[k]) - slack <= point[k]
                                && point[k] <= slack - f64::from(part.lanes[k + 4])
                        })
                    };
                    assert!(parts.iter().any(holds), "{corners:?} {point:?}");
                }
                assert!(parts.iter().all(|part| part.primitive() == 7));
            }
        }
    }
}
