//! Why a city cannot be changed as it was asked.

use crate::building::Building;

/// What keeps a city from being changed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EditError {
    /// A name that no building has.
    #[error("no building is named {name:?}; {}", others(near, *count))]
    NoBuilding {
        /// The name.
        name: String,
        /// Names that are much like it.
        near: Vec<String>,
        /// How many buildings there are.
        count: usize,
    },
    /// A name that several buildings have.
    #[error(
        "{} buildings are named {name:?}: {}; name one by its number",
        numbers.len(),
        list(numbers)
    )]
    SeveralBuildings {
        /// The name.
        name: String,
        /// Which they are.
        numbers: Vec<usize>,
    },
    /// Two wishes for one building.
    #[error(
        "building {name:?} is named twice; once is wanted, to take it away or to say its height"
    )]
    NamedTwice {
        /// The name.
        name: String,
    },
    /// A height that a building cannot have.
    #[error(
        "building {name:?} cannot be {metres} m tall; a height between 0 and 10000 m is wanted, of a building that has one"
    )]
    Height {
        /// The name.
        name: String,
        /// The height.
        metres: f64,
    },
}

impl EditError {
    pub(super) fn no_building(name: &str, all: &[Building]) -> Self {
        const MOST: usize = 3;
        let ids = all.iter().filter_map(|building| building.id.as_deref());
        let mut near: Vec<(usize, &str)> = ids
            .map(|id| (distance(name, id), id))
            .filter(|&(distance, id)| distance <= 1 + id.len().min(name.len()) / 3)
            .collect();
        near.sort_unstable();
        near.dedup();
        Self::NoBuilding {
            name: name.to_owned(),
            near: (near.iter().take(MOST))
                .map(|&(_, id)| id.to_owned())
                .collect(),
            count: all.len(),
        }
    }
}

/// How many letters must be changed, added or taken away to make one word of another (Levenshtein 1966); capitals
/// do not count.
fn distance(one: &str, other: &str) -> usize {
    const LONGEST: usize = 64;
    let letters = |word: &str| -> Vec<char> {
        let lower = word.chars().flat_map(char::to_lowercase);
        lower.take(LONGEST).collect()
    };
    let (one, other) = (letters(one), letters(other));
    let mut row: Vec<usize> = (0..=other.len()).collect();
    for (i, a) in one.iter().enumerate() {
        let mut corner = row[0];
        row[0] = i + 1;
        for (j, b) in other.iter().enumerate() {
            let changed = corner + usize::from(a != b);
            corner = row[j + 1];
            row[j + 1] = changed.min(corner + 1).min(row[j] + 1);
        }
    }
    row[other.len()]
}

fn others(near: &[String], count: usize) -> String {
    let numbers = match count {
        0 => "the city has none".to_owned(),
        _ => format!("#0 to #{} are buildings by their number", count - 1),
    };
    if near.is_empty() {
        return numbers;
    }
    let near: Vec<String> = near.iter().map(|name| format!("{name:?}")).collect();
    format!("did you mean {}? {numbers}", near.join(" or "))
}

fn list(numbers: &[usize]) -> String {
    const SHOWN: usize = 6;
    let mut shown: Vec<String> = (numbers.iter().take(SHOWN))
        .map(|number| format!("#{number}"))
        .collect();
    if numbers.len() > SHOWN {
        shown.push("and more".to_owned());
    }
    shown.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_as_far_apart_as_the_letters_that_differ() {
        for (one, other, expected) in [
            ("", "", 0),
            ("way/12", "way/12", 0),
            ("Tower", "tower", 0),
            ("kitten", "sitting", 3),
            ("", "abc", 3),
        ] {
            assert_eq!(distance(one, other), expected, "{one} {other}");
            assert_eq!(distance(other, one), expected, "{other} {one}");
        }
    }
}
