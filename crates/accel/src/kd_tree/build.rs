//! Building the tree, in O(n log n).
//!
//! Wald, Havran, "On building fast kd-Trees for Ray Tracing, and on doing that in O(N log N)", RT
//! 2006: the faces of all boxes are sorted once along each axis, and every cut hands both halves
//! their part of the three lists, still in order.
//!
//! Where this departs from the paper:
//! 1. A primitive that lies in both halves is clipped as a box, not as a triangle, because builders
//!    see nothing else. To clip a box to a half is to clamp its coordinates, which leaves them in
//!    order; so nothing is merged, and faces outside of a node are simply passed over.
//! 2. Boxes are padded and thus have volume: the case of a primitive within the plane is none.
//! 3. Besides the depth, the sum of references is bounded, by a budget that is handed down in
//!    proportion: the tree is the same whichever thread builds which part.

use std::cmp::Ordering;

use ombra_geometry::{Aabb, Axis};

use super::node::{MAX_DEPTH, halves};
use super::sah::{Split, best_across};

/// How often, on average, a primitive may be listed.
const REFERENCES: usize = 12;

/// A node with more primitives than this is built by several threads.
const PARALLEL: usize = 4096;

/// A node under construction. Primitives are indices of boxes.
#[derive(Debug)]
pub(super) enum Branch {
    Leaf(Vec<u32>),
    Inner {
        axis: Axis,
        plane: f64,
        /// Below and above.
        children: Box<[Branch; 2]>,
    },
}

/// A face of a box, across an axis: where it begins or ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Event {
    pub(super) position: f64,
    primitive: u32,
    end: bool,
}

impl Event {
    pub(super) const fn begin(position: f64, primitive: u32) -> Self {
        Self {
            position,
            primitive,
            end: false,
        }
    }

    pub(super) const fn end(position: f64, primitive: u32) -> Self {
        Self {
            position,
            primitive,
            end: true,
        }
    }

    pub(super) const fn is_end(&self) -> bool {
        self.end
    }

    /// By position, ends before beginnings.
    pub(super) fn order(&self, other: &Self) -> Ordering {
        self.position
            .total_cmp(&other.position)
            .then(other.end.cmp(&self.end))
            .then(self.primitive.cmp(&other.primitive))
    }
}

/// What a node has of its primitives: their faces along each axis, in order.
struct Faces([Vec<Event>; 3]);

impl Faces {
    fn of(boxes: &[Aabb<f64>]) -> Self {
        Self(on_each_axis(boxes.len(), |axis| {
            let mut events = Vec::with_capacity(2 * boxes.len());
            for (i, bounds) in (0..).zip(boxes) {
                events.push(Event::begin(bounds.min[axis], i));
                events.push(Event::end(bounds.max[axis], i));
            }
            events.sort_unstable_by(Event::order);
            events
        }))
    }

    fn count(&self) -> usize {
        self.0[0].len() / 2
    }

    fn best_split(&self, bounds: &Aabb<f64>) -> Option<Split> {
        let count = self.count();
        on_each_axis(count, |axis| {
            best_across(axis, &self.0[axis as usize], count, bounds)
        })
        .into_iter()
        .flatten()
        .min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    /// The faces of the primitives below and above a plane, which may be in both.
    fn cut(&self, boxes: &[Aabb<f64>], split: &Split) -> [Self; 2] {
        let (across, plane) = (split.axis, split.plane);
        let [x, y, z] = on_each_axis(self.count(), |axis| {
            let events = &self.0[axis as usize];
            // Where an event goes is as good as random. Written to both lists, of which the right
            // one moves on, it costs no mispredicted branch. One place more takes what is in excess.
            let room = |count: usize| vec![Event::begin(0.0, 0); 2 * count + 1];
            let [mut below, mut above] = split.counts.map(room);
            let (mut in_below, mut in_above) = (0, 0);
            for event in events {
                let bounds = &boxes[event.primitive as usize];
                below[in_below] = *event;
                above[in_above] = *event;
                in_below += usize::from(bounds.min[across] < plane);
                in_above += usize::from(bounds.max[across] > plane);
            }
            below.truncate(in_below);
            above.truncate(in_above);
            [below, above]
        });
        let ([x0, x1], [y0, y1], [z0, z1]) = (x, y, z);
        [Self([x0, y0, z0]), Self([x1, y1, z1])]
    }

    /// The primitives, in ascending order.
    fn primitives(&self) -> Vec<u32> {
        let begins = self.0[0].iter().filter(|event| !event.is_end());
        let mut primitives: Vec<_> = begins.map(|event| event.primitive).collect();
        primitives.sort_unstable();
        primitives
    }
}

/// Works on the three axes, by several threads if that is worth it.
fn on_each_axis<T: Send>(count: usize, work: impl Fn(Axis) -> T + Sync) -> [T; 3] {
    if count <= PARALLEL {
        return Axis::ALL.map(work);
    }
    let (x, (y, z)) = rayon::join(
        || work(Axis::X),
        || rayon::join(|| work(Axis::Y), || work(Axis::Z)),
    );
    [x, y, z]
}

/// Builds the tree over padded boxes, all of which lie in `bounds`.
pub(super) fn grow(boxes: &[Aabb<f64>], bounds: &Aabb<f64>) -> Branch {
    let count = boxes.len().max(1);
    // The rule of Pharr, Jakob, Humphreys, "Physically Based Rendering", for kd-trees.
    let depth = (8.0 + 1.3 * (count as f64).log2()) as usize;
    let budget = count.saturating_mul(REFERENCES).min(u32::MAX as usize);
    let faces = Faces::of(boxes);
    divide(boxes, faces, bounds, depth.min(MAX_DEPTH), budget)
}

/// Cuts a node if it is worth it. `budget`: how many references all its leaves together may have.
fn divide(
    boxes: &[Aabb<f64>],
    faces: Faces,
    bounds: &Aabb<f64>,
    depth: usize,
    budget: usize,
) -> Branch {
    let count = faces.count();
    let split = if depth == 0 || count == 0 {
        None
    } else {
        let pays = |split: &Split| split.cost < count as f64;
        faces.best_split(bounds).filter(pays)
    };
    let Some(split) = split else {
        return Branch::Leaf(faces.primitives());
    };
    let [below, above] = faces.cut(boxes, &split);
    let total = below.count() + above.count();
    if total > budget {
        return Branch::Leaf(faces.primitives());
    }
    drop(faces);
    let budget_below = (budget as u128 * below.count() as u128 / total as u128) as usize;
    let [lower, upper] = halves(bounds, split.axis, split.plane);
    let lower = || divide(boxes, below, &lower, depth - 1, budget_below);
    let upper = || divide(boxes, above, &upper, depth - 1, budget - budget_below);
    let (lower, upper) = if count > PARALLEL {
        rayon::join(lower, upper)
    } else {
        (lower(), upper())
    };
    Branch::Inner {
        axis: split.axis,
        plane: split.plane,
        children: Box::new([lower, upper]),
    }
}
