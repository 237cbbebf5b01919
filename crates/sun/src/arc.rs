//! A few minutes of the sun's way, as a conic.

use crate::position::DAY;
use crate::{Instant, Sky};

/// A piece of the sun's way across the sky. At the share u of its time, 0 to 1, the sun stands in
/// the direction (1-u) `from` + u `to` + u(1-u) `bulge`, which need not be of unit length.
///
/// The sun circles the pole at an even rate, on a cone. A quadratic in u has nine coefficients, of
/// which the two ends and the middle, where the arc meets the true sun exactly, take all but the
/// relative lengths of the three vectors. Their choice moves the sun along its way in between, so
/// it is where accuracy in time is won: with the cone itself (the middle shortened by cos²(θ/2), θ
/// half the arc's turn) u runs ahead of the time by 0.03 θ³, 25 ms in arcs of 18 minutes. Here the
/// middle is shortened less, by (3 + τ²)/(3 + 3τ²) with τ = tan(θ/2), which makes the quarters of
/// the arc right in time as well. The error left is of the order θ⁴: it is across the sun's way,
/// about 0.01 θ⁴ sin δ cos δ, a tenth of a millisecond's worth in arcs of 18 minutes.
///
/// The bulge then is orthogonal to the chord but for the drift of the declination and refraction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// When it begins: seconds, as [`Instant`] counts them.
    pub start: f64,
    /// When it ends.
    pub end: f64,
    /// The unit vector to the sun at the start: (east, north, up).
    pub from: [f64; 3],
    /// The unit vector at the end.
    pub to: [f64; 3],
    /// What bends the chord between the two.
    pub bulge: [f64; 3],
}

impl Arc {
    /// The arc between two instants, at which the sun is at `from` and `to`.
    pub(crate) fn between(sky: &Sky, start: f64, end: f64, from: [f64; 3], to: [f64; 3]) -> Self {
        let middle = sky.direction(Instant::from_seconds(0.5 * (start + end)));
        let half_turn = std::f64::consts::PI * (end - start) / DAY;
        let tau2 = (0.5 * half_turn).tan().powi(2);
        let length = (3.0 + tau2) / (3.0 + 3.0 * tau2);
        let bulge = std::array::from_fn(|i| 4.0 * length * middle[i] - 2.0 * (from[i] + to[i]));
        Self {
            start,
            end,
            from,
            to,
            bulge,
        }
    }

    /// The direction at a share of the arc's time, not of unit length.
    #[must_use]
    pub fn direction(&self, share: f64) -> [f64; 3] {
        let u = share;
        std::array::from_fn(|i| {
            (1.0 - u) * self.from[i] + u * self.to[i] + u * (1.0 - u) * self.bulge[i]
        })
    }

    /// The rate of the azimuth times the square of the distance from the vertical, in radians an
    /// arc: positive clockwise, and smooth even through the zenith.
    pub(crate) fn areal_speed(&self, share: f64) -> f64 {
        let at = self.direction(share);
        let slope = |i: usize| self.to[i] - self.from[i] + (1.0 - 2.0 * share) * self.bulge[i];
        slope(0) * at[1] - at[0] * slope(1)
    }
}
