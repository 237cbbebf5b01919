//! From a file to a structure.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::sync::Arc;

use memmap2::{Mmap, MmapMut};
use ombra_geometry::Aabb;

use super::super::node::Node;
use super::super::places::Places;
use super::super::quad::Quad;
use super::super::store::Store;
use super::super::wide::WideTree;
use super::super::{Body, Bvh8, Leaves, PhantomData, Wide};
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
        let mut start = [0; HEADER];
        let start = &mut start[..length.min(HEADER as u64) as usize];
        from.read_exact(start).map_err(io)?;
        let header = Header::read(start, length).map_err(content(path))?;
        // The file has as many bytes: no count asks for more memory than that.
        let too_long = |_| io(io::ErrorKind::OutOfMemory.into());
        let length = usize::try_from(length).map_err(too_long)?;
        let mut pages = MmapMut::map_anon(length).map_err(io)?;
        // To get 140 MB in pages of 4 KB takes 80 ms in a virtual machine, more than all else here.
        // Where there are no large ones, small ones do.
        #[cfg(target_os = "linux")]
        let _ = pages.advise(memmap2::Advice::HugePage);
        pages[..HEADER].copy_from_slice(start);
        from.read_exact(&mut pages[HEADER..]).map_err(io)?;
        Self::of_map(&header, pages.make_read_only().map_err(io)?).map_err(content(path))
    }

    /// The tree in a whole file, if that is whole too.
    pub(super) fn of_map(header: &Header, map: Mmap) -> Result<Self, Found> {
        let map = Arc::new(map);
        // Lists of so many bytes at multiples of 64, as the header was asked; maps begin at whole
        // pages.
        let quads = header.quads_begin() as usize;
        let nodes = Store::mapped(&map, HEADER..quads);
        let quads = Store::mapped(&map, quads..map.len());
        Self::new(header, nodes, quads)
    }

    /// The tree, if it is whole.
    fn new(header: &Header, nodes: Store<Node>, quads: Store<Quad>) -> Result<Self, Found> {
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
        let (leaves, reach) = (Leaves::Places(quads.clone()), Reach::of(&header.bounds));
        Ok(Self {
            structure: Bvh8 {
                tree: Wide::new(Body::Full(tree, leaves), &reach, header.repeats),
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
