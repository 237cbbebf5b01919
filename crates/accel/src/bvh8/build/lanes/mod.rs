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

#[cfg(test)]
mod tests {
    use super::*;
    use ombra_geometry::{Aabb, Point3};

    /// Boxes without a pattern, some of them far out.
    fn items(count: u32) -> Vec<Item> {
        let number = |i: u32| (i.wrapping_mul(0x9e37_79b9) >> 8) as f32 / 16_777_216.0;
        let item = |i: u32| {
            let low = [3 * i, 3 * i + 1, 3 * i + 2].map(|k| number(k) * number(i).powi(8) * 1e9);
            let high = low.map(|x| x + number(i + 7));
            Item::new(&Aabb::around([low, high].map(Point3::from)), i)
        };
        (0..count).map(item).collect()
    }

    #[test]
    fn every_level_makes_the_same_cuts_to_the_bit() {
        let bits = |item: &Item| item.lanes.map(f32::to_bits);
        // Not the numbers, which mean nothing in boxes that were added up.
        let box_bits = |item: &Item| {
            let [a, b, c, _, x, y, z, _] = bits(item);
            [a, b, c, x, y, z]
        };
        for count in [2, 9, 31, 33, 300, 5000] {
            let items = items(count);
            let mut centres = Item::EMPTY;
            items.iter().for_each(|item| centres.add_centre(item));
            let binning = Binning::new(&centres, items.len()).unwrap();
            // SAFETY: every processor has these.
            let plain = unsafe { fill::<portable::Portable>(&items, &binning) };
            let bins = filled(&items, &binning);
            assert_eq!(bins.counts(), plain.counts());
            let boxes = |bins: &Bins| bins.boxes().map(box_bits).collect::<Vec<_>>();
            assert_eq!(boxes(&bins), boxes(&plain));
            let cut = best_cut(&bins, &binning).unwrap();
            // SAFETY: as above.
            let plain = unsafe { best::<portable::Portable>(&plain, &binning) }.unwrap();
            assert_eq!(
                (cut.left, cut.cost.to_bits()),
                (plain.left, plain.cost.to_bits())
            );
            assert_eq!(
                cut.bounds.each_ref().map(box_bits),
                plain.bounds.each_ref().map(box_bits)
            );
            let mut to = vec![Item::EMPTY; items.len()];
            let (left, right) = to.split_at_mut(cut.left);
            let sides = parted(&items, &cut, left, right);
            let mut plain_to = vec![Item::EMPTY; items.len()];
            let (left, right) = plain_to.split_at_mut(cut.left);
            // SAFETY: as above.
            let plain_sides = unsafe { part::<portable::Portable>(&items, &plain, left, right) };
            assert_eq!(
                sides.each_ref().map(box_bits),
                plain_sides.each_ref().map(box_bits)
            );
            let all = |items: &[Item]| items.iter().map(bits).collect::<Vec<_>>();
            assert_eq!(all(&to), all(&plain_to));
        }
    }
}
