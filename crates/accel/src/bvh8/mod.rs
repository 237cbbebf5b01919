//! The wide bounding volume hierarchy: eight boxes a node, eight triangles a leaf, tested at once.
//!
//! Made in steps, each a value of its own:
//! 1. a builder cuts the list of primitives again and again and makes nodes of the parts, by so much
//!    care as is asked for (`build`);
//! 2. if the primitives are triangles they are copied into the leaves (`quad`, `compact`); leaves of other
//!    primitives become nodes with one in each leaf (`spread`).
//!
//! Such a tree over triangles is a file too, all in itself (`file`, `places`), and traced where the
//! file lies in memory (`store`).
//!
//! A tree over triangles takes about 50 bytes of each, over boxes of twelve triangles 64; in the
//! `compact` layout it takes half as much and is traced somewhat more slowly. While a tree is built it
//! never takes more than twice as much as when it is finished, the mesh aside; a compact one, which
//! is made of one like the others, three and a half times as much.
//!
//! Rays walk down it by kernels in single precision, at the best level of instructions that the
//! machine has (`kernel`): one for triangles, one that shows a visitor any other primitive. Rays that
//! are to be traced in double precision walk down it plainly (`traverse`).

mod build;
mod compact;
pub(crate) mod file;
mod kernel;
mod near;
mod node;
pub(crate) mod places;
mod quad;
mod refit;
mod shown;
mod spread;
mod store;
#[cfg(test)]
mod tests;
mod traverse;
#[cfg(test)]
mod validate;
mod wide;

use std::borrow::Cow;
use std::marker::PhantomData;
use std::ops::ControlFlow;

use ombra_geometry::{Aabb, EdgeRule, Hit, Ray, TriangleMesh};

use crate::{AnyHit, Bounded, Candidate, Counter, Reach, Structure, TraversalRay, Visitor};
pub(crate) use build::items::Items;
use compact::{Blocks, SmallNode};
use kernel::{Found, Full, Near, SingleRay, Small, Tree};
use node::Child;
use quad::Quad;
pub(crate) use refit::Moved;
pub(crate) use shown::Shown;
use store::Store;
pub(crate) use wide::WideTree;

pub use kernel::{Level, prefetch};
pub(crate) use kernel::{not_above, rounded};
pub(crate) use node::{Node, WIDTH};

/// How much care a builder takes, and what it makes.
pub trait Care: Clone + std::fmt::Debug + Send + Sync + 'static {
    /// How much.
    const EFFORT: Effort;
    /// Whether trees over triangles are made smaller.
    const IS_COMPACT: bool = false;
}

/// How much time a builder takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// As little as it can.
    Least,
    /// A little more.
    Usual,
    /// As much as makes rays quicker.
    Most,
}

/// Cuts along a Morton curve.
#[derive(Clone, Copy, Debug)]
pub enum Fast {}
impl Care for Fast {
    const EFFORT: Effort = Effort::Least;
}

/// Cuts by the surface area heuristic.
#[derive(Clone, Copy, Debug)]
pub enum Balanced {}
impl Care for Balanced {
    const EFFORT: Effort = Effort::Usual;
}

/// Cuts by the surface area heuristic, of the list or of space, whichever is cheaper: where large
/// triangles lie beside small ones, as in rooms, rays visit fewer nodes. Triangles are listed half as
/// often again at most.
#[derive(Clone, Copy, Debug)]
pub enum High {}
impl Care for High {
    const EFFORT: Effort = Effort::Most;
}

/// Cuts by the surface area heuristic, and packs what comes out in half the memory.
#[derive(Clone, Copy, Debug)]
pub enum Compact {}
impl Care for Compact {
    const EFFORT: Effort = Effort::Usual;
    const IS_COMPACT: bool = true;
}

/// A wide bounding volume hierarchy, built with the care `C`.
#[derive(Clone, Debug)]
pub struct Bvh8<C = Balanced> {
    pub(crate) tree: Wide,
    care: PhantomData<C>,
}

/// The tree itself, however it was built.
#[derive(Clone, Debug)]
pub(crate) struct Wide {
    body: Body,
    near: Near,
    /// Whether some triangles are in several leaves.
    repeats: bool,
    pub(crate) level: Level,
}

