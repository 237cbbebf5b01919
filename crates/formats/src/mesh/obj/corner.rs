//! The corners of a face: a, a/b, a//c or a/b/c, counted from 1, or from the end if negative.

use crate::error::{Fault, IndexBase, Place, quoted};
use crate::number::whole;

/// Stands for an attribute that a corner has not.
pub(super) const NONE: u32 = u32::MAX;

/// Which vertex, texture coordinates and normal meet at a corner, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Corner {
    pub(super) vertex: u32,
    pub(super) uv: u32,
    pub(super) normal: u32,
}

/// How many of each are defined.
pub(super) struct Defined {
    pub(super) vertices: usize,
    pub(super) uvs: usize,
    pub(super) normals: usize,
}

/// An index past what is defined at its line.
pub(super) struct Ahead {
    line: u64,
    attribute: Attribute,
    index: i64,
}

#[derive(Clone, Copy)]
enum Attribute {
    Vertex,
    Uv,
    Normal,
}

impl Attribute {
    const fn name(self) -> &'static str {
        match self {
            Self::Vertex => "vertex",
            Self::Uv => "texture coordinate",
            Self::Normal => "normal",
        }
    }

    const fn defined(self, defined: &Defined) -> u64 {
        (match self {
            Self::Vertex => defined.vertices,
            Self::Uv => defined.uvs,
            Self::Normal => defined.normals,
        }) as u64
    }

    fn out_of_range(self, index: i64, defined: &Defined) -> Fault {
        Fault::IndexOutOfRange {
            attribute: self.name(),
            index,
            defined: self.defined(defined),
            base: IndexBase::One,
        }
    }
}

impl Ahead {
    /// Its fault, if what it means is not defined in the whole file either.
    pub(super) fn fault(&self, defined: &Defined) -> Option<(Place, Fault)> {
        (self.index as u64 > self.attribute.defined(defined)).then(|| {
            let fault = self.attribute.out_of_range(self.index, defined);
            (Place::Line(self.line), fault)
        })
    }
}

/// Parses one corner. Indices that may be defined later in the file go to `ahead`.
#[inline]
pub(super) fn parse(
    word: &[u8],
    defined: &Defined,
    line: u64,
    ahead: &mut Vec<Ahead>,
) -> Result<Corner, Fault> {
    let mut pieces = word.split(|&b| b == b'/');
    let mut index = |attribute: Attribute| match pieces.next() {
        None => Ok(NONE),
        Some(b"") if !matches!(attribute, Attribute::Vertex) => Ok(NONE),
        Some(piece) => {
            let index = whole(piece, "face index")?;
            resolve(index, attribute, defined, line, ahead)
        }
    };
    let corner = Corner {
        vertex: index(Attribute::Vertex)?,
        uv: index(Attribute::Uv)?,
        normal: index(Attribute::Normal)?,
    };
    if pieces.next().is_some() {
        return Err(Fault::Unexpected {
            found: quoted(word),
            expected: "a corner a, a/b, a//c or a/b/c",
        });
    }
    Ok(corner)
}

#[inline]
fn resolve(
    index: i64,
    attribute: Attribute,
    defined: &Defined,
    line: u64,
    ahead: &mut Vec<Ahead>,
) -> Result<u32, Fault> {
    let count = attribute.defined(defined) as i64;
    let from_zero = match index {
        1.. => index - 1,
        0 => -1,
        _ => count + index,
    };
    match u32::try_from(from_zero) {
        Ok(found) if found != NONE => {
            if from_zero >= count {
                ahead.push(Ahead {
                    line,
                    attribute,
                    index,
                });
            }
            Ok(found)
        }
        _ => Err(attribute.out_of_range(index, defined)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse_word(word: &str) -> Result<Corner, String> {
        let defined = Defined {
            vertices: 3,
            uvs: 2,
            normals: 1,
        };
        parse(word.as_bytes(), &defined, 1, &mut Vec::new()).map_err(|f| f.to_string())
    }

    #[test]
    fn all_forms_are_read() {
        let corner = |vertex, uv, normal| Corner { vertex, uv, normal };
        assert_eq!(parse_word("3").unwrap(), corner(2, NONE, NONE));
        assert_eq!(parse_word("1/2").unwrap(), corner(0, 1, NONE));
        assert_eq!(parse_word("1/").unwrap(), corner(0, NONE, NONE));
        assert_eq!(parse_word("1//1").unwrap(), corner(0, NONE, 0));
        assert_eq!(parse_word("1/2/1").unwrap(), corner(0, 1, 0));
        assert_eq!(parse_word("-1/-2/-1").unwrap(), corner(2, 0, 0));
        // May be defined later.
        assert_eq!(parse_word("7").unwrap().vertex, 6);
    }

    #[test]
    fn what_is_no_corner_is_named() {
        for (word, expected) in [
            ("0", "face uses vertex 0, but only 3 are defined (1 to 3)"),
            (
                "-4",
                "face uses vertex -4, but only 3 are defined up to here (-3 to -1)",
            ),
            (
                "1/0",
                "face uses texture coordinate 0, but only 2 are defined (1 to 2)",
            ),
            (
                "1//-2",
                "face uses normal -2, but only 1 is defined up to here (-1 to -1)",
            ),
            ("/1", "face index is \"\", which is not a number"),
            (
                "1/1/1/1",
                "\"1/1/1/1\" found where a corner a, a/b, a//c or a/b/c is expected",
            ),
            ("1.5", "face index is \"1.5\", which is not a number"),
        ] {
            assert_eq!(parse_word(word).unwrap_err(), expected);
        }
        assert!(parse_word("4294967296").is_err());
    }
}
