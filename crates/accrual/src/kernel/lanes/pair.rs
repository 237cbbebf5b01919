//! Twice as many lanes.

use super::{Lanes, Mask};

/// Two side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair<L>(L, L);

/// The same with both halves.
macro_rules! both {
    ($a:expr, $function:ident) => {
        // SAFETY: the caller's promise.
        unsafe { Self($a.0.$function(), $a.1.$function()) }
    };
    ($a:expr, $b:expr, $function:ident) => {
        // SAFETY: the caller's promise.
        unsafe { Self($a.0.$function($b.0), $a.1.$function($b.1)) }
    };
}

impl<M: Mask> Mask for Pair<M> {
    #[inline(always)]
    unsafe fn and(self, other: Self) -> Self {
        both!(self, other, and)
    }

    #[inline(always)]
    unsafe fn or(self, other: Self) -> Self {
        both!(self, other, or)
    }

    #[inline(always)]
    unsafe fn and_not(self, other: Self) -> Self {
        both!(self, other, and_not)
    }

    #[inline(always)]
    unsafe fn bits(self) -> u32 {
        // SAFETY: the caller's promise.
        unsafe { self.0.bits() | self.1.bits() << 8 }
    }
}

impl<L: Lanes> Lanes for Pair<L> {
    type Mask = Pair<L::Mask>;
    const COUNT: usize = 2 * L::COUNT;

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        // SAFETY: the caller's promise.
        unsafe { Self(L::splat(x), L::splat(x)) }
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        // SAFETY: the caller's promise.
        unsafe { Self(L::load(from), L::load(from.add(L::COUNT))) }
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        // SAFETY: the caller's promise.
        unsafe {
            self.0.store(to);
            self.1.store(to.add(L::COUNT));
        }
    }

    #[inline(always)]
    unsafe fn plus(self, other: Self) -> Self {
        both!(self, other, plus)
    }

    #[inline(always)]
    unsafe fn minus(self, other: Self) -> Self {
        both!(self, other, minus)
    }

    #[inline(always)]
    unsafe fn times(self, other: Self) -> Self {
        both!(self, other, times)
    }

    #[inline(always)]
    unsafe fn over(self, other: Self) -> Self {
        both!(self, other, over)
    }

    #[inline(always)]
    unsafe fn root(self) -> Self {
        both!(self, root)
    }

    #[inline(always)]
    unsafe fn smaller(self, other: Self) -> Self {
        both!(self, other, smaller)
    }

    #[inline(always)]
    unsafe fn larger(self, other: Self) -> Self {
        both!(self, other, larger)
    }

    #[inline(always)]
    unsafe fn below(self, other: Self) -> Self::Mask {
        // SAFETY: the caller's promise.
        unsafe { Pair(self.0.below(other.0), self.1.below(other.1)) }
    }

    #[inline(always)]
    unsafe fn or_where_not(self, mask: Self::Mask, other: Self) -> Self {
        // SAFETY: the caller's promise.
        unsafe {
            Self(
                self.0.or_where_not(mask.0, other.0),
                self.1.or_where_not(mask.1, other.1),
            )
        }
    }

    #[inline(always)]
    unsafe fn size(self) -> Self {
        both!(self, size)
    }
}
