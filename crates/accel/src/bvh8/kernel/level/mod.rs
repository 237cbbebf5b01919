//! Eight numbers that go through the same operations, at each level of instructions.
//!
//! A kernel is written once over [`Lanes`]; an entry point a level compiles it with the level's
//! instructions. Which level a machine has is found out once ([`Level::detect`]).

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
#[cfg(any(target_arch = "aarch64", debug_assertions))]
mod fours;
mod portable;
#[cfg(test)]
mod tests;

use super::super::node::Child;

#[cfg(target_arch = "aarch64")]
pub(crate) use fours::Neon;
#[cfg(debug_assertions)]
pub(crate) use fours::NeonTwin;
pub(crate) use portable::Portable;
#[cfg(target_arch = "x86_64")]
pub(crate) use {avx2::Avx2, avx512::Avx512};

/// Eight single-precision numbers, and what a walk does with them: no more than is in use.
///
/// All levels give the same results to the bit but for [`multiply_add`](Self::multiply_add).
pub(crate) trait Lanes: Copy {
    /// The same numbers in double precision.
    type Wide: WideLanes<Self>;

    /// Eight times the same.
    ///
    /// # Safety
    /// - The processor has the level's instructions; so for all functions here.
    unsafe fn splat(x: f32) -> Self;

    /// From memory.
    ///
    /// # Safety
    /// - Eight numbers may be read at `from`.
    unsafe fn load(from: *const f32) -> Self;

    /// Eight bytes as numbers.
    ///
    /// # Safety
    /// - Eight bytes may be read at `from`.
    #[inline(always)]
    unsafe fn load_bytes(from: *const u8) -> Self {
        // SAFETY: the caller's promise.
        unsafe {
            let bytes = from.cast::<[u8; 8]>().read();
            let mut numbers = [0.0; 8];
            for (k, number) in numbers.iter_mut().enumerate() {
                *number = f32::from(bytes[k]);
            }
            Self::load(numbers.as_ptr())
        }
    }

    /// Of sixteen numbers those that eight bytes say; of a byte the lowest four bits count.
    ///
    /// # Safety
    /// - Sixteen numbers may be read at `from`, and eight bytes at `which`.
    #[inline(always)]
    unsafe fn chosen(from: *const f32, which: *const u8) -> Self {
        // SAFETY: the caller's promise.
        unsafe {
            let which = which.cast::<[u8; 8]>().read();
            let mut numbers = [0.0; 8];
            for (k, number) in numbers.iter_mut().enumerate() {
                *number = *from.add(usize::from(which[k] & 15));
            }
            Self::load(numbers.as_ptr())
        }
    }

    /// To memory.
    ///
    /// # Safety
    /// - Eight numbers may be written at `to`.
    unsafe fn store(self, to: *mut f32);

    /// `self − other`.
    ///
    /// # Safety
    /// - See [`splat`](Self::splat); so below.
    unsafe fn minus(self, other: Self) -> Self;

    /// `self · other`.
    ///
    /// # Safety
    /// - As above.
    unsafe fn times(self, other: Self) -> Self;

    /// `self / other`.
    ///
    /// # Safety
    /// - As above.
    unsafe fn over(self, other: Self) -> Self;

    /// To memory, those numbers whose bits are set.
    ///
    /// # Safety
    /// - Eight numbers may be read and written at `to`.
    unsafe fn store_where(self, bits: u32, to: *mut f32);

    /// `self · factor + addend`, rounded once or twice.
    ///
    /// # Safety
    /// - As above.
    unsafe fn multiply_add(self, factor: Self, addend: Self) -> Self;

    /// The smaller of each two; `other`'s where one is NaN or they are equal.
    ///
    /// # Safety
    /// - As above.
    unsafe fn smaller(self, other: Self) -> Self;

    /// The larger of each two; `other`'s where one is NaN or they are equal.
    ///
    /// # Safety
    /// - As above.
    unsafe fn larger(self, other: Self) -> Self;

    /// Bit k: whether number k is not above the other one's; no where one is NaN.
    ///
    /// # Safety
    /// - As above.
    unsafe fn at_most(self, other: Self) -> u32;

