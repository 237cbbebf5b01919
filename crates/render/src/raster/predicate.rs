//! On which side of a line a point lies, without rounding.
//!
//! Two triangles that share an edge must never both claim a pixel, nor both leave it: so the sign of
//! an edge function has to be the true one, even where the value rounds.

/// Half a unit in the last place of 1: the largest relative error of one rounding.
const ROUNDING: f64 = f64::EPSILON / 2.0;

/// (b − a) × (p − a), the edge function: twice the area of the triangle a, b, p, in a picture whose y
/// runs down positive where p is on the right of somebody who walks from a to b.
///
/// The sign is exact and 0 means on the line, as long as products of coordinates neither overflow nor
/// underflow; the value is rounded. After Shewchuk, "Adaptive Precision Floating-Point Arithmetic and
/// Fast Robust Geometric Predicates", Discrete & Computational Geometry 18(3), 1997, section 4.2: the
/// plain formula where its sign is certain, an exact sum otherwise.
#[inline]
pub(super) fn edge_function(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    let left = (a[0] - p[0]) * (b[1] - p[1]);
    let right = (a[1] - p[1]) * (b[0] - p[0]);
    let value = left - right;
    let certain = (3.0 + 16.0 * ROUNDING) * ROUNDING * (left.abs() + right.abs());
    if value.abs() > certain {
        value
    } else {
        exact(a, b, p)
    }
}

/// The same with the differences multiplied out: a sum of six products, each of which is the sum of
/// two numbers exactly.
#[cold]
fn exact(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    let products = [
        (a[0], b[1]),
        (-a[0], p[1]),
        (-p[0], b[1]),
        (-a[1], b[0]),
        (a[1], p[0]),
        (p[1], b[0]),
    ];
    let mut sum = [0.0; 12];
    for (i, (x, y)) in products.into_iter().enumerate() {
        let product = x * y;
        grow(&mut sum[..=2 * i], x.mul_add(y, -product));
        grow(&mut sum[..=2 * i + 1], product);
    }
    // Parts do not overlap and grow, so the largest that is not 0 has the sign of all.
    sum.into_iter().rfind(|&part| part != 0.0).unwrap_or(0.0)
}

/// Adds a number to an expansion, whose last place is free: Shewchuk's Grow-Expansion.
fn grow(expansion: &mut [f64], number: f64) {
    let mut carried = number;
    let Some((last, parts)) = expansion.split_last_mut() else {
        return;
    };
    for part in parts {
        let sum = carried + *part;
        let of_part = sum - carried;
        let error = (carried - (sum - of_part)) + (*part - of_part);
        (*part, carried) = (error, sum);
    }
    *last = carried;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_right_of_an_edge_is_positive_where_y_runs_down() {
        let (a, b) = ([0.0, 0.0], [2.0, 0.0]);
        assert_eq!(edge_function(a, b, [0.5, 3.0]), 6.0);
        assert_eq!(edge_function(b, a, [0.5, 3.0]), -6.0);
        assert_eq!(edge_function(a, b, [7.0, 0.0]), 0.0);
    }

    #[test]
    fn signs_are_those_of_whole_numbers() {
        // Points next to a line, in steps of the last place: the plain formula gives 0 or the wrong
        // sign for many of them (Kettner et al., "Classroom Examples of Robustness Problems in
        // Geometric Computations", 2008).
        let step = 2_f64.powi(-53);
        let (a, b) = ([12.0, 12.0], [24.0, 24.0]);
        let mut rounded_off = 0;
        for i in 0..64_i32 {
            for j in 0..64_i32 {
                let p = [0.5 + f64::from(i) * step, 0.5 + f64::from(j) * step];
                // Here (b − a) × (p − a) = 12 (p_y − p_x).
                let expected = (j - i).signum();
                let found = edge_function(a, b, p);
                assert_eq!(found.partial_cmp(&0.0), Some(expected.cmp(&0)), "{i}, {j}");
                let back = -edge_function(b, a, p);
                assert_eq!(
                    back.partial_cmp(&0.0),
                    found.partial_cmp(&0.0),
                    "antisymmetric"
                );
                let plain = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
                rounded_off += i32::from(plain.partial_cmp(&0.0) != Some(expected.cmp(&0)));
            }
        }
        assert!(
            rounded_off > 100,
            "{rounded_off}: this test would prove nothing"
        );
    }

    #[test]
    fn no_number_is_on_no_side() {
        let nan = edge_function([0.0, 0.0], [1.0, f64::NAN], [0.5, 0.5]);
        assert!(!(nan > 0.0) && nan != 0.0);
    }
}
