//! OpenStreetMap PBF (<https://wiki.openstreetmap.org/wiki/PBF_Format>): blobs one after the other,
//! each packed by itself.

mod block;
mod wire;

use std::borrow::Cow;
use std::io::Read as _;

use flate2::read::ZlibDecoder;

use super::super::wrong;
use super::element::{Kind, Visit};
use crate::error::{Fault, FormatError, Place, plural, quoted, shown};
use crate::limits::Limits;
use wire::{Fields, Value};

/// What the format allows.
const MOST_HEADER: usize = 64 << 10;
const MOST_BLOB: usize = 32 << 20;

/// What a reader must know, of which this one does.
const FEATURES: [&[u8]; 2] = [b"OsmSchema-V0.6", b"DenseNodes"];

/// Whether a file begins as such files do: with a blob that says that it is their header.
pub(super) fn is_pbf(bytes: &[u8]) -> bool {
    let Some((length, rest)) = bytes.split_first_chunk() else {
        return false;
    };
    let length = u32::from_be_bytes(*length) as usize;
    length <= MOST_HEADER
        && (Fields(&rest[..rest.len().min(length)]))
            .map_while(Result::ok)
            .any(|field| field == (1, Value::Bytes(b"OSMHeader")))
}

/// Visits all elements of a kind.
pub(super) fn each(
    bytes: &[u8],
    kind: Kind,
    limits: &Limits,
    visit: Visit<'_>,
) -> Result<(), FormatError> {
    let mut unpacked = 0;
    let mut at = 0;
    let mut number = 0;
    while at < bytes.len() {
        number += 1;
        let place = Place::Byte(at as u64);
        let blob = Blob::read(bytes, &mut at, number).map_err(|error| error.at(place))?;
        // Blobs of other kinds are for readers that know them.
        if !matches!(blob.kind, b"OSMHeader" | b"OSMData") {
            continue;
        }
        let mut block = || {
            let content = blob.content(number)?;
            unpacked += content.len() as u64;
            let limit = limits.decompressed_bytes;
            if unpacked > limit {
                let what = "unpacked content";
                return Err(FormatError::file(Fault::TooLarge { what, limit }));
            }
            match blob.kind {
                b"OSMHeader" => check_features(&content),
                _ => block::each(&content, kind, visit),
            }
        };
        block().map_err(|error| error.at(place))?;
    }
    Ok(())
}

struct Blob<'a> {
    kind: &'a [u8],
    data: &'a [u8],
}

impl<'a> Blob<'a> {
    /// Reads the blob at an offset, and sets it behind it.
    fn read(bytes: &'a [u8], at: &mut usize, number: u64) -> Result<Self, FormatError> {
        let place = || format!("blob {number}");
        let mut take = |length: usize| {
            let rest = &bytes[*at..];
            let taken = rest.get(..length).ok_or_else(|| {
                let (left, bytes) = (rest.len(), plural("byte", length as u64));
                let message =
                    format!("unexpected end of file: {length} {bytes} should follow, {left} do");
                wrong(place(), message)
            })?;
            *at += length;
            Ok::<_, FormatError>(taken)
        };
        let too_large = |what: &str, length: i64, most: usize| {
            let message = format!("{what} of {length} bytes; up to {most} are allowed");
            wrong(place(), message)
        };
        let mut length = [0; 4];
        length.copy_from_slice(take(4)?);
        let length = u32::from_be_bytes(length);
        if length as usize > MOST_HEADER {
            return Err(too_large("header", i64::from(length), MOST_HEADER));
        }
        let mut kind = None;
        let mut size = None;
        for field in Fields(take(length as usize)?) {
            match field? {
                (1, Value::Bytes(bytes)) => kind = Some(bytes),
                (3, Value::Number(number)) => size = Some(number as i64),
                _ => {}
            }
        }
        let (Some(kind), Some(size)) = (kind, size) else {
            return Err(wrong(place(), "header without a kind and a size"));
        };
        let length = usize::try_from(size).ok().filter(|&size| size <= MOST_BLOB);
        let length = length.ok_or_else(|| too_large("content", size, MOST_BLOB))?;
        let data = take(length)?;
        Ok(Self { kind, data })
    }

    /// What is in it, unpacked.
    fn content(&self, number: u64) -> Result<Cow<'a, [u8]>, FormatError> {
        let place = || format!("blob {number}");
        for field in Fields(self.data) {
            match field? {
                (1, Value::Bytes(raw)) => return Ok(Cow::Borrowed(raw)),
                (3, Value::Bytes(packed)) => {
                    // It is unpacked as far as it goes, whatever size it says.
                    let mut content = Vec::new();
                    let most = MOST_BLOB as u64;
                    ZlibDecoder::new(packed)
                        .take(most + 1)
                        .read_to_end(&mut content)
                        .map_err(|error| wrong(place(), format!("cannot be unpacked: {error}")))?;
                    if content.len() > MOST_BLOB {
                        return Err(wrong(place(), format!("unpacks to more than {most} bytes")));
                    }
                    return Ok(Cow::Owned(content));
                }
                (packed @ 4..=7, Value::Bytes(_)) => {
                    let how = ["LZMA", "bzip2", "LZ4", "Zstandard"][packed as usize - 4];
                    let message = format!(
                        "is packed by {how}; zlib or none is expected, as osmium writes it"
                    );
                    return Err(wrong(place(), message));
                }
                _ => {}
            }
        }
        Err(wrong(place(), "has no content"))
    }
}

/// A file may ask for readers that know more than this one.
fn check_features(header: &[u8]) -> Result<(), FormatError> {
    for field in Fields(header) {
        if let (4, Value::Bytes(feature)) = field?
            && !FEATURES.contains(&feature)
        {
            let message = format!("{} is needed to read this file", shown(&quoted(feature)));
            return Err(wrong("required features", message));
        }
    }
    Ok(())
}

fn broken(what: &str) -> FormatError {
    wrong("PBF", what)
}