/// Nodes and what they lead to.
#[derive(Clone, Debug)]
enum Body {
    /// All numbers as they are.
    Full(WideTree<Store<Node>>, Leaves),
    /// Triangles in the compact layout.
    Compact(WideTree<Vec<SmallNode>>, Blocks),
}

/// What leaves hold.
#[derive(Clone, Debug)]
enum Leaves {
    /// Primitives by number.
    Lists(Vec<u32>),
    /// Triangles, shown to a plain walk by their numbers.
    Quads(Store<Quad>),
    /// Triangles, shown to a plain walk by their places.
    Places(Store<Quad>),
}

/// A tree over triangles as the kernels want it.
enum Triangles<'a> {
    Full(Tree<Full<'a>>),
    Compact(Tree<Small<'a>>),
}

/// The same for a tree of either layout.
macro_rules! on_tree {
    ($triangles:expr, $tree:ident => $answer:expr) => {
        match $triangles {
            Triangles::Full($tree) => {
                let $tree = &$tree;
                $answer
            }
            Triangles::Compact($tree) => {
                let $tree = &$tree;
                $answer
            }
        }
    };
}

impl<C: Care> Bvh8<C> {
    /// Builds one over boxes that are finite and not empty; over triangles if there is a mesh.
    /// `bounds_of` gives the box of a primitive.
    pub(crate) fn new(
        items: Items,
        reach: &Reach,
        mesh: Option<&TriangleMesh>,
        bounds_of: &dyn Fn(u32) -> Aabb,
    ) -> Self {
        let count = items.list.len();
        let (mut tree, list) = match C::EFFORT {
            Effort::Least => build::morton::build(&items),
            Effort::Usual => build::binned::build(items),
            Effort::Most => build::spatial::build(items, mesh),
        };
        let repeats = list.len() > count;
        let body = match mesh {
            None => {
                spread::spread(&mut tree, &|place| bounds_of(list[place]));
                Body::Full(tree.stored(), Leaves::Lists(list))
            }
            Some(mesh) if C::IS_COMPACT => {
                let (tree, blocks) = compact::pack(&tree, &list, mesh);
                Body::Compact(tree, blocks)
            }
            Some(mesh) => {
                let quads = build::pack::pack(&mut tree, &list, mesh);
                Body::Full(tree.stored(), Leaves::Quads(quads.into()))
            }
        };
        Self {
            tree: Wide::new(body, reach, repeats),
            care: PhantomData,
        }
    }
}

/// The tree over boxes, with one in each leaf, and the list of primitives that leaves name.
pub(crate) fn tree_over_boxes(items: Items, boxes: &[Aabb]) -> (WideTree, Vec<u32>) {
    let (mut tree, list) = build::binned::build(items);
    spread::spread(&mut tree, &|place| boxes[list[place] as usize]);
    (tree, list)
}

impl<C: Care> Structure for Bvh8<C> {
    fn build(primitives: &[Bounded], reach: &Reach) -> Self {
        let bounds_of = |primitive| {
            let place = primitives.partition_point(|own| own.primitive < primitive);
            primitives[place].bounds
        };
        Self::new(Items::bounded(primitives), reach, None, &bounds_of)
    }

    #[inline]
    fn traverse<V: Visitor>(&self, ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()> {
        self.tree.traverse(ray, visitor)
    }

    fn bytes(&self) -> usize {
        match &self.tree.body {
            Body::Full(tree, leaves) => {
                let leaves = match leaves {
                    Leaves::Lists(list) => size_of_val(list.as_slice()),
                    Leaves::Quads(quads) | Leaves::Places(quads) => size_of_val(&**quads),
                };
                size_of_val(&*tree.nodes) + leaves
            }
            Body::Compact(tree, blocks) => size_of_val(&*tree.nodes) + blocks.bytes(),
        }
    }
}

impl Wide {
    /// With the best level of this machine.
    fn new(body: Body, reach: &Reach, repeats: bool) -> Self {
        Self {
            body,
            near: Near::new(reach),
            repeats,
            level: Level::detect(),
        }
    }

    /// Whether a search may come upon the same triangle more than once.
    pub(crate) const fn repeats(&self) -> bool {
        self.repeats
    }

    /// Whether leaves hold triangles, so that kernels trace all but a few rays.
    pub(crate) const fn is_of_triangles(&self) -> bool {
        matches!(
            self.body,
            Body::Full(_, Leaves::Quads(_)) | Body::Compact(..)
        )
    }

    fn root(&self) -> Child {
        match &self.body {
            Body::Full(tree, _) => tree.root,
            Body::Compact(tree, _) => tree.root,
        }
    }

    /// A node with all its numbers.
    fn node(&self, child: Child) -> Cow<'_, Node> {
        match &self.body {
            Body::Full(tree, _) => Cow::Borrowed(&tree.nodes[child.index()]),
            Body::Compact(tree, _) => Cow::Owned(tree.nodes[child.index()].expanded()),
        }
    }

    /// The parts that the kernels need, if leaves hold triangles.
    #[inline(always)]
    fn triangles(&self) -> Option<Triangles<'_>> {
        match &self.body {
            Body::Full(_, Leaves::Lists(_)) => None,
            Body::Full(tree, Leaves::Quads(quads) | Leaves::Places(quads)) => {
                let layout = Full {
                    nodes: &tree.nodes,
                    quads,
                };
                Some(Triangles::Full(tree.laid(layout)))
            }
            Body::Compact(tree, blocks) => {
                let layout = Small {
                    nodes: &tree.nodes,
                    words: blocks.words(),
                };
                Some(Triangles::Compact(tree.laid(layout)))
            }
        }
    }

    /// The closest hit; `None` if this ray is not for the kernels.
    #[inline]
    pub(crate) fn closest(&self, ray: &Ray) -> Option<Option<Candidate>> {
        let (level, near) = (self.level, &self.near);
        let found = on_tree!(self.triangles()?, tree => kernel::closest(level, tree, near, ray))?;
        Some(found.map(|found| found.candidate()))
    }

    /// The closest hits of many rays, and which rays are not for the kernels; no if none is.
    pub(crate) fn closest_many(
        &self,
        rays: &[Ray],
        hits: &mut [Option<Hit>],
        slow: &mut dyn FnMut(usize),
    ) -> bool {
        let Some(tree) = self.triangles() else {
            return false;
        };
        let (level, near) = (self.level, &self.near);
        on_tree!(tree, tree => kernel::closest_many(level, tree, near, rays, hits, slow));
        true
    }

    /// Whether many rays have a hit, and which rays are not for the kernels; no if none is.
    pub(crate) fn any_many(
        &self,
        rays: &[Ray],
        hits: &mut [bool],
        slow: &mut dyn FnMut(usize),
    ) -> bool {
        let Some(tree) = self.triangles() else {
            return false;
        };
        let (level, near) = (self.level, &self.near);
        on_tree!(tree, tree => kernel::any_many(level, tree, near, rays, hits, slow));
        true
    }

    /// The closest hit that `any_hit` accepts; `None` if this ray is not for the kernels.
    pub(crate) fn search<C: Counter>(
        &self,
        ray: &TraversalRay,
        rule: EdgeRule,
        counter: &mut C,
        any_hit: &mut dyn FnMut(&Candidate) -> AnyHit,
    ) -> Option<Option<Candidate>> {
        let tree = self.triangles()?;
        let mut ray = SingleRay::rounded(ray, &self.near)?;
        let mut said = |found: &Found| any_hit(&found.candidate());
        let (level, ray, said) = (self.level, &mut ray, &mut said);
        let found = on_tree!(tree, tree => match counter.statistics() {
            None => kernel::search(level, tree, ray, rule, said),
            Some(counted) => kernel::search_counted(level, tree, ray, rule, said, counted),
        });
        Some(found.map(|found| found.candidate()))
    }

    /// Whether there is a hit; `None` if this ray is not for the kernels.
    #[inline]
    pub(crate) fn any(&self, ray: &Ray) -> Option<bool> {
        let (level, near) = (self.level, &self.near);
        on_tree!(self.triangles()?, tree => kernel::any(level, tree, near, ray))
    }
}
