//! Bits that look random.

/// Scrambles 64 bits, one to one: the finalizer of SplitMix64 (Steele, Lea, Flood, "Fast Splittable
/// Pseudorandom Number Generators", OOPSLA 2014) with the constants of Stafford's variant 13.
#[inline]
pub(super) const fn mix(bits: u64) -> u64 {
    let bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ bits >> 31
}

/// The state of SplitMix64 that starts at `key`, `index + 1` steps on, scrambled.
#[inline]
pub(super) const fn step(key: u64, index: u32) -> u64 {
    /// 2⁶⁴ over the golden ratio, made odd.
    const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
    mix(key.wrapping_add(GOLDEN.wrapping_mul(index as u64 + 1)))
}
