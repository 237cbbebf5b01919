//! How much a study does.

use ombra::accel::StructureKind;
use ombra::geometry::triangle::TriangleTest;

/// The most pixels a side: with four kinds of rays and their answers this is about a gigabyte.
pub const LARGEST_SIDE: u32 = 2048;

/// How much a study does.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Which structures, in the order in which they are shown.
    pub kinds: Vec<StructureKind>,
    /// Width and height of the picture that primary rays are of, each from 1 to [`LARGEST_SIDE`].
    /// There are as many rays of each other kind.
    pub size: [u32; 2],
    /// How many times each job is on the clock; 0 counts and compares only.
    pub rounds: usize,
    /// On how many threads, one after the other; 0 is all that the machine has.
    pub threads: Vec<usize>,
    /// Another seed gives other rays.
    pub seed: u64,
    /// How fine generated scenes are: their triangles grow with its square.
    pub detail: u32,
    /// How rays are tested against triangles.
    pub triangle_test: TriangleTest,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            kinds: StructureKind::ALL.to_vec(),
            size: [160, 160],
            rounds: 5,
            threads: vec![1, 0],
            seed: 0,
            detail: 200,
            triangle_test: TriangleTest::default(),
        }
    }
}

impl Settings {
    /// So small that it is done in a few seconds: for tests, and to see whether all is well. Its
    /// times mean little.
    #[must_use]
    pub fn smoke() -> Self {
        Self {
            size: [24, 24],
            rounds: 2,
            detail: 12,
            ..Self::default()
        }
    }
}
