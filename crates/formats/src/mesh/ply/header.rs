//! The header: which elements follow, and what their rows are made of.

use crate::error::{Fault, FormatError, quoted, shown};
use crate::number::{Words, whole};
use crate::source::Source;

/// More properties than any file has; keeps a hostile header small.
const MOST_PROPERTIES: usize = 4096;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
}

/// A table.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

/// A column of a table.
#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(Number),
    List { length: Number, item: Number },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Number {
    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// Its size in bytes.
    pub(super) const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

impl Element {
    /// The fewest bytes that a row can take: one digit and one blank a number in text.
    pub(super) fn least_row(&self, encoding: Encoding) -> u64 {
        let least = |p: &Property| match (encoding, p.kind) {
            (Encoding::Ascii, _) => 2,
            (_, Kind::Scalar(number) | Kind::List { length: number, .. }) => number.size() as u64,
        };
        self.properties.iter().map(least).sum()
    }
}

impl Header {
    pub(super) fn count_of(&self, element: &str) -> u64 {
        let found = self.elements.iter().find(|e| e.name == element);
        found.map_or(0, |e| e.count)
    }

    /// From "ply" to "end_header".
    pub(super) fn read(source: &mut Source<'_>) -> Result<Self, FormatError> {
        let mut encoding = None;
        let mut elements = Vec::new();
        let mut properties = 0;
        let first = source.line()?.map_or(&[][..], |line| line.bytes);
        if first.trim_ascii() != b"ply" {
            let found = quoted(first);
            let expected = "\"ply\" in the first line of a PLY file";
            return Err(FormatError::line(1, Fault::Unexpected { found, expected }));
        }
        while let Some(line) = source.line()? {
            let mut words = Words(line.bytes);
            let at_line = |fault| FormatError::line(line.number, fault);
            match words.next() {
                None | Some(b"comment" | b"obj_info") => {}
                Some(b"format") => encoding = Some(read_encoding(&mut words).map_err(at_line)?),
                Some(b"element") => elements.push(read_element(&mut words).map_err(at_line)?),
                Some(b"property") => {
                    let element = elements.last_mut().ok_or_else(|| {
                        at_line(unexpected(
                            Some(b"property"),
                            "an element before its properties",
                        ))
                    })?;
                    let property = read_property(&mut words).map_err(at_line)?;
                    element.properties.push(property);
                    properties += 1;
                }
                Some(b"end_header") => {
                    let encoding = encoding.ok_or_else(|| {
                        at_line(unexpected(Some(b"end_header"), "a format line before it"))
                    })?;
                    return Ok(Self { encoding, elements });
                }
                other => {
                    let expected = "format, comment, element, property or end_header";
                    return Err(at_line(unexpected(other, expected)));
                }
            }
            if properties + elements.len() > MOST_PROPERTIES {
                let expected = "fewer than 4096 elements and properties";
                return Err(at_line(unexpected(words.next(), expected)));
            }
        }
        let line = source.lines_read();
        let found = "the end of the file".to_owned();
        let expected = "end_header";
        Err(FormatError::line(
            line,
            Fault::Unexpected { found, expected },
        ))
    }
}

fn unexpected(found: Option<&[u8]>, expected: &'static str) -> Fault {
    let found = found.map_or_else(|| "the end of the line".to_owned(), quoted);
    Fault::Unexpected { found, expected }
}

fn read_encoding(words: &mut Words<'_>) -> Result<Encoding, Fault> {
    match words.next() {
        Some(b"ascii") => Ok(Encoding::Ascii),
        Some(b"binary_little_endian") => Ok(Encoding::LittleEndian),
        Some(b"binary_big_endian") => Ok(Encoding::BigEndian),
        other => {
            let expected = "ascii, binary_little_endian or binary_big_endian";
            Err(unexpected(other, expected))
        }
    }
}

fn read_element(words: &mut Words<'_>) -> Result<Element, Fault> {
    let name = (words.next()).ok_or_else(|| unexpected(None, "the element's name"))?;
    let count = (words.next()).ok_or_else(|| unexpected(None, "the number of rows"))?;
    let rows = whole(count, "number of rows")?;
    Ok(Element {
        name: shown(&String::from_utf8_lossy(name)),
        count: u64::try_from(rows)
            .map_err(|_| unexpected(Some(count), "a number of rows of 0 or more"))?,
        properties: Vec::new(),
    })
}

fn read_property(words: &mut Words<'_>) -> Result<Property, Fault> {
    let number = |word: Option<&[u8]>| {
        let expected = "a type: char, uchar, short, ushort, int, uint, float, double or list";
        word.and_then(Number::named)
            .ok_or_else(|| unexpected(word, expected))
    };
    let kind = match words.next() {
        Some(b"list") => Kind::List {
            length: number(words.next())?,
            item: number(words.next())?,
        },
        word => Kind::Scalar(number(word)?),
    };
    if let Kind::List {
        length: Number::F32 | Number::F64,
        ..
    } = kind
    {
        return Err(unexpected(
            Some(b"float"),
            "a whole-number type for the length of a list",
        ));
    }
    let name = (words.next()).ok_or_else(|| unexpected(None, "the property's name"))?;
    Ok(Property {
        name: shown(&String::from_utf8_lossy(name)),
        kind,
    })
}
