//! Structures that belong together, for the eye.

/// What a structure is a kind of. Told by its name, so that a new kind finds its place by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Family {
    None,
    Grid,
    Octree,
    KdTree,
    Bih,
    Bvh,
    Other,
}

impl Family {
    pub(crate) const ALL: [Self; 7] = [
        Self::None,
        Self::Grid,
        Self::Octree,
        Self::KdTree,
        Self::Bih,
        Self::Bvh,
        Self::Other,
    ];

    pub(crate) fn of(structure: &str) -> Self {
        let begins = |name: &str| structure.starts_with(name);
        match () {
            () if begins("brute-force") => Self::None,
            () if begins("grid") => Self::Grid,
            () if begins("octree") => Self::Octree,
            () if begins("kd-") => Self::KdTree,
            () if begins("bih") => Self::Bih,
            () if begins("bvh") => Self::Bvh,
            () => Self::Other,
        }
    }

    /// The class of what is drawn of it.
    pub(crate) const fn class(self) -> &'static str {
        match self {
            Self::None => "f-none",
            Self::Grid => "f-grid",
            Self::Octree => "f-octree",
            Self::KdTree => "f-kd",
            Self::Bih => "f-bih",
            Self::Bvh => "f-bvh",
            Self::Other => "f-other",
        }
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::None => "no structure",
            Self::Grid => "grids",
            Self::Octree => "octree",
            Self::KdTree => "kd-tree",
            Self::Bih => "bounding intervals",
            Self::Bvh => "bounding volumes",
            Self::Other => "others",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ombra::accel::StructureKind;

    #[test]
    fn every_structure_has_a_family() {
        for kind in StructureKind::ALL {
            assert_ne!(Family::of(kind.name()), Family::Other, "{kind}");
        }
    }
}
