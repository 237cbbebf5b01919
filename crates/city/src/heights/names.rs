//! The names of attributes, to tell when nothing has the one that was asked for.

use std::collections::BTreeSet;

use super::{HEIGHTS, Heights, shortened};

/// What is in a name that looks like that of a height.
const LIKE: &[&str] = &[
    "height", "hoehe", "höhe", "hoogte", "hauteur", "altura", "altezza", "levels", "floors",
    "storey",
];

/// So many names are told.
const MOST: usize = 6;

/// What the buildings of a file call their heights.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// The attribute that was asked for, while none has it.
    missed: Option<String>,
    is_found: bool,
    like: BTreeSet<String>,
}

impl Names {
    /// Looks at the names of one building's attributes.
    pub fn look<'a>(&mut self, heights: &Heights, names: impl IntoIterator<Item = &'a str>) {
        let Some(asked) = heights.attribute.as_ref().filter(|_| !self.is_found) else {
            return;
        };
        for name in names {
            if name.eq_ignore_ascii_case(asked) {
                self.is_found = true;
                self.missed = None;
                return;
            }
            if self.like.len() < MOST && is_like_height(name) {
                self.like.insert(shortened(name));
            }
        }
        self.missed.get_or_insert_with(|| asked.clone());
    }

    /// That none has the attribute, if so, and which may be meant.
    #[must_use]
    pub fn missing(&self) -> Option<String> {
        let missed = shortened(self.missed.as_ref()?);
        let quoted: Vec<String> = self.like.iter().map(|name| format!("{name:?}")).collect();
        let meant = if quoted.is_empty() {
            "none that looks like a height, either".to_owned()
        } else {
            format!("heights may be in {}", quoted.join(", "))
        };
        Some(format!("no building has an attribute {missed:?}; {meant}"))
    }
}

fn is_like_height(name: &str) -> bool {
    let is_known = HEIGHTS
        .iter()
        .any(|(known, _)| known.eq_ignore_ascii_case(name));
    let low = name.to_lowercase();
    is_known || LIKE.iter().any(|like| low.contains(like))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn missing(buildings: &[&[&str]]) -> Option<String> {
        let heights = Heights {
            attribute: Some("hoogte".to_owned()),
            ..Heights::default()
        };
        let mut names = Names::default();
        for building in buildings {
            names.look(&heights, building.iter().copied());
        }
        names.missing()
    }

    #[test]
    fn what_no_building_has_is_told_with_what_may_be_meant() {
        assert_eq!(missing(&[]), None);
        assert_eq!(missing(&[&["use"], &["Hoogte"], &["use"]]), None);
        let told = missing(&[&["use", "roof_hoehe_m"], &["Num_Floors", "use"]]).unwrap();
        assert_eq!(
            told,
            "no building has an attribute \"hoogte\"; heights may be in \"Num_Floors\", \"roof_hoehe_m\""
        );
        assert!(missing(&[&["use"]]).unwrap().contains("none that looks"));
    }
}
