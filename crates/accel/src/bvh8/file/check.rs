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

use ombra_geometry::{Aabb, Point3};
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
        for (k, &child) in node.child.iter().enumerate() {
            self.child(index, child, &node.bounds(k)).map_err(here)?;
        }
        Ok(())
    }

    fn child(&self, parent: usize, child: Child, bounds: &Aabb) -> Result<(), StructureFault> {
        if child == Child::NONE && *bounds == Aabb::EMPTY {
            return Ok(());
        }
        if bounds.is_empty() || !bounds.is_finite() {
            return Err(StructureFault::Box);
        }
        if child.is_leaf() {
            return self.leaf(child);
        }
        // The kernels find nodes by this very number.
        let index = child.index();
        if child.0 % 8 != 0 {
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
    let (mut finite, mut nan) = ([true; N], [true; N]);
    for c in 0..9 {
        let row = row(c);
        for k in 0..N {
            finite[k] &= row[k].is_finite();
            nan[k] &= row[k].is_nan();
        }
    }
    let number = row(9).map(f32::to_bits);
    (0..N).find(|&k| {
        let is_triangle = finite[k] & (number[k] < triangles);
        let is_none = nan[k] & (number[k] == u32::MAX);
        !(is_triangle | is_none)
    })
}

/// Whether all boxes of a node lie in one.
fn is_within(node: &Node, bounds: &Aabb) -> bool {
    let least = |row: &[f32; WIDTH]| row.iter().fold(f32::INFINITY, |a, &b| a.min(b));
    let most = |row: &[f32; WIDTH]| row.iter().fold(f32::NEG_INFINITY, |a, &b| a.max(b));
    let lower = Point3::from(node.lower.each_ref().map(least));
    let upper = Point3::from(node.upper.each_ref().map(most));
    let (min, max) = (bounds.min.to_array(), bounds.max.to_array());
    let (lower, upper) = (lower.to_array(), upper.to_array());
    (0..3).all(|k| min[k] <= lower[k] && upper[k] <= max[k])
}

/// Whether a word names each of eight children once.
fn names_all(order: u32) -> bool {
    let named = (0..WIDTH).fold(0, |named, k| named | 1_u32 << (order >> (3 * k) & 7));
    named == 255 && order >> 24 == 0
}
