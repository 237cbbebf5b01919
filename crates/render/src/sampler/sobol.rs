//! Owen-scrambled Sobol points, scrambled by a hash: Burley, "Practical Hash-based Owen Scrambling",
//! JCGT 9(4), 2020.
//!
//! The first two Sobol dimensions make a (0, 2)-sequence: of the first 2ᵏ points each of the 2ᵏ
//! boxes of any one shape (2⁻ᵃ × 2⁻ᵇ, a + b = k) holds exactly one. Owen scrambling keeps that and
//! makes the points uniform and, with other keys, independent. Further pairs of dimensions are the
//! same two, in another order (Burley's "padding").

use super::{hash, unit};

/// Point `index` of the sequence that belongs to `key`.
#[inline]
pub(super) fn pair(key: u64, index: u32) -> [f32; 2] {
    let more = hash::mix(key);
    // An Owen scramble of the index is a permutation that keeps each aligned run of 2ᵏ indices
    // together: the points come in another order, evenly spread all the same.
    let index = scramble(index.reverse_bits(), key as u32).reverse_bits();
    let x = scramble(index, (key >> 32) as u32).reverse_bits();
    let y = scramble(pascal(index), more as u32).reverse_bits();
    [unit(x), unit(y)]
}

/// The second Sobol dimension with its bits in reverse order; the first is the index itself.
///
/// Its generator matrix is Pascal's triangle modulo 2: binary digit j of the point is the sum of
/// those bits i of the index for which C(i, j) is odd, that is, for which j is a part of i as a set
/// of binary digits (Lucas). Such a sum over supersets takes one step for each digit of i.
#[inline]
const fn pascal(index: u32) -> u32 {
    let index = index ^ (index >> 16 & 0x0000_ffff);
    let index = index ^ (index >> 8 & 0x00ff_00ff);
    let index = index ^ (index >> 4 & 0x0f0f_0f0f);
    let index = index ^ (index >> 2 & 0x3333_3333);
    index ^ (index >> 1 & 0x5555_5555)
}

/// An Owen scramble of a number whose bits are in reverse order: each bit is flipped or not by a
/// hash of the bits below it. Multiplication carries upward only, which is why this has that form:
/// Laine, Karras, "Stratified Sampling for Stochastic Transparency", EGSR 2011, section 3.1, with
/// the constants that Vegdahl found ("Building a Better LK Hash", 2021).
#[inline]
const fn scramble(reversed: u32, seed: u32) -> u32 {
    let x = reversed;
    let x = x ^ x.wrapping_mul(0x3d20_adea);
    let x = x.wrapping_add(seed);
    let x = x.wrapping_mul(seed >> 16 | 1);
    let x = x ^ x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Kollig, Keller, "Efficient Multidimensional Sampling", Eurographics 2002, appendix.
    fn second_dimension(mut index: u32) -> u32 {
        let mut direction = 1_u32 << 31;
        let mut point = 0;
        while index > 0 {
            if index & 1 == 1 {
                point ^= direction;
            }
            index >>= 1;
            direction ^= direction >> 1;
        }
        point
    }

    #[test]
    fn the_steps_make_the_sobol_matrix() {
        for i in 0..1000_u32 {
            let index = i.wrapping_mul(0x9e37_79b9) >> (i % 32);
            assert_eq!(pascal(index).reverse_bits(), second_dimension(index));
        }
    }

    #[test]
    fn a_scramble_only_looks_at_lower_bits() {
        for seed in [0, 1, 0xdead_beef, u32::MAX] {
            for bit in 0..32 {
                let x = hash::mix(u64::from(seed) + bit) as u32;
                let changed = scramble(x, seed) ^ scramble(x ^ 1 << bit, seed);
                assert_eq!(u64::from(changed.trailing_zeros()), bit);
            }
        }
    }
}
