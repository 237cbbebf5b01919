//! A name for content: the same bytes, the same name.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::error::{Fault, FormatError};

/// The SHA-256 of what a file holds, in hexadecimal.
///
/// # Errors
/// When the file cannot be read.
pub fn of_file(path: impl AsRef<Path>) -> Result<String, FormatError> {
    of_files(&[path.as_ref().to_owned()])
}

/// The SHA-256 of what some files hold, one after the other, in hexadecimal.
///
/// # Errors
/// When a file cannot be read.
pub fn of_files(paths: &[PathBuf]) -> Result<String, FormatError> {
    let mut content = Content::default();
    content.take_files(paths)?;
    Ok(content.hexadecimal())
}

/// The SHA-256 of some bytes, in hexadecimal.
#[must_use]
pub fn of_bytes(bytes: &[u8]) -> String {
    let mut content = Content::default();
    content.take(bytes);
    content.hexadecimal()
}

/// The SHA-256 of bytes that come a piece at a time.
#[derive(Clone, Debug, Default)]
pub struct Content(Sha256);

impl Content {
    /// Takes the next piece.
    pub fn take(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    pub(crate) fn take_files(&mut self, paths: &[PathBuf]) -> Result<(), FormatError> {
        for path in paths {
            let copied = File::open(path).and_then(|mut file| io::copy(&mut file, self));
            copied.map_err(|source| {
                let action = "be read";
                FormatError::file(Fault::Io { action, source }).in_file(path)
            })?;
        }
        Ok(())
    }

    /// The hash of all that was taken, in hexadecimal.
    #[must_use]
    pub fn hexadecimal(self) -> String {
        let bytes = self.0.finalize();
        bytes.iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

impl io::Write for Content {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.take(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn nothing_has_the_hash_that_the_standard_gives() {
        let empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        assert_eq!(super::of_bytes(b""), empty);
        let file = tempfile::NamedTempFile::new().unwrap();
        assert_eq!(super::of_file(file.path()).unwrap(), empty);
    }
}
