//! What was met on the way to a city, and gone on from.

use std::collections::HashMap;
use std::fmt::{self, Write as _};

use serde::Serialize;

/// Something in a city's file that its user should hear of, though there is a city.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// Where it was met first, such as `feature 12`.
    pub place: String,
    /// What it is, and what was done about it.
    pub message: String,
    /// How often it was met.
    pub count: u64,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let line = format!("{}: {}", self.place, self.message);
        // Names and values come from the file: whatever is in them, a finding stays on one line that
        // can be read.
        const MOST: usize = 300;
        for (i, c) in line.chars().enumerate() {
            if i == MOST {
                f.write_str("...")?;
                break;
            }
            if c.is_control() {
                write!(f, "{}", c.escape_default())?;
            } else {
                f.write_char(c)?;
            }
        }
        if self.count > 1 {
            write!(f, " ({} times)", self.count)?;
        }
        Ok(())
    }
}

/// Findings, counted by what they say.
#[derive(Clone, Debug, Default)]
pub struct Notes {
    found: Vec<Finding>,
    places: HashMap<String, usize>,
    more: u64,
}

impl Notes {
    /// So many different ones are kept; the others are counted together.
    const MOST: usize = 1000;

    /// Takes note of something at a place; of what says the same only the first place is kept.
    pub fn add(&mut self, place: &str, message: impl Into<String>) {
        let message = message.into();
        self.add_kind(&message.clone(), place, message);
    }

    /// The same for messages that differ in their numbers and are of one kind: the first is kept,
    /// the others are counted.
    pub fn add_kind(&mut self, kind: &str, place: &str, message: impl Into<String>) {
        if let Some(&index) = self.places.get(kind) {
            self.found[index].count += 1;
        } else if self.found.len() < Self::MOST {
            self.places.insert(kind.to_owned(), self.found.len());
            self.found.push(Finding {
                place: place.to_owned(),
                message: message.into(),
                count: 1,
            });
        } else {
            self.more += 1;
        }
    }

    /// Takes note of something that is told before all that was met so far, as it may be the cause of that.
    pub fn add_first(&mut self, place: &str, message: impl Into<String>) {
        for index in self.places.values_mut() {
            *index += 1;
        }
        let finding = Finding {
            place: place.to_owned(),
            message: message.into(),
            count: 1,
        };
        self.found.insert(0, finding);
    }

    /// The findings in the order in which they were met.
    #[must_use]
    pub fn into_findings(self) -> Vec<Finding> {
        let mut found = self.found;
        if self.more > 0 {
            found.push(Finding {
                place: "file".to_owned(),
                message: "more findings of other kinds".to_owned(),
                count: self.more,
            });
        }
        found
    }
}
