//! Cuts where the surface area heuristic expects rays to cost least, tried at the borders of bins.
//!
//! Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", IEEE Symposium on
//! Interactive Ray Tracing 2007. What is done otherwise:
//! 1. All three axes are tried.
//! 2. A leaf costs the same whether it holds one primitive or eight, since eight are tested at
//!    once; so sides count in leaves, rounded up.
//! 3. Boxes of bins are the smaller of eight lanes (see [`Item`]), and the boxes around the centres
//!    of both sides are worked out while the list is parted.
//! 4. Boxes and counts of bins do not depend on the order of the list, and where a list is cut in
//!    parts for several threads does not depend on their number: the tree is the same for any.

use super::super::kernel::MAX_DEPTH;
use super::super::node::MAX_LEAF;
use super::item::Item;
use super::{BinaryNode, BinaryTree};

/// Bins an axis.
const BINS: usize = 16;
/// Lists shorter than this are one task.
const PARALLEL: usize = 1 << 13;

/// A list with the box around its primitives and the one around their centres.
struct List<'a> {
    items: &'a mut [Item],
    /// Where it begins in the whole list.
    first: u32,
    bounds: Item,
    centres: Item,
    depth: usize,
}

/// Builds the tree; the list comes out in the order of the leaves.
pub(crate) fn build(items: &mut [Item]) -> BinaryTree {
    let mut nodes = Vec::new();
    if !items.is_empty() {
        let (bounds, centres) = around(items);
        let list = List {
            items,
            first: 0,
            bounds,
            centres,
            depth: 0,
        };
        grow(list, &mut nodes);
    }
    BinaryTree { nodes }
}

/// The boxes around some primitives and around their centres.
fn around(items: &[Item]) -> (Item, Item) {
    if items.len() >= PARALLEL {
        let (left, right) = items.split_at(items.len() / 2);
        let (mut a, b) = rayon::join(|| around(left), || around(right));
        a.0.add(&b.0);
        a.1.add(&b.1);
        return a;
    }
    let (mut bounds, mut centres) = (Item::EMPTY, Item::EMPTY);
    for item in items {
        bounds.add(item);
        centres.add_centre(item);
    }
    (bounds, centres)
}

/// Appends the tree over a list.
///
/// Everywhere depth + ⌈log₂ items⌉ ≤ [`MAX_DEPTH`]: any cut keeps that below the limit, halving
/// keeps it at the limit.
fn grow(list: List<'_>, nodes: &mut Vec<BinaryNode>) {
    let count = list.items.len();
    let place = nodes.len();
    nodes.push(BinaryNode {
        bounds: list.bounds.bounds(),
        first_or_right: list.first,
        count: count as u32,
    });
    if count <= MAX_LEAF {
        return;
    }
    let [left, right] = cut(list);
    nodes[place].count = 0;
    if count < PARALLEL {
        grow(left, nodes);
        nodes[place].first_or_right = nodes.len() as u32;
        grow(right, nodes);
        return;
    }
    let grown = |list: List<'_>| {
        let mut nodes = Vec::with_capacity(list.items.len() / 2);
        grow(list, &mut nodes);
        nodes
    };
    let (left, right) = rayon::join(|| grown(left), || grown(right));
    for branch in [left, right] {
        let base = nodes.len() as u32;
        nodes[place].first_or_right = base;
        nodes.extend(branch.into_iter().map(|mut node| {
            if !node.is_leaf() {
                node.first_or_right += base;
            }
            node
        }));
    }
}

/// Cuts a list in two, neither empty.
fn cut(list: List<'_>) -> [List<'_>; 2] {
    let List {
        items,
        first,
        centres,
        depth,
        ..
    } = list;
    let count = items.len();
    let levels = count.next_power_of_two().ilog2() as usize;
    let best = if depth + levels < MAX_DEPTH {
        Binning::new(&centres).and_then(|binning| best_cut(items, binning))
    } else {
        None
    };
    let parted = match best {
        Some(cut) => part(items, &cut),
        None => halve(items, &centres),
    };
    let (left, right) = items.split_at_mut(parted.at);
    let side = |items, first, [bounds, centres]: [Item; 2]| List {
        items,
        first,
        bounds,
        centres,
        depth: depth + 1,
    };
    [
        side(left, first, parted.left),
        side(right, first + parted.at as u32, parted.right),
    ]
}

/// Which bin a centre lies in, along each axis.
#[derive(Clone, Copy)]
struct Binning {
    /// Twice the lowest centre.
    low: [f32; 4],
    scale: [f32; 4],
}

impl Binning {
    /// `None` if all centres are one.
    #[inline(always)]
    fn new(centres: &Item) -> Option<Self> {
        let mut low = [0.0; 4];
        let mut scale = [0.0; 4];
        let mut any = false;
        for k in 0..3 {
            low[k] = centres.lanes[k];
            let extent = -centres.lanes[k + 4] - low[k];
            // The highest centre lies in the last bin. An extent beyond the range of numbers, or next
            // to nothing, makes one bin of the axis.
            let factor = (BINS as f32 * 0.999) / extent;
            if extent > 0.0 && factor.is_finite() && factor > 0.0 {
                scale[k] = factor;
                any = true;
            }
        }
        any.then_some(Self { low, scale })
    }

