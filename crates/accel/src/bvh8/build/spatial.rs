//! Cuts of space where they pay: what lies on both sides of a plane is listed on both, each time with
//! the box of its part.
//!
//! Stich, Friedrich, Dietrich, "Spatial Splits in Bounding Volume Hierarchies", High-Performance
//! Graphics 2009. Such cuts are tried where the two boxes of the best cut of the list overlap by more
//! than a little (section 4.5 there), and taken if they are cheaper; primitives are put on one side
//! only if that is cheaper still (section 4.4). How many times more primitives there may be is
//! limited, and each list has its share of that from the start, so the tree is the same for any
//! number of threads.

use ombra_geometry::TriangleMesh;

use super::super::kernel::MAX_DEPTH;
use super::super::node::{Child, MAX_LEAF};
use super::super::wide::WideTree;
use super::clip::{Triangle, split};
use super::grow::{self, Part};
use super::item::Item;
use super::items::Items;
use super::lanes::{self, Binning, Cut};

/// There may be half as many listed again as there are primitives.
const MORE: usize = 2;
/// By how much boxes must overlap, as a part of the root's area.
const OVERLAP: f32 = 1e-5;
/// By how much boxes must overlap, as a part of the list's own area. With less a hall of 66 000
/// triangles has no fewer nodes visited, and a city of boxes 1.5 %, for a build that takes three times
/// as long; with twice as much a fifth of what is gained in the hall is lost (November 2026).
const PART: f32 = 0.2;
/// Bins an axis.
const BINS: usize = 16;

/// A list.
struct List<'a> {
    mesh: Option<&'a TriangleMesh>,
    items: Vec<Item>,
    bounds: Item,
    centres: Item,
    /// How many more may be listed below.
    more: usize,
    /// From which area of overlap on space is cut.
    overlap: f32,
    cuts: usize,
}

/// Builds the tree, and the list of primitives that its leaves name: more than once where space was
/// cut, which is only done to triangles.
pub(crate) fn build(items: Items, mesh: Option<&TriangleMesh>) -> (WideTree, Vec<u32>) {
    let overlap = if items.list.is_empty() {
        0.0
    } else {
        OVERLAP * items.bounds.half_area()
    };
    let (mut tree, mut numbers) = grow::grow(List {
        mesh,
        more: mesh.map_or(0, |_| items.list.len() / MORE),
        bounds: items.bounds,
        centres: items.centres,
        items: items.list,
        overlap,
        cuts: 0,
    });
    once(&mut tree, &mut numbers);
    (tree, numbers)
}

impl Part for List<'_> {
    const SHORTEST: usize = 2;

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
        let count = self.items.len();
        let levels = count.next_power_of_two().ilog2() as usize;
        if self.cuts + levels >= MAX_DEPTH {
            return self.halve();
        }
        let object = Binning::new(&self.centres, count).and_then(|binning| {
            let bins = lanes::filled(&self.items, &binning);
            lanes::best_cut(&bins, &binning)
        });
        let overlap = object.as_ref().map_or(f32::INFINITY, |cut| {
            common_area(&cut.bounds[0], &cut.bounds[1])
        });
        let enough = overlap > self.overlap && overlap > PART * self.bounds.half_area();
        if self.more > 0 && count > MAX_LEAF && enough {
            let limit = object.as_ref().map_or(f32::INFINITY, |cut| cut.cost);
            if let Some(plane) = self.best_plane(limit)
                && let Some(sides) = self.cut_space(&plane)
            {
                return sides;
            }
        }
        match object {
            Some(cut) => self.cut_list(&cut),
            None => self.halve(),
        }
    }

    fn write(&self, numbers: &mut Vec<u32>) {
        numbers.extend(self.items.iter().map(Item::primitive));
    }
}

/// Half the area of what two boxes have in common; 0 if that is nothing.
fn common_area(a: &Item, b: &Item) -> f32 {
    let larger = |k: usize| {
        if a.lanes[k] > b.lanes[k] {
            a.lanes[k]
        } else {
            b.lanes[k]
        }
    };
    let common = Item {
        lanes: std::array::from_fn(larger),
    };
    if (0..3).all(|k| common.lanes[k] <= -common.lanes[k + 4]) {
        common.half_area()
    } else {
        0.0
    }
}

/// A plane, and what lies on both sides of it.
struct Plane {
    axis: usize,
    at: f32,
    bounds: [Item; 2],
    counts: [u32; 2],
    cost: f32,
}

