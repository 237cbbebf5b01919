//! Eight numbers in two vectors of four: for processors whose vectors have 128 bits.
//!
//! What such a processor does in one instruction is a function of [`Four`], [`Words`] or [`Two`]; all
//! else is written once over these ([`Halves`], [`HalvesWide`]). They are there twice: as the
//! instructions of NEON, and as a twin of those in arrays, which every machine can test.

mod halves;
#[cfg(target_arch = "aarch64")]
mod neon;
#[cfg(debug_assertions)]
mod twin;
mod wide;

use halves::Halves;
use wide::HalvesWide;

/// The lanes with NEON.
#[cfg(target_arch = "aarch64")]
pub(crate) type Neon = Halves<neon::NeonFour>;

/// The same lanes without its instructions.
#[cfg(debug_assertions)]
pub(crate) type NeonTwin = Halves<twin::TwinFour>;

/// Four single-precision numbers.
pub(crate) trait Four: Copy {
    /// As many words of 32 bits.
    type Words: Words;
    /// Half as many doubles.
    type Two: Two<Self>;

    /// # Safety
    /// - The processor has the level's instructions; so for all functions here.
    unsafe fn splat(x: f32) -> Self;

    /// # Safety
    /// - Four numbers may be read at `from`.
    unsafe fn load(from: *const f32) -> Self;

    /// # Safety
    /// - Four numbers may be written at `to`.
    unsafe fn store(self, to: *mut f32);

    /// # Safety
    /// - See [`splat`](Self::splat); so below.
    unsafe fn minus(self, other: Self) -> Self;

    /// # Safety
    /// - As above.
    unsafe fn times(self, other: Self) -> Self;

    /// # Safety
    /// - As above.
    unsafe fn over(self, other: Self) -> Self;

    /// `self · factor + addend`, rounded once.
    ///
    /// # Safety
    /// - As above.
    unsafe fn multiply_add(self, factor: Self, addend: Self) -> Self;

    /// All bits set where a number is below the other one; none where one is NaN.
    ///
    /// # Safety
    /// - As above.
    unsafe fn below(self, other: Self) -> Self::Words;

    /// All bits set where a number is not above the other one; none where one is NaN.
    ///
    /// # Safety
    /// - As above.
    unsafe fn at_most(self, other: Self) -> Self::Words;

    /// Each number where all bits are set in `which`, the other one where none is.
    ///
    /// # Safety
    /// - As above.
    unsafe fn where_set(self, which: Self::Words, other: Self) -> Self;

    /// The same bits.
    ///
    /// # Safety
    /// - As above.
    unsafe fn bits(self) -> Self::Words;

    /// See [`Lanes::smaller`](super::Lanes::smaller). NEON has instructions for it, but with other
    /// answers where one is NaN, and of zeros.
    ///
    /// # Safety
    /// - As above.
    #[inline(always)]
    unsafe fn smaller(self, other: Self) -> Self {
        // SAFETY: the caller's promise.
        unsafe { self.where_set(self.below(other), other) }
    }

    /// See [`Lanes::larger`](super::Lanes::larger).
    ///
    /// # Safety
    /// - As above.
    #[inline(always)]
    unsafe fn larger(self, other: Self) -> Self {
        // SAFETY: the caller's promise.
        unsafe { self.where_set(other.below(self), other) }
    }
}

/// Four words of 32 bits.
pub(crate) trait Words: Copy {
    /// # Safety
    /// - As for [`Four`]; so below.
    unsafe fn splat(x: u32) -> Self;

    /// # Safety
    /// - Four words may be read at `from`.
    unsafe fn load(from: *const u32) -> Self;

    /// # Safety
    /// - Four words may be written at `to`.
    unsafe fn store(self, to: *mut u32);

    /// # Safety
    /// - As above.
    unsafe fn and(self, other: Self) -> Self;

    /// # Safety
    /// - As above.
    unsafe fn or(self, other: Self) -> Self;

    /// All bits set where the two have one in common.
    ///
    /// # Safety
    /// - As above.
    unsafe fn meets(self, other: Self) -> Self;

    /// Each by as many bits as the other says, below 32.
    ///
    /// # Safety
    /// - As above.
    unsafe fn shifted_right(self, by: Self) -> Self;

    /// `self · factor + addend`, modulo 2³².
    ///
    /// # Safety
    /// - As above.
    unsafe fn multiply_add(self, factor: Self, addend: Self) -> Self;

    /// Of all four, modulo 2³².
    ///
    /// # Safety
    /// - As above.
    unsafe fn sum(self) -> u32;

    /// Of the 32 bytes of two those whose numbers the bytes of `self` are; each is below 32.
    ///
    /// # Safety
    /// - As above.
    unsafe fn bytes_of(self, of: [Self; 2]) -> Self;
}

/// Two double-precision numbers.
pub(crate) trait Two<F: Four>: Copy {
    /// What is answered of each two.
    type Mask: Copy;

    /// # Safety
    /// - As for [`Four`]; so below.
    unsafe fn splat(x: f64) -> Self;

    /// Of four singles the first two.
    ///
    /// # Safety
    /// - As above.
    unsafe fn of_first(four: F) -> Self;

    /// Of four singles the last two.
    ///
    /// # Safety
    /// - As above.
    unsafe fn of_last(four: F) -> Self;

    /// Both rounded to singles.
    ///
    /// # Safety
    /// - As above.
    unsafe fn rounded(first: Self, last: Self) -> F;

    /// # Safety
    /// - As above.
    unsafe fn plus(self, other: Self) -> Self;

    /// # Safety
    /// - As above.
    unsafe fn minus(self, other: Self) -> Self;

    /// # Safety
    /// - As above.
    unsafe fn times(self, other: Self) -> Self;

    /// # Safety
    /// - As above.
    unsafe fn over(self, other: Self) -> Self;

    /// All bits set where a number is below the other one; none where one is NaN.
    ///
    /// # Safety
    /// - As above.
    unsafe fn below(self, other: Self) -> Self::Mask;

    /// Each number where all bits are set in `which`, the other one where none is.
    ///
    /// # Safety
    /// - As above.
    unsafe fn where_set(self, which: Self::Mask, other: Self) -> Self;

    /// Of all bits of 64, or none, as many of 32.
    ///
    /// # Safety
    /// - As above.
    unsafe fn narrowed(first: Self::Mask, last: Self::Mask) -> F::Words;

    /// See [`Four::smaller`].
    ///
    /// # Safety
    /// - As above.
    #[inline(always)]
    unsafe fn smaller(self, other: Self) -> Self {
        // SAFETY: the caller's promise.
        unsafe { self.where_set(self.below(other), other) }
    }

    /// See [`Four::larger`].
    ///
    /// # Safety
    /// - As above.
    #[inline(always)]
    unsafe fn larger(self, other: Self) -> Self {
        // SAFETY: the caller's promise.
        unsafe { self.where_set(other.below(self), other) }
    }
}
