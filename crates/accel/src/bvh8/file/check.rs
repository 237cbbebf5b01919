//! Whether a tree is whole.
//!
//! What kernels rely on, and what answers rely on:
//! 1. Each child is a node or a leaf that is there (`node`, `leaf`), each of them once, a node after
//!    the one that names it; so there is no cycle, and the depth is what the header says (`links`).
//! 2. Boxes are finite or the one around nothing, and lie in the box around them; orders name each
//!    child once; leaves hold triangles (`node`, `leaf`).
//!
//! Nothing here follows a path down the tree: each part is one pass over lists, the larger one for
//! several threads.

use crc32fast::Hasher;
use ombra_geometry::Aabb;
use rayon::prelude::*;

use super::super::node::{Child, Node, WIDTH};
use super::super::quad::Quad;
use super::fault::{Found, Part, StructureFault};
use super::header::{AT_BOUNDS, AT_NODES_SUM, AT_QUADS_SUM, AT_ROOT, HEADER, Header};
use super::links;

/// Bytes that are summed up at once where nothing else is done.
const BYTES: usize = 1 << 20;
/// Nodes a task, with their part of the quads: so few that they are in the cache of the processor when
/// they are looked at for the second time.
const NODES: usize = 1 << 9;

/// Nodes and quads as a file has them, with its header.
#[derive(Clone, Copy)]
pub(super) struct Content<'a> {
    pub(super) header: &'a Header,
    pub(super) nodes: &'a [Node],
    pub(super) quads: &'a [Quad],
}

/// Adds up bytes by CRC-32.
pub(super) fn sum(bytes: &[u8]) -> u32 {
    let parts = bytes.par_chunks(BYTES).map(hashed);
    parts.reduce(Hasher::new, joined).finalize()
}

fn hashed(bytes: &[u8]) -> Hasher {
    let mut hasher = Hasher::new();
    hasher.update(bytes);
    hasher
}

fn joined(mut a: Hasher, b: Hasher) -> Hasher {
    a.combine(&b);
    a
}

/// What a task found, or several that lie side by side.
struct Seen {
    nodes: Hasher,
    quads: Hasher,
    /// The first thing that is wrong.
    fault: Option<Found>,
}

/// The byte at which a node begins.
pub(super) const fn at_node(index: usize) -> u64 {
    (HEADER + index * size_of::<Node>()) as u64
}

impl Content<'_> {
    /// The first thing that is wrong, if anything is; damage before all else.
    pub(super) fn check(&self) -> Result<(), Found> {
        let tasks = self.nodes.len().div_ceil(NODES).max(1);
        let nothing = || Seen {
            nodes: Hasher::new(),
            quads: Hasher::new(),
            fault: None,
        };
        let both = |a: Seen, b: Seen| Seen {
            nodes: joined(a.nodes, b.nodes),
            quads: joined(a.quads, b.quads),
            fault: a.fault.or(b.fault),
        };
        let seen = (0..tasks)
            .into_par_iter()
            .map(|task| self.task(task, tasks));
        let seen = seen.reduce(nothing, both);
        let header = self.header;
        for (part, sum, at, stated) in [
            (Part::Nodes, seen.nodes, AT_NODES_SUM, header.nodes_sum),
            (Part::Quads, seen.quads, AT_QUADS_SUM, header.quads_sum),
        ] {
            let found = sum.finalize();
            if found != stated {
                let fault = StructureFault::Checksum {
                    part,
                    found,
                    stated,
                };
                return Err((at as u64, fault));
            }
        }
        self.root()?;
        seen.fault.map_or(Ok(()), Err)?;
        links::check(self)
    }

    /// Looks at some nodes and their leaves, and adds up as large a part of all quads: which in files
    /// that were saved is about those of the leaves.
    fn task(&self, task: usize, tasks: usize) -> Seen {
        let first = (task * NODES).min(self.nodes.len());
        let nodes = &self.nodes[first..(first + NODES).min(self.nodes.len())];
        let quad = |task: usize| (task as u64 * self.quads.len() as u64 / tasks as u64) as usize;
        let quads = &self.quads[quad(task)..quad(task + 1)];
        let mut numbered = (first..).zip(nodes);
        Seen {
            nodes: hashed(bytemuck::cast_slice(nodes)),
            quads: hashed(bytemuck::cast_slice(quads)),
            fault: numbered.find_map(|(index, node)| self.node(index, node).err()),
        }
    }

    /// The root, and the bounds around it.
    fn root(&self) -> Result<(), Found> {
        let root = self.header.root;
        let at = AT_ROOT as u64;
        if root.is_leaf() {
            return self.leaf(root).map_err(|fault| (at, fault));
        }
        if root.0 != 0 {
            return Err((at, StructureFault::Child(root.0)));
        }
        let Some(node) = self.nodes.first() else {
            return Err((at, missing(Part::Nodes, 0, 0)));
        };
        if !is_within(node, &self.header.bounds) {
            return Err((AT_BOUNDS as u64, StructureFault::Outside(0)));
        }
        Ok(())
    }

    fn node(&self, index: usize, node: &Node) -> Result<(), Found> {
        let here = |fault| (at_node(index), fault);
        for (octant, &order) in node.order.iter().enumerate() {
            if !names_all(order) {
                return Err(here(StructureFault::Order(octant)));
            }
        }
        let (bad, not_none) = boxes(node);
        for (k, &child) in node.child.iter().enumerate() {
            if child == Child::NONE && not_none[k] == 0 {
                continue;
            }
            if bad[k] != 0 {
                return Err(here(StructureFault::Box));
            }
            let checked = if child.is_leaf() {
                self.leaf(child)
            } else {
                self.inner(index, child, &node.bounds(k))
            };
            checked.map_err(here)?;
        }
        Ok(())
    }

    /// A child that is a node.
    fn inner(&self, parent: usize, child: Child, bounds: &Aabb) -> Result<(), StructureFault> {
        // The kernels find nodes by this very number.
        let index = child.index();
        if !child.0.is_multiple_of(8) {
            return Err(StructureFault::Child(child.0));
        }
        if index <= parent {
            return Err(StructureFault::Before(index));
        }
        let Some(node) = self.nodes.get(index) else {
            return Err(missing(Part::Nodes, index, self.nodes.len()));
        };
        if !is_within(node, bounds) {
            return Err(StructureFault::Outside(index));
        }
        Ok(())
    }

    fn leaf(&self, leaf: Child) -> Result<(), StructureFault> {
        // The kernels find quads by this very number.
        if leaf.offset() != leaf.quad() * size_of::<Quad>() {
            return Err(StructureFault::Child(leaf.0));
        }
        let (first, count) = (leaf.quad(), leaf.places() / 4);
        let Some(quads) = self.quads.get(first..first + count) else {
            return Err(missing(Part::Quads, first + count - 1, self.quads.len()));
        };
        let numbers: &[f32] = bytemuck::cast_slice(quads);
        let wrong = if count == 1 {
            wrong_place::<4>(numbers, self.header.triangles)
        } else {
            wrong_place::<8>(numbers, self.header.triangles)
        };
        wrong.map_or(Ok(()), |place| Err(StructureFault::Triangle(place)))
    }
}

