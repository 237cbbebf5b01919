//! The header: what the rest of the file is.

use ombra_geometry::{Aabb, Point3};

use super::super::kernel::MAX_DEPTH;
use super::super::node::{Child, Node};
use super::super::quad::Quad;
use super::fault::{Found, Part, StructureFault};

/// Bytes of the header; the nodes begin here, at a multiple of 64.
pub(super) const HEADER: usize = 128;
/// The version that is written and read: a number for each way in which nodes and quads can lie.
pub(super) const VERSION: u32 = 1;
/// What no text begins with, and what does not outlive being sent as text.
const MAGIC: [u8; 8] = *b"\x89OMBRA\r\n";
const STRUCTURE: [u8; 4] = *b"bvh8";
/// As many as a child can name and a kernel can find (see [`Child::offset`]).
const MOST_NODES: u32 = 1 << 27;
const MOST_QUADS: u32 = (1 << 30) / 5;

// Where the fields are.
const AT_VERSION: usize = 8;
const AT_STRUCTURE: usize = 12;
const AT_NODES: usize = 16;
const AT_QUADS: usize = 20;
const AT_TRIANGLES: usize = 24;
pub(super) const AT_DEPTH: usize = 28;
pub(super) const AT_ROOT: usize = 32;
pub(super) const AT_NODES_SUM: usize = 36;
pub(super) const AT_QUADS_SUM: usize = 40;
pub(super) const AT_BOUNDS: usize = 44;
const AT_REPEATS: usize = 68;
const AT_RESERVED: usize = 72;
const AT_SUM: usize = 124;

/// What a header says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Header {
    pub(super) nodes: u32,
    pub(super) quads: u32,
    /// All numbers of triangles are below this.
    pub(super) triangles: u32,
    /// Whether leaves may name a triangle more than once.
    pub(super) repeats: bool,
    pub(super) depth: u32,
    pub(super) root: Child,
    pub(super) nodes_sum: u32,
    pub(super) quads_sum: u32,
    pub(super) bounds: Aabb,
}

impl Header {
    pub(super) fn to_bytes(self) -> [u8; HEADER] {
        let mut bytes = [0; HEADER];
        let mut put = |at: usize, field: [u8; 4]| bytes[at..at + 4].copy_from_slice(&field);
        put(AT_VERSION, VERSION.to_le_bytes());
        put(AT_STRUCTURE, STRUCTURE);
        put(AT_NODES, self.nodes.to_le_bytes());
        put(AT_QUADS, self.quads.to_le_bytes());
        put(AT_TRIANGLES, self.triangles.to_le_bytes());
        put(AT_DEPTH, self.depth.to_le_bytes());
        put(AT_ROOT, self.root.0.to_le_bytes());
        put(AT_NODES_SUM, self.nodes_sum.to_le_bytes());
        put(AT_QUADS_SUM, self.quads_sum.to_le_bytes());
        let (min, max) = (self.bounds.min.to_array(), self.bounds.max.to_array());
        for (k, number) in min.into_iter().chain(max).enumerate() {
            put(AT_BOUNDS + 4 * k, number.to_le_bytes());
        }
        put(AT_REPEATS, u32::from(self.repeats).to_le_bytes());
        bytes[..MAGIC.len()].copy_from_slice(&MAGIC);
        let sum = crc32fast::hash(&bytes[..AT_SUM]);
        bytes[AT_SUM..].copy_from_slice(&sum.to_le_bytes());
        bytes
    }

    /// Reads the header of a file of so many bytes: `start` is the first [`HEADER`] of them, or all
    /// if there are fewer.
    pub(super) fn read(start: &[u8], length: u64) -> Result<Self, Found> {
        if cfg!(target_endian = "big") {
            return Err((0, StructureFault::Endian));
        }
        let magic = start.len().min(MAGIC.len());
        // A file that is cut is told from one of another kind.
        if start[..magic] != MAGIC[..magic] || magic == 0 {
            return Err((0, StructureFault::Magic));
        }
        let Some(bytes) = start.first_chunk::<HEADER>() else {
            return Err((start.len() as u64, StructureFault::Short));
        };
        let four = |at: usize| [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
        let word = |at: usize| u32::from_le_bytes(four(at));
        // Another version may have its sum elsewhere.
        if word(AT_VERSION) != VERSION {
            return Err((AT_VERSION as u64, StructureFault::Version(word(AT_VERSION))));
        }
        if four(AT_STRUCTURE) != STRUCTURE {
            let fault = StructureFault::Structure(four(AT_STRUCTURE));
            return Err((AT_STRUCTURE as u64, fault));
        }
        let (found, stated) = (crc32fast::hash(&bytes[..AT_SUM]), word(AT_SUM));
        if found != stated {
            let part = Part::Header;
            let fault = StructureFault::Checksum {
                part,
                found,
                stated,
            };
            return Err((AT_SUM as u64, fault));
        }
        let corner = |at: usize| Point3::from([0, 4, 8].map(|k| f32::from_bits(word(at + k))));
        let header = Self {
            nodes: word(AT_NODES),
            quads: word(AT_QUADS),
            triangles: word(AT_TRIANGLES),
            repeats: word(AT_REPEATS) != 0,
            depth: word(AT_DEPTH),
            root: Child(word(AT_ROOT)),
            nodes_sum: word(AT_NODES_SUM),
            quads_sum: word(AT_QUADS_SUM),
            bounds: Aabb {
                min: corner(AT_BOUNDS),
                max: corner(AT_BOUNDS + 12),
            },
        };
        if word(AT_REPEATS) > 1 {
            let fault = StructureFault::Repeats(word(AT_REPEATS));
            return Err((AT_REPEATS as u64, fault));
        }
        let reserved = AT_RESERVED..AT_SUM;
        if let Some(at) = reserved.into_iter().find(|&at| bytes[at] != 0) {
            return Err((at as u64, StructureFault::Reserved(bytes[at])));
        }
        header.check(length)?;
        Ok(header)
    }

    /// What can be said before the rest is seen.
    fn check(&self, length: u64) -> Result<(), Found> {
        for (part, at, found, most) in [
            (Part::Nodes, AT_NODES, self.nodes, MOST_NODES),
            (Part::Quads, AT_QUADS, self.quads, MOST_QUADS),
        ] {
            if found > most {
                return Err((at as u64, StructureFault::TooMany { part, found, most }));
            }
        }
        if self.length() != length {
            let fault = StructureFault::Length {
                nodes: self.nodes,
                quads: self.quads,
                stated: self.length(),
                found: length,
            };
            return Err((AT_NODES as u64, fault));
        }
        let bounds = &self.bounds;
        if *bounds != Aabb::EMPTY && (bounds.is_empty() || !bounds.is_finite()) {
            return Err((AT_BOUNDS as u64, StructureFault::Box));
        }
        if self.depth as usize > MAX_DEPTH {
            let fault = StructureFault::Deep(self.depth as usize);
            return Err((AT_DEPTH as u64, fault));
        }
        Ok(())
    }

    /// Where the quads begin: a multiple of 64 too.
    pub(super) fn quads_begin(&self) -> u64 {
        HEADER as u64 + u64::from(self.nodes) * size_of::<Node>() as u64
    }

    /// Of the whole file.
    pub(super) fn length(&self) -> u64 {
        self.quads_begin() + u64::from(self.quads) * size_of::<Quad>() as u64
    }
}
