//! Real roots of small polynomials, by where they turn.
//!
//! Yuksel, "High-Performance Polynomial Root Finding for Graphics", HPG 2022: between neighbouring
//! turning points a polynomial is monotone, so a change of sign there is one root, found by Newton's
//! method kept inside its bracket by bisection; and turning points are the roots of the derivative,
//! found the same way one degree lower, down to the quadratic.

use arrayvec::ArrayVec;

/// Where a quartic turns in the open interval `(lo, hi)`, in order. Coefficients come constant first.
pub(crate) fn turning_points(quartic: &[f64; 5], lo: f64, hi: f64) -> ArrayVec<f64, 3> {
    let [_, c1, c2, c3, c4] = *quartic;
    let cubic = [c1, 2.0 * c2, 3.0 * c3, 4.0 * c4];
    let value = |s: f64| {
        let [c0, c1, c2, c3] = cubic;
        (
            ((c3 * s + c2) * s + c1) * s + c0,
            (3.0 * c3 * s + 2.0 * c2) * s + c1,
        )
    };
    let [_, q0, q1, q2] = cubic;
    let turns = quadratic_roots(q0, q1, 3.0 * q2);
    let tolerance = f64::EPSILON * lo.abs().max(hi.abs());
    let mut found = ArrayVec::new();
    let (mut last, mut was_negative) = (lo, value(lo).0 < 0.0);
    for next in turns
        .into_iter()
        .filter(|&turn| lo < turn && turn < hi)
        .chain([hi])
    {
        let is_negative = value(next).0 < 0.0;
        if is_negative != was_negative {
            found.push(bracketed_root(last, next, was_negative, tolerance, value));
        }
        (last, was_negative) = (next, is_negative);
    }
    found
}

/// The roots of c + 2 b s + a s², in order; a double one may come twice or not at all.
fn quadratic_roots(c: f64, b: f64, a: f64) -> ArrayVec<f64, 2> {
    let discriminant = b * b - a * c;
    let mut roots = ArrayVec::new();
    if !(discriminant >= 0.0) {
        return roots;
    }
    let q = -(b + discriminant.sqrt().copysign(b));
    if q != 0.0 {
        let (r0, r1) = (q / a, c / q);
        roots.extend([r0.min(r1), r0.max(r1)]);
    } else {
        roots.push(0.0);
    }
    roots
}

/// Where a function, given with its derivative, changes sign in `[lo, hi]`. `lo_negative` says on
/// which side it starts; that it ends on the other one is believed. Newton's method, and bisection
/// wherever that leaves the bracket or dawdles.
pub(crate) fn bracketed_root(
    mut lo: f64,
    mut hi: f64,
    lo_negative: bool,
    tolerance: f64,
    function: impl Fn(f64) -> (f64, f64),
) -> f64 {
    let mut at = f64::midpoint(lo, hi);
    // Bisection alone needs no more steps than a double has bits; every fourth step is one.
    for step in 1..256 {
        let (value, slope) = function(at);
        if value == 0.0 {
            return at;
        }
        if (value < 0.0) == lo_negative {
            lo = at;
        } else {
            hi = at;
        }
        let newton = at - value / slope;
        let next = if lo < newton && newton < hi && step % 4 != 0 {
            newton
        } else {
            f64::midpoint(lo, hi)
        };
        if (next - at).abs() <= tolerance || hi - lo <= tolerance {
            return next;
        }
        at = next;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quartic_turns_where_its_derivative_is_zero() {
        // s⁴ / 4 − s² / 2 turns at −1, 0 and 1.
        let turns = turning_points(&[0.0, 0.0, -0.5, 0.0, 0.25], -3.0, 3.0);
        assert_eq!(turns.len(), 3);
        for (turn, expected) in turns.into_iter().zip([-1.0, 0.0, 1.0]) {
            assert!((turn - expected).abs() < 1e-14, "{turn}");
        }
        assert_eq!(
            turning_points(&[0.0, 0.0, 0.5, 0.0, 0.25], -3.0, 2.0).len(),
            1
        );
    }

    #[test]
    fn a_root_is_found_where_newton_runs_away() {
        // The arc tangent sends Newton's method further away at every step from beyond ±1.39.
        let root = bracketed_root(-1e6, 3e5, true, 1e-15, |s: f64| {
            ((s - 0.25).atan(), 1.0 / (1.0 + (s - 0.25) * (s - 0.25)))
        });
        assert!((root - 0.25).abs() < 1e-12, "{root}");
    }
}