    /// Writes the children `k` with `self[k] <= far[k]` and those numbers of `self`, one after the
    /// other in the given [order](super::super::node::Node::order). Bit k of the answer: whether
    /// the one at place k of the order is among them.
    ///
    /// # Safety
    /// - Eight may be read at `children` and written at `to` and at `entries`.
    unsafe fn push(
        self,
        far: Self,
        order: u32,
        children: *const Child,
        to: *mut Child,
        entries: *mut f32,
    ) -> u32;

    /// The same in the order in which they lie, without the numbers. Bit k of the answer: whether
    /// child k is among them.
    ///
    /// # Safety
    /// - Eight may be read at `children` and written at `to`.
    unsafe fn push_unordered(self, far: Self, children: *const Child, to: *mut Child) -> u32;

    /// Of `count` children and their entries keeps those that are not beyond `t_max`, in their order,
    /// and counts them.
    ///
    /// # Safety
    /// - `count` rounded up to eights may be read and written at both.
    unsafe fn keep(children: *mut Child, entries: *mut f32, count: usize, t_max: f32) -> usize;
}

/// Eight double-precision numbers: no more than is in use. All levels give the same results to the
/// bit.
pub(crate) trait WideLanes<L>: Copy {
    /// Of singles.
    ///
    /// # Safety
    /// - As for [`Lanes`]; so below.
    unsafe fn of(singles: L) -> Self;

    /// Eight times the same.
    ///
    /// # Safety
    /// - As above.
    unsafe fn splat(x: f64) -> Self;

    /// `self + other`.
    ///
    /// # Safety
    /// - As above.
    unsafe fn plus(self, other: Self) -> Self;

    /// `self − other`.
    ///
    /// # Safety
    /// - As above.
    unsafe fn minus(self, other: Self) -> Self;

    /// `self · other`.
    ///
    /// # Safety
    /// - As above.
    unsafe fn times(self, other: Self) -> Self;

    /// `self / other`.
    ///
    /// # Safety
    /// - As above.
    unsafe fn over(self, other: Self) -> Self;

    /// The smaller of each two; `other`'s where one is NaN or they are equal.
    ///
    /// # Safety
    /// - As above.
    unsafe fn smaller(self, other: Self) -> Self;

    /// The larger of each two; `other`'s where one is NaN or they are equal.
    ///
    /// # Safety
    /// - As above.
    unsafe fn larger(self, other: Self) -> Self;

    /// Bit k: whether number k is below the other one's; no where one is NaN.
    ///
    /// # Safety
    /// - As above.
    unsafe fn below(self, other: Self) -> u32;

    /// Rounded to singles.
    ///
    /// # Safety
    /// - As above.
    unsafe fn rounded(self) -> L;
}

/// A level of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Level {
    /// What stands in for `Neon` where tests run: the same lanes, each instruction
    /// spelled out. Slower than [`Scalar`](Self::Scalar), and not in release builds.
    #[doc(hidden)]
    #[cfg(debug_assertions)]
    NeonTwin,
    /// What every processor has.
    Scalar,
    /// AArch64 with NEON.
    #[cfg(target_arch = "aarch64")]
    Neon,
    /// x86-64 with AVX2 and FMA.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// x86-64 with AVX-512 F, VL, BW and DQ, and AVX2 and FMA.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Level {
    /// The best that this machine has.
    #[must_use]
    pub fn detect() -> Self {
        *Self::available().last().unwrap_or(&Self::Scalar)
    }

    /// All that this machine has, the best one last.
    #[must_use]
    pub fn available() -> Vec<Self> {
        #[cfg_attr(
            not(any(target_arch = "x86_64", target_arch = "aarch64")),
            expect(unused_mut, reason = "other processors have the plain level only")
        )]
        let mut levels = Vec::from([
            #[cfg(debug_assertions)]
            Self::NeonTwin,
            Self::Scalar,
        ]);
        #[cfg(target_arch = "aarch64")]
        if std::arch::is_aarch64_feature_detected!("neon") {
            levels.push(Self::Neon);
        }
        #[cfg(target_arch = "x86_64")]
        {
            let avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
            if avx2 {
                levels.push(Self::Avx2);
            }
            if avx2
                && is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512bw")
                && is_x86_feature_detected!("avx512dq")
            {
                levels.push(Self::Avx512);
            }
        }
        levels
    }
}
