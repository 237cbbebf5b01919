//! Angles as parts of a full turn.

/// The angle of (x, y) from +x towards +y as a part of a full turn, in `[0, 1]`.
#[inline]
pub(super) fn turn(x: f64, y: f64) -> f32 {
    let (flat, steep) = (x.abs(), y.abs());
    let (less, more) = if flat < steep {
        (flat, steep)
    } else {
        (steep, flat)
    };
    if more == 0.0 {
        return 0.0;
    }
    let ratio = less / more;
    let octant = ratio * arc(ratio * ratio);
    let quarter = if flat < steep { 0.25 - octant } else { octant };
    let half = if x < 0.0 { 0.5 - quarter } else { quarter };
    (if y < 0.0 { 1.0 - half } else { half }) as f32
}

/// arctan(√z) / (2 π √z) for z in `[0, 1]`, within 3 · 10⁻⁹ of it: less than single precision tells
/// apart. It interpolates at the zeros of a Chebyshev polynomial, and is half of what the library's
/// `atan2` costs, whose last bits differ between systems besides.
#[inline]
fn arc(z: f64) -> f64 {
    let z2 = z * z;
    let z4 = z2 * z2;
    let a = 0.159_154_942_701_332_1 - 0.053_051_566_468_073_935 * z;
    let b = 0.031_828_172_594_980_816 - 0.022_697_999_474_364_315 * z;
    let c = 0.017_411_867_435_580_25 - 0.013_324_553_609_161_996 * z;
    let d = 0.009_145_609_275_440_164 - 0.004_888_843_378_482_761 * z;
    let e = 0.001_699_889_294_141_030_3 - 0.000_277_518_656_002_937_65 * z;
    a + b * z2 + (c + d * z2) * z4 + e * (z4 * z4)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    #[test]
    fn it_is_the_angle_of_the_library() {
        for i in -3000..3000 {
            let angle = PI * f64::from(i) / 1500.0 + 1e-4;
            for length in [1e-150, 0.3, 1e150] {
                let (y, x) = angle.sin_cos();
                let right = y.atan2(x) / (2.0 * PI);
                let right = if right < 0.0 { right + 1.0 } else { right };
                let found = f64::from(turn(length * x, length * y));
                assert!((found - right).abs() < 3.5e-8, "{found} {right}");
            }
        }
    }

    #[test]
    fn near_an_axis_it_is_as_fine_as_the_number() {
        for x in [1e-3, 1e-10, 1e-40] {
            let found = f64::from(turn(1.0, x));
            let right = x.atan() / (2.0 * PI);
            assert!((found / right - 1.0).abs() < 1e-6 || right < 1e-38, "{x}");
        }
    }

    #[test]
    fn along_the_axes_it_is_exact() {
        let found = [
            (1.0, 0.0),
            (0.0, 2.0),
            (-3.0, 0.0),
            (0.0, -4.0),
            (1.0, -0.0),
            (1.0, 1.0),
        ];
        let found = found.map(|(x, y)| turn(x, y));
        assert_eq!(found, [0.0, 0.25, 0.5, 0.75, 0.0, 0.125]);
        assert_eq!(turn(0.0, 0.0), 0.0);
        assert!(turn(f64::NAN, 1.0).is_nan());
    }
}
