//! Where in a pixel, on the lens, over the hemisphere: the numbers behind a sample.
//!
//! A number is a function of (seed, pixel, sample index, dimension) and of nothing else: no state
//! is carried along, so pixels can be rendered in any order and samples taken up again later.

mod hash;
mod independent;
mod sobol;

use hash::mix;

/// How samples are spread.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SamplerKind {
    /// Owen-scrambled Sobol points: each run of 2ᵏ samples of a pixel is spread as evenly as can be.
    #[default]
    Sobol,
    /// Independent random numbers: the plainest, and the noisiest.
    Independent,
}

impl SamplerKind {
    /// All of them, the default first.
    pub const ALL: &[Self] = &[Self::Sobol, Self::Independent];
}

/// What a pair of numbers is for. Pairs for different ends are independent of one another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Dimension {
    /// The place in the pixel.
    Pixel,
    /// The place on the lens.
    Lens,
    /// The direction over the hemisphere at the first hit.
    Hemisphere,
}

impl Dimension {
    /// All of them.
    pub const ALL: &[Self] = &[Self::Pixel, Self::Lens, Self::Hemisphere];
}

/// All the numbers of one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Numbers {
    kind: SamplerKind,
    /// Seed and pixel.
    key: u64,
}

impl Numbers {
    /// The numbers of a pixel.
    #[must_use]
    #[inline]
    pub fn new(kind: SamplerKind, seed: u64, [x, y]: [u32; 2]) -> Self {
        let pixel = u64::from(x) | u64::from(y) << 32;
        let key = mix(mix(seed) ^ pixel);
        Self { kind, key }
    }

    /// Those of one sample.
    #[must_use]
    #[inline]
    pub fn sample(self, index: u32) -> Sample {
        Sample {
            numbers: self,
            index,
        }
    }
}

/// All the numbers of one sample of one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample {
    numbers: Numbers,
    index: u32,
}

impl Sample {
    /// Two numbers in `[0, 1)`, uniform over the square.
    #[must_use]
    #[inline]
    pub fn pair(&self, dimension: Dimension) -> [f32; 2] {
        let key = hash::step(self.numbers.key, dimension as u32);
        match self.numbers.kind {
            SamplerKind::Sobol => sobol::pair(key, self.index),
            SamplerKind::Independent => independent::pair(key, self.index),
        }
    }
}

/// The upper 24 bits as a number in `[0, 1)`: as many as single precision keeps apart evenly.
#[inline]
fn unit(bits: u32) -> f32 {
    const STEP: f32 = 1.0 / 16_777_216.0;
    (bits >> 8) as f32 * STEP
}

#[cfg(test)]
mod tests;
