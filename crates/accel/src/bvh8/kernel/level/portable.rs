//! The lanes for any processor: what the instructions are held against.

use super::super::super::node::Child;
use super::{Lanes, WideLanes};

/// Eight numbers in an array.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable([f32; 8]);

impl Portable {
    #[inline(always)]
    fn zip(self, other: Self, of: impl Fn(f32, f32) -> f32) -> Self {
        Self(std::array::from_fn(|k| of(self.0[k], other.0[k])))
    }
}

impl Lanes for Portable {
    type Wide = PortableWide;

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        Self([x; 8])
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        // SAFETY: the caller's promise; arrays of f32 need no more alignment than f32.
        Self(unsafe { *from.cast::<[f32; 8]>() })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        // SAFETY: the caller's promise.
        unsafe { *to.cast::<[f32; 8]>() = self.0 }
    }

    #[inline(always)]
    unsafe fn minus(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }

    #[inline(always)]
    unsafe fn times(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }

    #[inline(always)]
    unsafe fn over(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }

    #[inline(always)]
    unsafe fn store_where(self, bits: u32, to: *mut f32) {
        for k in 0..8 {
            if bits >> k & 1 == 1 {
                // SAFETY: the caller's promise.
                unsafe { *to.add(k) = self.0[k] };
            }
        }
    }

    #[inline(always)]
    unsafe fn multiply_add(self, factor: Self, addend: Self) -> Self {
        Self(std::array::from_fn(|k| {
            self.0[k] * factor.0[k] + addend.0[k]
        }))
    }

    #[inline(always)]
    unsafe fn smaller(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    unsafe fn larger(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    unsafe fn at_most(self, other: Self) -> u32 {
        (0..8).fold(0, |bits, k| bits | u32::from(self.0[k] <= other.0[k]) << k)
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
        let (mut count, mut pushed) = (0, 0);
        for place in 0..8 {
            let k = (order >> (3 * place) & 7) as usize;
            if self.0[k] <= far.0[k] {
                // SAFETY: the caller's promise; `count` and `k` are below 8.
                unsafe {
                    *to.add(count) = *children.add(k);
                    *entries.add(count) = self.0[k];
                }
                count += 1;
                pushed |= 1 << place;
            }
        }
        pushed
    }

    #[inline(always)]
    unsafe fn push_unordered(self, far: Self, children: *const Child, to: *mut Child) -> u32 {
        let (mut count, mut pushed) = (0, 0);
        for k in 0..8 {
            if self.0[k] <= far.0[k] {
                // SAFETY: the caller's promise; `count` and `k` are below 8.
                unsafe { *to.add(count) = *children.add(k) };
                count += 1;
                pushed |= 1 << k;
            }
        }
        pushed
    }

    #[inline(always)]
    unsafe fn keep(children: *mut Child, entries: *mut f32, count: usize, t_max: f32) -> usize {
        let mut kept = 0;
        for k in 0..count {
            // SAFETY: the caller's promise; `kept` is at most k.
            unsafe {
                let entry = *entries.add(k);
                if entry <= t_max {
                    *children.add(kept) = *children.add(k);
                    *entries.add(kept) = entry;
                    kept += 1;
                }
            }
        }
        kept
    }
}

/// Eight doubles in an array.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PortableWide([f64; 8]);

impl PortableWide {
    #[inline(always)]
    fn zip(self, other: Self, of: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|k| of(self.0[k], other.0[k])))
    }
}

impl WideLanes<Portable> for PortableWide {
    #[inline(always)]
    unsafe fn of(singles: Portable) -> Self {
        Self(singles.0.map(f64::from))
    }

    #[inline(always)]
    unsafe fn splat(x: f64) -> Self {
        Self([x; 8])
    }

    #[inline(always)]
    unsafe fn plus(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }

    #[inline(always)]
    unsafe fn minus(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }

    #[inline(always)]
    unsafe fn times(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }

    #[inline(always)]
    unsafe fn over(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }

    #[inline(always)]
    unsafe fn smaller(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    unsafe fn larger(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    unsafe fn below(self, other: Self) -> u32 {
        (0..8).fold(0, |bits, k| bits | u32::from(self.0[k] < other.0[k]) << k)
    }

    #[inline(always)]
    unsafe fn rounded(self) -> Portable {
        Portable(self.0.map(|x| x as f32))
    }
}
