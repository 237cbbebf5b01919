//! GLB, the binary container: a header and chunks (glTF 2.0, section 4).

use super::wrong;
use crate::error::{Fault, FormatError, Place, quoted};
use crate::finding::Finding;

const MAGIC: &[u8] = b"glTF";
const JSON: &[u8] = b"JSON";
const BIN: &[u8] = b"BIN\0";
const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;

/// The parts of a file: the JSON, and the binary chunk if it is a GLB file that has one.
pub(super) struct Parts<'a> {
    pub(super) json: &'a [u8],
    pub(super) binary: Option<&'a [u8]>,
    /// Whether it is a GLB file.
    pub(super) packed: bool,
}

/// Takes a file apart. `named_glb` is whether its name says that it is a GLB file; otherwise the
/// first bytes decide.
pub(super) fn parts<'a>(
    bytes: &'a [u8],
    named_glb: bool,
    findings: &mut Vec<Finding>,
) -> Result<Parts<'a>, FormatError> {
    if bytes.is_empty() {
        return Err(FormatError::file(Fault::Empty));
    }
    if !bytes.starts_with(MAGIC) {
        if named_glb {
            let found = &bytes[..bytes.len().min(MAGIC.len())];
            return Err(unexpected(
                0,
                quoted(found),
                "\"glTF\", with which a GLB file begins,",
            ));
        }
        return Ok(Parts {
            json: bytes,
            binary: None,
            packed: false,
        });
    }
    let bytes = whole(bytes, findings)?;
    let (json, next) = chunk(bytes, HEADER, "the JSON chunk")?;
    if json.kind != JSON {
        return Err(unexpected(
            HEADER + 4,
            quoted(json.kind),
            "the JSON chunk, which comes first,",
        ));
    }
    let mut binary = None;
    if next < bytes.len() {
        let (second, _) = chunk(bytes, next, "the chunk after the JSON")?;
        binary = (second.kind == BIN).then_some(second.content);
    }
    Ok(Parts {
        json: json.content,
        binary,
        packed: true,
    })
}

/// The file as long as its header says.
fn whole<'a>(bytes: &'a [u8], findings: &mut Vec<Finding>) -> Result<&'a [u8], FormatError> {
    let cut = |what| {
        wrong(
            what,
            format!("the file ends within it, after {} bytes", bytes.len()),
        )
    };
    let version = number(bytes, 4).ok_or_else(|| cut("GLB header"))?;
    let length = number(bytes, 8).ok_or_else(|| cut("GLB header"))? as usize;
    if version != 2 {
        let found = format!("version {version}");
        return Err(unexpected(4, found, "version 2 of GLB"));
    }
    if bytes.len() < length {
        return Err(wrong(
            "GLB header",
            format!(
                "the file should have {length} bytes, but has only {}: it was cut",
                bytes.len()
            ),
        ));
    }
    if length < HEADER {
        let message = format!("the file should have {length} bytes, but a header has {HEADER}");
        return Err(wrong("GLB header", message));
    }
    if bytes.len() > length {
        findings.push(Finding::TrailingData);
    }
    Ok(&bytes[..length])
}

struct Chunk<'a> {
    kind: &'a [u8],
    content: &'a [u8],
}

/// The chunk that begins at a byte, and where the next one does.
fn chunk<'a>(
    bytes: &'a [u8],
    at: usize,
    what: &'static str,
) -> Result<(Chunk<'a>, usize), FormatError> {
    let start = at + CHUNK_HEADER;
    let header = bytes.get(at..start).ok_or_else(|| {
        let message = format!("the file ends before it, after {} bytes", bytes.len());
        wrong(what, message)
    })?;
    let length = number(header, 0).unwrap_or_default() as usize;
    let content = bytes[start..].get(..length).ok_or_else(|| {
        let left = bytes.len() - start;
        let message = format!("{length} bytes are declared, but only {left} follow");
        wrong(what, message)
    })?;
    let kind = &header[4..];
    // Chunks begin at multiples of four bytes.
    let next = (start + length).next_multiple_of(4);
    Ok((Chunk { kind, content }, next))
}

fn number(bytes: &[u8], at: usize) -> Option<u32> {
    let bytes = bytes.get(at..at + 4)?;
    Some(u32::from_le_bytes(bytes.try_into().ok()?))
}

fn unexpected(byte: usize, found: String, expected: &'static str) -> FormatError {
    FormatError::new(
        Place::Byte(byte as u64),
        Fault::Unexpected { found, expected },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glb(version: u32, length: Option<u32>, chunks: &[(&[u8], u32, &[u8])]) -> Vec<u8> {
        let mut body = Vec::new();
        for (kind, length, content) in chunks {
            body.extend(length.to_le_bytes());
            body.extend(*kind);
            body.extend(*content);
        }
        let length = length.unwrap_or(body.len() as u32 + 12);
        let mut bytes = MAGIC.to_vec();
        bytes.extend(version.to_le_bytes());
        bytes.extend(length.to_le_bytes());
        bytes.extend(body);
        bytes
    }

    fn error(bytes: &[u8]) -> String {
        match parts(bytes, true, &mut Vec::new()) {
            Ok(_) => panic!("this is no GLB file"),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn the_chunks_are_found() {
        let bytes = glb(2, None, &[(JSON, 4, b"{}  "), (BIN, 4, b"1234")]);
        let mut findings = Vec::new();
        let parts = parts(&bytes, false, &mut findings).unwrap();
        assert_eq!(
            (parts.json, parts.binary),
            (&b"{}  "[..], Some(&b"1234"[..]))
        );
        assert!(parts.packed && findings.is_empty());
    }

    #[test]
    fn a_chunk_of_another_kind_is_passed_over() {
        let bytes = glb(2, None, &[(JSON, 4, b"{}  "), (b"XYZ ", 4, b"1234")]);
        let parts = parts(&bytes, true, &mut Vec::new()).unwrap();
        assert_eq!(parts.binary, None);
    }

    #[test]
    fn what_follows_the_declared_end_is_reported() {
        let mut bytes = glb(2, None, &[(JSON, 4, b"{}  ")]);
        bytes.push(0);
        let mut findings = Vec::new();
        assert!(parts(&bytes, true, &mut findings).is_ok());
        assert_eq!(findings, [Finding::TrailingData]);
    }

    #[test]
    fn broken_containers_are_named() {
        assert_eq!(error(b""), "file is empty (0 bytes)");
        assert_eq!(
            error(b"glTX...."),
            "byte 0: \"glTX\" found where \"glTF\", with which a GLB file begins, is expected"
        );
        assert!(error(b"glTF\x02").contains("ends within it, after 5 bytes"));
        assert!(error(&glb(1, None, &[])).contains("version 1 found"));
        assert!(error(&glb(2, Some(99), &[])).contains("should have 99 bytes, but has only 12"));
        assert!(error(&glb(2, Some(3), &[])).contains("a header has 12"));
        assert!(error(&glb(2, None, &[])).starts_with("the JSON chunk: the file ends before it"));
        assert!(
            error(&glb(2, None, &[(JSON, 4_000_000_000, b"{}")]))
                .contains("4000000000 bytes are declared, but only 2 follow")
        );
        assert!(
            error(&glb(2, None, &[(BIN, 0, b"")])).contains("the JSON chunk, which comes first")
        );
        assert!(
            error(&glb(2, None, &[(JSON, 4, b"{}  "), (BIN, 9, b"1")]))
                .contains("the chunk after the JSON: 9 bytes are declared, but only 1 follow")
        );
    }
}
