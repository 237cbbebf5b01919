//! The lanes with AVX2 and FMA.

use std::arch::x86_64::{
    __m256, __m256d, __m256i, _CMP_LE_OQ, _CMP_LT_OQ, _mm_cvtsi64_si128, _mm_loadl_epi64,
    _mm256_add_pd, _mm256_and_si256, _mm256_blendv_ps, _mm256_castps256_ps128, _mm256_castsi256_ps,
    _mm256_cmp_pd, _mm256_cmp_ps, _mm256_cmpeq_epi32, _mm256_cvtepi32_ps, _mm256_cvtepu8_epi32,
    _mm256_cvtpd_ps, _mm256_cvtps_pd, _mm256_div_pd, _mm256_div_ps, _mm256_extractf128_ps,
    _mm256_fmadd_ps, _mm256_loadu_ps, _mm256_loadu_si256, _mm256_maskstore_ps, _mm256_max_pd,
    _mm256_max_ps, _mm256_min_pd, _mm256_min_ps, _mm256_movemask_pd, _mm256_movemask_ps,
    _mm256_mul_pd, _mm256_mul_ps, _mm256_permutevar8x32_epi32, _mm256_permutevar8x32_ps,
    _mm256_set_m128, _mm256_set1_epi32, _mm256_set1_pd, _mm256_set1_ps, _mm256_setr_epi32,
    _mm256_slli_epi32, _mm256_srlv_epi32, _mm256_storeu_ps, _mm256_storeu_si256, _mm256_sub_pd,
    _mm256_sub_ps,
};

use super::super::super::node::Child;
use super::{Lanes, WideLanes};

/// A vector of 256 bits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2(__m256);

/// For each mask of eight bits the places of those that are set, a byte each, one after the other.
const COMPRESSED: [u64; 256] = {
    let mut table = [0; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut k, mut count) = (0, 0);
        while k < 8 {
            if mask >> k & 1 == 1 {
                table[mask] |= (k as u64) << (8 * count);
                count += 1;
            }
            k += 1;
        }
        mask += 1;
    }
    table
};

/// As lanes, the places of the bits that are set.
#[inline(always)]
unsafe fn compressed(mask: usize) -> __m256i {
    // SAFETY: the caller's promise.
    unsafe { _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(COMPRESSED[mask & 255] as i64)) }
}

/// Where each of eight fields of three bits begins.
#[inline(always)]
unsafe fn places(order: u32) -> __m256i {
    // SAFETY: the caller's promise. Permutations look at the lowest three bits only.
    unsafe {
        let first = _mm256_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21);
        _mm256_srlv_epi32(_mm256_set1_epi32(order as i32), first)
    }
}

