//! A tree of triangles as a file. `docs/structure-file.md` says what each byte means.
//!
//! A file is what lies in memory: a header, the nodes, the triangles of the leaves. Nothing is
//! converted, so that a file can be traced where it lies. Kernels read a tree without asking whether
//! what it names is there; so everything that they rely on is asked here, once (`check`).

mod check;
mod fault;
mod header;
mod links;
mod map;
mod over;
pub(crate) mod read;
mod write;

pub use fault::{Part, StructureFault, StructureFileError};
pub use over::OtherMesh;
