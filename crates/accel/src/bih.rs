//! The bounding interval hierarchy: half way between a kd-tree and a BVH.
//!
//! Wächter, Keller, "Instant Ray Tracing: The Bounding Interval Hierarchy", EGSR 2006. Each node
//! cuts its list of primitives in two and keeps two planes across one axis: where the left part
//! ends and where the right part begins. The parts may overlap or leave a gap.
//!
//! The cut is found without looking for it: a box, at first around everything, is halved along its
//! longest side, like the cells of an octree; primitives go by their centres.

use std::ops::ControlFlow;

use arrayvec::ArrayVec;
use ombra_geometry::{Aabb, Axis};

use crate::partition::{halve, partition};
use crate::{Bounded, Reach, Span, Structure, TraversalRay, Visitor};

/// As many primitives or fewer make a leaf.
const LEAF: usize = 4;

/// No leaf lies deeper than this; near it, lists are halved by number.
const MAX_DEPTH: usize = 64;

/// How often the box is halved for one node before the list is halved by number: so many steps
/// take it from the range of single precision to its finest grain.
const MAX_HALVINGS: usize = 3 * 280;

/// A bounding interval hierarchy.
#[derive(Clone, Debug)]
pub struct Bih {
    bounds: Aabb,
    /// The root first, unless there is nothing.
    nodes: Vec<Node>,
    primitives: Vec<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Node {
    /// Primitives, next to each other in the list.
    Leaf { first: u32, count: u32 },
    Inner {
        axis: Axis,
        /// The right child; the left one is the next node.
        right: u32,
        /// Where the left part ends and the right one begins.
        clip: [f32; 2],
    },
}

const _: () = assert!(size_of::<Node>() == 16);

impl Structure for Bih {
    fn build(primitives: &[Bounded], _reach: &Reach) -> Self {
        let mut items = primitives.to_vec();
        let bounds = items
            .iter()
            .fold(Aabb::EMPTY, |all, item| all.union(item.bounds));
        let mut nodes = Vec::new();
        if !items.is_empty() {
            grow(&mut items, 0, bounds, 0, &mut nodes);
        }
        nodes.shrink_to_fit();
        Self {
            bounds,
            nodes,
            primitives: items.iter().map(|item| item.primitive).collect(),
        }
    }

