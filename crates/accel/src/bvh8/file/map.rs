//! A file that is traced where it lies.
#![expect(
    unsafe_code,
    reason = "nobody can promise for the operating system that a mapped file stays as it is"
)]

use std::fs::File;
use std::path::Path;

use memmap2::MmapOptions;

use super::fault::StructureFileError;
use super::header::{HEADER, Header};
use super::read::{Loaded, content};

impl Loaded {
    /// Maps a file.
    ///
    /// # Safety
    /// - Nobody changes the file, nor makes it shorter, as long as anything of it lives.
    pub(crate) unsafe fn map(path: &Path) -> Result<Self, StructureFileError> {
        let io = |action| move |source| StructureFileError::io(path, action, source);
        let file = File::open(path).map_err(io("opened"))?;
        // All of it is looked at, so all pages may come in at once.
        let mut options = MmapOptions::new();
        // SAFETY: the caller's promise.
        let map = unsafe { options.populate().map(&file) }.map_err(io("mapped"))?;
        let start = &map[..map.len().min(HEADER)];
        let header = Header::read(start, map.len() as u64).map_err(content(path))?;
        Self::of_map(&header, map).map_err(content(path))
    }
}
