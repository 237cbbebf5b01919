//! Numbers side by side, at each level of instructions: what the kernel is written in.
//!
//! No operation is fused with another one and all are those of IEEE 754, so that every level gives the
//! same bits.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod pair;
mod portable;
#[cfg(test)]
mod tests;

pub(crate) use pair::Pair;
pub(crate) use portable::Portable;
#[cfg(target_arch = "x86_64")]
pub(crate) use {avx2::Avx2, avx512::Avx512};

/// Which lanes fulfil something.
pub(crate) trait Mask: Copy {
    /// Both.
    ///
    /// # Safety
    /// - The processor has the instructions; so everywhere in this module.
    unsafe fn and(self, other: Self) -> Self;

    /// One of both, or both.
    ///
    /// # Safety
    /// - As above.
    unsafe fn or(self, other: Self) -> Self;

    /// This and not the other.
    ///
    /// # Safety
    /// - As above.
    unsafe fn and_not(self, other: Self) -> Self;

    /// Bit k: lane k.
    ///
    /// # Safety
    /// - As above.
    unsafe fn bits(self) -> u32;
}

/// Eight or sixteen numbers.
pub(crate) trait Lanes: Copy {
    type Mask: Mask;

    /// How many.
    const COUNT: usize;

    /// One number in all lanes.
    ///
    /// # Safety
    /// - The processor has the instructions; so everywhere below.
    unsafe fn splat(x: f32) -> Self;

    /// From memory.
    ///
    /// # Safety
    /// - `COUNT` numbers may be read at `from`.
    unsafe fn load(from: *const f32) -> Self;

    /// To memory.
    ///
    /// # Safety
    /// - `COUNT` numbers may be written at `to`.
    unsafe fn store(self, to: *mut f32);

    /// The sum.
    ///
    /// # Safety
    /// - As above; so below.
    unsafe fn plus(self, other: Self) -> Self;

    /// The difference.
    ///
    /// # Safety
    /// - As above.
    unsafe fn minus(self, other: Self) -> Self;

    /// The product.
    ///
    /// # Safety
    /// - As above.
    unsafe fn times(self, other: Self) -> Self;

    /// The quotient.
    ///
    /// # Safety
    /// - As above.
    unsafe fn over(self, other: Self) -> Self;

    /// The square root; NaN of what is below 0.
    ///
    /// # Safety
    /// - As above.
    unsafe fn root(self) -> Self;

    /// The smaller one; the other one if either is NaN, or both are zeros.
    ///
    /// # Safety
    /// - As above.
    unsafe fn smaller(self, other: Self) -> Self;

    /// The larger one; the other one if either is NaN, or both are zeros.
    ///
    /// # Safety
    /// - As above.
    unsafe fn larger(self, other: Self) -> Self;

    /// Where this is below the other.
    ///
    /// # Safety
    /// - As above.
    unsafe fn below(self, other: Self) -> Self::Mask;

    /// This where the mask says so, and the other elsewhere.
    ///
    /// # Safety
    /// - As above.
    unsafe fn or_where_not(self, mask: Self::Mask, other: Self) -> Self;

    /// Without the sign.
    ///
    /// # Safety
    /// - As above.
    unsafe fn size(self) -> Self;
}
