//! Independent random numbers.

use super::{hash, unit};

/// Two numbers from 64 random bits.
#[inline]
pub(super) fn pair(key: u64, index: u32) -> [f32; 2] {
    let bits = hash::step(key, index);
    [unit(bits as u32), unit((bits >> 32) as u32)]
}
