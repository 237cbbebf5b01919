//! The walk of one ray down the tree: the one body behind every question at every level.
//!
//! ```text
//! push the root
//! while something waits:
//!     take the last that was pushed; leave it if it begins beyond the nearest hit
//!     a node: test the boxes of its eight children at once, push those that are entered, far to near
//!     a leaf: test its triangles, up to eight at once
//! ```
//!
//! Where this departs from the plain way, and why:
//! 1. Children are pushed in the order of their middles along the octant of the direction, found
//!    when the tree was built, and not in that of where the ray enters them: one permutation without
//!    a branch in place of sorting. (The order by octant is that of Wald, Benthin, Boulos, "Getting
//!    Rid of Packets", 2008, and of the compressed wide BVH of Ylitie, Karras, Laine, 2017.)
//! 2. The nearest child is pushed too and taken again at once. What branches on how many children
//!    are entered is predicted wrongly half of the time.
//! 3. Triangles are turned away by the first half of the watertight test, eight at once and to the
//!    bit as the scalar test does; what is left, seldom more than one, is decided by the scalar
//!    test's own second half. So all levels give the answers of the scalar test.
//! 4. If any hit will do, children are pushed as they lie.

use ombra_geometry::triangle::Watertight;
use ombra_geometry::{Crossing, EdgeRule, Vector3};

use super::level::Lanes;
use super::super::node::{Child, Node, WIDTH};
use super::super::quad::Quad;
use super::ray::SingleRay;
use crate::{AnyHit, Counter};

/// No node lies deeper than this.
pub(crate) const MAX_DEPTH: usize = 64;

/// At each level seven siblings may wait; eight are written at once.
pub(crate) const STACK: usize = MAX_DEPTH * (WIDTH - 1) + 2 * WIDTH;

/// The parts of a tree of triangles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tree<'a> {
    pub(crate) root: Child,
    pub(crate) nodes: &'a [Node],
    pub(crate) quads: &'a [Quad],
}

/// A hit of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Found {
    pub(crate) crossing: Crossing,
    pub(crate) triangle: u32,
}

/// What to make of a hit.
pub(crate) trait Word {
    /// Whether it matters which hit comes first.
    const ORDERED: bool;
    fn on(&mut self, found: &Found) -> AnyHit;
}

/// The closest hit.
#[derive(Debug, Default)]
pub(crate) struct Closest;
impl Word for Closest {
    const ORDERED: bool = true;
    #[inline(always)]
    fn on(&mut self, _: &Found) -> AnyHit {
        AnyHit::Accept
    }
}

/// Any hit.
#[derive(Debug, Default)]
pub(crate) struct Any;
impl Word for Any {
    const ORDERED: bool = false;
    #[inline(always)]
    fn on(&mut self, _: &Found) -> AnyHit {
        AnyHit::Terminate
    }
}

/// Whatever a program says.
pub(crate) struct Said<'a>(pub(crate) &'a mut dyn FnMut(&Found) -> AnyHit);
impl Word for Said<'_> {
    const ORDERED: bool = true;
    #[inline(always)]
    fn on(&mut self, found: &Found) -> AnyHit {
        (self.0)(found)
    }
}

/// The search of one ray, as far as it has come.
pub(super) struct Search<'a, W> {
    pub(super) word: &'a mut W,
    pub(super) rule: EdgeRule,
    pub(super) t_min: f64,
    pub(super) t_max: f64,
    pub(super) best: Option<Found>,
}

