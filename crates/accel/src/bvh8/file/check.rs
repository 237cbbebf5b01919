//! Whether a tree is whole.
//!
//! What kernels rely on, and what answers rely on:
//! 1. Each child is a node or a leaf that is there (`node`, `leaf`), each of them once, a node after
//!    the one that names it; so there is no cycle, and the depth is what the header says (`links`).
//! 2. Boxes are finite or the one around nothing, and lie in the box around them; orders name each
//!    child once; leaves hold triangles (`node`, `leaf`).
//!
//! Nothing here follows a path down the tree: each part is one pass over lists, for several threads
//! but for `links`.

use ombra_geometry::Aabb;
use rayon::prelude::*;

use super::super::node::{Child, Node, WIDTH};
use super::super::quad::Quad;
use super::fault::{Found, Part, StructureFault};
use super::header::{AT_BOUNDS, AT_NODES_SUM, AT_QUADS_SUM, AT_ROOT, HEADER, Header};
use super::links;

/// Bytes that are summed up at once, and the nodes that are looked at by one task.
const BYTES: usize = 1 << 20;
const NODES: usize = 1 << 10;

/// Nodes and quads as a file has them, with its header.
#[derive(Clone, Copy)]
pub(super) struct Content<'a> {
    pub(super) header: &'a Header,
    pub(super) nodes: &'a [Node],
    pub(super) quads: &'a [Quad],
}

/// Adds up bytes by CRC-32.
pub(super) fn sum(bytes: &[u8]) -> u32 {
    let hashed = |bytes: &[u8]| {
        let mut hasher = crc32fast::Hasher::new();
        hasher.update(bytes);
        hasher
    };
    let joined = |mut a: crc32fast::Hasher, b| {
        a.combine(&b);
        a
    };
    let parts = bytes.par_chunks(BYTES).map(hashed);
    parts.reduce(crc32fast::Hasher::new, joined).finalize()
}

/// The byte at which a node begins.
pub(super) const fn at_node(index: usize) -> u64 {
    (HEADER + index * size_of::<Node>()) as u64
}

impl Content<'_> {
    /// The first thing that is wrong, if anything is.
    pub(super) fn check(&self) -> Result<(), Found> {
        let Header {
            nodes_sum,
            quads_sum,
            ..
        } = *self.header;
        let (nodes, quads) = (
            bytemuck::cast_slice(self.nodes),
            bytemuck::cast_slice(self.quads),
        );
        for (part, bytes, at, stated) in [
            (Part::Nodes, nodes, AT_NODES_SUM, nodes_sum),
            (Part::Quads, quads, AT_QUADS_SUM, quads_sum),
        ] {
            let found = sum(bytes);
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
        let faulty = |(chunk, nodes): (usize, &[Node])| {
            let mut nodes = nodes.iter().enumerate();
            nodes.find_map(|(k, node)| self.node(chunk * NODES + k, node).err())
        };
        let chunks = self.nodes.par_chunks(NODES).enumerate();
        // The first one, whichever thread finds it.
        if let Some(found) = chunks.find_map_first(faulty) {
            return Err(found);
        }
        links::check(self)
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
            places::<4>(numbers, self.header.triangles)
        } else {
            places::<8>(numbers, self.header.triangles)
        };
        wrong.map_or(Ok(()), |place| Err(StructureFault::Triangle(place)))
    }
}

fn missing(part: Part, index: usize, count: usize) -> StructureFault {
    StructureFault::Missing { part, index, count }
}

/// Which place of a leaf with N of them holds neither a triangle nor none.
fn places<const N: usize>(numbers: &[f32], triangles: u32) -> Option<usize> {
    let row = |c: usize| numbers[N * c..].first_chunk::<N>().expect("ten rows");
    // Numbers as bits without their sign, and words in place of yes and no: all places of a row go
    // through four instructions.
    const INFINITE: i32 = f32::INFINITY.to_bits().cast_signed();
    let (mut not_finite, mut not_nan) = ([0_u32; N], [0_u32; N]);
    for c in 0..9 {
        let row = row(c);
        for k in 0..N {
            let size = (row[k].to_bits() & !(1 << 31)).cast_signed();
            not_finite[k] |= u32::from(size >= INFINITE);
            not_nan[k] |= u32::from(size <= INFINITE);
        }
    }
    let number = row(9).map(f32::to_bits);
    // Kernels stop at the first place without a triangle.
    let mut ended = false;
    (0..N).find(|&k| {
        let is_triangle = (not_finite[k] == 0) & (number[k] < triangles);
        let is_none = (not_nan[k] == 0) & (number[k] == u32::MAX);
        ended |= is_none;
        !(is_triangle | is_none) | (is_triangle & ended)
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
