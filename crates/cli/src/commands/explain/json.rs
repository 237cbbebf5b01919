//! The tree as JSON, written a sample at a time.

use std::cell::RefCell;

use serde::ser::{Error as _, SerializeSeq as _};
use serde::{Serialize, Serializer};

use super::document::{Heading, Sample};
use super::number::Number;

/// A document whose samples are made while it is written: memory is taken for one of them.
#[derive(Serialize)]
#[serde(bound = "F: FnMut() -> anyhow::Result<Option<Sample>>")]
pub(crate) struct Written<'a, F> {
    #[serde(flatten)]
    pub(crate) heading: &'a Heading,
    /// Gives the next sample, or none after the last one.
    pub(crate) samples: Samples<F>,
    /// Asked when all samples are written.
    #[serde(serialize_with = "asked")]
    pub(crate) colour: &'a dyn Fn() -> [Number; 3],
}

pub(crate) struct Samples<F>(pub(crate) RefCell<F>);

impl<F: FnMut() -> anyhow::Result<Option<Sample>>> Serialize for Samples<F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(None)?;
        let mut next = self.0.borrow_mut();
        while let Some(sample) = next().map_err(S::Error::custom)? {
            list.serialize_element(&sample)?;
        }
        list.end()
    }
}

fn asked<S: Serializer>(
    colour: &&dyn Fn() -> [Number; 3],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    colour().serialize(serializer)
}
