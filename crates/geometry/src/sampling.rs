//! Sampling warps: from two uniform numbers to a point on a disk, a sphere, a hemisphere, a
//! triangle.
//!
//! Each keeps neighbours neighbours, so that a well-spread set of numbers stays well spread. Input
//! numbers lie in `[0, 1)`. Directions come with z as the pole; a frame turns them
//! ([`Vector3::orthonormal_basis`](crate::Vector3::orthonormal_basis)).

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4, PI};

use crate::Vector3;

/// The density of [`uniform_sphere`] per unit of solid angle.
pub const UNIFORM_SPHERE_PDF: f64 = FRAC_1_PI / 4.0;

/// A point of the unit disk, uniform by area: squares become rings (Shirley, Chiu, "A Low Distortion
/// Map Between Disk and Square", Journal of Graphics Tools 2(3), 1997).
#[must_use]
#[inline]
pub fn uniform_disk(xi: [f32; 2]) -> [f64; 2] {
    let [a, b] = xi.map(|x| 2.0 * f64::from(x) - 1.0);
    if a == 0.0 && b == 0.0 {
        return [0.0, 0.0];
    }
    let (radius, angle) = if a.abs() > b.abs() {
        (a, FRAC_PI_4 * (b / a))
    } else {
        (b, FRAC_PI_2 - FRAC_PI_4 * (a / b))
    };
    let (sin, cos) = angle.sin_cos();
    [radius * cos, radius * sin]
}

/// A unit vector of the hemisphere z ≥ 0, its density proportional to the cosine with z
/// ([`cosine_hemisphere_pdf`]): a uniform point of the disk below it, lifted (Malley's method).
#[must_use]
#[inline]
pub fn cosine_hemisphere(xi: [f32; 2]) -> Vector3<f64> {
    let [x, y] = uniform_disk(xi);
    Vector3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt())
}

/// The density of [`cosine_hemisphere`] per unit of solid angle at a direction whose cosine with
/// the pole is `cosine`; 0 below the horizon.
#[must_use]
#[inline]
pub fn cosine_hemisphere_pdf(cosine: f64) -> f64 {
    cosine.max(0.0) * FRAC_1_PI
}

/// A unit vector, uniform over all directions: by Archimedes the height of a uniform point on a
/// sphere is uniform.
#[must_use]
#[inline]
pub fn uniform_sphere([x0, x1]: [f32; 2]) -> Vector3<f64> {
    let z = 1.0 - 2.0 * f64::from(x0);
    let ring = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = (2.0 * PI * f64::from(x1)).sin_cos();
    Vector3::new(ring * cos, ring * sin, z)
}

/// The barycentric weights of the second and third corner of a uniform point of a triangle: the
/// square is folded onto one half, without a square root (Heitz, "A Low-Distortion Map Between
/// Triangle and Square", 2019).
#[must_use]
#[inline]
pub fn uniform_triangle(xi: [f32; 2]) -> [f64; 2] {
    fold(xi.map(f64::from))
}

/// [`uniform_triangle`] from numbers that were stretched already.
#[inline]
pub(crate) fn fold([a, b]: [f64; 2]) -> [f64; 2] {
    if a < b {
        [a / 2.0, b - a / 2.0]
    } else {
        [a - b / 2.0, b / 2.0]
    }
}

