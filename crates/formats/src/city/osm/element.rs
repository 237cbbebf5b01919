//! The elements of a map: nodes, ways and relations.

use std::borrow::Cow;

use ombra_city::heights::Value;

use crate::error::FormatError;

/// What an element is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Node,
    Way,
    Relation,
}

/// An element as it is met in a file.
#[derive(Clone, Copy, Debug)]
pub(super) enum Element<'a> {
    Node {
        id: i64,
        /// Longitude and latitude, degrees.
        place: [f64; 2],
    },
    Way {
        id: i64,
        nodes: &'a [i64],
        tags: &'a [Tag<'a>],
    },
    Relation {
        id: i64,
        members: &'a [Member],
        tags: &'a [Tag<'a>],
    },
}

/// Where elements go. What it does not want is left where it is.
pub(super) type Visit<'a> = &'a mut dyn FnMut(Element<'_>) -> Result<(), FormatError>;

/// A key and a value.
pub(super) type Tag<'a> = (Cow<'a, str>, Cow<'a, str>);

/// A member of a relation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Member {
    pub(super) kind: Kind,
    pub(super) id: i64,
    /// Whether its role is to be a courtyard.
    pub(super) is_inner: bool,
}

/// Whether a key is there and its value is not "no".
pub(super) fn says(tags: &[Tag<'_>], key: &str) -> bool {
    tags.iter().any(|(k, value)| k == key && value != "no")
}

/// Whether tags are those of a building or a part of one.
pub(super) fn is_of_building(tags: &[Tag<'_>]) -> bool {
    says(tags, "building") || says(tags, "building:part")
}

/// The value of a key, whatever its capitals.
pub(super) fn value<'a>(tags: &'a [Tag<'_>], key: &str) -> Option<Value<'a>> {
    let exact = tags.iter().find(|(k, _)| k == key);
    let found = exact.or_else(|| tags.iter().find(|(k, _)| k.eq_ignore_ascii_case(key)));
    found.map(|(_, value)| Value::Text(value))
}