/// Walks down the tree.
///
/// # Safety
/// - The processor has the instructions of `L`.
/// - The tree is whole: every child names a node or quads that are there, and no node lies deeper
///   than [`MAX_DEPTH`].
#[inline(always)]
pub(crate) unsafe fn walk<L: Lanes, W: Word, C: Counter>(
    tree: &Tree<'_>,
    ray: &SingleRay,
    rule: EdgeRule,
    word: &mut W,
    counter: &mut C,
) -> Option<Found> {
    let mut children = [const { std::mem::MaybeUninit::<Child>::uninit() }; STACK];
    let mut entries = [const { std::mem::MaybeUninit::<f32>::uninit() }; STACK];
    let children = children.as_mut_ptr().cast::<Child>();
    let entries = entries.as_mut_ptr().cast::<f32>();
    let mut search = Search {
        word,
        rule,
        t_min: ray.t_min.into(),
        t_max: ray.t_max.into(),
        best: None,
    };
    // SAFETY: `waiting` stays below the number of places, since a tree is at most `MAX_DEPTH` deep;
    // what is read was written; children name what is there (the caller's promise).
    unsafe {
        let slabs = Slabs::<L>::new(ray);
        let triangles = Triangles::<L>::new(ray);
        let mut t_max = ray.t_max;
        let mut waiting = 0;
        let mut child = tree.root;
        'search: loop {
            while !child.is_leaf() {
                counter.node();
                let node = tree.nodes.as_ptr().add(child.index());
                let (near, far) = slabs.entries(node, L::splat(t_max));
                let entered = near.at_most(far);
                let what: *const Child = (&raw const (*node).child).cast();
                if entered & entered.wrapping_sub(1) == 0 {
                    // One child or none.
                    if entered != 0 {
                        child = *what.add(entered.trailing_zeros() as usize);
                        continue;
                    }
                    match next::<W>(children, entries, &mut waiting, t_max) {
                        Some(next) => child = next,
                        None => break 'search,
                    }
                    continue;
                }
                let to = children.add(waiting);
                let nearest = if W::ORDERED {
                    let order = (*node).order[(ray.octant & 7) as usize];
                    let pushed = near.push(far, order, what, to, entries.add(waiting));
                    order >> (3 * pushed.ilog2()) & 7
                } else {
                    near.push_unordered(far, what, to);
                    entered.ilog2()
                };
                waiting += entered.count_ones() as usize - 1;
                child = *what.add(nearest as usize);
            }
            let quad = tree.quads.as_ptr().add(child.quad()).cast::<f32>();
            if !triangles.test(quad, child.places(), &ray.watertight, &mut search, counter) {
                break;
            }
            if W::ORDERED {
                t_max = search.t_max as f32;
            }
            match next::<W>(children, entries, &mut waiting, t_max) {
                Some(next) => child = next,
                None => break,
            }
        }
    }
    search.best
}

/// What waits and is not beyond `t_max`, the last that was pushed first.
///
/// # Safety
/// - So many children and entries were written.
#[inline(always)]
unsafe fn next<W: Word>(
    children: *const Child,
    entries: *const f32,
    waiting: &mut usize,
    t_max: f32,
) -> Option<Child> {
    while *waiting > 0 {
        *waiting -= 1;
        // SAFETY: the caller's promise.
        unsafe {
            if !W::ORDERED || *entries.add(*waiting) <= t_max {
                return Some(*children.add(*waiting));
            }
        }
    }
    None
}

/// Three numbers, each eight times. No closure: it would not have the level's instructions.
///
/// # Safety
/// - See [`walk`].
#[inline(always)]
unsafe fn splat<L: Lanes>([x, y, z]: [f32; 3]) -> [L; 3] {
    // SAFETY: the caller's promise.
    unsafe { [L::splat(x), L::splat(y), L::splat(z)] }
}

/// The test of eight boxes.
#[derive(Clone, Copy)]
pub(super) struct Slabs<L> {
    inverse: [L; 3],
    near: [L; 3],
    far: [L; 3],
    t_min: L,
    /// Where the planes of the near side begin in a node, by axis, in numbers; those of the far side
    /// begin as far from the middle.
    first: [usize; 3],
}

impl<L: Lanes> Slabs<L> {
    /// # Safety
    /// - See [`walk`].
    #[inline(always)]
    pub(super) unsafe fn new(ray: &SingleRay) -> Self {
        let first = |k: usize| {
            let backward = (ray.octant >> k & 1) as usize;
            (k + 3 * backward) * WIDTH
        };
        // SAFETY: the caller's promise.
        unsafe {
            Self {
                inverse: splat(ray.inverse),
                near: splat(ray.near),
                far: splat(ray.far),
                t_min: L::splat(ray.t_min),
                first: [first(0), first(1), first(2)],
            }
        }
    }

    /// Where the ray enters each box and where it leaves it.
    ///
    /// # Safety
    /// - See [`walk`]; and the node may be read.
    #[inline(always)]
    pub(super) unsafe fn entries(&self, node: *const Node, t_max: L) -> (L, L) {
        let planes = node.cast::<f32>();
        // SAFETY: the six lists of planes are the first numbers of a node.
        unsafe {
            let (mut near, mut far) = (self.t_min, t_max);
            let mut enter = [self.t_min; 3];
            let mut leave = [t_max; 3];
            for k in 0..3 {
                let first = self.first[k];
                let opposite = (3 + 2 * k) * WIDTH - first;
                enter[k] = L::load(planes.add(first)).multiply_add(self.inverse[k], self.near[k]);
                leave[k] = L::load(planes.add(opposite)).multiply_add(self.inverse[k], self.far[k]);
            }
            near = enter[0].larger(enter[1]).larger(enter[2].larger(near));
            far = leave[0].smaller(leave[1]).smaller(leave[2].smaller(far));
            (near, far)
        }
    }
}

/// The first half of the watertight test, for eight triangles.
#[derive(Clone, Copy)]
pub(super) struct Triangles<L> {
    /// Which component takes the place of x, y and z.
    axes: [usize; 3],
    origin: [L; 3],
    shear: [L; 2],
}