    /// In double precision, whose rounding is far below what `box_pad` has more than `hit_pad`.
    fn traverse<V: Visitor>(&self, ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()> {
        if self.nodes.is_empty() {
            return ControlFlow::Continue(());
        }
        let mut waiting = ArrayVec::<(u32, Interval), MAX_DEPTH>::new();
        let mut next = clipped_to(&self.bounds, ray).map(|interval| (0, interval));
        visitor.node();
        while let Some((index, interval)) = next.take().or_else(|| waiting.pop()) {
            if interval.from > visitor.t_max() {
                continue;
            }
            match self.nodes[index as usize] {
                Node::Leaf { first, count } => {
                    let leaf = first as usize..first as usize + count as usize;
                    visitor.leaf(&self.primitives[leaf], Span::ALL)?;
                }
                Node::Inner { axis, right, clip } => {
                    visitor.node();
                    let parts = interval.cut(axis, clip, ray);
                    let children = [
                        parts[0].map(|i| (index + 1, i)),
                        parts[1].map(|i| (right, i)),
                    ];
                    let [near, far] = if ray.ray.direction[axis] < 0.0 {
                        [children[1], children[0]]
                    } else {
                        children
                    };
                    next = near;
                    match next {
                        None => next = far,
                        Some(_) => waiting.extend(far),
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }

    fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice()) + size_of_val(self.primitives.as_slice())
    }
}

/// The part of the ray within a node: t in `[from, to]`.
#[derive(Clone, Copy)]
struct Interval {
    from: f64,
    to: f64,
}

impl Interval {
    /// If anything is left.
    fn new(from: f64, to: f64) -> Option<Self> {
        (from <= to).then_some(Self { from, to })
    }

    /// What lies before the end of the left part and behind the beginning of the right one.
    #[inline]
    fn cut(self, axis: Axis, clip: [f32; 2], ray: &TraversalRay) -> [Option<Self>; 2] {
        let origin = ray.ray.origin[axis];
        let to_left = f64::from(clip[0]) + ray.box_pad - origin;
        let to_right = f64::from(clip[1]) - ray.box_pad - origin;
        let inverse = ray.inverse_direction[axis];
        let Self { from, to } = self;
        if inverse.is_infinite() {
            // Along the planes: on the right side of each or not.
            return [
                (to_left >= 0.0).then_some(self),
                (to_right <= 0.0).then_some(self),
            ];
        }
        let (left_end, right_start) = (to_left * inverse, to_right * inverse);
        if inverse > 0.0 {
            [
                Self::new(from, to.min(left_end)),
                Self::new(from.max(right_start), to),
            ]
        } else {
            [
                Self::new(from.max(left_end), to),
                Self::new(from, to.min(right_start)),
            ]
        }
    }
}

/// The part of the ray within a padded box.
fn clipped_to(bounds: &Aabb, ray: &TraversalRay) -> Option<Interval> {
    let all = Interval::new(ray.ray.t_min, ray.ray.t_max);
    Axis::ALL.into_iter().fold(all, |interval, axis| {
        // Before the upper face, and of that what is behind the lower one.
        let faces = [bounds.max[axis], bounds.min[axis]];
        let [before, _] = interval?.cut(axis, faces, ray);
        let [_, behind] = before?.cut(axis, faces, ray);
        behind
    })
}

/// Appends the tree over `items`, which begin at `first` in the whole list. `cell` is the box that
/// is halved.
///
/// Everywhere `depth` + ⌈log₂ items⌉ ≤ [`MAX_DEPTH`]: any cut keeps that below the limit, halving
/// keeps it at the limit.
fn grow(items: &mut [Bounded], first: u32, cell: Aabb, depth: usize, nodes: &mut Vec<Node>) {
    let count = items.len();
    let place = nodes.len();
    nodes.push(Node::Leaf {
        first,
        count: count as u32,
    });
    if count <= LEAF {
        return;
    }
    let levels = count.next_power_of_two().ilog2() as usize;
    let cut = if depth + levels < MAX_DEPTH {
        cut_cell(items, cell)
    } else {
        None
    };
    let Cut { axis, at, cells } = cut.unwrap_or_else(|| cut_by_number(items, cell));
    let (left, right) = items.split_at_mut(at);
    let all = |items: &[Bounded]| items.iter().fold(Aabb::EMPTY, |all, i| all.union(i.bounds));
    let clip = [all(left).max[axis], all(right).min[axis]];
    grow(left, first, cells[0], depth + 1, nodes);
    let right_place = nodes.len() as u32;
    grow(right, first + at as u32, cells[1], depth + 1, nodes);
    nodes[place] = Node::Inner {
        axis,
        right: right_place,
        clip,
    };
}

/// How a list is cut: `at` items on the left, and the box of either part.
struct Cut {
    axis: Axis,
    at: usize,
    cells: [Aabb; 2],
}

/// Halves the box until there are centres in both halves.
fn cut_cell(items: &mut [Bounded], mut cell: Aabb) -> Option<Cut> {
    let centres = Aabb::around(items.iter().map(|item| item.bounds.centre()));
    if centres.min == centres.max {
        return None;
    }
    for _ in 0..MAX_HALVINGS {
        let axis = cell.wide().extent().dominant_axis();
        let middle = cell.centre()[axis];
        let mut cells = [cell; 2];
        cells[0].max[axis] = middle;
        cells[1].min[axis] = middle;
        if centres.max[axis] < middle {
            cell = cells[0];
        } else if centres.min[axis] >= middle {
            cell = cells[1];
        } else {
            let at = partition(items, |item| item.bounds.centre()[axis] < middle);
            return Some(Cut { axis, at, cells });
        }
    }
    None
}

/// Halves the list by number; the box stays what it is.
fn cut_by_number(items: &mut [Bounded], cell: Aabb) -> Cut {
    let centres = Aabb::around(items.iter().map(|item| item.bounds.centre()));
    let axis = centres.wide().extent().dominant_axis();
    let at = halve(items, axis);
    let cells = [cell; 2];
    Cut { axis, at, cells }
}