impl Lanes for Avx2 {
    type Wide = Avx2Wide;

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        // SAFETY: the caller's promise; so everywhere below.
        Self(unsafe { _mm256_set1_ps(x) })
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_loadu_ps(from) })
    }

    #[inline(always)]
    unsafe fn load_bytes(from: *const u8) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_loadl_epi64(from.cast()))) })
    }

    #[inline(always)]
    unsafe fn chosen(from: *const f32, which: *const u8) -> Self {
        // SAFETY: as above. A permutation looks at the lowest three bits, a blend at the highest, which
        // the fourth one becomes.
        unsafe {
            let which = _mm256_cvtepu8_epi32(_mm_loadl_epi64(which.cast()));
            let low = _mm256_permutevar8x32_ps(_mm256_loadu_ps(from), which);
            let high = _mm256_permutevar8x32_ps(_mm256_loadu_ps(from.add(8)), which);
            let upper = _mm256_castsi256_ps(_mm256_slli_epi32::<28>(which));
            Self(_mm256_blendv_ps(low, high, upper))
        }
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        // SAFETY: as above.
        unsafe { _mm256_storeu_ps(to, self.0) }
    }

    #[inline(always)]
    unsafe fn minus(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_sub_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn times(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_mul_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn over(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_div_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn store_where(self, bits: u32, to: *mut f32) {
        // SAFETY: as above.
        unsafe {
            let bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
            let chosen = _mm256_and_si256(_mm256_set1_epi32(bits as i32), bit);
            _mm256_maskstore_ps(to, _mm256_cmpeq_epi32(chosen, bit), self.0);
        }
    }

    #[inline(always)]
    unsafe fn multiply_add(self, factor: Self, addend: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_fmadd_ps(self.0, factor.0, addend.0) })
    }

    #[inline(always)]
    unsafe fn smaller(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_min_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn larger(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_max_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn at_most(self, other: Self) -> u32 {
        // SAFETY: as above.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(self.0, other.0)) as u32 }
    }

    #[inline(always)]
    unsafe fn push(
        self,
        far: Self,
        order: u32,
        children: *const Child,
        to: *mut Child,
        entries: *mut f32,
    ) -> u32 {
        // SAFETY: as above.
        unsafe {
            let places = places(order);
            let near = _mm256_permutevar8x32_ps(self.0, places);
            let far = _mm256_permutevar8x32_ps(far.0, places);
            let children = _mm256_permutevar8x32_epi32(_mm256_loadu_si256(children.cast()), places);
            let entered = Self(near).at_most(Self(far)) as usize;
            let kept = compressed(entered);
            _mm256_storeu_ps(entries, _mm256_permutevar8x32_ps(near, kept));
            _mm256_storeu_si256(to.cast(), _mm256_permutevar8x32_epi32(children, kept));
            entered as u32
        }
    }

    #[inline(always)]
    unsafe fn push_unordered(self, far: Self, children: *const Child, to: *mut Child) -> u32 {
        // SAFETY: as above.
        unsafe {
            let entered = self.at_most(far) as usize;
            let children = _mm256_loadu_si256(children.cast());
            let kept = compressed(entered);
            _mm256_storeu_si256(to.cast(), _mm256_permutevar8x32_epi32(children, kept));
            entered as u32
        }
    }

    #[inline(always)]
    unsafe fn keep(children: *mut Child, entries: *mut f32, count: usize, t_max: f32) -> usize {
        // SAFETY: as above. What is written begins at or before what was read, so nothing that is
        // still to be read is written over.
        unsafe {
            let (mut from, mut kept) = (0, 0);
            while from < count {
                let near = _mm256_loadu_ps(entries.add(from));
                let what = _mm256_loadu_si256(children.add(from).cast());
                let there = ((1_u64 << (count - from).min(8)) - 1) as usize;
                let near_enough = Self(near).at_most(Self::splat(t_max)) as usize & there;
                let places = compressed(near_enough);
                _mm256_storeu_ps(entries.add(kept), _mm256_permutevar8x32_ps(near, places));
                let what = _mm256_permutevar8x32_epi32(what, places);
                _mm256_storeu_si256(children.add(kept).cast(), what);
                kept += near_enough.count_ones() as usize;
                from += 8;
            }
            kept
        }
    }
}

/// Two vectors of 256 bits: the first four numbers, the last four.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2Wide([__m256d; 2]);

impl WideLanes<Avx2> for Avx2Wide {
    #[inline(always)]
    unsafe fn of(singles: Avx2) -> Self {
        // SAFETY: as above; so everywhere below.
        unsafe {
            let (low, high) = (
                _mm256_castps256_ps128(singles.0),
                _mm256_extractf128_ps::<1>(singles.0),
            );
            Self([_mm256_cvtps_pd(low), _mm256_cvtps_pd(high)])
        }
    }

    #[inline(always)]
    unsafe fn splat(x: f64) -> Self {
        // SAFETY: as above.
        Self(unsafe { [_mm256_set1_pd(x); 2] })
    }

    #[inline(always)]
    unsafe fn plus(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe {
            [
                _mm256_add_pd(self.0[0], other.0[0]),
                _mm256_add_pd(self.0[1], other.0[1]),
            ]
        })
    }

    #[inline(always)]
    unsafe fn minus(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe {
            [
                _mm256_sub_pd(self.0[0], other.0[0]),
                _mm256_sub_pd(self.0[1], other.0[1]),
            ]
        })
    }

    #[inline(always)]
    unsafe fn times(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe {
            [
                _mm256_mul_pd(self.0[0], other.0[0]),
                _mm256_mul_pd(self.0[1], other.0[1]),
            ]
        })
    }

    #[inline(always)]
    unsafe fn over(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe {
            [
                _mm256_div_pd(self.0[0], other.0[0]),
                _mm256_div_pd(self.0[1], other.0[1]),
            ]
        })
    }

    #[inline(always)]
    unsafe fn smaller(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe {
            [
                _mm256_min_pd(self.0[0], other.0[0]),
                _mm256_min_pd(self.0[1], other.0[1]),
            ]
        })
    }

    #[inline(always)]
    unsafe fn larger(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe {
            [
                _mm256_max_pd(self.0[0], other.0[0]),
                _mm256_max_pd(self.0[1], other.0[1]),
            ]
        })
    }

    #[inline(always)]
    unsafe fn below(self, other: Self) -> u32 {
        // SAFETY: as above.
        unsafe {
            let low = _mm256_cmp_pd::<_CMP_LT_OQ>(self.0[0], other.0[0]);
            let high = _mm256_cmp_pd::<_CMP_LT_OQ>(self.0[1], other.0[1]);
            (_mm256_movemask_pd(low) | _mm256_movemask_pd(high) << 4) as u32
        }
    }

    #[inline(always)]
    unsafe fn rounded(self) -> Avx2 {
        // SAFETY: as above.
        unsafe {
            let (low, high) = (_mm256_cvtpd_ps(self.0[0]), _mm256_cvtpd_ps(self.0[1]));
            Avx2(_mm256_set_m128(high, low))
        }
    }
}
