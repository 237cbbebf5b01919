//! The tree as JSON, written a sample at a time.

use std::cell::RefCell;

use serde::ser::{Error as _, SerializeMap as _, SerializeSeq as _};
use serde::{Serialize, Serializer};

use super::document::{Heading, Sample};
use super::number::Number;

/// A document whose samples are made while it is written: memory is taken for one of them.
pub(crate) struct Written<'a, F> {
    pub(crate) heading: &'a Heading,
    /// Gives the next sample, or none after the last one.
    pub(crate) next: RefCell<F>,
    /// Asked when all samples are written.
    pub(crate) colour: &'a dyn Fn() -> [Number; 3],
}

impl<F: FnMut() -> anyhow::Result<Option<Sample>>> Serialize for Written<'_, F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        let heading = serde_json::to_value(self.heading).map_err(S::Error::custom)?;
        if let serde_json::Value::Object(fields) = heading {
            for (name, value) in fields {
                map.serialize_entry(&name, &value)?;
            }
        }
        map.serialize_entry("samples", &Samples(&self.next))?;
        map.serialize_entry("colour", &(self.colour)())?;
        map.end()
    }
}

struct Samples<'a, F>(&'a RefCell<F>);

impl<F: FnMut() -> anyhow::Result<Option<Sample>>> Serialize for Samples<'_, F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(None)?;
        let mut next = self.0.borrow_mut();
        while let Some(sample) = next().map_err(S::Error::custom)? {
            list.serialize_element(&sample)?;
        }
        list.end()
    }
}
