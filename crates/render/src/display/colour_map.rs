//! Numbers as colours.

use ombra_scene::Rgb;

/// From few to many, encoded for a screen: night blue, blue, violet, red, orange, yellow, pale
/// yellow. The lightness rises evenly, so that the map can be read in grey and by the colour-blind.
const HEAT: [[f32; 3]; 7] = [
    [0.015, 0.02, 0.12],
    [0.17, 0.07, 0.42],
    [0.46, 0.07, 0.54],
    [0.74, 0.18, 0.42],
    [0.93, 0.37, 0.22],
    [0.99, 0.64, 0.11],
    [0.98, 0.95, 0.62],
];

/// The colour of a fraction, from dark (0) to light (1); what is outside is taken as the nearer end,
/// NaN as 0.
#[must_use]
pub fn heat(fraction: f32) -> Rgb {
    let fraction = if fraction.is_nan() { 0.0 } else { fraction };
    let place = fraction.clamp(0.0, 1.0) * (HEAT.len() - 1) as f32;
    let from = (place as usize).min(HEAT.len() - 2);
    let way = place - from as f32;
    let mixed = std::array::from_fn(|i| HEAT[from][i] + (HEAT[from + 1][i] - HEAT[from][i]) * way);
    Rgb::from_srgb(mixed)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CIE 1976 L*, from linear sRGB.
    fn lightness(colour: Rgb) -> f32 {
        let y = 0.2126 * colour.r + 0.7152 * colour.g + 0.0722 * colour.b;
        if y > 0.008_856 {
            116.0 * y.cbrt() - 16.0
        } else {
            903.3 * y
        }
    }

    #[test]
    fn more_is_lighter_at_an_even_pace() {
        let steps: Vec<f32> = (0..=48).map(|i| lightness(heat(i as f32 / 48.0))).collect();
        let mean = (steps[48] - steps[0]) / 48.0;
        for pair in steps.windows(2) {
            let step = pair[1] - pair[0];
            assert!(
                step > 0.4 * mean && step < 1.8 * mean,
                "{step} where the mean is {mean}"
            );
        }
    }

    #[test]
    fn what_is_outside_takes_the_nearer_end() {
        assert_eq!(heat(f32::NAN), heat(0.0));
        assert_eq!(heat(-1.0), heat(0.0));
        assert_eq!(heat(f32::INFINITY), heat(1.0));
    }
}
