//! Cuts where the surface area heuristic expects rays to cost least, tried at the borders of bins.
//!
//! Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", IEEE Symposium on
//! Interactive Ray Tracing 2007. What is done otherwise:
//! 1. All three axes are tried.
//! 2. Far from the leaves a node is made at once: its list is cut in two, then again and again the
//!    part with the largest surface, until there are eight (Wald, Benthin, Boulos, "Getting Rid of
//!    Packets", IEEE Symposium on Interactive Ray Tracing 2008). Shorter lists become a small binary
//!    tree, which is collapsed in the best way there is ([`collapse`](super::collapse)): so rays
//!    visit 2 % fewer nodes, and there is a third less of them.
//! 3. Sides count otherwise near the leaves (`weight`).
//! 4. Boxes of bins are the smaller of eight lanes (see [`Item`]); lists go to and fro between two
//!    buffers, so that no branch hangs on the side to which an item goes ([`lanes`](super::lanes)).
//! 5. Boxes and counts of bins do not depend on the order of the list, and where a list is cut in
//!    tasks does not depend on the number of threads: the tree is the same for any.

use rayon::prelude::*;

use super::super::kernel::MAX_DEPTH;
use super::super::node::MAX_LEAF;
use super::super::wide::WideTree;
use super::grow::{self, Part, TASK};
use super::item::Item;
use super::items::Items;
use super::lanes::{self, Binning, Bins, Cut};

/// Longer lists than this are cut by several tasks.
const CUT_PARALLEL: usize = 8 * TASK;

/// A list with the box around its primitives and the one around their centres.
struct List<'a> {
    items: &'a mut [Item],
    /// As much room again.
    room: &'a mut [Item],
    bounds: Item,
    centres: Item,
    /// How often the whole list was cut to make this one.
    cuts: usize,
}

/// Builds the tree, and the list of primitives that its leaves name.
pub(crate) fn build(items: Items) -> (WideTree, Vec<u32>) {
    let mut list = items.list;
    let mut room = lanes::zeroed_items(list.len());
    grow::grow(List {
        items: &mut list,
        room: &mut room,
        bounds: items.bounds,
        centres: items.centres,
        cuts: 0,
    })
}

impl Part for List<'_> {
    const SHORTEST: usize = MAX_LEAF;

    fn count(&self) -> usize {
        self.items.len()
    }

    fn bounds(&self) -> Item {
        self.bounds
    }

    fn size(&self) -> f32 {
        self.bounds.half_area()
    }

    fn cut(self) -> [Self; 2] {
        cut(self)
    }

    fn write(&self, numbers: &mut Vec<u32>) {
        numbers.extend(self.items.iter().map(Item::primitive));
    }
}

/// Cuts a list in two, neither empty.
fn cut(list: List<'_>) -> [List<'_>; 2] {
    let count = list.items.len();
    let levels = count.next_power_of_two().ilog2() as usize;
    if list.cuts + levels < MAX_DEPTH
        && let Some(binning) = Binning::new(&list.centres, count)
    {
        if count >= CUT_PARALLEL {
            return cut_by_many(list, &binning);
        }
        let bins = lanes::filled(list.items, &binning);
        if let Some(cut) = lanes::best_cut(&bins, &binning) {
            let (left, right) = list.room.split_at_mut(cut.left);
            let centres = lanes::parted(list.items, &cut, left, right);
            return list.moved_to_room(cut.left, cut.bounds, centres);
        }
    }
    halve(list)
}

/// The same by many tasks.
fn cut_by_many<'a>(list: List<'a>, binning: &Binning) -> [List<'a>; 2] {
    let bins: Vec<Bins> = list
        .items
        .par_chunks(TASK)
        .map(|items| lanes::filled(items, binning))
        .collect();
    let mut all = bins[0].clone();
    bins[1..].iter().for_each(|bins| all.add(bins));
    let Some(cut) = lanes::best_cut(&all, binning) else {
        return halve(list);
    };
    let (mut left, mut right) = list.room.split_at_mut(cut.left);
    let mut tasks: Vec<(&[Item], &mut [Item], &mut [Item])> = Vec::with_capacity(bins.len());
    for (items, bins) in list.items.chunks(TASK).zip(&bins) {
        let count = bins.left_of(&cut);
        let (low, high);
        (low, left) = left.split_at_mut(count);
        (high, right) = right.split_at_mut(items.len() - count);
        tasks.push((items, low, high));
    }
    let sides = tasks
        .into_par_iter()
        .map(|(items, low, high)| lanes::parted(items, &cut, low, high))
        .reduce(
            || [Item::EMPTY; 2],
            |mut a, b| {
                a[0].add(&b[0]);
                a[1].add(&b[1]);
                a
            },
        );
    let Cut { left, bounds, .. } = cut;
    list.moved_to_room(left, bounds, sides)
}

/// Halves a list at the middle centre along the longest axis, of equal centres the smaller numbers
/// first.
fn halve(list: List<'_>) -> [List<'_>; 2] {
    let centres = &list.centres;
    let extent = |k: usize| -centres.lanes[k + 4] - centres.lanes[k];
    let axis = (0..3).fold(0, |best, k| if extent(k) > extent(best) { k } else { best });
    let at = list.items.len() / 2;
    list.items.select_nth_unstable_by(at, |a, b| {
        a.twice_centre(axis)
            .total_cmp(&b.twice_centre(axis))
            .then(a.primitive().cmp(&b.primitive()))
    });
    let (mut bounds, mut centres) = ([Item::EMPTY; 2], [Item::EMPTY; 2]);
    for (k, item) in list.items.iter().enumerate() {
        bounds[usize::from(k >= at)].add(item);
        centres[usize::from(k >= at)].add_centre(item);
    }
    list.split(at, bounds, centres)
}

impl<'a> List<'a> {
    /// Both sides, after items were copied to the room.
    fn moved_to_room(self, at: usize, bounds: [Item; 2], centres: [Item; 2]) -> [List<'a>; 2] {
        let moved = Self {
            items: self.room,
            room: self.items,
            ..self
        };
        moved.split(at, bounds, centres)
    }

    fn split(self, at: usize, bounds: [Item; 2], centres: [Item; 2]) -> [List<'a>; 2] {
        let items = self.items.split_at_mut(at);
        let room = self.room.split_at_mut(at);
        let cuts = self.cuts + 1;
        [
            List {
                items: items.0,
                room: room.0,
                bounds: bounds[0],
                centres: centres[0],
                cuts,
            },
            List {
                items: items.1,
                room: room.1,
                bounds: bounds[1],
                centres: centres[1],
                cuts,
            },
        ]
    }
}
