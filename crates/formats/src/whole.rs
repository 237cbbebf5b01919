//! Files that are either whole or not there.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use crate::error::FormatError;
use crate::image::{file_beside, write_error};

/// Writes a file beside its place under another name, and renames it when it is whole.
///
/// # Errors
/// When the folder does not exist or cannot be written into, or the path is a folder; what was there
/// before is still there then.
pub fn write_whole(path: impl AsRef<Path>, content: &[u8]) -> Result<(), FormatError> {
    write_whole_with(path, |file| file.write_all(content))
}

/// The same for content that is not in memory at once: `write` writes it.
pub(crate) fn write_whole_with(
    path: impl AsRef<Path>,
    write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> Result<(), FormatError> {
    let path = path.as_ref();
    let write = || {
        let mut beside = file_beside(path)?;
        let mut file = BufWriter::with_capacity(1 << 18, beside.as_file_mut());
        write(&mut file)
            .and_then(|()| file.flush())
            .map_err(write_error)?;
        drop(file);
        beside
            .persist(path)
            .map(drop)
            .map_err(|e| write_error(e.error))
    };
    write().map_err(|e| e.in_file(path))
}

/// Whether [`write_whole`] could write there now, for whoever has long to work before it does. Nothing
/// is left behind.
///
/// # Errors
/// As for [`write_whole`].
pub fn can_write_whole(path: impl AsRef<Path>) -> Result<(), FormatError> {
    let path = path.as_ref();
    file_beside(path).map(drop).map_err(|e| e.in_file(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_or_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write_whole(&path, b"one").unwrap();
        write_whole(&path, b"two").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"two");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);

        assert!(can_write_whole(&path).is_ok());
        assert_eq!(std::fs::read(&path).unwrap(), b"two");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);

        let missing = folder.path().join("no/such.txt");
        let error = can_write_whole(&missing).unwrap_err().to_string();
        assert!(error.contains("does not exist"), "{error}");
        assert!(can_write_whole(folder.path()).is_err());
        let error = write_whole(missing, b"").unwrap_err().to_string();
        assert!(error.contains("does not exist"), "{error}");
        assert!(write_whole(folder.path(), b"").is_err());
    }
}
