//! Without vector instructions.

use super::super::item::Item;
use super::Eight;
use super::bins::number;

/// Eight numbers in an array.
#[derive(Clone, Copy, Debug)]
pub(super) struct Portable([f32; 8]);

impl Eight for Portable {
    #[inline(always)]
    unsafe fn load(item: &Item) -> Self {
        Self(item.lanes)
    }

    #[inline(always)]
    unsafe fn store(self, to: &mut Item) {
        to.lanes = self.0;
    }

    #[inline(always)]
    unsafe fn smaller(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| {
            let (a, b) = (self.0[k], other.0[k]);
            if b < a { b } else { a }
        }))
    }

    #[inline(always)]
    unsafe fn centre(self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] - self.0[k ^ 4]))
    }

    #[inline(always)]
    unsafe fn only_if(self, keep: bool) -> Self {
        if keep { self } else { Self([f32::NAN; 8]) }
    }

    #[inline(always)]
    unsafe fn half_area(self) -> f32 {
        Item { lanes: self.0 }.half_area()
    }

    #[inline(always)]
    unsafe fn bins(self, low: &[f32; 4], scale: &[f32; 4]) -> [u32; 3] {
        std::array::from_fn(|k| number((self.0[k] - self.0[k + 4] - low[k]) * scale[k]))
    }
}