    /// The bins along all axes; the fourth means nothing.
    #[inline(always)]
    fn bins(&self, item: &Item) -> [usize; 4] {
        std::array::from_fn(|k| {
            number((item.lanes[k] - item.lanes[k + 4] - self.low[k]) * self.scale[k])
        })
    }

    /// The bin along one axis.
    #[inline(always)]
    fn bin(&self, item: &Item, axis: usize) -> usize {
        number((item.twice_centre(axis) - self.low[axis]) * self.scale[axis])
    }
}

/// The whole number nearest to x − ½, for x from 0 to less than [`BINS`]; some bin for any other.
/// Next to 1½ · 2²³ singles are whole numbers, so that their last bits are those of the number: unlike a
/// conversion, that takes one instruction for four.
#[inline(always)]
fn number(x: f32) -> usize {
    (x - 0.5 + 12_582_912.0).to_bits() as usize & (BINS - 1)
}

/// A border between two bins.
struct Cut {
    axis: usize,
    first_right: usize,
    binning: Binning,
}

/// The bins of three axes.
struct Bins {
    boxes: [[Item; BINS]; 3],
    counts: [[u32; BINS]; 3],
}

impl Bins {
    const EMPTY: Self = Self {
        boxes: [[Item::EMPTY; BINS]; 3],
        counts: [[0; BINS]; 3],
    };

    /// Puts every item into one bin an axis.
    fn fill(items: &[Item], binning: &Binning) -> Self {
        if items.len() >= 8 * PARALLEL {
            let (left, right) = items.split_at(items.len() / 2);
            let (mut bins, other) = rayon::join(
                || Box::new(Self::fill(left, binning)),
                || Box::new(Self::fill(right, binning)),
            );
            for axis in 0..3 {
                for k in 0..BINS {
                    bins.boxes[axis][k].add(&other.boxes[axis][k]);
                    bins.counts[axis][k] += other.counts[axis][k];
                }
            }
            return *bins;
        }
        let mut bins = Self::EMPTY;
        for item in items {
            let into = binning.bins(item);
            for (axis, &bin) in into[..3].iter().enumerate() {
                bins.boxes[axis][bin].add(item);
                bins.counts[axis][bin] += 1;
            }
        }
        bins
    }
}

/// What a side costs, but for the area of its box: leaves that it needs.
#[inline(always)]
fn leaves(count: u32) -> f32 {
    count as f32
}

/// The cheapest border: the least sum of half area · leaves over both sides. `None` if areas are
/// beyond the range of numbers.
fn best_cut(items: &[Item], binning: Binning) -> Option<Cut> {
    let bins = Bins::fill(items, &binning);
    let mut best_cost = f32::INFINITY;
    let mut best = None;
    for axis in 0..3 {
        if binning.scale[axis] == 0.0 {
            continue;
        }
        let (boxes, counts) = (&bins.boxes[axis], &bins.counts[axis]);
        let mut right_cost = [0.0; BINS];
        let (mut right, mut count) = (Item::EMPTY, 0);
        for i in (1..BINS).rev() {
            right.add(&boxes[i]);
            count += counts[i];
            right_cost[i] = right.half_area() * leaves(count);
        }
        let (mut left, mut count) = (Item::EMPTY, 0);
        for i in 1..BINS {
            left.add(&boxes[i - 1]);
            count += counts[i - 1];
            let cost = left.half_area() * leaves(count) + right_cost[i];
            // Sides without a primitive cost NaN.
            if cost < best_cost && count > 0 && (count as usize) < items.len() {
                best_cost = cost;
                best = Some((axis, i));
            }
        }
    }
    best.map(|(axis, first_right)| Cut {
        axis,
        first_right,
        binning,
    })
}

/// A list parted in two, with the boxes of both sides: around primitives, around centres.
struct Parted {
    at: usize,
    left: [Item; 2],
    right: [Item; 2],
}

/// Brings the items of the lower bins to the front.
fn part(items: &mut [Item], cut: &Cut) -> Parted {
    let (mut left, mut right) = ([Item::EMPTY; 2], [Item::EMPTY; 2]);
    let is_left = |item: &Item| cut.binning.bin(item, cut.axis) < cut.first_right;
    let (mut from, mut to) = (0, items.len());
    while from < to {
        let item = items[from];
        if is_left(&item) {
            left[0].add(&item);
            left[1].add_centre(&item);
            from += 1;
        } else {
            right[0].add(&item);
            right[1].add_centre(&item);
            to -= 1;
            items.swap(from, to);
        }
    }
    Parted {
        at: from,
        left,
        right,
    }
}

/// Halves a list at the middle centre along the longest axis, of equal centres the smaller numbers
/// first.
fn halve(items: &mut [Item], centres: &Item) -> Parted {
    let extent = |k: usize| -centres.lanes[k + 4] - centres.lanes[k];
    let axis = (0..3).fold(0, |best, k| if extent(k) > extent(best) { k } else { best });
    let at = items.len() / 2;
    items.select_nth_unstable_by(at, |a, b| {
        a.twice_centre(axis)
            .total_cmp(&b.twice_centre(axis))
            .then(a.primitive().cmp(&b.primitive()))
    });
    let boxes = |items: &[Item]| <[Item; 2]>::from(around(items));
    let (left, right) = (boxes(&items[..at]), boxes(&items[at..]));
    Parted { at, left, right }
}
