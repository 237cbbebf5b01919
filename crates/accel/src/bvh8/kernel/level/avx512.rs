//! The lanes with AVX-512 on vectors of 256 bits.
//!
//! Not on 512: a node has eight children and a leaf eight triangles at most, and two of either at a
//! time are seldom wanted.

use std::arch::x86_64::{
    __m256, __m256i, __m512d, _CMP_LE_OQ, _CMP_LT_OQ, _mm_loadl_epi64, _mm256_cmp_ps,
    _mm256_cmp_ps_mask, _mm256_cvtepi32_ps, _mm256_cvtepu8_epi32, _mm256_div_ps, _mm256_fmadd_ps,
    _mm256_loadu_ps, _mm256_loadu_si256, _mm256_mask_storeu_ps, _mm256_maskz_compress_epi32,
    _mm256_maskz_compress_ps, _mm256_max_ps, _mm256_min_ps, _mm256_movemask_ps, _mm256_mul_ps,
    _mm256_permutevar8x32_epi32, _mm256_permutevar8x32_ps, _mm256_permutex2var_ps,
    _mm256_set1_epi32, _mm256_set1_ps, _mm256_setr_epi32, _mm256_srlv_epi32, _mm256_storeu_ps,
    _mm256_storeu_si256, _mm256_sub_ps, _mm512_add_pd, _mm512_cmp_pd_mask, _mm512_cvtpd_ps,
    _mm512_cvtps_pd, _mm512_div_pd, _mm512_max_pd, _mm512_min_pd, _mm512_mul_pd, _mm512_set1_pd,
    _mm512_sub_pd,
};

use super::super::super::node::Child;
use super::{Lanes, WideLanes};

/// A vector of 256 bits, compared into mask registers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx512(__m256);

/// Where each of eight fields of three bits begins.
#[inline(always)]
pub(super) unsafe fn places(order: u32) -> __m256i {
    // SAFETY: the caller's promise. Permutations look at the lowest three bits only.
    unsafe {
        let first = _mm256_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21);
        _mm256_srlv_epi32(_mm256_set1_epi32(order as i32), first)
    }
}

impl Lanes for Avx512 {
    type Wide = Avx512Wide;

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
        // SAFETY: as above. A permutation of two vectors looks at the lowest four bits.
        unsafe {
            let which = _mm256_cvtepu8_epi32(_mm_loadl_epi64(which.cast()));
            let (low, high) = (_mm256_loadu_ps(from), _mm256_loadu_ps(from.add(8)));
            Self(_mm256_permutex2var_ps(low, which, high))
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
        unsafe { _mm256_mask_storeu_ps(to, bits as u8, self.0) }
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
        // Not into a mask register: from there it takes longer to where branches can see it.
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
            let entered = _mm256_cmp_ps_mask::<_CMP_LE_OQ>(near, far);
            _mm256_storeu_ps(entries, _mm256_maskz_compress_ps(entered, near));
            _mm256_storeu_si256(to.cast(), _mm256_maskz_compress_epi32(entered, children));
            u32::from(entered)
        }
    }

    #[inline(always)]
    unsafe fn push_unordered(self, far: Self, children: *const Child, to: *mut Child) -> u32 {
        // SAFETY: as above.
        unsafe {
            let entered = _mm256_cmp_ps_mask::<_CMP_LE_OQ>(self.0, far.0);
            let children = _mm256_loadu_si256(children.cast());
            _mm256_storeu_si256(to.cast(), _mm256_maskz_compress_epi32(entered, children));
            u32::from(entered)
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
                let there = ((1_u32 << (count - from).min(8)) - 1) as u8;
                let near_enough = Self(near).at_most(Self::splat(t_max)) as u8 & there;
                _mm256_storeu_ps(
                    entries.add(kept),
                    _mm256_maskz_compress_ps(near_enough, near),
                );
                let what = _mm256_maskz_compress_epi32(near_enough, what);
                _mm256_storeu_si256(children.add(kept).cast(), what);
                kept += near_enough.count_ones() as usize;
                from += 8;
            }
            kept
        }
    }
}

/// A vector of 512 bits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx512Wide(__m512d);

impl WideLanes<Avx512> for Avx512Wide {
    #[inline(always)]
    unsafe fn of(singles: Avx512) -> Self {
        // SAFETY: as above; so everywhere below.
        Self(unsafe { _mm512_cvtps_pd(singles.0) })
    }

    #[inline(always)]
    unsafe fn splat(x: f64) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_set1_pd(x) })
    }

    #[inline(always)]
    unsafe fn plus(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_add_pd(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn minus(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_sub_pd(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn times(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_mul_pd(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn over(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_div_pd(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn smaller(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_min_pd(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn larger(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_max_pd(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn below(self, other: Self) -> u32 {
        // SAFETY: as above.
        u32::from(unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn rounded(self) -> Avx512 {
        // SAFETY: as above.
        Avx512(unsafe { _mm512_cvtpd_ps(self.0) })
    }
}
