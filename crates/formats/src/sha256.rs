//! A name for content: the same bytes, the same name.

use std::fs::File;
use std::io;
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::error::{Fault, FormatError};

/// The SHA-256 of some bytes, in hexadecimal.
#[must_use]
pub fn of_bytes(bytes: &[u8]) -> String {
    hexadecimal(Sha256::new_with_prefix(bytes))
}

/// The SHA-256 of what a file holds, in hexadecimal.
///
/// # Errors
/// When the file cannot be read.
pub fn of_file(path: impl AsRef<Path>) -> Result<String, FormatError> {
    let path = path.as_ref();
    let mut hasher = Hasher(Sha256::new());
    let copied = File::open(path).and_then(|mut file| io::copy(&mut file, &mut hasher));
    copied.map_err(|source| {
        let action = "be read";
        FormatError::file(Fault::Io { action, source }).in_file(path)
    })?;
    Ok(hexadecimal(hasher.0))
}

/// Takes what is written to it into the hash.
struct Hasher(Sha256);

impl io::Write for Hasher {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn hexadecimal(hasher: Sha256) -> String {
    hasher
        .finalize()
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
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
