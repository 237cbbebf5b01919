//! Bins: how a list may be cut, which cut is cheapest, and the cutting.

use super::super::item::Item;
use super::Eight;

/// The most bins an axis.
pub(in super::super) const BINS: usize = 16;
/// Bins an axis of a list that is short: to look at every border takes longer than to fill.
const FEW: usize = 8;
/// The longest list that is short.
const SHORT: usize = 32;

/// Which bin a centre lies in, along each axis.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Binning {
    /// How many bins.
    count: usize,
    /// Twice the lowest centre.
    low: [f32; 4],
    scale: [f32; 4],
}

impl Binning {
    /// For a list of a length and the box around its centres; `None` if all centres are one.
    #[inline(always)]
    pub(in super::super) fn new(centres: &Item, length: usize) -> Option<Self> {
        let count = if length <= SHORT { FEW } else { BINS };
        let mut low = [0.0; 4];
        let mut scale = [0.0; 4];
        let mut any = false;
        for k in 0..3 {
            low[k] = centres.lanes[k];
            let extent = -centres.lanes[k + 4] - low[k];
            // The highest centre lies in the last bin. An extent beyond the range of numbers, or
            // next to nothing, makes one bin of the axis.
            let factor = (count as f32 * 0.999) / extent;
            if extent > 0.0 && factor.is_finite() && factor > 0.0 {
                scale[k] = factor;
                any = true;
            }
        }
        any.then_some(Self { count, low, scale })
    }

    /// The bin along one axis.
    #[inline(always)]
    fn bin(&self, item: &Item, axis: usize) -> u32 {
        number((item.twice_centre(axis) - self.low[axis]) * self.scale[axis])
    }
}

/// Next to 1½ · 2²³ singles are whole numbers, so that their last bits are those of the number:
/// unlike a conversion, that takes one instruction for four.
pub(super) const NUMBER: f32 = 12_582_912.0;

/// The whole number nearest to x − ½, for x from 0 to less than [`BINS`]; some bin for any other.
#[inline(always)]
pub(super) fn number(x: f32) -> u32 {
    (x - 0.5 + NUMBER).to_bits() & (BINS as u32 - 1)
}

/// A border between two bins.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Cut {
    axis: usize,
    first_right: usize,
    binning: Binning,
    /// The boxes around both sides, and how many primitives the left one has.
    pub(in super::super) bounds: [Item; 2],
    pub(in super::super) left: usize,
    pub(in super::super) cost: f32,
}

/// The bins of three axes.
#[derive(Clone, Debug)]
pub(in super::super) struct Bins {
    boxes: [[Item; BINS]; 3],
    counts: [[u32; BINS]; 3],
}

impl Bins {
    const EMPTY: Self = Self {
        boxes: [[Item::EMPTY; BINS]; 3],
        counts: [[0; BINS]; 3],
    };

    /// Takes in other ones of the same binning.
    pub(in super::super) fn add(&mut self, other: &Self) {
        for axis in 0..3 {
            for k in 0..BINS {
                self.boxes[axis][k].add(&other.boxes[axis][k]);
                self.counts[axis][k] += other.counts[axis][k];
            }
        }
    }

    /// How many primitives each bin has.
    #[cfg(test)]
    pub(super) fn counts(&self) -> [[u32; BINS]; 3] {
        self.counts
    }

    /// All boxes.
    #[cfg(test)]
    pub(super) fn boxes(&self) -> impl Iterator<Item = &Item> {
        self.boxes.as_flattened().iter()
    }

    /// How many primitives lie to the left of a cut.
    pub(in super::super) fn left_of(&self, cut: &Cut) -> usize {
        let counts = &self.counts[cut.axis][..cut.first_right];
        counts.iter().sum::<u32>() as usize
    }
}

/// Lists from this length on are put into two sets of bins in turn.
const TWO_SETS: usize = 256;

/// See [`filled`](super::filled).
#[inline(always)]
pub(super) unsafe fn fill<E: Eight>(items: &[Item], binning: &Binning) -> Bins {
    let mut bins = Bins::EMPTY;
    // SAFETY: the caller's promise.
    unsafe {
        if items.len() < TWO_SETS {
            for item in items {
                put::<E>(&mut bins, item, binning);
            }
            return bins;
        }
        // Neighbours in the list often share a bin, and to read what was just written takes long.
        let mut other = Bins::EMPTY;
        let mut pairs = items.chunks_exact(2);
        for pair in &mut pairs {
            put::<E>(&mut bins, &pair[0], binning);
            put::<E>(&mut other, &pair[1], binning);
        }
        for item in pairs.remainder() {
            put::<E>(&mut bins, item, binning);
        }
        bins.add(&other);
    }
    bins
}

