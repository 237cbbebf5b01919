//! Whether a tree is one, and what it is like.

use ombra_geometry::Aabb;

use super::collapse::{MAX_LEAF, TEST_COST, TRAVERSAL_COST};
use super::layout::{Layout, Node};
use crate::Bounded;

/// What a tree is like.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BvhStatistics {
    /// How many nodes there are, leaves included.
    pub nodes: usize,
    /// How many of them are leaves.
    pub leaves: usize,
    /// The most primitives in a leaf.
    pub largest_leaf: usize,
    /// How many levels the deepest leaf lies below the root.
    pub depth: usize,
    /// What a line that meets the root's box is expected to cost, in tests of primitives, by the
    /// surface area heuristic; NaN where the root's box has no area.
    pub sah_cost: f64,
}

/// What is wrong with a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum InvalidBvh {
    /// A node names children or primitives that are not there, or a leaf is too large.
    Range {
        /// The first that it names.
        first: u32,
        /// How many, or 0 if it names children.
        count: u32,
    },
    /// A node's box does not hold the box of something below it.
    NotEnclosed {
        /// The primitive that sticks out, or `None` if a child does.
        primitive: Option<u32>,
    },
    /// A primitive is in no leaf, in several, or was never given.
    Times {
        /// Which primitive.
        primitive: u32,
        /// How many leaves it is in.
        found: u32,
    },
    /// A leaf lies too deep for the stack of the traversal.
    TooDeep {
        /// How deep it lies.
        depth: usize,
    },
}

impl std::fmt::Display for InvalidBvh {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Range { first, count } => {
                write!(
                    f,
                    "a node names {count} from {first} on, which is out of range"
                )
            }
            Self::NotEnclosed {
                primitive: Some(primitive),
            } => write!(f, "primitive {primitive} sticks out of its leaf"),
            Self::NotEnclosed { primitive: None } => {
                write!(f, "a node sticks out of the one above it")
            }
            Self::Times { primitive, found } => {
                write!(f, "primitive {primitive} is in {found} leaves, not in one")
            }
            Self::TooDeep { depth } => write!(f, "a leaf lies {depth} levels deep"),
        }
    }
}

impl std::error::Error for InvalidBvh {}

/// Checks a tree against its primitives and measures it.
pub(super) fn validate(
    layout: &Layout,
    primitives: &[Bounded],
) -> Result<BvhStatistics, InvalidBvh> {
    let most = primitives.iter().map(|p| p.primitive as usize + 1).max();
    let mut walk = Walk {
        layout,
        boxes: vec![None; most.unwrap_or(0)],
        found: vec![0; most.unwrap_or(0)],
        area_cost: 0.0,
        statistics: BvhStatistics::default(),
    };
    for p in primitives {
        walk.boxes[p.primitive as usize] = Some(p.bounds);
    }
    if let Some(root) = &layout.root {
        walk.node(root, 0)?;
        walk.statistics.sah_cost = walk.area_cost / root.bounds.wide().half_area();
    }
    for (primitive, (bounds, &found)) in (0..).zip(walk.boxes.iter().zip(&walk.found)) {
        if found != u32::from(bounds.is_some()) {
            return Err(InvalidBvh::Times { primitive, found });
        }
    }
    Ok(walk.statistics)
}

struct Walk<'a> {
    layout: &'a Layout,
    /// By primitive; `None` for numbers that no primitive has.
    boxes: Vec<Option<Aabb>>,
    /// By primitive: in how many leaves it was found.
    found: Vec<u32>,
    /// The sum of cost · half area over all nodes.
    area_cost: f64,
    statistics: BvhStatistics,
}

impl Walk<'_> {
    fn node(&mut self, node: &Node, depth: usize) -> Result<(), InvalidBvh> {
        if depth > super::MAX_DEPTH {
            return Err(InvalidBvh::TooDeep { depth });
        }
        self.statistics.nodes += 1;
        if node.is_leaf() {
            return self.leaf(node, depth);
        }
        let range = InvalidBvh::Range {
            first: node.first,
            count: 0,
        };
        let siblings = self.layout.siblings.get(node.first as usize);
        let children = siblings.ok_or(range)?.nodes();
        self.area_cost += TRAVERSAL_COST * node.bounds.wide().half_area();
        for child in children {
            if !node.bounds.encloses(&child.bounds) {
                return Err(InvalidBvh::NotEnclosed { primitive: None });
            }
            self.node(&child, depth + 1)?;
        }
        Ok(())
    }

    fn leaf(&mut self, leaf: &Node, depth: usize) -> Result<(), InvalidBvh> {
        let Node { first, count, .. } = *leaf;
        let range = first as usize..first as usize + count as usize;
        let primitives = self.layout.primitives.get(range);
        let in_leaf = primitives
            .filter(|_| count <= MAX_LEAF)
            .ok_or(InvalidBvh::Range { first, count })?;
        for &primitive in in_leaf {
            let bounds = self.boxes.get(primitive as usize).copied().flatten();
            let unknown = InvalidBvh::Times {
                primitive,
                found: 1,
            };
            if !leaf.bounds.encloses(&bounds.ok_or(unknown)?) {
                let primitive = Some(primitive);
                return Err(InvalidBvh::NotEnclosed { primitive });
            }
            self.found[primitive as usize] += 1;
        }
        let statistics = &mut self.statistics;
        statistics.leaves += 1;
        statistics.largest_leaf = statistics.largest_leaf.max(count as usize);
        statistics.depth = statistics.depth.max(depth);
        self.area_cost += TEST_COST * f64::from(count) * leaf.bounds.wide().half_area();
        Ok(())
    }
}