/// Which of some parts a number in `[0, 1)` falls into, each as likely as its weight, and the number
/// stretched to `[0, 1)` again. The weights must add up to more than 0; a part without weight is
/// never chosen.
#[must_use]
pub(crate) fn choose(xi: f64, weights: impl Iterator<Item = f64> + Clone) -> (usize, f64) {
    let total: f64 = weights.clone().sum();
    let mut left = xi * total;
    let mut last = (0, 0.0);
    for (part, weight) in weights.enumerate().filter(|&(_, weight)| weight > 0.0) {
        if left < weight {
            return (part, left / weight);
        }
        left -= weight;
        last = (part, 1.0_f64.next_down());
    }
    // Rounding carried the number past the end.
    last
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNT: usize = 1 << 18;

    /// Points that fill the square evenly and lie on no lattice: the additive recurrence with the
    /// plastic number.
    fn spread() -> impl Iterator<Item = [f32; 2]> {
        let steps = [0.754_877_666_246_693, 0.569_840_290_998_053];
        (0..COUNT).map(move |i| steps.map(|step| (0.5 + i as f64 * step).fract() as f32))
    }

    /// The shares of the points that fall into each of `N` bins, against what they should be.
    fn assert_shares<const N: usize>(bin: impl Fn([f32; 2]) -> usize, expected: [f64; N]) {
        let mut counts = [0_usize; N];
        for xi in spread() {
            counts[bin(xi)] += 1;
        }
        for (i, (count, share)) in counts.into_iter().zip(expected).enumerate() {
            let found = count as f64 / COUNT as f64;
            assert!(
                (found - share).abs() < 2e-4,
                "bin {i}: {found}, not {share}"
            );
        }
    }

    fn octant(x: f64, y: f64) -> usize {
        ((y.atan2(x) / (2.0 * PI) + 1.0).fract() * 8.0) as usize % 8
    }

    #[test]
    fn the_disk_is_filled_evenly() {
        assert_shares::<32>(
            |xi| {
                let [x, y] = uniform_disk(xi);
                octant(x, y) * 4 + (((x * x + y * y) * 4.0) as usize).min(3)
            },
            [1.0 / 32.0; 32],
        );
        assert_eq!(uniform_disk([0.5, 0.5]), [0.0, 0.0]);
    }

    #[test]
    fn the_sphere_is_covered_evenly() {
        assert_shares::<32>(
            |xi| {
                let w = uniform_sphere(xi);
                octant(w.x, w.y) * 4 + (((w.z + 1.0) * 2.0) as usize).min(3)
            },
            [UNIFORM_SPHERE_PDF * 4.0 * PI / 32.0; 32],
        );
    }

    #[test]
    fn the_hemisphere_follows_the_cosine() {
        // Between heights a and b the density integrates to b² − a².
        let share = |i: usize| {
            let (a, b) = (i as f64 / 8.0, (i + 1) as f64 / 8.0);
            let middle = cosine_hemisphere_pdf((a + b) / 2.0);
            middle * 2.0 * PI * (b - a)
        };
        assert_shares::<8>(
            |xi| ((cosine_hemisphere(xi).z * 8.0) as usize).min(7),
            std::array::from_fn(share),
        );
        assert_eq!(cosine_hemisphere_pdf(-0.5), 0.0);
    }

    #[test]
    fn the_triangle_is_filled_evenly() {
        // Cut into 16 equal triangles: rows and columns of quarters, upper and lower halves.
        let mut counts = std::collections::BTreeMap::new();
        for xi in spread() {
            let [u, v] = uniform_triangle(xi);
            assert!(u >= 0.0 && v >= 0.0 && u + v <= 1.0);
            let (i, j) = ((u * 4.0) as usize, (v * 4.0) as usize);
            let upper = (u * 4.0).fract() + (v * 4.0).fract() > 1.0;
            *counts.entry((i, j, upper)).or_insert(0_usize) += 1;
        }
        let whole: Vec<_> = counts.values().filter(|&&count| count > 1000).collect();
        assert_eq!(whole.len(), 16);
        for count in whole {
            let share = *count as f64 * 16.0 / COUNT as f64;
            assert!((share - 1.0).abs() < 5e-3, "{share}");
        }
    }

    #[test]
    fn a_part_without_weight_is_never_chosen() {
        let weights = [0.0, 1.0, 0.0, 3.0, 0.0];
        for (xi, part) in [
            (0.0, 1),
            (0.24, 1),
            (0.26, 3),
            (1.0_f64.next_down(), 3),
            (1.0, 3),
        ] {
            let (chosen, rest) = choose(xi, weights.into_iter());
            assert_eq!(chosen, part, "{xi}");
            assert!((0.0..1.0).contains(&rest));
        }
    }
}
