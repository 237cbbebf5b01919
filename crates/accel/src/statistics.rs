//! What a query costs, counted.

use std::iter::Sum;
use std::ops::AddAssign;

/// Counts the steps of a traversal. `()` counts nothing and costs nothing.
pub trait Counter {
    /// Whether anything is counted.
    const COUNTS: bool;
    /// Where to count, if anything is counted.
    fn statistics(&mut self) -> Option<&mut Statistics>;
    /// A node was visited.
    fn node(&mut self);
    /// A primitive was tested.
    fn test(&mut self);
}

impl Counter for () {
    const COUNTS: bool = false;
    #[inline]
    fn statistics(&mut self) -> Option<&mut Statistics> {
        None
    }
    #[inline]
    fn node(&mut self) {}
    #[inline]
    fn test(&mut self) {}
}

/// How much work some queries were.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Nodes visited: boxes or planes tested, cells entered, on both levels of instancing.
    pub nodes_visited: u64,
    /// Primitives tested, instances included.
    pub tests_made: u64,
}

impl Counter for Statistics {
    const COUNTS: bool = true;
    #[inline]
    fn statistics(&mut self) -> Option<&mut Statistics> {
        Some(self)
    }
    #[inline]
    fn node(&mut self) {
        self.nodes_visited += 1;
    }
    #[inline]
    fn test(&mut self) {
        self.tests_made += 1;
    }
}

impl AddAssign for Statistics {
    fn add_assign(&mut self, other: Self) {
        self.nodes_visited += other.nodes_visited;
        self.tests_made += other.tests_made;
    }
}

impl Sum for Statistics {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |mut sum, one| {
            sum += one;
            sum
        })
    }
}
