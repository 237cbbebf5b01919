//! Which triangles a primitive's vertices make: lists, strips and fans (section 3.7.2.1 of the
//! specification).

/// How vertices make triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Mode {
    List,
    Strip,
    Fan,
}

impl Mode {
    /// By its code; otherwise what else it is, or nothing that there is.
    pub(super) const fn of(code: u32) -> Result<Self, Option<&'static str>> {
        match code {
            4 => Ok(Self::List),
            5 => Ok(Self::Strip),
            6 => Ok(Self::Fan),
            0 => Err(Some("points")),
            1..=3 => Err(Some("lines")),
            _ => Err(None),
        }
    }

    /// How many triangles so many vertices make.
    pub(super) const fn triangles(self, vertices: u64) -> u64 {
        match self {
            Self::List => vertices / 3,
            Self::Strip | Self::Fan => vertices.saturating_sub(2),
        }
    }

    /// Which of the vertices the corners of a triangle are. In a strip every other triangle has two
    /// of them exchanged, so that all wind the same way.
    pub(super) const fn corners(self, triangle: u64) -> [u64; 3] {
        let i = triangle;
        match self {
            Self::List => [3 * i, 3 * i + 1, 3 * i + 2],
            Self::Strip => [i, i + 1 + i % 2, i + 2 - i % 2],
            Self::Fan => [i + 1, i + 2, 0],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(mode: Mode, vertices: u64) -> Vec<[u64; 3]> {
        (0..mode.triangles(vertices))
            .map(|i| mode.corners(i))
            .collect()
    }

    #[test]
    fn the_triangles_are_those_of_the_specification() {
        assert_eq!(all(Mode::List, 7), [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(all(Mode::Strip, 5), [[0, 1, 2], [1, 3, 2], [2, 3, 4]]);
        assert_eq!(all(Mode::Fan, 5), [[1, 2, 0], [2, 3, 0], [3, 4, 0]]);
        for mode in [Mode::List, Mode::Strip, Mode::Fan] {
            assert_eq!(all(mode, 2), [[0; 3]; 0]);
            assert_eq!(all(mode, 0), [[0; 3]; 0]);
        }
    }

    #[test]
    fn other_modes_are_told_apart() {
        assert_eq!(Mode::of(0), Err(Some("points")));
        assert_eq!(Mode::of(3), Err(Some("lines")));
        assert_eq!(Mode::of(7), Err(None));
    }
}