/// The planes between the bins of an axis.
struct Planes {
    low: f32,
    step: f32,
}

impl Planes {
    /// Below bin k.
    fn at(&self, k: usize) -> f32 {
        self.low + self.step * k as f32
    }

    /// The last bin whose lower plane is not above x, or is below it.
    fn bin(&self, x: f32, or_below: bool) -> usize {
        let guess = ((x - self.low) / self.step) as usize;
        let mut bin = guess.min(BINS - 1);
        let beyond = |plane: f32| if or_below { plane >= x } else { plane > x };
        while bin > 0 && beyond(self.at(bin)) {
            bin -= 1;
        }
        while bin + 1 < BINS && !beyond(self.at(bin + 1)) {
            bin += 1;
        }
        bin
    }
}

impl<'a> List<'a> {
    /// The triangle of an item, if it is one to compute with.
    fn triangle(&self, item: &Item) -> Option<Triangle> {
        let corners = self.mesh?.corners(item.primitive() as usize);
        let corners = corners.map(|p| [p.x, p.y, p.z, 0.0].map(f64::from));
        let finite = corners.as_flattened().iter().all(|x| x.is_finite());
        finite.then_some(corners)
    }

    /// The cheapest plane, if it costs less than a limit.
    fn best_plane(&self, limit: f32) -> Option<Plane> {
        let mut best: Option<Plane> = None;
        for axis in 0..3 {
            let low = self.bounds.lanes[axis];
            let step = (-self.bounds.lanes[axis + 4] - low) / BINS as f32;
            if !(step > 0.0 && step.is_finite() && low + step > low) {
                continue;
            }
            let limit = best.as_ref().map_or(limit, |best| best.cost);
            if let Some(plane) = self.best_plane_across(axis, &Planes { low, step }, limit) {
                best = Some(plane);
            }
        }
        best
    }

    fn best_plane_across(&self, axis: usize, planes: &Planes, limit: f32) -> Option<Plane> {
        let mut boxes = [Item::EMPTY; BINS];
        let (mut entries, mut exits) = ([0_u32; BINS], [0_u32; BINS]);
        for item in &self.items {
            let first = planes.bin(item.lanes[axis], false);
            let last = planes.bin(-item.lanes[axis + 4], true).max(first);
            entries[first] += 1;
            exits[last] += 1;
            if first == last {
                boxes[first].add(item);
                continue;
            }
            let triangle = self.triangle(item);
            let mut rest = Some(*item);
            for (bin, within) in boxes.iter_mut().enumerate().take(last).skip(first) {
                let plane = planes.at(bin + 1);
                // Parts are smaller than the bins that the whole reaches.
                let Some(part) = rest.filter(|part| part.lanes[axis] < plane) else {
                    continue;
                };
                let [below, above] = if plane < -part.lanes[axis + 4] {
                    split(&part, triangle.as_ref(), axis, plane)
                } else {
                    [Some(part), None]
                };
                if let Some(below) = below {
                    within.add(&below);
                }
                rest = above;
            }
            if let Some(rest) = rest {
                boxes[last].add(&rest);
            }
        }
        let few = self.items.len() < lanes::FEW_LEAVES;
        let mut right_costs = [(0.0, Item::EMPTY, 0); BINS];
        let (mut right, mut count) = (Item::EMPTY, 0);
        for k in (1..BINS).rev() {
            right.add(&boxes[k]);
            count += exits[k];
            right_costs[k] = (right.half_area() * lanes::weight(count, few), right, count);
        }
        let (mut left, mut count) = (Item::EMPTY, 0);
        let mut best: Option<Plane> = None;
        for k in 1..BINS {
            left.add(&boxes[k - 1]);
            count += entries[k - 1];
            let (right_cost, right, right_count) = right_costs[k];
            let cost = left.half_area() * lanes::weight(count, few) + right_cost;
            if cost < best.as_ref().map_or(limit, |best| best.cost) {
                best = Some(Plane {
                    axis,
                    at: planes.at(k),
                    bounds: [left, right],
                    counts: [count, right_count],
                    cost,
                });
            }
        }
        best
    }

