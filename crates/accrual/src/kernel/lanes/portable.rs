//! Eight lanes as an array, for any processor.

use super::{Lanes, Mask};

/// Eight numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable([f32; 8]);

/// Bit k: lane k.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bits(u32);

impl Mask for Bits {
    #[inline(always)]
    unsafe fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    #[inline(always)]
    unsafe fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    #[inline(always)]
    unsafe fn and_not(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    #[inline(always)]
    unsafe fn bits(self) -> u32 {
        self.0
    }
}

/// The same with each pair of lanes.
macro_rules! each {
    ($a:expr, $b:expr, $x:ident, $y:ident => $z:expr) => {{
        let mut out = [0.0; 8];
        for k in 0..8 {
            let ($x, $y) = ($a[k], $b[k]);
            out[k] = $z;
        }
        Self(out)
    }};
}

#[expect(
    clippy::needless_range_loop,
    reason = "what is indexed alike is seen to be eight lanes"
)]
impl Lanes for Portable {
    type Mask = Bits;
    const COUNT: usize = 8;

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        Self([x; 8])
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        // SAFETY: the caller's promise.
        Self(unsafe { from.cast::<[f32; 8]>().read_unaligned() })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        // SAFETY: the caller's promise.
        unsafe { to.cast::<[f32; 8]>().write_unaligned(self.0) }
    }

    #[inline(always)]
    unsafe fn plus(self, other: Self) -> Self {
        each!(self.0, other.0, x, y => x + y)
    }

    #[inline(always)]
    unsafe fn minus(self, other: Self) -> Self {
        each!(self.0, other.0, x, y => x - y)
    }

    #[inline(always)]
    unsafe fn times(self, other: Self) -> Self {
        each!(self.0, other.0, x, y => x * y)
    }

    #[inline(always)]
    unsafe fn over(self, other: Self) -> Self {
        each!(self.0, other.0, x, y => x / y)
    }

    #[inline(always)]
    unsafe fn root(self) -> Self {
        each!(self.0, self.0, x, _y => x.sqrt())
    }

    #[inline(always)]
    unsafe fn smaller(self, other: Self) -> Self {
        each!(self.0, other.0, x, y => if x < y { x } else { y })
    }

    #[inline(always)]
    unsafe fn larger(self, other: Self) -> Self {
        each!(self.0, other.0, x, y => if x > y { x } else { y })
    }

    #[inline(always)]
    unsafe fn below(self, other: Self) -> Bits {
        let mut bits = 0;
        for k in 0..8 {
            bits |= u32::from(self.0[k] < other.0[k]) << k;
        }
        Bits(bits)
    }

    #[inline(always)]
    unsafe fn or_where_not(self, mask: Bits, other: Self) -> Self {
        let mut out = [0.0; 8];
        for k in 0..8 {
            out[k] = if mask.0 >> k & 1 == 1 {
                self.0[k]
            } else {
                other.0[k]
            };
        }
        Self(out)
    }

    #[inline(always)]
    unsafe fn size(self) -> Self {
        each!(self.0, self.0, x, _y => x.abs())
    }
}
