//! The structures by name.

use std::fmt;
use std::ops::ControlFlow;
use std::str::FromStr;

use crate::bvh::{Bvh, Lbvh, Median, Sah};
use crate::bvh8::{Balanced, Bvh8, Compact, Fast, High, Wide};
use crate::{
    Bih, Bounded, BruteForce, Grid, Grid2, KdRestart, KdRopes, KdShortStack, KdStack, Octree,
    Reach, Structure, StructureAlias, TraversalRay, Visitor,
};

/// Every structure, with its name and a line on each.
///
/// One line a structure; everything else follows from it.
macro_rules! structures {
    ($($(#[$meta:meta])* $variant:ident($type:ty), $name:literal, $line:literal;)*) => {
        /// Which structure to build.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum StructureKind {
            $(#[doc = $line] $(#[$meta])* $variant,)*
        }

        impl StructureKind {
            /// All of them, in the order in which they are listed.
            pub const ALL: &[Self] = &[$(Self::$variant,)*];

            /// The name that a person types.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// What it is, in one line.
            #[must_use]
            pub const fn line(self) -> &'static str {
                match self { $(Self::$variant => $line,)* }
            }

            /// Builds one.
            #[must_use]
            pub fn build(self, primitives: &[Bounded], reach: &Reach) -> AnyStructure {
                match self {
                    $(Self::$variant => {
                        AnyStructure::$variant(<$type>::build(primitives, reach))
                    })*
                }
            }
        }

        /// A structure chosen by name.
        #[derive(Clone, Debug)]
        #[non_exhaustive]
        pub enum AnyStructure {
            $(#[doc = $line] $variant($type),)*
        }

        impl AnyStructure {
            /// Which one it is.
            #[must_use]
            pub const fn kind(&self) -> StructureKind {
                match self { $(Self::$variant(_) => StructureKind::$variant,)* }
            }

            /// Bytes held on the heap.
            #[must_use]
            pub fn bytes(&self) -> usize {
                match self { $(Self::$variant(structure) => structure.bytes(),)* }
            }

            /// See [`Structure::traverse`].
            #[inline]
            pub fn traverse<V: Visitor>(
                &self,
                ray: &TraversalRay,
                visitor: &mut V,
            ) -> ControlFlow<()> {
                match self { $(Self::$variant(structure) => structure.traverse(ray, visitor),)* }
            }
        }
    };
}

structures! {
    BruteForce(BruteForce), "brute-force", "no structure: every primitive is tested";
    Grid(Grid), "grid", "uniform grid: equal cells, walked from one to the next";
    Grid2(Grid2), "grid2", "grid in a grid: crowded cells hold a grid of their own";
    Octree(Octree), "octree", "octree: crowded cubes are cut into eight";
    KdStack(KdStack), "kd-stack", "kd-tree, what is still to visit waits on a stack";
    KdRestart(KdRestart), "kd-restart", "kd-tree, walked from the root for every leaf";
    KdShortStack(KdShortStack), "kd-short-stack", "kd-tree, a stack of four, else from the root";
    KdRopes(KdRopes), "kd-ropes", "kd-tree, ropes lead from leaf to leaf";
    Bih(Bih), "bih", "bounding interval hierarchy: two clip planes a node, built in one quick pass";
    Bvh(Bvh<Sah>), "bvh", "boxes within boxes, cut where the surface area heuristic says";
    BvhMedian(Bvh<Median>), "bvh-median", "boxes within boxes, each list halved along the widest axis";
    #[default]
    Bvh8(Bvh8<Balanced>), "bvh8", "eight boxes a node, tested at once: the quickest to trace";
    Bvh8Fast(Bvh8<Fast>), "bvh8-fast", "eight boxes a node, cut along a Morton curve: built in a third of the time";
    Bvh8High(Bvh8<High>), "bvh8-high", "eight boxes a node, space itself cut where that pays: slower to build, quicker in rooms";
    Bvh8Compact(Bvh8<Compact>), "bvh8-compact", "eight boxes a node in half the memory: traced somewhat more slowly";
    BvhLbvh(Bvh<Lbvh>), "bvh-lbvh", "boxes within boxes, cut along a Morton curve: built in one quick pass";
}

impl AnyStructure {
    /// The wide tree, if this is one.
    #[inline]
    pub(crate) const fn wide(&self) -> Option<&Wide> {
        match self {
            Self::Bvh8(bvh) => Some(&bvh.tree),
            Self::Bvh8Fast(bvh) => Some(&bvh.tree),
            Self::Bvh8High(bvh) => Some(&bvh.tree),
            Self::Bvh8Compact(bvh) => Some(&bvh.tree),
            _ => None,
        }
    }

    /// The same, to change it.
    pub(crate) const fn wide_mut(&mut self) -> Option<&mut Wide> {
        match self {
            Self::Bvh8(bvh) => Some(&mut bvh.tree),
            Self::Bvh8Fast(bvh) => Some(&mut bvh.tree),
            Self::Bvh8High(bvh) => Some(&mut bvh.tree),
            Self::Bvh8Compact(bvh) => Some(&mut bvh.tree),
            _ => None,
        }
    }
}

/// A name that no structure has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownStructure(String);

impl fmt::Display for UnknownStructure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<_> = StructureKind::ALL.iter().map(|kind| kind.name()).collect();
        write!(
            f,
            "there is no structure \"{}\"; there are: {}",
            self.0,
            names.join(", ")
        )
    }
}

impl std::error::Error for UnknownStructure {}

impl FromStr for StructureKind {
    type Err = UnknownStructure;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .iter()
            .copied()
            .find(|kind| kind.name().eq_ignore_ascii_case(name))
            .or_else(|| StructureAlias::of(name).map(|alias| alias.kind))
            .ok_or_else(|| UnknownStructure(name.to_owned()))
    }
}

impl fmt::Display for StructureKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
