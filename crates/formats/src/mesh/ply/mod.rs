//! PLY: ASCII, binary of either byte order (Turk, "The PLY Polygon File Format", 1994).
//!
//! Elements and properties may come in any order and of any type. Used are `x y z`, `nx ny nz` and
//! the texture coordinates `s t`, `u v` or `texture_u texture_v` of `vertex`, the corners of `face`
//! and of `tristrips`. All else is passed over.

mod ascii;
mod binary;
mod collected;
mod header;

use super::{Model, ModelFormat};
use crate::error::{Fault, FormatError};
use crate::finding::Finding;
use crate::source::{Size, Source};

use collected::{Collected, Role};
use header::{Encoding, Header};

/// Whether the content is PLY.
pub(super) fn begins(source: &mut Source<'_>) -> Result<bool, FormatError> {
    let head = source.peek(4)?;
    Ok(matches!(
        head,
        [b'p', b'l', b'y', b'\r' | b'\n' | b' ' | b'\t']
    ))
}

pub(super) fn read(source: &mut Source<'_>) -> Result<Model, FormatError> {
    let header = Header::read(source)?;
    check_room(&header, source)?;
    let vertices = header.count_of("vertex");
    if vertices >= u64::from(u32::MAX) {
        return Err(FormatError::file(Fault::TooMany { what: "vertices" }));
    }
    let mut collected = Collected::new(vertices);
    let mut findings = Vec::new();
    for element in &header.elements {
        let role = Role::of(element, &mut findings);
        if element.properties.is_empty() || element.count == 0 {
            continue;
        }
        collected.reserve(&role, source, element);
        match header.encoding {
            Encoding::Ascii => ascii::read_rows(source, element, &role, &mut collected)?,
            Encoding::LittleEndian => {
                binary::read_rows::<false>(source, element, &role, &mut collected)?;
            }
            Encoding::BigEndian => {
                binary::read_rows::<true>(source, element, &role, &mut collected)?;
            }
        }
    }
    if more_follows(source, header.encoding)? {
        findings.push(Finding::TrailingData);
    }
    let format = match header.encoding {
        Encoding::Ascii => ModelFormat::PlyAscii,
        Encoding::LittleEndian => ModelFormat::PlyLittleEndian,
        Encoding::BigEndian => ModelFormat::PlyBigEndian,
    };
    let raw = collected.triangulated(&mut findings)?;
    Model::of_one_part(format, raw, findings)
}

/// Refuses counts that the file cannot hold, before anything is allocated.
///
/// Plain text is not refused here: it is cheap to read to where it breaks, which says more.
fn check_room(header: &Header, source: &Source<'_>) -> Result<(), FormatError> {
    let at_most = matches!(source.size(), Size::AtMost(_));
    if header.encoding == Encoding::Ascii && !at_most {
        return Ok(());
    }
    let available = source.most_left();
    let mut needed = 0_u64;
    for element in &header.elements {
        let rows = element.count;
        needed = needed.saturating_add(rows.saturating_mul(element.least_row(header.encoding)));
        // The last line of a text needs no end.
        let ends = u64::from(header.encoding == Encoding::Ascii);
        if needed > available.saturating_add(ends) {
            return Err(FormatError::file(Fault::TooShort {
                what: format!("rows of element {}", element.name),
                rows,
                needed,
                available,
                at_most,
            }));
        }
    }
    Ok(())
}

fn more_follows(source: &mut Source<'_>, encoding: Encoding) -> Result<bool, FormatError> {
    if encoding != Encoding::Ascii {
        return Ok(!source.peek(1)?.is_empty());
    }
    let rest = source.peek(4096)?;
    Ok(!rest.trim_ascii().is_empty())
}
