//! How far two pictures agree in colour.

use crate::Film;

/// How far two pictures agree in colour, in steps of an eight-bit file (sRGB, 0 to 255).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ColourAgreement {
    /// How many pixels were compared.
    pub pixels: u64,
    /// Where all three channels are the same.
    pub equal: u64,
    /// Where none differs by more than one step.
    pub within_one: u64,
    /// The mean difference of a channel.
    pub mean: f64,
    /// The largest difference of a channel.
    pub largest: u8,
}

impl ColourAgreement {
    /// Compares two films of the same size.
    #[must_use]
    pub fn of(one: &Film, other: &Film) -> Self {
        let (one, other) = (eight_bits(one), eight_bits(other));
        let mut agreement = Self::default();
        let mut sum = 0;
        for (a, b) in one.iter().zip(&other) {
            let steps = [0, 1, 2].map(|k| a[k].abs_diff(b[k]));
            let largest = steps.into_iter().fold(0, u8::max);
            agreement.pixels += 1;
            agreement.equal += u64::from(largest == 0);
            agreement.within_one += u64::from(largest <= 1);
            agreement.largest = agreement.largest.max(largest);
            sum += steps.map(u64::from).iter().sum::<u64>();
        }
        agreement.mean = sum as f64 / (3 * agreement.pixels.max(1)) as f64;
        agreement
    }
}

/// What an eight-bit file of the picture holds, row by row from the top.
#[must_use]
pub fn eight_bits(film: &Film) -> Vec<[u8; 3]> {
    let encode = |x: f32| (x * 255.0).round() as u8;
    let pixels = film.display().into_iter();
    pixels.map(|pixel| pixel.to_srgb().map(encode)).collect()
}
