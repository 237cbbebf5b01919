//! The octree.
//!
//! The idea: a cube with too much in it is cut into eight, and so on. Empty space stays in large
//! pieces, detail gets small ones, and where to cut is never a question. In a flat scene the
//! upper four of each eight stay empty, and what remains is a quadtree.
//!
//! Glassner, "Space Subdivision for Fast Ray Tracing", IEEE CG&A 4(10), 1984. The traversal is in
//! the spirit of Revelles, Ureña, Lastra, "An Efficient Parametric Algorithm for Octree Traversal",
//! WSCG 2000: a node is entered with the ray's span in it, the t of its three mid-planes say which
//! child comes first and which after which; at most four of the eight. Unlike there, a plane's t
//! comes from its coordinate and not from halving the t of two others.

use std::ops::ControlFlow;

use arrayvec::ArrayVec;
use ombra_geometry::{Aabb, Axis};
use rayon::prelude::*;

use crate::cells::{CellRay, Root, padded};
use crate::{Bounded, Reach, Structure, TraversalRay, Visitor};

/// A node with no more primitives than this is not cut.
const LEAF: usize = 6;

/// How often a node is cut at most. A cell of this depth is four pads wide.
const DEPTH: u32 = 12;

/// How often, on average, a primitive may be listed.
const REFERENCES: usize = 12;

/// A node with more primitives than this is built by several threads.
const PARALLEL: usize = 4096;

/// An octree.
#[derive(Clone, Debug)]
pub struct Octree {
    root: Root,
    cube: Cube,
    /// The root first; the eight children of a node lie together.
    nodes: Vec<Node>,
    references: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
enum Node {
    /// Bit k of a child's number: it lies above the mid-plane of axis k.
    Inner { children: u32 },
    /// A part of `references`.
    Leaf { first: u32, count: u32 },
}

/// The cube that is cut, and the planes that cut it: 2^[`DEPTH`] a side.
#[derive(Clone, Debug)]
struct Cube {
    min: [f64; 3],
    /// Between two planes of the finest level.
    step: f64,
}

impl Cube {
    /// It begins at the smallest corner of the box, so that a flat scene lies in its lowest layer.
    fn around(bounds: &Aabb<f64>) -> Self {
        Self {
            min: bounds.min.to_vector().to_array(),
            step: bounds.extent().max_norm() / f64::from(1_u32 << DEPTH),
        }
    }

    #[inline]
    fn plane(&self, axis: Axis, index: u32) -> f64 {
        self.min[axis as usize] + f64::from(index) * self.step
    }
}

/// Where a node lies: the indices of its lowest planes, and how many steps its half is.
#[derive(Clone, Copy, Debug)]
struct Place {
    at: [u32; 3],
    /// 0 at the finest level, which cannot be cut.
    half: u32,
}

impl Place {
    const ROOT: Self = Self {
        at: [0; 3],
        half: 1 << (DEPTH - 1),
    };

    /// The mid-plane across an axis.
    #[inline]
    fn middle(&self, axis: Axis) -> u32 {
        self.at[axis as usize] + self.half
    }

    #[inline]
    fn child(&self, child: u32) -> Self {
        Self {
            at: std::array::from_fn(|k| self.at[k] + self.half * (child >> k & 1)),
            half: self.half / 2,
        }
    }
}

/// A node under construction.
enum Branch {
    Leaf(Vec<u32>),
    Inner(Vec<Branch>),
}

impl Structure for Octree {
    fn build(primitives: &[Bounded], reach: &Reach) -> Self {
        let root = Root::new(reach);
        let cube = Cube::around(root.bounds());
        let boxes = padded(primitives, reach);
        let all: Vec<u32> = (0..boxes.len() as u32).collect();
        let budget = if root.can_be_cut() {
            all.len().saturating_mul(REFERENCES).min(u32::MAX as usize)
        } else {
            0
        };
        let branch = grow(&cube, &boxes, all, Place::ROOT, budget);
        let mut tree = Self {
            root,
            cube,
            nodes: vec![Node::Inner { children: 0 }],
            references: Vec::new(),
        };
        tree.lay_down(0, branch, primitives);
        tree.nodes.shrink_to_fit();
        tree.references.shrink_to_fit();
        tree
    }

