//! The headers that PPM and PFM share: a magic word and numbers between blanks, with comments.

use super::check_size;
use crate::error::{Fault, FormatError, quoted};
use crate::input::Input;
use crate::limits::Limits;
use crate::number::whole;
use crate::source::Source;

/// No number in a header is longer.
const LONGEST_WORD: usize = 64;

pub(super) struct Header {
    pub(super) magic: [u8; 2],
    pub(super) width: u32,
    pub(super) height: u32,
    /// The largest value (PPM), or the scale whose sign is the byte order (PFM).
    pub(super) last: Vec<u8>,
}

/// Opens a file and reads its header, so that its pixels are next.
pub(super) fn open<'a>(
    input: &Input<'a>,
    limits: &Limits,
    expected: &'static str,
    known: &[&[u8; 2]],
) -> Result<(Source<'a>, Header), FormatError> {
    let mut source = input.source(limits)?;
    let magic: Option<[u8; 2]> = source.take(2)?.and_then(|m| m.try_into().ok());
    let magic = magic.unwrap_or_default();
    if !known.contains(&&magic) {
        let found = quoted(&magic);
        return Err(FormatError::file(Fault::Unexpected { found, expected }));
    }
    let width = size(&word(&mut source)?)?;
    let height = size(&word(&mut source)?)?;
    let last = word(&mut source)?;
    check_size(width.into(), height.into(), limits)?;
    let header = Header {
        magic,
        width,
        height,
        last,
    };
    Ok((source, header))
}

/// Refuses a file that is too short for its pixels.
pub(super) fn check_room(
    source: &Source<'_>,
    header: &Header,
    pixel: u64,
) -> Result<(), FormatError> {
    let rows = u64::from(header.height);
    let needed = rows * u64::from(header.width) * pixel;
    let available = source.most_left();
    if needed <= available {
        return Ok(());
    }
    Err(FormatError::file(Fault::TooShort {
        what: "rows of pixels".to_owned(),
        rows,
        needed,
        available,
        at_most: false,
    }))
}

fn size(word: &[u8]) -> Result<u32, FormatError> {
    let size = whole(word, "image size").map_err(FormatError::file)?;
    match u32::try_from(size) {
        Ok(size @ 1..) => Ok(size),
        _ => Err(FormatError::file(Fault::Unexpected {
            found: quoted(word),
            expected: "a width or height of 1 or more",
        })),
    }
}

/// The next word, together with the one blank after it.
fn word(source: &mut Source<'_>) -> Result<Vec<u8>, FormatError> {
    let mut word = Vec::new();
    let mut in_comment = false;
    while let Some(&[byte]) = source.take(1)? {
        match byte {
            b'\n' | b'\r' if in_comment => in_comment = false,
            _ if in_comment => {}
            b'#' if word.is_empty() => in_comment = true,
            byte if byte.is_ascii_whitespace() => {
                if !word.is_empty() {
                    break;
                }
            }
            byte => word.push(byte),
        }
        if word.len() > LONGEST_WORD {
            let (found, expected) = (quoted(&word), "a number");
            return Err(FormatError::file(Fault::Unexpected { found, expected }));
        }
    }
    Ok(word)
}
