//! With AVX2: eight numbers at once.

use std::arch::x86_64::*;

use super::super::item::Item;
use super::Eight;
use super::bins::{BINS, NUMBER};

/// Eight numbers in a register.
#[derive(Clone, Copy, Debug)]
pub(super) struct Avx2(__m256);

impl Eight for Avx2 {
    #[inline(always)]
    unsafe fn load(item: &Item) -> Self {
        // SAFETY: the caller's promise on the instructions, so below; an item is eight singles at
        // a multiple of 32 bytes.
        unsafe { Self(_mm256_load_ps(item.lanes.as_ptr())) }
    }

    #[inline(always)]
    unsafe fn store(self, to: &mut Item) {
        // SAFETY: as above.
        unsafe { _mm256_store_ps(to.lanes.as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    unsafe fn smaller(self, other: Self) -> Self {
        // SAFETY: as above.
        unsafe { Self(_mm256_min_ps(other.0, self.0)) }
    }

    #[inline(always)]
    unsafe fn centre(self) -> Self {
        // SAFETY: as above.
        unsafe {
            let swapped = _mm256_permute2f128_ps::<1>(self.0, self.0);
            Self(_mm256_sub_ps(self.0, swapped))
        }
    }

    #[inline(always)]
    unsafe fn only_if(self, keep: bool) -> Self {
        // SAFETY: as above. All bits set are NaN.
        unsafe {
            let lost = _mm256_set1_epi32(i32::from(keep) - 1);
            Self(_mm256_or_ps(self.0, _mm256_castsi256_ps(lost)))
        }
    }

    #[inline(always)]
    unsafe fn half_area(self) -> f32 {
        // SAFETY: as above.
        unsafe {
            let lower = _mm256_castps256_ps128(self.0);
            let upper = _mm_xor_ps(_mm256_extractf128_ps::<1>(self.0), _mm_set1_ps(-0.0));
            let extent = _mm_sub_ps(upper, lower);
            let x = _mm_cvtss_f32(extent);
            let y = _mm_cvtss_f32(_mm_movehdup_ps(extent));
            let z = _mm_cvtss_f32(_mm_movehl_ps(extent, extent));
            x * (y + z) + y * z
        }
    }

    #[inline(always)]
    unsafe fn bins(self, low: &[f32; 4], scale: &[f32; 4]) -> [u32; 3] {
        // SAFETY: as above; four singles may be read from an array of four.
        unsafe {
            let (low, scale) = (_mm_loadu_ps(low.as_ptr()), _mm_loadu_ps(scale.as_ptr()));
            let lower = _mm256_castps256_ps128(self.0);
            let twice = _mm_sub_ps(lower, _mm256_extractf128_ps::<1>(self.0));
            let x = _mm_mul_ps(_mm_sub_ps(twice, low), scale);
            let x = _mm_add_ps(_mm_sub_ps(x, _mm_set1_ps(0.5)), _mm_set1_ps(NUMBER));
            let x = _mm_and_si128(_mm_castps_si128(x), _mm_set1_epi32(BINS as i32 - 1));
            let xy = _mm_cvtsi128_si64(x) as u64;
            [
                xy as u32,
                (xy >> 32) as u32,
                _mm_extract_epi32::<2>(x) as u32,
            ]
        }
    }
}
