//! A TIFF image file directory: tags and their values (TIFF 6.0, section 2), little-endian.

use std::collections::BTreeMap;

/// The value of a tag.
pub(super) enum Value {
    Shorts(Vec<u16>),
    Longs(Vec<u32>),
    Doubles(Vec<f64>),
    /// UTF-8, as GDAL has it, where TIFF asks for ASCII. A zero byte ends it and must not be inside.
    Ascii(String),
}

/// Tags in their order.
#[derive(Default)]
pub(super) struct Directory {
    entries: BTreeMap<u16, Value>,
}

impl Directory {
    pub(super) fn add(&mut self, tag: u16, value: Value) {
        self.entries.insert(tag, value);
    }

    /// Bytes that it takes, with the values that do not fit into an entry; always even.
    pub(super) fn len(&self) -> usize {
        let lengths = self.entries.values().map(Value::len);
        self.entries_len() + lengths.filter(|&n| n > 4).map(even).sum::<usize>()
    }

    /// Appends the directory, which begins at byte `at` of the file. The next one follows it unless
    /// it is the last.
    pub(super) fn encode(&self, at: u32, is_last: bool, file: &mut Vec<u8>) {
        let mut values = Vec::new();
        let values_at = at + self.entries_len() as u32;
        file.extend_from_slice(&(self.entries.len() as u16).to_le_bytes());
        for (tag, value) in &self.entries {
            let mut bytes = value.bytes();
            file.extend_from_slice(&tag.to_le_bytes());
            file.extend_from_slice(&value.kind().to_le_bytes());
            file.extend_from_slice(&((bytes.len() / value.size()) as u32).to_le_bytes());
            if bytes.len() > 4 {
                file.extend_from_slice(&(values_at + values.len() as u32).to_le_bytes());
                bytes.resize(even(bytes.len()), 0);
                values.append(&mut bytes);
            } else {
                bytes.resize(4, 0);
                file.append(&mut bytes);
            }
        }
        let next = if is_last { 0 } else { at + self.len() as u32 };
        file.extend_from_slice(&next.to_le_bytes());
        file.append(&mut values);
    }

    /// How many entries there are, the entries, and where the next directory is.
    fn entries_len(&self) -> usize {
        2 + 12 * self.entries.len() + 4
    }
}

impl Value {
    /// The number that TIFF gives to the type.
    fn kind(&self) -> u16 {
        match self {
            Self::Ascii(_) => 2,
            Self::Shorts(_) => 3,
            Self::Longs(_) => 4,
            Self::Doubles(_) => 12,
        }
    }

    /// Bytes of one number or character.
    fn size(&self) -> usize {
        match self {
            Self::Ascii(_) => 1,
            Self::Shorts(_) => 2,
            Self::Longs(_) => 4,
            Self::Doubles(_) => 8,
        }
    }

    /// Bytes of all of them.
    fn len(&self) -> usize {
        let count = match self {
            Self::Ascii(text) => text.len() + 1,
            Self::Shorts(values) => values.len(),
            Self::Longs(values) => values.len(),
            Self::Doubles(values) => values.len(),
        };
        count * self.size()
    }

    fn bytes(&self) -> Vec<u8> {
        match self {
            Self::Ascii(text) => text.bytes().chain([0]).collect(),
            Self::Shorts(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Self::Longs(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Self::Doubles(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
        }
    }
}

/// Offsets in TIFF files are even.
fn even(length: usize) -> usize {
    length.next_multiple_of(2)
}
