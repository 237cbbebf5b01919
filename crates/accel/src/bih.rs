//! The bounding interval hierarchy: half way between a kd-tree and a BVH.
//!
//! Wächter, Keller, "Instant Ray Tracing: The Bounding Interval Hierarchy", EGSR 2006. Each node
//! cuts its list of primitives in two and keeps two planes across one axis: where the left part
//! ends and where the right part begins. The parts may overlap or leave a gap.
//!
//! The cut is found without looking for it: a box, at first around everything, is halved along its
//! longest side, like the cells of an octree; primitives go by their centres.
//!
//! What the two planes leave open is closed by a third kind of node, a slab: where primitives take
//! much less room across some axis than the nodes above say, it says so.

use std::ops::ControlFlow;

use arrayvec::ArrayVec;
use ombra_geometry::{Aabb, Axis, Vector3};

use crate::partition::{halve, partition};
use crate::{Bounded, Reach, Span, Structure, TraversalRay, Visitor};

/// As many primitives or fewer make a leaf.
const LEAF: usize = 4;

/// No leaf lies deeper than this; near it, lists are halved by number.
const MAX_DEPTH: usize = 64;

/// A slab is worth a node if primitives take less than this part of the room that they seem to have.
const SLAB: f32 = 0.75;

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
    /// Where everything below begins and ends. Its one child is the next node.
    Slab { axis: Axis, clip: [f32; 2] },
}

const _: () = assert!(size_of::<Node>() == 16);

impl Structure for Bih {
    fn build(primitives: &[Bounded], _reach: &Reach) -> Self {
        let mut items = primitives.to_vec();
        let bounds = around(&items);
        let mut nodes = Vec::new();
        if !items.is_empty() {
            let room = Room {
                cell: bounds,
                known: bounds,
                depth: 0,
            };
            grow(&mut items, 0, room, &mut nodes);
        }
        nodes.shrink_to_fit();
        Self {
            bounds,
            nodes,
            primitives: items.iter().map(|item| item.primitive).collect(),
        }
    }

