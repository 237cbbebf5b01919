//! Four numbers with NEON, which is part of every AArch64 that Rust's targets for Linux, macOS and
//! Windows are for. Of each function no more than an instruction or two: the rest is in `halves.rs`
//! and `wide.rs`, where the twin tests it.

use std::arch::aarch64::{
    float32x4_t, float64x2_t, uint8x16x2_t, uint32x4_t, uint64x2_t, vaddq_f64, vaddvq_u32,
    vandq_u32, vbslq_f32, vbslq_f64, vcleq_f32, vcltq_f32, vcltq_f64, vcvt_f32_f64, vcvt_f64_f32,
    vcvt_high_f32_f64, vcvt_high_f64_f32, vdivq_f32, vdivq_f64, vdupq_n_f32, vdupq_n_f64,
    vdupq_n_u32, vfmaq_f32, vget_low_f32, vld1q_f32, vld1q_u32, vmlaq_u32, vmulq_f32, vmulq_f64,
    vnegq_s32, vorrq_u32, vqtbl2q_u8, vreinterpretq_s32_u32, vreinterpretq_u8_u32,
    vreinterpretq_u32_f32, vreinterpretq_u32_u8, vreinterpretq_u32_u64, vshlq_u32, vst1q_f32,
    vst1q_u32, vsubq_f32, vsubq_f64, vtstq_u32, vuzp1q_u32,
};

use super::{Four, Two, Words};

/// A vector of four singles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NeonFour(float32x4_t);

impl Four for NeonFour {
    type Words = NeonWords;
    type Two = NeonTwo;

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        // SAFETY: the caller's promise; so everywhere below.
        Self(unsafe { vdupq_n_f32(x) })
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        // SAFETY: as above.
        Self(unsafe { vld1q_f32(from) })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        // SAFETY: as above.
        unsafe { vst1q_f32(to, self.0) }
    }

    #[inline(always)]
    unsafe fn minus(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vsubq_f32(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn times(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vmulq_f32(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn over(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vdivq_f32(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn multiply_add(self, factor: Self, addend: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vfmaq_f32(addend.0, self.0, factor.0) })
    }

    #[inline(always)]
    unsafe fn below(self, other: Self) -> NeonWords {
        // SAFETY: as above.
        NeonWords(unsafe { vcltq_f32(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn at_most(self, other: Self) -> NeonWords {
        // SAFETY: as above.
        NeonWords(unsafe { vcleq_f32(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn where_set(self, which: NeonWords, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vbslq_f32(which.0, self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn bits(self) -> NeonWords {
        // SAFETY: as above.
        NeonWords(unsafe { vreinterpretq_u32_f32(self.0) })
    }
}

/// A vector of four words.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NeonWords(uint32x4_t);

impl Words for NeonWords {
    #[inline(always)]
    unsafe fn splat(x: u32) -> Self {
        // SAFETY: as above; so everywhere below.
        Self(unsafe { vdupq_n_u32(x) })
    }

    #[inline(always)]
    unsafe fn load(from: *const u32) -> Self {
        // SAFETY: as above.
        Self(unsafe { vld1q_u32(from) })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut u32) {
        // SAFETY: as above.
        unsafe { vst1q_u32(to, self.0) }
    }

    #[inline(always)]
    unsafe fn and(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vandq_u32(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn or(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vorrq_u32(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn meets(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vtstq_u32(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn shifted_right(self, by: Self) -> Self {
        // SAFETY: as above. Only to the left can each word be shifted on its own, or by less than
        // nothing.
        Self(unsafe { vshlq_u32(self.0, vnegq_s32(vreinterpretq_s32_u32(by.0))) })
    }

    #[inline(always)]
    unsafe fn multiply_add(self, factor: Self, addend: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vmlaq_u32(addend.0, self.0, factor.0) })
    }

    #[inline(always)]
    unsafe fn sum(self) -> u32 {
        // SAFETY: as above.
        unsafe { vaddvq_u32(self.0) }
    }

    #[inline(always)]
    unsafe fn bytes_of(self, of: [Self; 2]) -> Self {
        // SAFETY: as above.
        unsafe {
            let of = [of[0].0, of[1].0];
            let of = uint8x16x2_t(vreinterpretq_u8_u32(of[0]), vreinterpretq_u8_u32(of[1]));
            let found = vqtbl2q_u8(of, vreinterpretq_u8_u32(self.0));
            Self(vreinterpretq_u32_u8(found))
        }
    }
}

/// A vector of two doubles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NeonTwo(float64x2_t);

impl Two<NeonFour> for NeonTwo {
    type Mask = uint64x2_t;

    #[inline(always)]
    unsafe fn splat(x: f64) -> Self {
        // SAFETY: as above; so everywhere below.
        Self(unsafe { vdupq_n_f64(x) })
    }

    #[inline(always)]
    unsafe fn of_first(four: NeonFour) -> Self {
        // SAFETY: as above.
        Self(unsafe { vcvt_f64_f32(vget_low_f32(four.0)) })
    }

    #[inline(always)]
    unsafe fn of_last(four: NeonFour) -> Self {
        // SAFETY: as above.
        Self(unsafe { vcvt_high_f64_f32(four.0) })
    }

    #[inline(always)]
    unsafe fn rounded(first: Self, last: Self) -> NeonFour {
        // SAFETY: as above.
        NeonFour(unsafe { vcvt_high_f32_f64(vcvt_f32_f64(first.0), last.0) })
    }

    #[inline(always)]
    unsafe fn plus(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vaddq_f64(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn minus(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vsubq_f64(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn times(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vmulq_f64(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn over(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vdivq_f64(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn below(self, other: Self) -> uint64x2_t {
        // SAFETY: as above.
        unsafe { vcltq_f64(self.0, other.0) }
    }

    #[inline(always)]
    unsafe fn where_set(self, which: uint64x2_t, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vbslq_f64(which, self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn narrowed(first: uint64x2_t, last: uint64x2_t) -> NeonWords {
        // SAFETY: as above. Both halves of what has all bits or none are the same.
        NeonWords(unsafe { vuzp1q_u32(vreinterpretq_u32_u64(first), vreinterpretq_u32_u64(last)) })
    }
}