    /// Cuts at a plane; `None` if that makes a side empty or no smaller than it was.
    fn cut_space(&self, plane: &Plane) -> Option<[Self; 2]> {
        let count = self.items.len();
        let mut sides = [self.side(plane.counts[0], 0), self.side(plane.counts[1], 0)];
        let mut more = self.more;
        let few = count < lanes::FEW_LEAVES;
        let [mut left, mut right] = plane.bounds;
        let [mut left_count, mut right_count] = plane.counts;
        for item in &self.items {
            if item.lanes[plane.axis] >= plane.at {
                sides[1].push(item);
                continue;
            }
            if -item.lanes[plane.axis + 4] <= plane.at {
                sides[0].push(item);
                continue;
            }
            let parts = split(item, self.triangle(item).as_ref(), plane.axis, plane.at);
            let [Some(below), Some(above)] = parts else {
                let side = usize::from(parts[0].is_none());
                parts
                    .iter()
                    .flatten()
                    .for_each(|part| sides[side].push(part));
                continue;
            };
            let cost = |left: &Item, left_count: u32, right: &Item, right_count: u32| {
                left.half_area() * lanes::weight(left_count, few)
                    + right.half_area() * lanes::weight(right_count, few)
            };
            let (mut all_left, mut all_right) = (left, right);
            all_left.add(item);
            all_right.add(item);
            let both = cost(&left, left_count, &right, right_count);
            let below_only = cost(&all_left, left_count, &right, right_count.saturating_sub(1));
            let above_only = cost(&left, left_count.saturating_sub(1), &all_right, right_count);
            if more > 0 && both <= below_only && both <= above_only {
                more -= 1;
                sides[0].push(&below);
                sides[1].push(&above);
            } else if below_only <= above_only {
                (left, right_count) = (all_left, right_count.saturating_sub(1));
                sides[0].push(item);
            } else {
                (right, left_count) = (all_right, left_count.saturating_sub(1));
                sides[1].push(item);
            }
        }
        let [left, right] = [sides[0].items.len(), sides[1].items.len()];
        if left == 0 || right == 0 || left >= count || right >= count {
            return None;
        }
        sides[0].more = (more as u64 * left as u64 / (left + right) as u64) as usize;
        sides[1].more = more - sides[0].more;
        Some(sides)
    }

    /// Cuts the list.
    fn cut_list(self, cut: &Cut) -> [Self; 2] {
        let count = self.items.len();
        let mut sides = [
            self.side(cut.left as u32, 0),
            self.side((count - cut.left) as u32, 0),
        ];
        let [left, right] = &mut sides;
        left.items.resize(cut.left, Item::EMPTY);
        right.items.resize(count - cut.left, Item::EMPTY);
        let centres = lanes::parted(&self.items, cut, &mut left.items, &mut right.items);
        left.more = (self.more as u64 * cut.left as u64 / count as u64) as usize;
        right.more = self.more - left.more;
        (left.bounds, right.bounds) = (cut.bounds[0], cut.bounds[1]);
        (left.centres, right.centres) = (centres[0], centres[1]);
        sides
    }

    /// Halves the list as it lies.
    fn halve(self) -> [Self; 2] {
        let half = self.items.len() / 2;
        let mut sides = [
            self.side(half as u32, self.more / 2),
            self.side(half as u32, self.more / 2),
        ];
        for (k, item) in self.items.iter().enumerate() {
            sides[usize::from(k >= half)].push(item);
        }
        sides
    }

    /// A side that has nothing yet.
    fn side(&self, count: u32, more: usize) -> Self {
        Self {
            items: Vec::with_capacity(count as usize),
            bounds: Item::EMPTY,
            centres: Item::EMPTY,
            more,
            cuts: self.cuts + 1,
            ..*self
        }
    }

    fn push(&mut self, item: &Item) {
        self.bounds.add(item);
        self.centres.add_centre(item);
        self.items.push(*item);
    }
}

/// Names each primitive once a leaf.
fn once(tree: &mut WideTree, numbers: &mut [u32]) {
    let mut named = |leaf: &mut Child| {
        if leaf.is_leaf() {
            let list = &mut numbers[leaf.range()];
            let mut count = 0;
            for k in 0..list.len() {
                if !list[..count].contains(&list[k]) {
                    list[count] = list[k];
                    count += 1;
                }
            }
            *leaf = Child::list(leaf.range().start, count);
        }
    };
    named(&mut tree.root);
    let children = tree.nodes.iter_mut().flat_map(|node| &mut node.child);
    children.for_each(named);
}
