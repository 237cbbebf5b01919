//! The wide bounding volume hierarchy: eight boxes a node, eight triangles a leaf, tested at once.
//!
//! Made in steps, each a value of its own:
//! 1. a builder cuts the list of primitives in two again and again, down to lists of at most eight
//!    (`build`);
//! 2. nodes take in what is below them until they have eight children (`collapse`, `node`);
//! 3. if the primitives are triangles they are copied into the leaves (`quad`).
//!
//! Such a tree over triangles is a file too, all in itself (`file`, `places`), and traced where the file lies in memory
//! (`store`).
//!
//! Rays walk down it in one of two ways: a kernel for triangles in single precision at the best
//! level of instructions that the machine has (`kernel`), and a plain walk for everything else (`traverse`): any primitive, and rays that are
//! to be traced in double precision.

mod build;
mod collapse;
pub(crate) mod file;
mod kernel;
mod node;
pub(crate) mod places;
mod quad;
mod store;
mod traverse;

use std::marker::PhantomData;
use std::ops::ControlFlow;

use ombra_geometry::{EdgeRule, Hit, Ray, TriangleMesh};

use crate::{AnyHit, Bounded, Candidate, Counter, Reach, Structure, TraversalRay, Visitor};
pub(crate) use build::item::Item;
use collapse::WideTree;
use kernel::{Found, Near, SingleRay, Tree};
use node::{Child, Node};
use quad::Quad;
use store::Store;

pub use kernel::Level;

/// How much care a builder takes.
pub trait Care: Clone + std::fmt::Debug + Send + Sync + 'static {}

/// Cuts by the surface area heuristic.
#[derive(Clone, Copy, Debug)]
pub enum Balanced {}
impl Care for Balanced {}

/// A wide bounding volume hierarchy, built with the care `C`.
#[derive(Clone, Debug)]
pub struct Bvh8<C = Balanced> {
    pub(crate) tree: Wide,
    care: PhantomData<C>,
}

/// The tree itself, however it was built.
#[derive(Clone, Debug)]
pub(crate) struct Wide {
    tree: WideTree<Store<Node>>,
    leaves: Leaves,
    near: Near,
    pub(crate) level: Level,
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

impl<C: Care> Bvh8<C> {
    /// Builds one over boxes that are finite and not empty; over triangles if there is a mesh.
    pub(crate) fn new(items: Vec<Item>, reach: &Reach, mesh: Option<&TriangleMesh>) -> Self {
        let mut items = items;
        let binary = build::binned::build(&mut items);
        let list: Vec<u32> = items.iter().map(Item::primitive).collect();
        drop(items);
        let mut tree = collapse::collapse(&binary);
        drop(binary);
        let leaves = match mesh {
            None => Leaves::Lists(list),
            Some(mesh) => Leaves::Quads(pack(&mut tree, &list, mesh).into()),
        };
        Self {
            tree: Wide::new(tree.stored(), leaves, reach),
            care: PhantomData,
        }
    }
}

/// Copies triangles into leaves.
fn pack(tree: &mut WideTree, list: &[u32], mesh: &TriangleMesh) -> Vec<Quad> {
    let mut quads = Vec::with_capacity(list.len() / 3 + 2);
    let mut packed = |child: &mut Child| {
        if child.is_leaf() {
            let first = quads.len();
            let eight = Quad::lay(&mut quads, mesh, &list[child.range()]);
            *child = Child::triangles(first, eight);
        }
    };
    packed(&mut tree.root);
    tree.nodes
        .iter_mut()
        .flat_map(|node| &mut node.child)
        .for_each(packed);
    quads
}

impl<C: Care> Structure for Bvh8<C> {
    fn build(primitives: &[Bounded], reach: &Reach) -> Self {
        let item = |own: &Bounded| Item::new(&own.bounds, own.primitive);
        Self::new(primitives.iter().map(item).collect(), reach, None)
    }

    #[inline]
    fn traverse<V: Visitor>(&self, ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()> {
        self.tree.traverse(ray, visitor)
    }

    fn bytes(&self) -> usize {
        let leaves = match &self.tree.leaves {
            Leaves::Lists(list) => size_of_val(list.as_slice()),
            Leaves::Quads(quads) | Leaves::Places(quads) => size_of_val(&**quads),
        };
        size_of_val(&*self.tree.tree.nodes) + leaves
    }
}

impl Wide {
    /// With the best level of this machine.
    fn new(tree: WideTree<Store<Node>>, leaves: Leaves, reach: &Reach) -> Self {
        Self {
            tree,
            leaves,
            near: Near::new(reach),
            level: Level::detect(),
        }
    }

    /// The parts that the kernels need, if leaves hold triangles.
    #[inline(always)]
    fn triangles(&self) -> Option<Tree<'_>> {
        match &self.leaves {
            Leaves::Lists(_) => None,
            Leaves::Quads(quads) | Leaves::Places(quads) => Some(Tree {
                root: self.tree.root,
                nodes: &self.tree.nodes,
                quads,
                stack: kernel::stack(self.tree.depth),
            }),
        }
    }

    /// The closest hit; `None` if this ray is not for the kernels.
    #[inline]
    pub(crate) fn closest(&self, ray: &Ray) -> Option<Option<Candidate>> {
        let tree = self.triangles()?;
        let found = kernel::closest(self.level, &tree, &self.near, ray)?;
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
        kernel::closest_many(self.level, &tree, &self.near, rays, hits, slow);
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
        kernel::any_many(self.level, &tree, &self.near, rays, hits, slow);
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
        let found = match counter.statistics() {
            None => kernel::search(self.level, &tree, &mut ray, rule, &mut said),
            Some(counted) => {
                kernel::search_counted(self.level, &tree, &mut ray, rule, &mut said, counted)
            }
        };
        Some(found.map(|found| found.candidate()))
    }

    /// Whether there is a hit; `None` if this ray is not for the kernels.
    #[inline]
    pub(crate) fn any(&self, ray: &Ray) -> Option<bool> {
        let tree = self.triangles()?;
        kernel::any(self.level, &tree, &self.near, ray)
    }
}
