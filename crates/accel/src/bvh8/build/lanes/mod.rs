//! What is done to every primitive again and again while a tree is built: written once over
//! [`Eight`], compiled once for each level of instructions.
//!
//! All levels do the same operations in the same order on every number, so they make the same tree.
#![expect(
    unsafe_code,
    reason = "vector instructions, and memory that begins as zeros"
)]

#[cfg(target_arch = "x86_64")]
mod avx2;
mod bins;
mod memory;
mod portable;

use super::item::Item;
pub(super) use bins::{Binning, Bins, Cut, FEW_LEAVES, weight};
use bins::{Sides, best, fill, part};

/// The eight numbers of an [`Item`].
pub(super) trait Eight: Copy {
    /// # Safety
    /// - The processor has the level's instructions; so for all functions here.
    unsafe fn load(item: &Item) -> Self;

    /// # Safety
    /// - As above; so below.
    unsafe fn store(self, to: &mut Item);

    /// The smaller of each two; of equal or unordered ones `self`'s.
    ///
    /// # Safety
    /// - As above.
    unsafe fn smaller(self, other: Self) -> Self;

    /// Of a box: twice its centre in the first four numbers, the same with its sign changed in the
    /// others.
    ///
    /// # Safety
    /// - As above.
    unsafe fn centre(self) -> Self;

    /// The same, or what changes nothing when the [`smaller`](Self::smaller) is taken.
    ///
    /// # Safety
    /// - As above.
    unsafe fn only_if(self, keep: bool) -> Self;

    /// See [`Item::half_area`].
    ///
    /// # Safety
    /// - As above.
    unsafe fn half_area(self) -> f32;

    /// See [`Binning::bins`].
    ///
    /// # Safety
    /// - As above.
    unsafe fn bins(self, low: &[f32; 4], scale: &[f32; 4]) -> [u32; 3];
}

/// Makes of each function one a level, and one that chooses.
macro_rules! levels {
    ($($(#[$meta:meta])* fn $name:ident($($argument:ident: $type:ty),*) -> $answer:ty = $body:ident;)*) => {
        $(
            $(#[$meta])*
            pub(super) fn $name($($argument: $type),*) -> $answer {
                #[cfg(target_arch = "x86_64")]
                {
                    #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
                    unsafe fn wide($($argument: $type),*) -> $answer {
                        // SAFETY: the caller's promise.
                        unsafe { $body::<avx2::Avx2>($($argument),*) }
                    }
                    if has_avx2() {
                        // SAFETY: just asked.
                        return unsafe { wide($($argument),*) };
                    }
                }
                // SAFETY: every processor has these.
                unsafe { $body::<portable::Portable>($($argument),*) }
            }
        )*
    };
}

levels! {
    /// Puts every item into one bin an axis.
    fn filled(items: &[Item], binning: &Binning) -> Bins = fill;
    /// The cheapest border: the least sum of half area · primitives over both sides. `None` if areas
    /// are beyond the range of numbers.
    fn best_cut(bins: &Bins, binning: &Binning) -> Option<Cut> = best;
    /// Copies items to both sides, each in the order in which it comes.
    fn parted(items: &[Item], cut: &Cut, left: &mut [Item], right: &mut [Item]) -> Sides = part;
}

#[cfg(target_arch = "x86_64")]
fn has_avx2() -> bool {
    std::is_x86_feature_detected!("avx2")
        && std::is_x86_feature_detected!("bmi1")
        && std::is_x86_feature_detected!("bmi2")
        && std::is_x86_feature_detected!("lzcnt")
        && std::is_x86_feature_detected!("popcnt")
}

/// So many items, all zeros.
pub(crate) fn zeroed_items(count: usize) -> Vec<Item> {
    // SAFETY: an item is eight singles, and a single may be zero.
    unsafe { memory::zeroed(count) }
}

/// So many quads, all zeros.
pub(crate) fn zeroed_quads(count: usize) -> Vec<super::super::Quad> {
    // SAFETY: a quad is forty singles.
    unsafe { memory::zeroed(count) }
}
