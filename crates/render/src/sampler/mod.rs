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

    /// The name that a person types.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sobol => "sobol",
            Self::Independent => "independent",
        }
    }
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
    /// The place on a light that has an area.
    Light,
}

impl Dimension {
    /// All of them.
    pub const ALL: &[Self] = &[Self::Pixel, Self::Lens, Self::Hemisphere, Self::Light];

    /// Whether the only sample of a pixel takes the middle: of the pixel, the lens, the light.
    const fn has_middle(self) -> bool {
        !matches!(self, Self::Hemisphere)
    }
}

/// All the numbers of one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Numbers {
    kind: SamplerKind,
    /// Seed and pixel.
    key: u64,
    /// Of one sample a pixel, which goes through the middle of things.
    centred: bool,
}

impl Numbers {
    /// The numbers of a pixel.
    #[must_use]
    #[inline]
    pub fn new(kind: SamplerKind, seed: u64, [x, y]: [u32; 2]) -> Self {
        let pixel = u64::from(x) | u64::from(y) << 32;
        let key = mix(mix(seed) ^ pixel);
        Self {
            kind,
            key,
            centred: false,
        }
    }

    /// The same where a pixel has but one sample: it goes through the middle of the pixel, of the lens
    /// and of lights that have an area.
    #[must_use]
    #[inline]
    pub const fn centred(self) -> Self {
        Self {
            centred: true,
            ..self
        }
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
        self.of_key(dimension, hash::step(self.numbers.key, dimension as u32))
    }

    /// The same for what a sample needs more than one pair of: `branch` tells rays apart, `n` what is
    /// done where they end.
    #[must_use]
    #[inline]
    pub fn nth_pair(&self, dimension: Dimension, branch: u64, n: u32) -> [f32; 2] {
        let key = hash::step(self.numbers.key, dimension as u32);
        self.of_key(dimension, hash::step(mix(key ^ branch), n))
    }

    #[inline]
    fn of_key(&self, dimension: Dimension, key: u64) -> [f32; 2] {
        if self.numbers.centred && dimension.has_middle() {
            return [0.5; 2];
        }
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
