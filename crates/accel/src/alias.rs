//! Other names under which structures are known.

use std::fmt;

use crate::StructureKind;

/// A name that stands for a structure without being its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StructureAlias {
    /// The name.
    pub name: &'static str,
    /// What it stands for.
    pub kind: StructureKind,
    /// Whose name it is; `None` if it is only another name here.
    pub origin: Option<&'static str>,
}

impl StructureAlias {
    /// All of them.
    pub const ALL: &[Self] = &[
        Self {
            name: "bvh-sah",
            kind: StructureKind::Bvh,
            origin: None,
        },
        // In OptiX before version 7 an acceleration had a builder and a traverser, each by name.
        Self {
            name: "Lbvh",
            kind: StructureKind::BvhLbvh,
            origin: Some("legacy OptiX"),
        },
        Self {
            name: "Bvh",
            kind: StructureKind::Bvh,
            origin: Some("legacy OptiX"),
        },
    ];

    /// What a person means who types `name`; `None` if it is no alias, and a structure's own name
    /// is none. Capitals only matter where they make the difference: `Bvh` is an alias of `bvh`.
    #[must_use]
    pub fn of(name: &str) -> Option<Self> {
        if StructureKind::ALL.iter().any(|kind| kind.name() == name) {
            return None;
        }
        Self::ALL
            .iter()
            .copied()
            .find(|alias| alias.name.eq_ignore_ascii_case(name))
    }
}

impl fmt::Display for StructureAlias {
    /// As a sentence: "Lbvh is the legacy OptiX name of bvh-lbvh".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, kind, origin } = self;
        match origin {
            Some(origin) => write!(f, "{name} is the {origin} name of {kind}"),
            None => write!(f, "{name} is another name of {kind}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legacy_names_are_understood_and_explained() {
        assert_eq!("Lbvh".parse(), Ok(StructureKind::BvhLbvh));
        assert_eq!("Bvh".parse(), Ok(StructureKind::Bvh));
        assert_eq!("bvh-sah".parse(), Ok(StructureKind::Bvh));
        let explained = |name| StructureAlias::of(name).map(|alias| alias.to_string());
        assert_eq!(
            explained("Lbvh").unwrap(),
            "Lbvh is the legacy OptiX name of bvh-lbvh"
        );
        assert_eq!(
            explained("Bvh").unwrap(),
            "Bvh is the legacy OptiX name of bvh"
        );
        assert_eq!(explained("bvh"), None);
        assert_eq!(explained("quadtree"), None);
    }

    #[test]
    fn every_structure_is_found_by_its_own_name() {
        for &kind in StructureKind::ALL {
            assert_eq!(kind.name().parse(), Ok(kind));
        }
    }
}