fn missing(part: Part, index: usize, count: usize) -> StructureFault {
    StructureFault::Missing { part, index, count }
}

/// Which place of a leaf with N of them holds neither a triangle nor none, or a triangle after none:
/// kernels stop at the first place without one.
#[inline(never)]
fn wrong_place<const N: usize>(numbers: &[f32], triangles: u32) -> Option<usize> {
    // Words in place of yes and no: all places of a row go through a few instructions.
    let word = |yes: bool| if yes { u32::MAX } else { 0 };
    let mut zero = [0.0_f32; WIDTH];
    let mut some = [0_u32; WIDTH];
    let mut take = |k: usize, x: f32| {
        // Of what is not finite this is NaN, and stays it.
        zero[k] += 0.0 * x;
        some[k] |= word(!x.is_nan());
    };
    // Eight numbers at once: of four places that is two rows, and at last one.
    let rows = numbers[..9 * N].chunks_exact(WIDTH);
    let rest = rows.remainder();
    for row in rows {
        (0..WIDTH).for_each(|k| take(k, row[k]));
    }
    (0..rest.len()).for_each(|k| take(k, rest[k]));
    for k in N..WIDTH {
        zero[k - N] += zero[k];
        some[k - N] |= some[k];
    }
    let (mut is_triangle, mut is_none) = ([0; N], [0; N]);
    for (k, name) in numbers[9 * N..10 * N].iter().enumerate() {
        let name = name.to_bits();
        is_triangle[k] = word(zero[k] == 0.0) & word(name < triangles);
        is_none[k] = !some[k] & word(name == u32::MAX);
    }
    let mut wrong = 0;
    for k in 0..N {
        wrong |= !(is_triangle[k] | is_none[k]);
    }
    for k in 1..N {
        wrong |= is_triangle[k] & is_none[k - 1];
    }
    if wrong == 0 {
        return None;
    }
    (0..N).find(|&k| {
        is_triangle[k] | is_none[k] == 0 || k > 0 && is_triangle[k] & is_none[k - 1] != 0
    })
}

/// Which boxes of a node are not finite, or upside down; and which are not the one around nothing.
fn boxes(node: &Node) -> ([u32; WIDTH], [u32; WIDTH]) {
    let (mut bad, mut not_none) = ([0; WIDTH], [0; WIDTH]);
    for axis in 0..3 {
        for k in 0..WIDTH {
            let (lower, upper) = (node.lower[axis][k], node.upper[axis][k]);
            // What is NaN fails too.
            bad[k] |= u32::from(!(lower >= f32::MIN))
                | u32::from(!(lower <= upper))
                | u32::from(!(upper <= f32::MAX));
            not_none[k] |= lower.to_bits() ^ f32::INFINITY.to_bits();
            not_none[k] |= upper.to_bits() ^ f32::NEG_INFINITY.to_bits();
        }
    }
    (bad, not_none)
}

/// Whether all boxes of a node lie in one.
fn is_within(node: &Node, bounds: &Aabb) -> bool {
    let (min, max) = (bounds.min.to_array(), bounds.max.to_array());
    let mut outside = [0; WIDTH];
    for axis in 0..3 {
        for (k, outside) in outside.iter_mut().enumerate() {
            let (lower, upper) = (node.lower[axis][k], node.upper[axis][k]);
            *outside |= u32::from(!(lower >= min[axis])) | u32::from(!(upper <= max[axis]));
        }
    }
    outside == [0; WIDTH]
}

/// Whether a word names each of eight children once.
fn names_all(order: u32) -> bool {
    let (low, high) = (order & 0xfff, order >> 12);
    high < 0x1000 && FOUR[low as usize] | FOUR[high as usize] == 255
}

/// Of four children in twelve bits: which they are, a bit each.
static FOUR: [u8; 0x1000] = {
    let mut named = [0; 0x1000];
    let mut four = 0;
    while four < named.len() {
        named[four] =
            1 << (four & 7) | 1 << (four >> 3 & 7) | 1 << (four >> 6 & 7) | 1 << (four >> 9);
        four += 1;
    }
    named
};
