//! What a URI in a document stands for: bytes in the URI itself, or a file beside the document.

use std::borrow::Cow;
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use base64::{DecodeError, Engine as _};
use percent_encoding::percent_decode_str;

use crate::error::{Fault, FormatError, quoted};
use crate::finding::Finding;
use crate::mesh::resolve;

/// Base64 with or without its padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// Whether a URI holds its bytes itself.
pub(super) fn is_data(uri: &str) -> bool {
    let scheme = uri.get(..5);
    scheme.is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:"))
}

/// The bytes of a data URI; `None` if it is a URI of another kind.
pub(super) fn data(uri: &str) -> Option<Result<Vec<u8>, String>> {
    if !is_data(uri) {
        return None;
    }
    let Some((kind, content)) = uri[5..].split_once(',') else {
        return Some(Err("the data URI has no comma before its data".to_owned()));
    };
    if !kind.to_ascii_lowercase().ends_with(";base64") {
        return Some(Ok(percent_decode_str(content).collect()));
    }
    let content: Cow<'_, [u8]> = percent_decode_str(content).into();
    let decoded = BASE64.decode(content.trim_ascii());
    Some(decoded.map_err(|error| not_base64(&error)))
}

/// What is wrong with base64, and what would be right.
fn not_base64(error: &DecodeError) -> String {
    let wrong = match *error {
        DecodeError::InvalidByte(at, byte) => {
            let found = quoted(&[byte]);
            format!(
                "{found} after {at} digits; digits are A-Z, a-z, 0-9, + and /, with = at the end alone"
            )
        }
        DecodeError::InvalidLength(_) => {
            "one digit is left over; the last two, three or four digits make bytes".to_owned()
        }
        DecodeError::InvalidLastSymbol { .. } => {
            "bits are left over in the last digit; they have to be 0".to_owned()
        }
        DecodeError::InvalidPadding => {
            "wrong = at the end; they fill it up to a multiple of four digits, or are left out"
                .to_owned()
        }
    };
    format!("the data URI cannot be decoded as base64: {wrong}")
}

/// A URI as the name of a file: with its `%20` and the like decoded.
pub(super) fn file_name(uri: &str) -> String {
    percent_decode_str(uri).decode_utf8_lossy().into_owned()
}

/// The file that a URI names, if it is there and in the folder or below it.
pub(super) fn file(folder: &Path, uri: &str, what: &'static str) -> Result<PathBuf, Finding> {
    resolve(folder, &file_name(uri), what)
}

/// The first bytes of a file, `most` of them or as many as there are.
pub(super) fn read(path: &Path, most: u64) -> Result<Vec<u8>, FormatError> {
    let cannot = |action| move |source| FormatError::file(Fault::Io { action, source });
    let file = File::open(path).map_err(cannot("be opened"));
    let read = file.and_then(|file| {
        let mut bytes = Vec::new();
        file.take(most)
            .read_to_end(&mut bytes)
            .map_err(cannot("be read"))?;
        Ok(bytes)
    });
    read.map_err(|error| error.in_file(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_uris_hold_their_bytes() {
        let bytes = |uri| data(uri).unwrap().unwrap();
        assert_eq!(
            bytes("data:application/octet-stream;base64,AQID"),
            [1, 2, 3]
        );
        assert_eq!(bytes("data:;base64,AQI="), [1, 2]);
        assert_eq!(bytes("DATA:;BASE64,AQI"), [1, 2], "without padding");
        assert_eq!(bytes("data:text/plain,a%20b"), b"a b");
        assert!(bytes("data:;base64,").is_empty());
        assert!(data("box.bin").is_none());
        assert!(data("é").is_none());
    }

    #[test]
    fn broken_data_uris_are_named() {
        let error = |uri: &str| data(uri).unwrap().unwrap_err();
        assert!(error("data:;base64,@@@@").contains("cannot be decoded as base64"));
        for (wrong, right) in [("@@@@", "A-Z"), ("AQIDA", "left over"), ("AQJ=", "0")] {
            let said = error(&format!("data:;base64,{wrong}"));
            assert!(said.contains(right) && !said.contains("Invalid"), "{said}");
        }
        assert!(error("data:;base64").contains("no comma"));
    }
}