    #[inline]
    fn traverse<V: Visitor>(&self, ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()> {
        self.root
            .traverse(ray, &self.references, visitor, |ray, visitor| {
                self.walk(ray, visitor)
            })
    }

    fn bytes(&self) -> usize {
        self.root.bytes()
            + size_of_val(self.nodes.as_slice())
            + size_of_val(self.references.as_slice())
    }
}

/// Cuts a node if it is worth it. `budget`: how many references all its leaves together may have.
fn grow(cube: &Cube, boxes: &[Aabb<f64>], list: Vec<u32>, place: Place, budget: usize) -> Branch {
    if list.len() <= LEAF || place.half == 0 {
        return Branch::Leaf(list);
    }
    let mut lists: [Vec<u32>; 8] = Default::default();
    let middle = Axis::ALL.map(|axis| cube.plane(axis, place.middle(axis)));
    for &i in &list {
        let bounds = &boxes[i as usize];
        // Bit k: reaches below, or above, the mid-plane of axis k.
        let (mut below, mut above) = (0, 0);
        for axis in Axis::ALL {
            let k = axis as usize;
            below |= usize::from(bounds.min[axis] <= middle[k]) << k;
            above |= usize::from(bounds.max[axis] >= middle[k]) << k;
        }
        for (child, list) in lists.iter_mut().enumerate() {
            if child & !above == 0 && !child & 7 & !below == 0 {
                list.push(i);
            }
        }
    }
    let total: usize = lists.iter().map(Vec::len).sum();
    if total > budget {
        return Branch::Leaf(list);
    }
    let parallel = list.len() > PARALLEL;
    drop(list);
    let child = |(child, list): (usize, Vec<u32>)| {
        let share = (budget as u128 * list.len() as u128 / total as u128) as usize;
        grow(cube, boxes, list, place.child(child as u32), share)
    };
    Branch::Inner(if parallel {
        lists.into_par_iter().enumerate().map(child).collect()
    } else {
        lists.into_iter().enumerate().map(child).collect()
    })
}

/// A node that is yet to be visited.
#[derive(Clone, Copy, Debug)]
struct Pending {
    node: u32,
    place: Place,
    from: f64,
    to: f64,
}

impl Octree {
    fn lay_down(&mut self, node: usize, branch: Branch, primitives: &[Bounded]) {
        match branch {
            Branch::Leaf(list) => {
                self.nodes[node] = Node::Leaf {
                    first: self.references.len() as u32,
                    count: list.len() as u32,
                };
                let names = list.iter().map(|&i| primitives[i as usize].primitive);
                self.references.extend(names);
            }
            Branch::Inner(branches) => {
                let children = self.nodes.len();
                self.nodes[node] = Node::Inner {
                    children: children as u32,
                };
                self.nodes
                    .resize(children + 8, Node::Leaf { first: 0, count: 0 });
                for (i, branch) in branches.into_iter().enumerate() {
                    self.lay_down(children + i, branch, primitives);
                }
            }
        }
    }

    fn walk<V: Visitor>(&self, ray: &CellRay, visitor: &mut V) -> ControlFlow<()> {
        // Of the at most four children of a node all but one wait while that one is visited.
        let mut stack = ArrayVec::<Pending, { 3 * DEPTH as usize + 4 }>::new();
        stack.push(Pending {
            node: 0,
            place: Place::ROOT,
            from: ray.enter,
            to: ray.exit,
        });
        while let Some(pending) = stack.pop() {
            if visitor.t_max() < pending.from {
                break;
            }
            visitor.node();
            match self.nodes[pending.node as usize] {
                Node::Leaf { count: 0, .. } => {}
                Node::Leaf { first, count } => {
                    let list = &self.references[first as usize..(first + count) as usize];
                    visitor.leaf(list, ray.span(pending.from, pending.to))?;
                }
                Node::Inner { children } => {
                    let parts = self.cut(ray, &pending, children);
                    stack.extend(parts.into_iter().rev());
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// The children that the ray meets, near to far, with their spans.
    #[inline]
    fn cut(&self, ray: &CellRay, node: &Pending, children: u32) -> ArrayVec<Pending, 4> {
        let place = node.place;
        let mut crossing =
            Axis::ALL.map(|axis| ray.crossing(axis, self.cube.plane(axis, place.middle(axis))));
        let mut child = 0;
        for axis in Axis::ALL {
            let k = axis as usize;
            let crossed = !(crossing[k] > node.from);
            child |= u32::from(crossed != ray.runs_down(axis)) << k;
            if crossed {
                crossing[k] = f64::INFINITY;
            }
        }
        let mut parts = ArrayVec::new();
        let mut from = node.from;
        loop {
            let [x, y, z] = crossing;
            let next = if x <= y && x <= z {
                0
            } else if y <= z {
                1
            } else {
                2
            };
            let to = crossing[next].min(node.to);
            // Planes met at the same t leave nothing between them.
            if from < to {
                parts.push(Pending {
                    node: children + child,
                    place: place.child(child),
                    from,
                    to,
                });
            }
            if !(to < node.to) {
                return parts;
            }
            child ^= 1 << next;
            crossing[next] = f64::INFINITY;
            from = to;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::tests::{check_listing, scenes};

    fn leaves(tree: &Octree, node: u32, place: Place, found: &mut Vec<(Aabb<f64>, Vec<u32>)>) {
        match tree.nodes[node as usize] {
            Node::Leaf { first, count } => {
                let edge = (2 * place.half).max(1);
                let corner = |further| {
                    let plane =
                        |axis: Axis| tree.cube.plane(axis, place.at[axis as usize] + further);
                    ombra_geometry::Point3::new(plane(Axis::X), plane(Axis::Y), plane(Axis::Z))
                };
                let bounds = Aabb {
                    min: corner(0),
                    max: corner(edge),
                };
                let list = &tree.references[first as usize..(first + count) as usize];
                found.push((bounds, list.to_vec()));
            }
            Node::Inner { children } => {
                for child in 0..8 {
                    leaves(tree, children + child, place.child(child), found);
                }
            }
        }
    }

    #[test]
    fn every_primitive_is_listed_wherever_its_padded_box_reaches() {
        for (primitives, reach) in scenes() {
            let tree = Octree::build(&primitives, &reach);
            let mut found = Vec::new();
            leaves(&tree, 0, Place::ROOT, &mut found);
            check_listing(&primitives, &reach, &found);
            assert!(tree.references.len() <= primitives.len() * REFERENCES);
        }
    }
}
