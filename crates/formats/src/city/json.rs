//! JSON: what a document is, and where it is wrong.

use std::fmt;

use serde::Deserialize;
use serde::de::{DeserializeSeed, IgnoredAny, SeqAccess, Visitor};
use serde_json::Value;

use crate::error::{Fault, FormatError, Place, one_line};

/// What a file is, by its content.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A list.
    List,
    /// GeoJSON, and what of it.
    GeoJson(String),
    /// CityJSON.
    CityJson,
    /// CityJSON and what belongs to it, one after the other.
    CityJsonSeq,
    /// None of these.
    Unknown,
}

/// What GeoJSON can be (RFC 7946, 1.4).
const GEOJSON: [&str; 9] = [
    "FeatureCollection",
    "Feature",
    "Point",
    "MultiPoint",
    "LineString",
    "MultiLineString",
    "Polygon",
    "MultiPolygon",
    "GeometryCollection",
];

#[derive(Deserialize)]
struct Probe {
    #[serde(rename = "type")]
    kind: Option<Value>,
}

impl Probe {
    fn kind(&self) -> Option<&str> {
        self.kind.as_ref()?.as_str()
    }
}

/// Goes through the whole document once, keeping nothing of it.
pub(super) fn kind(text: &[u8]) -> Result<Kind, FormatError> {
    match text.trim_ascii_start().first() {
        Some(b'[') => parse::<IgnoredAny>(text).map(|_| Kind::List),
        Some(b'{') => {
            let mut all = serde_json::Deserializer::from_slice(text).into_iter::<Probe>();
            let first = all.next().and_then(Result::ok);
            let ends_there = text[all.byte_offset()..].trim_ascii().is_empty();
            let probe = match first {
                Some(probe) if ends_there => probe,
                Some(probe) if probe.kind() == Some("CityJSON") => return Ok(Kind::CityJsonSeq),
                // Again, for what is wrong with it.
                _ => parse(text)?,
            };
            Ok(match probe.kind() {
                Some("CityJSON") => Kind::CityJson,
                Some(kind) if GEOJSON.contains(&kind) => Kind::GeoJson(kind.to_owned()),
                _ => Kind::Unknown,
            })
        }
        _ => Ok(Kind::Unknown),
    }
}

/// A document as a whole.
pub(super) fn parse<'a, T: Deserialize<'a>>(text: &'a [u8]) -> Result<T, FormatError> {
    serde_json::from_slice(text).map_err(|error| syntax(text, &error))
}

/// Documents one after the other, each handed on before the next is read.
pub(super) fn parse_each<'a, T: Deserialize<'a>>(
    text: &'a [u8],
    mut each: impl FnMut(T) -> Result<(), FormatError>,
) -> Result<(), FormatError> {
    for document in serde_json::Deserializer::from_slice(text).into_iter() {
        each(document.map_err(|error| syntax(text, &error))?)?;
    }
    Ok(())
}

/// A document whose content goes where `seed` puts it.
pub(super) fn parse_into<'a, S: DeserializeSeed<'a>>(
    text: &'a [u8],
    seed: S,
) -> Result<S::Value, FormatError> {
    let mut reader = serde_json::Deserializer::from_slice(text);
    let value = seed.deserialize(&mut reader);
    (value.and_then(|value| reader.end().map(|()| value))).map_err(|error| syntax(text, &error))
}

/// A list whose elements are handed on one by one, so that one at a time is in memory.
pub(super) struct Each<F>(pub(super) F);

impl<'de, F: FnMut(usize, Value)> DeserializeSeed<'de> for Each<F> {
    type Value = ();

    fn deserialize<D: serde::Deserializer<'de>>(self, reader: D) -> Result<(), D::Error> {
        reader.deserialize_seq(self)
    }
}

impl<'de, F: FnMut(usize, Value)> Visitor<'de> for Each<F> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list")
    }

    fn visit_seq<A: SeqAccess<'de>>(mut self, mut list: A) -> Result<(), A::Error> {
        let mut index = 0;
        while let Some(element) = list.next_element()? {
            (self.0)(index, element);
            index += 1;
        }
        Ok(())
    }
}

/// An error of the library, with its place as an offset from the start.
fn syntax(text: &[u8], error: &serde_json::Error) -> FormatError {
    let at = offset(text, error);
    let mut message = error.to_string();
    if let Some(end) = message.find(" at line ") {
        message.truncate(end);
    }
    message += &format!(" (line {}, column {})", error.line(), error.column());
    if error.is_eof() {
        message += ": the file is cut short";
    } else if error.is_syntax() {
        let rest = text.get(at..).unwrap_or_default();
        let is_part = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'+' | b'-' | b'.');
        let length = rest.iter().take_while(|b| is_part(b)).count().min(40);
        let word = String::from_utf8_lossy(&rest[..length]);
        let lower = word.to_ascii_lowercase();
        let name = lower.trim_start_matches(['-', '+']);
        if name.starts_with("nan") || name.starts_with("inf") {
            message += &format!(": {word} is not JSON; a number, or null for none, would be right");
        } else if !word.is_empty() {
            message += &format!(": {word:?} found");
        }
    }
    let place = Place::Byte(at as u64);
    let fault = Fault::InDocument {
        place: "JSON".to_owned(),
        message: one_line(&message),
    };
    FormatError::new(place, fault)
}

/// The library counts lines and the bytes in them from 1. It may point at the last byte of a word
/// that it gave up in; the start of the word is of more use.
fn offset(text: &[u8], error: &serde_json::Error) -> usize {
    let mut start = 0;
    for _ in 1..error.line() {
        match text[start..].iter().position(|&b| b == b'\n') {
            Some(length) => start += length + 1,
            None => break,
        }
    }
    let column = error.column();
    let mut at = (start
        + if error.is_eof() {
            column
        } else {
            column.saturating_sub(1)
        })
    .min(text.len());
    if error.is_syntax() {
        while at > 0 && (text[at - 1].is_ascii_alphabetic() || b"+-".contains(&text[at - 1])) {
            at -= 1;
        }
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_says_what_it_is() {
        let of = |text: &str| kind(text.as_bytes()).unwrap();
        assert_eq!(of(" [1]"), Kind::List);
        assert_eq!(of("{\"a\": 1, \"type\": \"CityJSON\"}"), Kind::CityJson);
        assert_eq!(of("{\"type\": \"CityJSON\"} {"), Kind::CityJsonSeq);
        assert_eq!(
            of("{\"type\": \"Polygon\"}"),
            Kind::GeoJson("Polygon".to_owned())
        );
        for text in [
            "{\"type\": \"Topology\"}",
            "{}",
            "{\"type\": 3}",
            "<osm/>",
            "12",
            "\u{0}",
        ] {
            assert_eq!(of(text), Kind::Unknown, "{text}");
        }
    }

    #[test]
    fn faults_have_their_offsets() {
        for (text, expected) in [
            (
                "{\"type\": \"Feature\",\n \"a\": NaN}",
                "byte 26: JSON: expected value (line 2, column 7): NaN is not JSON; a number, or \
                 null for none, would be right",
            ),
            ("[1, -Infinity]", "byte 4: JSON: invalid number"),
            (
                "{\"type\": \"Fea",
                "byte 13: JSON: EOF while parsing a string (line 1, column 13): the file is cut short",
            ),
            (
                "[1] x",
                "byte 4: JSON: trailing characters (line 1, column 5): \"x\" found",
            ),
            ("[1, tru]", "byte 4: JSON: expected ident"),
        ] {
            let error = kind(text.as_bytes()).unwrap_err().to_string();
            assert!(error.starts_with(expected), "{error}");
        }
    }
}