/// Puts an item into one bin an axis.
#[inline(always)]
unsafe fn put<E: Eight>(bins: &mut Bins, item: &Item, binning: &Binning) {
    // SAFETY: the caller's promise.
    unsafe {
        let own = E::load(item);
        let into = own.bins(&binning.low, &binning.scale);
        for (axis, bin) in into.into_iter().enumerate() {
            let bin = bin as usize % BINS;
            let of = &mut bins.boxes[axis][bin];
            E::load(of).smaller(own).store(of);
            bins.counts[axis][bin] += 1;
        }
    }
}

/// Below this many primitives sides count in leaves and in quads.
pub(in super::super) const FEW_LEAVES: usize = 64;

/// What a side costs, but for the area of its box. A leaf costs about the same whether it holds one
/// primitive or eight, and its memory comes in fours. So what is near the leaves counts in leaves and
/// fours, as one to a half: against counting primitives that makes trees a tenth smaller, and rays
/// quicker by 5 % on a dragon of 871 000 triangles, by 1 % in a hall; leaves alone, or fours alone,
/// make them less so. Far above the leaves rounding tells nothing (Zen 5, November 2026).
#[inline(always)]
pub(in super::super) fn weight(count: u32, few: bool) -> f32 {
    if few {
        (2 * count.div_ceil(8) + count.div_ceil(4)) as f32
    } else {
        count as f32
    }
}

/// See [`best_cut`](super::best_cut).
#[inline(always)]
pub(super) unsafe fn best<E: Eight>(bins: &Bins, binning: &Binning) -> Option<Cut> {
    let last = binning.count;
    let few = (bins.counts[0].iter().sum::<u32>() as usize) < FEW_LEAVES;
    let mut best_cost = f32::INFINITY;
    let mut best = None;
    // SAFETY: the caller's promise.
    unsafe {
        let empty = E::load(&Item::EMPTY);
        for axis in 0..3 {
            if binning.scale[axis] == 0.0 {
                continue;
            }
            let (boxes, counts) = (&bins.boxes[axis], &bins.counts[axis]);
            let mut right_cost = [0.0; BINS];
            let (mut right, mut right_count) = (empty, 0);
            for i in (1..last).rev() {
                right = right.smaller(E::load(&boxes[i]));
                right_count += counts[i];
                right_cost[i] = right.half_area() * weight(right_count, few);
            }
            let (mut left, mut count) = (empty, 0);
            for i in 1..last {
                left = left.smaller(E::load(&boxes[i - 1]));
                count += counts[i - 1];
                let cost = left.half_area() * weight(count, few) + right_cost[i];
                // Sides without a primitive cost NaN.
                if cost < best_cost {
                    best_cost = cost;
                    best = Some((axis, i, count));
                }
            }
        }
        let (axis, first_right, count) = best?;
        let mut bounds = [Item::EMPTY; 2];
        for (i, item) in bins.boxes[axis][..last].iter().enumerate() {
            bounds[usize::from(i >= first_right)].add(item);
        }
        Some(Cut {
            axis,
            first_right,
            binning: *binning,
            bounds,
            left: count as usize,
            cost: best_cost,
        })
    }
}

/// The boxes around the centres of both sides.
pub(in super::super) type Sides = [Item; 2];

/// See [`parted`](super::parted).
#[inline(always)]
pub(super) unsafe fn part<E: Eight>(
    items: &[Item],
    cut: &Cut,
    left: &mut [Item],
    right: &mut [Item],
) -> Sides {
    let mut sides = [Item::EMPTY; 2];
    // SAFETY: the caller's promise.
    unsafe {
        let (mut low, mut high) = (E::load(&Item::EMPTY), E::load(&Item::EMPTY));
        let mut count = 0;
        for (i, item) in items.iter().enumerate() {
            let own = E::load(item);
            let is_left = (cut.binning.bin(item, cut.axis) as usize) < cut.first_right;
            // Which way it goes is as good as random: no branch hangs on it.
            let to = if is_left {
                left.as_mut_ptr().wrapping_add(count)
            } else {
                right.as_mut_ptr().wrapping_add(i - count)
            };
            let room = if is_left {
                left.len() - count
            } else {
                right.len() + count - i
            };
            assert!(room > 0, "counted before");
            own.store(&mut *to);
            count += usize::from(is_left);
            let centre = own.centre();
            low = low.smaller(centre.only_if(is_left));
            high = high.smaller(centre.only_if(!is_left));
        }
        low.store(&mut sides[0]);
        high.store(&mut sides[1]);
    }
    sides
}
