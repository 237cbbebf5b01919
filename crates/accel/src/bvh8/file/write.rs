//! From a structure to a file.

use std::io::{self, Write};
use std::path::Path;

use ombra_geometry::Aabb;

use super::super::{Body, Leaves, Wide};
use super::check::sum;
use super::fault::StructureFileError;
use super::header::Header;

impl Wide {
    /// Writes the file, if leaves hold triangles and this machine's numbers are those of the file.
    /// What was at the path is there until all is written.
    pub(crate) fn save(
        &self,
        path: &Path,
        bounds: Aabb,
        triangles: u32,
    ) -> Option<Result<(), StructureFileError>> {
        let Body::Full(tree, Leaves::Quads(quads) | Leaves::Places(quads)) = &self.body else {
            return None;
        };
        if cfg!(target_endian = "big") {
            return None;
        }
        let nodes: &[u8] = bytemuck::cast_slice(&tree.nodes);
        let header = Header {
            nodes: tree.nodes.len() as u32,
            quads: quads.len() as u32,
            triangles,
            repeats: self.repeats,
            depth: tree.depth as u32,
            root: tree.root,
            nodes_sum: sum(nodes),
            quads_sum: sum(bytemuck::cast_slice(quads)),
            bounds,
        };
        let parts = [&header.to_bytes(), nodes, bytemuck::cast_slice(quads)];
        let written = write_and_rename(path, parts);
        Some(written.map_err(|source| StructureFileError::io(path, "written", source)))
    }
}

fn write_and_rename(path: &Path, parts: [&[u8]; 3]) -> io::Result<()> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".ombra-");
    // Temporary files are private by default; this one has the permissions of any new file.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut beside = builder.tempfile_in(folder)?;
    for part in parts {
        beside.write_all(part)?;
    }
    beside.persist(path).map_err(|e| e.error)?;
    Ok(())
}
