//! What the instructions of NEON do, in arrays: so that a machine without them can test all that is
//! made of them. Not in release builds.

use std::array::from_fn;

use super::{Four, Two, Words};

/// All bits where it is so.
const fn all_bits(so: bool) -> u32 {
    if so { u32::MAX } else { 0 }
}

/// Four singles in an array.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TwinFour([f32; 4]);

impl Four for TwinFour {
    type Words = TwinWords;
    type Two = TwinTwo;

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        Self([x; 4])
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        // SAFETY: the caller's promise; arrays of f32 need no more alignment than f32.
        Self(unsafe { *from.cast() })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        // SAFETY: the caller's promise.
        unsafe { *to.cast() = self.0 }
    }

    #[inline(always)]
    unsafe fn minus(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] - other.0[k]))
    }

    #[inline(always)]
    unsafe fn times(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] * other.0[k]))
    }

    #[inline(always)]
    unsafe fn over(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] / other.0[k]))
    }

    #[inline(always)]
    unsafe fn multiply_add(self, factor: Self, addend: Self) -> Self {
        Self(from_fn(|k| self.0[k].mul_add(factor.0[k], addend.0[k])))
    }

    #[inline(always)]
    unsafe fn below(self, other: Self) -> TwinWords {
        TwinWords(from_fn(|k| all_bits(self.0[k] < other.0[k])))
    }

    #[inline(always)]
    unsafe fn at_most(self, other: Self) -> TwinWords {
        TwinWords(from_fn(|k| all_bits(self.0[k] <= other.0[k])))
    }

    #[inline(always)]
    unsafe fn where_set(self, which: TwinWords, other: Self) -> Self {
        Self(from_fn(|k| {
            let (own, other, which) = (self.0[k].to_bits(), other.0[k].to_bits(), which.0[k]);
            f32::from_bits(own & which | other & !which)
        }))
    }

    #[inline(always)]
    unsafe fn bits(self) -> TwinWords {
        TwinWords(self.0.map(f32::to_bits))
    }
}

/// Four words in an array.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TwinWords([u32; 4]);

impl Words for TwinWords {
    #[inline(always)]
    unsafe fn splat(x: u32) -> Self {
        Self([x; 4])
    }

    #[inline(always)]
    unsafe fn load(from: *const u32) -> Self {
        // SAFETY: the caller's promise; arrays of u32 need no more alignment than u32.
        Self(unsafe { *from.cast() })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut u32) {
        // SAFETY: the caller's promise.
        unsafe { *to.cast() = self.0 }
    }

    #[inline(always)]
    unsafe fn and(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] & other.0[k]))
    }

    #[inline(always)]
    unsafe fn or(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] | other.0[k]))
    }

    #[inline(always)]
    unsafe fn meets(self, other: Self) -> Self {
        Self(from_fn(|k| all_bits(self.0[k] & other.0[k] != 0)))
    }

    #[inline(always)]
    unsafe fn shifted_right(self, by: Self) -> Self {
        Self(from_fn(|k| self.0[k] >> by.0[k]))
    }

    #[inline(always)]
    unsafe fn multiply_add(self, factor: Self, addend: Self) -> Self {
        let product = |k: usize| self.0[k].wrapping_mul(factor.0[k]);
        Self(from_fn(|k| product(k).wrapping_add(addend.0[k])))
    }

    #[inline(always)]
    unsafe fn sum(self) -> u32 {
        self.0.into_iter().fold(0, u32::wrapping_add)
    }

    #[inline(always)]
    unsafe fn bytes_of(self, of: [Self; 2]) -> Self {
        let byte = |k: u8| {
            of[usize::from(k) / 16].0[usize::from(k) / 4 % 4].to_ne_bytes()[usize::from(k) % 4]
        };
        Self(
            self.0
                .map(|which| u32::from_ne_bytes(which.to_ne_bytes().map(byte))),
        )
    }
}

/// Two doubles in an array.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TwinTwo([f64; 2]);

impl Two<TwinFour> for TwinTwo {
    type Mask = [u64; 2];

    #[inline(always)]
    unsafe fn splat(x: f64) -> Self {
        Self([x; 2])
    }

    #[inline(always)]
    unsafe fn of_first(four: TwinFour) -> Self {
        let [a, b, _, _] = four.0;
        Self([a.into(), b.into()])
    }

    #[inline(always)]
    unsafe fn of_last(four: TwinFour) -> Self {
        let [_, _, c, d] = four.0;
        Self([c.into(), d.into()])
    }

    #[inline(always)]
    unsafe fn rounded(first: Self, last: Self) -> TwinFour {
        let (Self([a, b]), Self([c, d])) = (first, last);
        TwinFour([a as f32, b as f32, c as f32, d as f32])
    }

    #[inline(always)]
    unsafe fn plus(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] + other.0[k]))
    }

    #[inline(always)]
    unsafe fn minus(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] - other.0[k]))
    }

    #[inline(always)]
    unsafe fn times(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] * other.0[k]))
    }

    #[inline(always)]
    unsafe fn over(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] / other.0[k]))
    }

    #[inline(always)]
    unsafe fn below(self, other: Self) -> [u64; 2] {
        from_fn(|k| if self.0[k] < other.0[k] { u64::MAX } else { 0 })
    }

    #[inline(always)]
    unsafe fn where_set(self, which: [u64; 2], other: Self) -> Self {
        Self(from_fn(|k| {
            let (own, other, which) = (self.0[k].to_bits(), other.0[k].to_bits(), which[k]);
            f64::from_bits(own & which | other & !which)
        }))
    }

    #[inline(always)]
    unsafe fn narrowed(first: [u64; 2], last: [u64; 2]) -> TwinWords {
        TwinWords([first[0], first[1], last[0], last[1]].map(|mask| mask as u32))
    }
}
