//! Rows of numbers in text, one a line.

use super::collected::{Collected, Role, SLOTS, slot_name};
use super::header::{Element, Kind};
use crate::error::{Fault, FormatError};
use crate::number::{Words, finite, whole};
use crate::source::Source;

pub(super) fn read_rows(
    source: &mut Source<'_>,
    element: &Element,
    role: &Role,
    collected: &mut Collected,
) -> Result<(), FormatError> {
    let mut row = 0;
    while row < element.count {
        let Some(line) = source.line()? else {
            let fault = Fault::UnexpectedEnd {
                element: element.name.clone(),
                row: row + 1,
                rows: element.count,
            };
            return Err(FormatError::line(source.lines_read(), fault));
        };
        let mut words = Words(line.bytes);
        if words.0.trim_ascii().is_empty() {
            continue;
        }
        row += 1;
        let outcome = read_row(&mut words, element, role, collected);
        let wrong_length = |expected| Fault::RowLength {
            element: element.name.clone(),
            row,
            rows: element.count,
            found: Words(line.bytes).count() as u64,
            expected,
        };
        match outcome {
            Ok(()) if words.next().is_none() => {}
            Ok(()) => {
                let too_many = words.count() as u64 + 1;
                let found = Words(line.bytes).count() as u64;
                return Err(FormatError::line(
                    line.number,
                    wrong_length(found - too_many),
                ));
            }
            Err(Stop::Missing(expected)) => {
                return Err(FormatError::line(line.number, wrong_length(expected)));
            }
            Err(Stop::Fault(fault)) => return Err(FormatError::line(line.number, fault)),
        }
    }
    Ok(())
}

fn read_row(
    words: &mut Words<'_>,
    element: &Element,
    role: &Role,
    collected: &mut Collected,
) -> Result<(), Stop> {
    match role {
        Role::Vertices { slots, .. } => read_vertex(words, element, slots, collected),
        Role::Faces { corners } => {
            read_lists(words, element, *corners, |i| collected.push_corner(i))?;
            collected.end_face();
            Ok(())
        }
        Role::Strips { corners } => {
            read_lists(words, element, *corners, |i| collected.push_strip_corner(i))?;
            collected.end_strip();
            Ok(())
        }
        Role::Unused => {
            words.0 = &[];
            Ok(())
        }
    }
}

/// Why a row could not be read.
enum Stop {
    /// It is too short; so many numbers are needed, as far as can be said.
    Missing(u64),
    Fault(Fault),
}

impl From<Fault> for Stop {
    fn from(fault: Fault) -> Self {
        Self::Fault(fault)
    }
}

fn read_vertex(
    words: &mut Words<'_>,
    element: &Element,
    slots: &[Option<usize>],
    collected: &mut Collected,
) -> Result<(), Stop> {
    let mut row = [0.0; SLOTS];
    for (property, slot) in element.properties.iter().zip(slots) {
        match (property.kind, slot) {
            (Kind::Scalar(_), Some(slot)) => {
                let word = words.next().ok_or_else(|| missing(element, 0))?;
                row[*slot] = finite(word, slot_name(*slot))?;
            }
            (Kind::Scalar(_), None) => {
                words.next().ok_or_else(|| missing(element, 0))?;
            }
            (Kind::List { .. }, _) => read_list(words, element, |_| Ok(()))?,
        }
    }
    collected.push_vertex(row);
    Ok(())
}

/// A row of which only the items of the list in column `used` are kept.
fn read_lists(
    words: &mut Words<'_>,
    element: &Element,
    used: usize,
    mut keep: impl FnMut(i64) -> Result<(), Fault>,
) -> Result<(), Stop> {
    for (column, property) in element.properties.iter().enumerate() {
        match property.kind {
            Kind::Scalar(_) => {
                words.next().ok_or_else(|| missing(element, 0))?;
            }
            Kind::List { .. } if column == used => {
                read_list(words, element, |word| keep(whole(word, "vertex index")?))?;
            }
            Kind::List { .. } => read_list(words, element, |_| Ok(()))?,
        }
    }
    Ok(())
}

fn read_list(
    words: &mut Words<'_>,
    element: &Element,
    mut keep: impl FnMut(&[u8]) -> Result<(), Fault>,
) -> Result<(), Stop> {
    let word = words.next().ok_or_else(|| missing(element, 0))?;
    let length = whole(word, "length of a list")?;
    let length = u64::try_from(length).map_err(|_| Fault::Unexpected {
        found: length.to_string(),
        expected: "the length of a list, 0 or more,",
    })?;
    for _ in 0..length {
        let word = words.next().ok_or_else(|| missing(element, length))?;
        keep(word)?;
    }
    Ok(())
}

/// A row needs a number for each property, and the items of its lists.
fn missing(element: &Element, items: u64) -> Stop {
    Stop::Missing(element.properties.len() as u64 + items)
}
