//! The wire format of Protocol Buffers (<https://protobuf.dev/programming-guides/encoding/>): fields
//! one after the other, each a number and a value.
//!
//! Nothing is unpacked into objects: a hostile block of 32 MB could hold 16 million empty messages,
//! each of which a general library gives a hundred bytes and more.

use super::broken;
use crate::error::FormatError;

/// The value of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Value<'a> {
    /// A varint.
    Number(u64),
    /// Text, a message, or numbers in a row.
    Bytes(&'a [u8]),
    /// A number of four or eight bytes, which no field here has.
    Fixed,
}

/// The fields of a message.
#[derive(Clone, Debug)]
pub(super) struct Fields<'a>(pub(super) &'a [u8]);

impl<'a> Fields<'a> {
    fn field(&mut self) -> Result<(u64, Value<'a>), FormatError> {
        let key = varint(&mut self.0)?;
        let value = match key & 7 {
            0 => Value::Number(varint(&mut self.0)?),
            1 => self.take(8).map(|_| Value::Fixed)?,
            2 => {
                let length = varint(&mut self.0)?;
                Value::Bytes(self.take(usize::try_from(length).unwrap_or(usize::MAX))?)
            }
            5 => self.take(4).map(|_| Value::Fixed)?,
            _ => return Err(broken("a field of no known wire type")),
        };
        Ok((key >> 3, value))
    }

    fn take(&mut self, length: usize) -> Result<&'a [u8], FormatError> {
        let (taken, rest) = (self.0.split_at_checked(length))
            .ok_or_else(|| broken("a field is longer than the message that it lies in"))?;
        self.0 = rest;
        Ok(taken)
    }
}

impl<'a> Iterator for Fields<'a> {
    type Item = Result<(u64, Value<'a>), FormatError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.0.is_empty() {
            return None;
        }
        let field = self.field();
        if field.is_err() {
            self.0 = &[];
        }
        Some(field)
    }
}

/// Varints in a row.
#[derive(Clone, Debug, Default)]
pub(super) struct Numbers<'a>(pub(super) &'a [u8]);

impl Iterator for Numbers<'_> {
    type Item = Result<u64, FormatError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.0.is_empty() {
            return None;
        }
        let number = varint(&mut self.0);
        if number.is_err() {
            self.0 = &[];
        }
        Some(number)
    }
}

/// Numbers that are each told by what they differ from the one before. Sums wrap.
#[derive(Clone, Debug, Default)]
pub(super) struct Deltas<'a> {
    numbers: Numbers<'a>,
    last: i64,
}

impl<'a> Deltas<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self {
            numbers: Numbers(bytes),
            last: 0,
        }
    }
}

impl Iterator for Deltas<'_> {
    type Item = Result<i64, FormatError>;

    fn next(&mut self) -> Option<Self::Item> {
        let number = self.numbers.next()?;
        Some(number.map(|number| {
            self.last = self.last.wrapping_add(signed(number));
            self.last
        }))
    }
}

/// The number that a zigzag code stands for.
pub(super) fn signed(code: u64) -> i64 {
    (code >> 1) as i64 ^ -((code & 1) as i64)
}

fn varint(bytes: &mut &[u8]) -> Result<u64, FormatError> {
    let mut number = 0;
    for (i, &byte) in bytes.iter().take(10).enumerate() {
        // Bits above the 64th are let go, as the format asks.
        number |= u64::from(byte & 0x7f) << (7 * i);
        if byte < 0x80 {
            *bytes = &bytes[i + 1..];
            return Ok(number);
        }
    }
    Err(broken(if bytes.len() < 10 {
        "a number is cut off"
    } else {
        "a number has more than ten bytes"
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_the_format_has_them() {
        let read = |bytes: &[u8]| Numbers(bytes).collect::<Result<Vec<_>, _>>();
        assert_eq!(read(&[1, 0x96, 1]).unwrap(), [1, 150]);
        assert_eq!(
            read(&[0xff; 9]).unwrap_err().to_string(),
            "PBF: a number is cut off"
        );
        assert!(
            read(&[0xff; 10])
                .unwrap_err()
                .to_string()
                .contains("more than ten")
        );
        let most = [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 1];
        assert_eq!(read(&most).unwrap(), [u64::MAX]);
        assert_eq!([0, 1, 2, 3, u64::MAX].map(signed), [0, -1, 1, -2, i64::MIN]);
        let deltas = Deltas::new(&[4, 1, 1]).collect::<Result<Vec<_>, _>>();
        assert_eq!(deltas.unwrap(), [2, 1, 0]);
    }

    #[test]
    fn fields_end_where_the_message_does() {
        let read = |bytes: &'static [u8]| Fields(bytes).collect::<Result<Vec<_>, _>>();
        assert_eq!(
            read(b"\x1d1234\x2112345678").unwrap(),
            [(3, Value::Fixed), (4, Value::Fixed)]
        );
        assert!(
            read(b"\x1d123")
                .unwrap_err()
                .to_string()
                .contains("longer than the message")
        );
        assert_eq!(
            read(b"\x08\x05\x12\x02ab").unwrap(),
            [(1, Value::Number(5)), (2, Value::Bytes(b"ab"))]
        );
        assert!(read(b"\x12\xff\xff\xff\xff\xff\xff\xff\xff\xff\x01").is_err());
        assert!(read(b"\x0b").unwrap_err().to_string().contains("wire type"));
    }
}
