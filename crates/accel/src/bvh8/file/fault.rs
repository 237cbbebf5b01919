//! What is wrong with a structure's file, and where.

use std::io;
use std::path::{Path, PathBuf};

use super::header::{HEADER, VERSION};
use crate::StructureKind;

/// A structure that cannot be saved, or a file that holds none. Shown as one line, such as
/// `city.ombra: byte 8: written as version 7, but version 1 is read here: build and save it again`.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StructureFileError {
    /// The operating system refuses.
    #[error("{}: cannot be {action}: {source}", .path.display())]
    Io {
        /// Which file.
        path: PathBuf,
        /// What was tried: "opened", "read", "written".
        action: &'static str,
        /// Its answer.
        source: io::Error,
    },
    /// Not a structure that can be a file.
    #[error(
        "{}: a structure `{kind}` over these primitives cannot be saved; one that can is `bvh8`, `bvh8-fast` or `bvh8-high` over a mesh with the watertight test",
        .path.display()
    )]
    NotSaved {
        /// Which file.
        path: PathBuf,
        /// What kind of structure.
        kind: StructureKind,
    },
    /// What the file says cannot be.
    #[error("{}: byte {at}: {fault}", .path.display())]
    Content {
        /// Which file.
        path: PathBuf,
        /// Where, in bytes from 0.
        at: u64,
        /// What is wrong there.
        fault: StructureFault,
    },
}

impl StructureFileError {
    pub(super) fn io(path: &Path, action: &'static str, source: io::Error) -> Self {
        let path = path.to_owned();
        Self::Io {
            path,
            action,
            source,
        }
    }
}

/// A part of a structure's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The first bytes.
    Header,
    /// The nodes.
    Nodes,
    /// The triangles of the leaves, by fours.
    Quads,
}

impl Part {
    const fn name(self) -> &'static str {
        match self {
            Self::Header => "header",
            Self::Nodes => "nodes",
            Self::Quads => "quads",
        }
    }
}

/// What can be wrong within a structure's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum StructureFault {
    /// Read where numbers lie the other way round.
    #[error("numbers are little-endian here, and those of this machine are big-endian: build anew")]
    Endian,
    /// Less than a header.
    #[error("the file ends here, within its header of {HEADER} bytes")]
    Short,
    /// Other first bytes.
    #[error(
        "this is no structure file of ombra; one begins with the bytes 89 4F 4D 42 52 41 0D 0A"
    )]
    Magic,
    /// Another version.
    #[error("written as version {0}, but version {VERSION} is read here: build and save it again")]
    Version(u32),
    /// Another kind of structure.
    #[error("the structure is \"{}\", but \"bvh8\" is read here", .0.escape_ascii())]
    Structure([u8; 4]),
    /// Damage.
    #[error("the {} add up to {found:08x} by CRC-32, but {stated:08x} is stated: the file is damaged", .part.name())]
    Checksum {
        /// Of what.
        part: Part,
        /// Of the bytes that are there.
        found: u32,
        /// In the header.
        stated: u32,
    },
    /// More than a child can name.
    #[error("{found} {} are stated, but there can be {most} at most", .part.name())]
    TooMany {
        /// Of what.
        part: Part,
        /// How many are stated.
        found: u32,
        /// How many there can be.
        most: u32,
    },
    /// Another length than the header says.
    #[error("{nodes} nodes and {quads} quads make {stated} bytes, but the file has {found}")]
    Length {
        /// How many nodes are stated.
        nodes: u32,
        /// How many quads are stated.
        quads: u32,
        /// How many bytes there should be.
        stated: u64,
        /// How many there are.
        found: u64,
    },
    /// Bytes without a meaning that are not 0.
    #[error("a byte is {0} that has no meaning in version {VERSION} and must be 0")]
    Reserved(u8),
    /// Neither yes nor no.
    #[error(
        "whether triangles are listed more than once is 0 for no or 1 for yes, but {0} is stated"
    )]
    Repeats(u32),
    /// A box that is neither finite nor that around nothing.
    #[error(
        "a box is neither finite, its lower corner below its upper one, nor the one around nothing, from inf to -inf"
    )]
    Box,
    /// A box that sticks out.
    #[error("boxes of node {0} are not within the box around them")]
    Outside(usize),
    /// A word that is no order.
    #[error("the order for octant {0} does not name each of the eight children once")]
    Order(usize),
    /// A child that is not what a child can be.
    #[error(
        "the child {0:#010x} is neither a node, nor a leaf, nor 0 in a place with the box around nothing"
    )]
    Child(u32),
    /// A child that is not there.
    #[error("a child is {} {index}, but there are {count}", .part.name())]
    Missing {
        /// Of what.
        part: Part,
        /// Which is named.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A child that comes before its parent, as in a cycle.
    #[error("a child is node {0}, which does not come after the node that names it")]
    Before(usize),
    /// A child of two nodes.
    #[error("a child is {} {index}, which another one is already", .part.name())]
    Twice {
        /// Of what.
        part: Part,
        /// Which is named twice.
        index: usize,
    },
    /// A node or a quad that no node names.
    #[error("{} {index} is no child of any node", .part.name())]
    Unnamed {
        /// Of what.
        part: Part,
        /// Which.
        index: usize,
    },
    /// More levels than a walk has room for.
    #[error("a node lies on level {0}, but there are at most 64 levels")]
    Deep(usize),
    /// Another depth than the header says.
    #[error("{stated} levels of nodes are stated, but there are {found}")]
    Depth {
        /// In the header.
        stated: u32,
        /// How many there are.
        found: usize,
    },
    /// A triangle that is not one.
    #[error(
        "place {0} of a leaf holds neither a triangle, with finite corners and a number below that of triangles, nor, after all triangles, NaN corners and the number 4294967295"
    )]
    Triangle(usize),
}

/// A fault and the byte where it is.
pub(super) type Found = (u64, StructureFault);
