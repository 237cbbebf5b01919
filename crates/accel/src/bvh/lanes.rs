//! Four numbers that go through the same operations.
//!
//! On x86-64 these are the vector instructions that every such processor has. Left to itself the
//! compiler takes numbers that are compared and chosen between apart again, at twice the instructions
//! for the test of two boxes (rustc 1.95, by callgrind).
#![cfg_attr(
    target_arch = "x86_64",
    expect(
        unsafe_code,
        reason = "intrinsics of SSE, which is part of x86-64: there is no processor to check for"
    )
)]

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64 as sse;

/// Four single-precision numbers.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug)]
pub(super) struct Lanes(sse::__m128);

/// Four single-precision numbers.
#[cfg(not(target_arch = "x86_64"))]
pub(super) type Lanes = Portable;

#[cfg(target_arch = "x86_64")]
impl Lanes {
    #[inline(always)]
    pub(super) fn new([a, b, c, d]: [f32; 4]) -> Self {
        // SAFETY: see the top of the file; so everywhere below.
        Self(unsafe { sse::_mm_setr_ps(a, b, c, d) })
    }

    /// Four times the same.
    #[inline(always)]
    pub(super) fn splat(x: f32) -> Self {
        Self::new([x; 4])
    }

    /// The first two.
    #[inline(always)]
    pub(super) fn first_two(self) -> [f32; 2] {
        // SAFETY: as above.
        unsafe {
            let second = sse::_mm_shuffle_ps::<1>(self.0, self.0);
            [sse::_mm_cvtss_f32(self.0), sse::_mm_cvtss_f32(second)]
        }
    }

    /// The last two in place of the first two; what the last become is not said.
    #[inline(always)]
    pub(super) fn last_two_first(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { sse::_mm_movehl_ps(self.0, self.0) })
    }

    #[inline(always)]
    pub(super) fn minus(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { sse::_mm_sub_ps(self.0, other.0) })
    }

    #[inline(always)]
    pub(super) fn times(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { sse::_mm_mul_ps(self.0, other.0) })
    }

    /// The smaller of each two; the other one where one is NaN or they are equal.
    #[inline(always)]
    pub(super) fn smaller(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { sse::_mm_min_ps(self.0, other.0) })
    }

    /// The larger of each two; the other one where one is NaN or they are equal.
    #[inline(always)]
    pub(super) fn larger(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { sse::_mm_max_ps(self.0, other.0) })
    }

    /// Whether the first, and the second, are not above the other one's; no where one is NaN.
    #[inline(always)]
    pub(super) fn first_two_at_most(self, other: Self) -> [bool; 2] {
        // SAFETY: as above.
        let bits = unsafe { sse::_mm_movemask_ps(sse::_mm_cmple_ps(self.0, other.0)) };
        [bits & 1 != 0, bits & 2 != 0]
    }
}

/// The same for any processor: what the instructions are held against.
#[cfg(any(test, not(target_arch = "x86_64")))]
#[derive(Clone, Copy, Debug)]
pub(super) struct Portable([f32; 4]);

#[cfg(any(test, not(target_arch = "x86_64")))]
impl Portable {
    pub(super) const fn new(numbers: [f32; 4]) -> Self {
        Self(numbers)
    }

    #[cfg(not(target_arch = "x86_64"))]
    pub(super) const fn splat(x: f32) -> Self {
        Self([x; 4])
    }

    #[inline(always)]
    fn zip(self, other: Self, of: impl Fn(f32, f32) -> f32) -> Self {
        let (Self([a, b, c, d]), Self([e, f, g, h])) = (self, other);
        Self([of(a, e), of(b, f), of(c, g), of(d, h)])
    }

    #[inline(always)]
    pub(super) const fn first_two(self) -> [f32; 2] {
        [self.0[0], self.0[1]]
    }

    #[inline(always)]
    pub(super) const fn last_two_first(self) -> Self {
        let Self([_, _, c, d]) = self;
        Self([c, d, c, d])
    }

    #[inline(always)]
    pub(super) fn minus(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }

    #[inline(always)]
    pub(super) fn times(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }

    #[inline(always)]
    pub(super) fn smaller(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    pub(super) fn larger(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    pub(super) fn first_two_at_most(self, other: Self) -> [bool; 2] {
        [self.0[0] <= other.0[0], self.0[1] <= other.0[1]]
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;

    #[test]
    fn instructions_do_what_the_portable_code_does() {
        let odd = [
            0.0,
            -0.0,
            1.0,
            -3.5,
            1e-45,
            f32::INFINITY,
            -f32::INFINITY,
            f32::NAN,
        ];
        let bits = |x: [f32; 2]| x.map(f32::to_bits);
        for i in 0..odd.len() {
            for j in 0..odd.len() {
                let (a, b) = ([odd[i], odd[j], 2.0, odd[j]], [odd[j], 1.0, odd[i], 7.0]);
                let (x, y) = (Lanes::new(a), Lanes::new(b));
                let (p, q) = (Portable::new(a), Portable::new(b));
                let pairs = [
                    (x.smaller(y), p.smaller(q)),
                    (x.larger(y), p.larger(q)),
                    (x.last_two_first(), p.last_two_first()),
                ];
                for (lanes, portable) in pairs {
                    assert_eq!(bits(lanes.first_two()), bits(portable.first_two()));
                }
                // Which NaN it is may differ.
                let same = |x: [f32; 2], y: [f32; 2]| {
                    x.into_iter()
                        .zip(y)
                        .all(|(x, y)| x == y || x.is_nan() && y.is_nan())
                };
                assert!(same(x.minus(y).first_two(), p.minus(q).first_two()));
                assert!(same(x.times(y).first_two(), p.times(q).first_two()));
                assert_eq!(x.first_two_at_most(y), p.first_two_at_most(q));
            }
        }
        assert_eq!(Lanes::splat(3.0).first_two(), [3.0; 2]);
    }
}
