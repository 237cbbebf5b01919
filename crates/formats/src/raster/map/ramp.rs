//! From sun to shadow in colours.
//!
//! The ramp is a curve through Oklab (Ottosson 2020), in which equal distances look about equally
//! different: lightness falls in a straight line from cream (sun) to dark violet (long shadow), over
//! green and blue. Lightness alone orders the values, so that the map reads the same to the
//! colour-blind and on a grey print; the hues run from yellow to blue, which all common kinds of
//! colour blindness tell apart.

use super::Scale;
use super::canvas::Colour;

/// Corners of a cubic Bézier curve in Oklab: lightness, green to red, blue to yellow. Lightness is in
/// even steps. Within sRGB all along; the longest step is 1.12 times the shortest.
const CURVE: [[f32; 3]; 4] = [
    [0.975, -0.012, 0.055],
    [0.735, -0.130, 0.000],
    [0.495, 0.020, -0.190],
    [0.255, 0.045, -0.105],
];

/// The colour of a fraction of the longest shadow, clipped to 0 to 1.
pub(super) fn colour(fraction: f32) -> Colour {
    to_srgb(oklab(fraction.clamp(0.0, 1.0)))
}

/// Shadow that is lost, none, and shadow that is new, in Oklab. Orange and blue are told apart by the colour-blind, too.
const CHANGE: [[f32; 3]; 3] = [[0.66, 0.10, 0.12], [1.0, 0.0, 0.0], [0.38, 0.0, -0.16]];

/// Sun, shadow, shadow that is new, and shadow that is gone, of one moment.
pub(super) const STATES: [Colour; 4] = [
    [250, 244, 219],
    [98, 98, 120],
    [38, 84, 214],
    [236, 140, 60],
];

/// The number of the last one.
pub(super) const LAST_STATE: f32 = 3.0;

/// How far along the ramp of a scale a fraction of its largest value lies, from 0 to 1.
pub(super) fn along(scale: Scale, fraction: f32) -> f32 {
    match scale {
        Scale::Shadow => fraction.clamp(0.0, 1.0),
        Scale::Change => 0.5 + 0.5 * fraction.clamp(-1.0, 1.0),
        Scale::Moment | Scale::MomentOfChange => fraction.clamp(0.0, 1.0),
    }
}

/// The colour so far along the ramp of a scale.
pub(super) fn of(scale: Scale, along: f32) -> Colour {
    match scale {
        Scale::Shadow => colour(along),
        Scale::Moment | Scale::MomentOfChange => STATES[(along * LAST_STATE).round() as usize],
        Scale::Change => {
            let [lost, none, new] = CHANGE;
            let fraction = 2.0 * along - 1.0;
            let end = if fraction < 0.0 { lost } else { new };
            let size = match fraction.abs().min(1.0) {
                0.0 => 0.0,
                // So much at least that the least change is seen.
                size => 0.12 + 0.88 * size,
            };
            to_srgb([0, 1, 2].map(|k| none[k] + size * (end[k] - none[k])))
        }
    }
}

fn oklab(t: f32) -> [f32; 3] {
    let u = 1.0 - t;
    let weights = [u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t];
    let mut sum = [0.0; 3];
    for (corner, weight) in CURVE.iter().zip(weights) {
        for (s, c) in sum.iter_mut().zip(corner) {
            *s += weight * c;
        }
    }
    sum
}

fn linear([lightness, a, b]: [f32; 3]) -> [f32; 3] {
    let cones = [
        lightness + 0.396_337_78 * a + 0.215_803_76 * b,
        lightness - 0.105_561_35 * a - 0.063_854_17 * b,
        lightness - 0.089_484_18 * a - 1.291_485_5 * b,
    ];
    let [l, m, s] = cones.map(|c| c * c * c);
    [
        4.076_741_7 * l - 3.307_711_6 * m + 0.230_969_93 * s,
        -1.268_438 * l + 2.609_757_4 * m - 0.341_319_4 * s,
        -0.004_196_086_3 * l - 0.703_418_6 * m + 1.707_614_7 * s,
    ]
}

fn to_srgb(oklab: [f32; 3]) -> Colour {
    let [r, g, b] = linear(oklab);
    let screen = ombra_scene::Rgb::new(r, g, b).to_srgb();
    screen.map(|x| (x * 255.0).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_look_alike_and_every_one_is_darker() {
        let along: Vec<_> = (0..=64).map(|i| oklab(i as f32 / 64.0)).collect();
        let distance = |p: &[[f32; 3]]| {
            let d = |i: usize| (p[1][i] - p[0][i]).powi(2);
            (d(0) + d(1) + d(2)).sqrt()
        };
        let steps: Vec<f32> = along.windows(2).map(distance).collect();
        let longest = steps.iter().copied().fold(0.0, f32::max);
        let shortest = steps.iter().copied().fold(1.0, f32::min);
        assert!(longest < 1.2 * shortest, "{shortest} to {longest}");
        assert!(along.is_sorted_by(|a, b| a[0] > b[0]));
    }

    #[test]
    fn every_colour_is_one_that_a_screen_has() {
        for i in 0..=256 {
            let rgb = linear(oklab(i as f32 / 256.0));
            assert!(rgb.iter().all(|x| (-1e-4..=1.0001).contains(x)), "{rgb:?}");
        }
    }

    #[test]
    fn change_is_white_where_there_is_none_and_has_a_hue_a_way() {
        let at = |fraction| of(Scale::Change, along(Scale::Change, fraction));
        assert_eq!(at(0.0), [255; 3]);
        for size in [0.01, 0.3, 1.0, 5.0] {
            let ([r, _, b], [u, _, w]) = (at(size), at(-size));
            assert!(b > r && u > w, "{size}");
        }
        for end in CHANGE {
            let rgb = linear(end);
            assert!(rgb.iter().all(|x| (-1e-3..=1.001).contains(x)), "{rgb:?}");
        }
    }

    #[test]
    fn the_ends_are_light_and_dark_and_nothing_lies_beyond() {
        let [r, g, b] = colour(0.0);
        assert!(r > 240 && g > 240 && b > 190);
        assert!(colour(1.0).iter().all(|&x| x < 100));
        assert_eq!(colour(-1.0), colour(0.0));
        assert_eq!(colour(9.0), colour(1.0));
    }
}
