//! What a reader of glTF met and went on from, each kind of it told once.

use std::collections::HashMap;

use crate::finding::Finding;

/// Findings, counted by what they say.
#[derive(Default)]
pub(super) struct Notes {
    found: Vec<(String, String, u64)>,
    places: HashMap<String, usize>,
}

impl Notes {
    /// Takes note of something at a place; of what says the same only the first place is kept.
    pub(super) fn add(&mut self, place: impl Into<String>, message: impl Into<String>) {
        self.add_many(place, message, 1);
    }

    /// The same of `count` things at once.
    pub(super) fn add_many(
        &mut self,
        place: impl Into<String>,
        message: impl Into<String>,
        count: u64,
    ) {
        if count == 0 {
            return;
        }
        let message = message.into();
        match self.places.get(&message) {
            Some(&index) => self.found[index].2 += count,
            None => {
                self.places.insert(message.clone(), self.found.len());
                self.found.push((place.into(), message, count));
            }
        }
    }

    /// As findings, in the order in which they were met.
    pub(super) fn into_findings(self) -> impl Iterator<Item = Finding> {
        self.found
            .into_iter()
            .map(|(place, message, count)| Finding::InDocument {
                place,
                message,
                count,
            })
    }
}
