//! Where in a pixel, on the lens, over the hemisphere: the numbers behind a sample.
//!
//! A number is a function of (seed, pixel, sample index, dimension) and of nothing else: no state
//! is carried along, so pixels can be rendered in any order and samples taken up again later.

mod hash;
mod independent;
mod sobol;

use std::fmt;
use std::str::FromStr;

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

    /// What it is, in one line.
    #[must_use]
    pub const fn line(self) -> &'static str {
        match self {
            Self::Sobol => "Owen-scrambled Sobol points, evenly spread at every power of two",
            Self::Independent => "independent random numbers",
        }
    }
}

/// A name that no sampler has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no sampler \"{0}\"; there are: sobol, independent")]
pub struct UnknownSampler(String);

impl FromStr for SamplerKind {
    type Err = UnknownSampler;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .iter()
            .copied()
            .find(|kind| kind.name().eq_ignore_ascii_case(name))
            .ok_or_else(|| UnknownSampler(name.to_owned()))
    }
}

impl fmt::Display for SamplerKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
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
}

impl Dimension {
    /// All of them.
    pub const ALL: &[Self] = &[Self::Pixel, Self::Lens, Self::Hemisphere];
}

/// All the numbers of one sample of one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample {
    kind: SamplerKind,
    /// Seed and pixel.
    key: u64,
    index: u32,
}

impl Sample {
    /// The numbers of sample `index` of a pixel.
    #[must_use]
    #[inline]
    pub fn new(kind: SamplerKind, seed: u64, [x, y]: [u32; 2], index: u32) -> Self {
        let pixel = u64::from(x) | u64::from(y) << 32;
        let key = mix(mix(seed) ^ pixel);
        Self { kind, key, index }
    }

    /// Two numbers in `[0, 1)`, uniform over the square.
    #[must_use]
    #[inline]
    pub fn pair(&self, dimension: Dimension) -> [f32; 2] {
        let key = hash::step(self.key, dimension as u32);
        match self.kind {
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
