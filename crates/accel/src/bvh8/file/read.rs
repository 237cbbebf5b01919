//! From a file to a structure.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use bytemuck::Pod;
use ombra_geometry::Aabb;

use super::super::collapse::WideTree;
use super::super::node::Node;
use super::super::places::Places;
use super::super::quad::Quad;
use super::super::store::Store;
use super::super::{Bvh8, Leaves, PhantomData, Wide};
use super::check::Content;
use super::fault::{Found, StructureFileError};
use super::header::{HEADER, Header};
use crate::Reach;

/// A tree out of a file, found to be whole.
pub(crate) struct Loaded {
    pub(crate) structure: Bvh8,
    pub(crate) places: Places,
    pub(crate) reach: Reach,
    pub(crate) bounds: Aabb,
}

impl Loaded {
    /// Reads a file into memory of its own.
    pub(crate) fn read(path: &Path) -> Result<Self, StructureFileError> {
        let io = |action| move |source| StructureFileError::io(path, action, source);
        let mut file = File::open(path).map_err(io("opened"))?;
        let length = file.metadata().map_err(io("read"))?.len();
        Self::from_reader(path, &mut file, length)
    }

    /// The same from bytes in memory.
    pub(crate) fn from_bytes(name: &Path, mut bytes: &[u8]) -> Result<Self, StructureFileError> {
        let length = bytes.len() as u64;
        Self::from_reader(name, &mut bytes, length)
    }

    fn from_reader(
        path: &Path,
        from: &mut impl Read,
        length: u64,
    ) -> Result<Self, StructureFileError> {
        let io = |source| StructureFileError::io(path, "read", source);
        let mut start = Vec::with_capacity(HEADER);
        let header = from.by_ref().take(HEADER as u64);
        { header }.read_to_end(&mut start).map_err(io)?;
        let header = Header::read(&start, length).map_err(content(path))?;
        // The file has as many bytes: no count asks for more memory than that.
        let nodes = list::<Node>(from, header.nodes).map_err(io)?;
        let quads = list::<Quad>(from, header.quads).map_err(io)?;
        Self::new(&header, Store::shared(nodes), Store::shared(quads)).map_err(content(path))
    }

    /// The tree, if it is whole.
    pub(super) fn new(
        header: &Header,
        nodes: Store<Node>,
        quads: Store<Quad>,
    ) -> Result<Self, Found> {
        let content = Content {
            header,
            nodes: &nodes,
            quads: &quads,
        };
        content.check()?;
        let tree = WideTree {
            root: header.root,
            nodes,
            depth: header.depth as usize,
        };
        let reach = Reach::of(&header.bounds);
        Ok(Self {
            structure: Bvh8 {
                tree: Wide::new(tree, Leaves::Places(quads.clone()), &reach),
                care: PhantomData,
            },
            places: Places {
                quads,
                triangles: header.triangles,
            },
            reach,
            bounds: header.bounds,
        })
    }
}

/// A fault as an error of the file.
pub(super) fn content(path: &Path) -> impl Fn(Found) -> StructureFileError + '_ {
    move |(at, fault)| StructureFileError::Content {
        path: path.to_owned(),
        at,
        fault,
    }
}

fn list<T: Pod>(from: &mut impl Read, count: u32) -> io::Result<Vec<T>> {
    if cfg!(target_endian = "big") {
        let message = "numbers in the file are little-endian and this machine's are not";
        return Err(io::Error::new(io::ErrorKind::Unsupported, message));
    }
    let none = |()| io::Error::from(io::ErrorKind::OutOfMemory);
    let mut list = bytemuck::allocation::try_zeroed_vec(count as usize).map_err(none)?;
    from.read_exact(bytemuck::cast_slice_mut(&mut list))?;
    Ok(list)
}