    /// In double precision, all t counted from `box_start`.
    fn traverse<V: Visitor>(&self, ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()> {
        if self.nodes.is_empty() {
            return ControlFlow::Continue(());
        }
        let mut waiting = ArrayVec::<(u32, Interval), MAX_DEPTH>::new();
        let inverse = ray.inverse_direction();
        let all = ray.clip(inverse, &self.bounds.wide(), visitor.t_max());
        let mut next = all.map(|[from, to]| (0, Interval { from, to }));
        visitor.node();
        while let Some((index, interval)) = next.take().or_else(|| waiting.pop()) {
            if interval.from > visitor.t_max() - ray.box_start {
                continue;
            }
            match self.nodes[index as usize] {
                Node::Leaf { first, count } => {
                    let leaf = first as usize..first as usize + count as usize;
                    visitor.leaf(&self.primitives[leaf], Span::ALL)?;
                }
                Node::Slab { axis, clip } => {
                    visitor.node();
                    next = interval
                        .within(axis, clip, ray, inverse)
                        .map(|interval| (index + 1, interval));
                }
                Node::Inner { axis, right, clip } => {
                    visitor.node();
                    let parts = interval.cut(axis, clip, ray, inverse);
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

/// The part of the ray within a node: t in `[from, to]`, counted from the walk's start.
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
    fn cut(
        self,
        axis: Axis,
        clip: [f32; 2],
        ray: &TraversalRay,
        inverse: Vector3<f64>,
    ) -> [Option<Self>; 2] {
        let origin = ray.box_origin[axis];
        let to_left = f64::from(clip[0]) + ray.box_pad - origin;
        let to_right = f64::from(clip[1]) - ray.box_pad - origin;
        let inverse = inverse[axis];
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

    /// What lies between two planes.
    #[inline]
    fn within(
        self,
        axis: Axis,
        [lower, upper]: [f32; 2],
        ray: &TraversalRay,
        inverse: Vector3<f64>,
    ) -> Option<Self> {
        // Before the upper one, and of that what is behind the lower one.
        let [before, _] = self.cut(axis, [upper, lower], ray, inverse);
        let [_, behind] = before?.cut(axis, [upper, lower], ray, inverse);
        behind
    }
}

/// What is known of a place in the tree before it is filled.
#[derive(Clone, Copy)]
struct Room {
    /// The box that is halved.
    cell: Aabb,
    /// What the planes above say of where the primitives are.
    known: Aabb,
    /// Cuts above this place.
    depth: usize,
}

/// Appends the tree over `items`, which begin at `first` in the whole list.
///
/// Everywhere depth + ⌈log₂ items⌉ ≤ [`MAX_DEPTH`]: any cut keeps that below the limit, halving
/// keeps it at the limit.
fn grow(items: &mut [Bounded], first: u32, room: Room, nodes: &mut Vec<Node>) {
    let count = items.len();
    let known = add_slabs(&around(items), room.known, nodes);
    let place = nodes.len();
    nodes.push(Node::Leaf {
        first,
        count: count as u32,
    });
    if count <= LEAF {
        return;
    }
    let levels = count.next_power_of_two().ilog2() as usize;
    let cut = if room.depth + levels < MAX_DEPTH {
        cut_cell(items, room.cell)
    } else {
        None
    };
    let Cut { axis, at, cells } = cut.unwrap_or_else(|| cut_by_number(items, room.cell));
    let (left, right) = items.split_at_mut(at);
    let clip = [around(left).max[axis], around(right).min[axis]];
    let mut rooms = cells.map(|cell| Room {
        cell,
        known,
        depth: room.depth + 1,
    });
    rooms[0].known.max[axis] = clip[0];
    rooms[1].known.min[axis] = clip[1];
    grow(left, first, rooms[0], nodes);
    let right_place = nodes.len() as u32;
    grow(right, first + at as u32, rooms[1], nodes);
    nodes[place] = Node::Inner {
        axis,
        right: right_place,
        clip,
    };
}

/// Appends slabs where `bounds` are much narrower than is known, and says what is known then.
fn add_slabs(bounds: &Aabb, mut known: Aabb, nodes: &mut Vec<Node>) -> Aabb {
    for axis in Axis::ALL {
        let clip = [bounds.min[axis], bounds.max[axis]];
        if clip[1] - clip[0] < SLAB * (known.max[axis] - known.min[axis]) {
            nodes.push(Node::Slab { axis, clip });
            [known.min[axis], known.max[axis]] = clip;
        }
    }
    known
}

/// The box around some primitives.
fn around(items: &[Bounded]) -> Aabb {
    let boxes = items.iter().map(|item| item.bounds);
    boxes.fold(Aabb::EMPTY, Aabb::union)
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

#[cfg(test)]
mod tests {
    use super::*;
    use ombra_geometry::Point3;

    fn built(centres: impl IntoIterator<Item = [f32; 3]>) -> (Bih, usize) {
        let bounded = |(primitive, centre): (u32, [f32; 3])| Bounded {
            bounds: Aabb::around([Point3::from(centre)]),
            primitive,
        };
        let primitives: Vec<_> = (0..).zip(centres).map(bounded).collect();
        let bih = Bih::build(&primitives, &Reach::of(&around(&primitives)));
        (bih, primitives.len())
    }

    /// Leaves in the order of nodes hold the list from front to back.
    fn assert_each_primitive_once((bih, count): (Bih, usize)) {
        let mut end = 0;
        for node in &bih.nodes {
            if let &Node::Leaf { first, count } = node {
                assert_eq!(first, end);
                end += count;
            }
        }
        assert_eq!(end as usize, count);
        let mut primitives = bih.primitives;
        primitives.sort_unstable();
        assert!(primitives.into_iter().eq(0..count as u32));
    }

    #[test]
    fn every_primitive_is_in_one_leaf_whatever_the_list() {
        assert_each_primitive_once(built([]));
        assert_each_primitive_once(built([[1.0, 2.0, 3.0]]));
        assert_each_primitive_once(built(vec![[1e7; 3]; 5000]));
        assert_each_primitive_once(built((0..5000).map(|i| [i as f32, 0.0, 0.0])));
        assert_each_primitive_once(built((-120..120).map(|i| [2.0_f32.powi(i); 3])));
        assert_each_primitive_once(built((0..100).map(|i| [(i as f32 - 50.0) * 6e36; 3])));
        assert_each_primitive_once(built((0..100).map(|i| [f32::from_bits(i), 0.0, 0.0])));
        let grain = (0..1000).map(|i| [f32::from_bits(1e7_f32.to_bits() + i % 3), 0.0, 1.0]);
        assert_each_primitive_once(built(grain));
    }
}
