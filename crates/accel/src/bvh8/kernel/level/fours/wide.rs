//! Eight doubles in four twos.

use super::super::WideLanes;
use super::halves::mask;
use super::{Four, Halves, Two};

/// Two by two, from the first on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HalvesWide<F: Four>([F::Two; 4]);

/// Functions that do to each two what they are called after.
macro_rules! two_by_two {
    ($($name:ident)*) => {
        $(
            #[inline(always)]
            unsafe fn $name(self, other: Self) -> Self {
                let (Self([a, b, c, d]), Self([e, f, g, h])) = (self, other);
                // SAFETY: the caller's promise.
                unsafe { Self([a.$name(e), b.$name(f), c.$name(g), d.$name(h)]) }
            }
        )*
    };
}

impl<F: Four> WideLanes<Halves<F>> for HalvesWide<F> {
    two_by_two!(plus minus times over smaller larger);

    #[inline(always)]
    unsafe fn of(singles: Halves<F>) -> Self {
        let Halves([first, last]) = singles;
        // SAFETY: the caller's promise; so everywhere below.
        unsafe {
            Self([
                F::Two::of_first(first),
                F::Two::of_last(first),
                F::Two::of_first(last),
                F::Two::of_last(last),
            ])
        }
    }

    #[inline(always)]
    unsafe fn splat(x: f64) -> Self {
        // SAFETY: as above.
        Self(unsafe { [F::Two::splat(x); 4] })
    }

    #[inline(always)]
    unsafe fn below(self, other: Self) -> u32 {
        let (Self([a, b, c, d]), Self([e, f, g, h])) = (self, other);
        // SAFETY: as above.
        unsafe {
            mask([
                F::Two::narrowed(a.below(e), b.below(f)),
                F::Two::narrowed(c.below(g), d.below(h)),
            ])
        }
    }

    #[inline(always)]
    unsafe fn rounded(self) -> Halves<F> {
        let Self([a, b, c, d]) = self;
        // SAFETY: as above.
        Halves(unsafe { [F::Two::rounded(a, b), F::Two::rounded(c, d)] })
    }
}