impl<L: Lanes> Triangles<L> {
    /// # Safety
    /// - See [`walk`].
    #[inline(always)]
    pub(super) unsafe fn new(ray: &SingleRay) -> Self {
        let axes = ray.watertight.axes();
        let shear = ray.watertight.shear();
        // SAFETY: the caller's promise.
        unsafe {
            Self {
                axes: axes.map(|axis| axis as usize),
                origin: splat(axes.map(|axis| ray.origin[axis])),
                shear: [L::splat(shear.x), L::splat(shear.y)],
            }
        }
    }

    /// The corners that begin at `from`, relative to the origin and sheared.
    ///
    /// # Safety
    /// - See [`test`](Self::test).
    #[inline(always)]
    unsafe fn corner(&self, from: *const f32, places: usize) -> [L; 3] {
        // SAFETY: the caller's promise.
        unsafe {
            let x = L::load(from.add(self.axes[0] * places)).minus(self.origin[0]);
            let y = L::load(from.add(self.axes[1] * places)).minus(self.origin[1]);
            let z = L::load(from.add(self.axes[2] * places)).minus(self.origin[2]);
            [
                x.minus(self.shear[0].times(z)),
                y.minus(self.shear[1].times(z)),
                z,
            ]
        }
    }

    /// Tests a leaf; no if the search is over.
    ///
    /// # Safety
    /// - See [`walk`]; and there is a leaf of so many places.
    #[inline(always)]
    pub(super) unsafe fn test<W: Word, C: Counter>(
        &self,
        leaf: *const f32,
        places: usize,
        watertight: &Watertight<f32>,
        search: &mut Search<'_, W>,
        counter: &mut C,
    ) -> bool {
        // SAFETY: of a leaf of four places eight numbers are read from the beginning of each of nine
        // components, the last four of them not being those of triangles; after the nine comes a
        // tenth, so all lie in the leaf.
        unsafe {
            let a = self.corner(leaf, places);
            let b = self.corner(leaf.add(3 * places), places);
            let c = self.corner(leaf.add(6 * places), places);
            let (u, v, w) = (edge(c, b), edge(a, c), edge(b, a));
            let (least, most) = (u.smaller(v).smaller(w), u.larger(v).larger(w));
            // Not on both sides; and where a corner is NaN, no.
            let zero = L::splat(0.0);
            let inside = zero.at_most(least) | most.at_most(zero);
            let mut left = inside & (255 >> (8 - places));
            if C::COUNTS {
                for k in 0..places {
                    let number = (*leaf.add(9 * places + k)).to_bits();
                    if number != u32::MAX {
                        counter.test();
                    }
                }
            }
            if left == 0 {
                return true;
            }
            let mut sheared = [[0.0_f32; 8]; 9];
            for k in 0..3 {
                a[k].store(sheared[k].as_mut_ptr());
                b[k].store(sheared[3 + k].as_mut_ptr());
                c[k].store(sheared[6 + k].as_mut_ptr());
            }
            while left != 0 {
                let k = left.trailing_zeros() as usize & 7;
                left &= left - 1;
                let corner = |which: usize| {
                    Vector3::new(
                        sheared[3 * which][k],
                        sheared[3 * which + 1][k],
                        sheared[3 * which + 2][k],
                    )
                };
                let corners = [corner(0), corner(1), corner(2)];
                if let Some(crossing) = watertight.decide(corners, search.rule) {
                    let triangle = (*leaf.add(9 * places + k)).to_bits();
                    if !search.report(Found { crossing, triangle }) {
                        return false;
                    }
                }
            }
            true
        }
    }
}

/// Twice the signed areas of the triangles (origin, q, p).
///
/// # Safety
/// - See [`walk`].
#[inline(always)]
unsafe fn edge<L: Lanes>(p: [L; 3], q: [L; 3]) -> L {
    // SAFETY: the caller's promise.
    unsafe { p[0].times(q[1]).minus(p[1].times(q[0])) }
}

impl<W: Word> Search<'_, W> {
    /// Takes in a crossing; no if the search is over.
    #[inline(always)]
    fn report(&mut self, found: Found) -> bool {
        let t = found.crossing.t;
        if !(self.t_min <= t && t <= self.t_max && t < f64::INFINITY) {
            return true;
        }
        // At the same t the smaller number comes first.
        let behind = |best: &Found| t == best.crossing.t && best.triangle <= found.triangle;
        if self.best.as_ref().is_some_and(behind) {
            return true;
        }
        match self.word.on(&found) {
            AnyHit::Ignore => true,
            answer => {
                self.best = Some(found);
                self.t_max = t;
                answer == AnyHit::Accept
            }
        }
    }
}
