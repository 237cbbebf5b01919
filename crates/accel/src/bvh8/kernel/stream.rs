//! The walk of many rays at once, for rays that have nothing to do with one another.
//!
//! One ray alone waits most of the time: for a node to come from memory, for the test of its boxes
//! to say where to go on, for the processor to find out that it guessed wrongly. So some rays are
//! under way at once, and each does one step in its turn:
//!
//! ```text
//! while rays are under way:
//!     for each ray that is at a node:
//!         test its boxes, push those that are entered, look what comes next and ask memory for it
//!         (not one branch that depends on the ray)
//!     for each ray that is at a leaf:
//!         test its triangles, drop what waits beyond a new hit, look what comes next
//!     for each ray that is at its end:
//!         write its answer and begin with another ray in its place
//! ```
//!
//! The order in which a ray meets nodes and leaves is that of `walk`, and so is the answer.

use std::mem::MaybeUninit;

use ombra_geometry::{EdgeRule, Ray};

use super::super::node::{Child, WIDTH};
use super::level::Lanes;
use super::ray::{Near, SingleRay};
use super::walk::{Found, STACK, Search, Slabs, Tree, Triangles, Word};
use crate::AnyHit;

/// How many rays are under way.
const FLIGHT: usize = 16;

/// What lies below all that waits: the end.
const END: Child = Child(u32::MAX);

/// A ray under way.
struct Under {
    ray: SingleRay,
    best: Option<Found>,
    /// Which ray it is.
    index: usize,
    /// How many children wait, the end included.
    waiting: usize,
    children: [MaybeUninit<Child>; STACK],
    entries: [MaybeUninit<f32>; STACK],
}

/// Walks with each of many rays, and tells the answers by the numbers of the rays, in no promised
/// order. `slow` is told which rays are not for the kernels.
///
/// # Safety
/// - As for [`walk`](super::walk::walk).
#[inline(always)]
pub(crate) unsafe fn stream<L: Lanes, W: Word + Default>(
    tree: &Tree<'_>,
    near: &Near,
    rays: &[Ray],
    mut answer: impl FnMut(usize, &Option<Found>),
    slow: &mut dyn FnMut(usize),
) {
    let mut flight = [const { MaybeUninit::<Under>::uninit() }; FLIGHT];
    let flight = flight.as_mut_ptr().cast::<Under>();
    let (mut at_nodes, mut at_leaves) = ([0_u8; FLIGHT], [0_u8; FLIGHT]);
    let (mut nodes, mut leaves) = (0, 0);
    let mut next = 0;
    // SAFETY: slots below `begun` were written; numbers in the lists are of such slots; the stacks of
    // rays stay below their size as in `walk`.
    unsafe {
        let mut slot = 0;
        while slot < FLIGHT {
            match begin(tree, near, rays, &mut next, slow, flight.add(slot)) {
                false => break,
                true => sort_in(slot as u8, tree.root, [&mut at_nodes, &mut at_leaves], [&mut nodes, &mut leaves]),
            }
            slot += 1;
        }
        while nodes + leaves > 0 {
            let count = nodes;
            nodes = 0;
            for k in 0..count {
                let slot = at_nodes[k & (FLIGHT - 1)];
                let under = flight.add(slot.into());
                let child = step::<L, W>(tree, under);
                sort_in(slot, child, [&mut at_nodes, &mut at_leaves], [&mut nodes, &mut leaves]);
            }
            if nodes > FLIGHT / 2 {
                continue;
            }
            let count = leaves;
            leaves = 0;
            for k in 0..count {
                let slot = at_leaves[k & (FLIGHT - 1)];
                let under = flight.add(slot.into());
                let mut child = *(*under).children.as_ptr().cast::<Child>().add((*under).waiting - 1);
                let mut over = child == END;
                if !over {
                    (*under).waiting -= 1;
                    over = !leaf::<L, W>(tree, child, under);
                    child = *(*under).children.as_ptr().cast::<Child>().add((*under).waiting - 1);
                }
                if over {
                    answer((*under).index, &(*under).best);
                    if !begin(tree, near, rays, &mut next, slow, under) {
                        continue;
                    }
                    child = tree.root;
                }
                ask_for(tree, child);
                sort_in(slot, child, [&mut at_nodes, &mut at_leaves], [&mut nodes, &mut leaves]);
            }
        }
    }
}

/// Appends a slot to the list of those at nodes or of those at leaves.
#[inline(always)]
fn sort_in(
    slot: u8,
    child: Child,
    [at_nodes, at_leaves]: [&mut [u8; FLIGHT]; 2],
    [nodes, leaves]: [&mut usize; 2],
) {
    let is_leaf = usize::from(child.is_leaf());
    at_nodes[*nodes & (FLIGHT - 1)] = slot;
    *nodes += 1 - is_leaf;
    at_leaves[*leaves & (FLIGHT - 1)] = slot;
    *leaves += is_leaf;
}

/// Begins with the next ray; no if there is none.
///
/// # Safety
/// - The slot may be written.
#[inline(always)]
unsafe fn begin(
    tree: &Tree<'_>,
    near: &Near,
    rays: &[Ray],
    next: &mut usize,
    slow: &mut dyn FnMut(usize),
    slot: *mut Under,
) -> bool {
    while let Some(ray) = rays.get(*next) {
        let index = *next;
        *next += 1;
        let Some(ready) = SingleRay::new(ray, near) else {
            slow(index);
            continue;
        };
        // SAFETY: the caller's promise; a stack has more than two places.
        unsafe {
            (*slot).ray = ready;
            (*slot).best = None;
            (*slot).index = index;
            (*slot).waiting = 2;
            (*slot).children[0] = MaybeUninit::new(END);
            (*slot).children[1] = MaybeUninit::new(tree.root);
            (*slot).entries[0] = MaybeUninit::new(f32::NEG_INFINITY);
            (*slot).entries[1] = MaybeUninit::new(f32::NEG_INFINITY);
        }
        return true;
    }
    false
}

/// Tests the boxes of the node that a ray is at, and says what comes next.
///
/// # Safety
/// - As for [`stream`].
#[inline(always)]
unsafe fn step<L: Lanes, W: Word>(tree: &Tree<'_>, under: *mut Under) -> Child {
    // SAFETY: the caller's promise.
    unsafe {
        let waiting = (*under).waiting - 1;
        let children = (&raw mut (*under).children).cast::<Child>();
        let node = tree.nodes.as_ptr().add((*children.add(waiting)).index());
        let ray = &(*under).ray;
        let (near, far) = Slabs::<L>::new(ray).entries(node, L::splat(ray.t_max));
        let what: *const Child = (&raw const (*node).child).cast();
        let to = children.add(waiting);
        let pushed = if W::ORDERED {
            let order = (*node).order[(ray.octant & 7) as usize];
            let entries = (&raw mut (*under).entries).cast::<f32>();
            near.push(far, order, what, to, entries.add(waiting))
        } else {
            near.push_unordered(far, what, to)
        };
        let waiting = waiting + pushed.count_ones() as usize;
        (*under).waiting = waiting;
        let next = *children.add(waiting - 1);
        ask_for(tree, next);
        next
    }
}

/// Tests the triangles of a leaf; no if the search is over.
///
/// # Safety
/// - As for [`stream`].
#[inline(always)]
unsafe fn leaf<L: Lanes, W: Word + Default>(tree: &Tree<'_>, child: Child, under: *mut Under) -> bool {
    // SAFETY: the caller's promise.
    unsafe {
        let mut word = W::default();
        let ray = &mut (*under).ray;
        let mut search = Search {
            word: &mut word,
            rule: EdgeRule::Closed,
            t_min: ray.t_min.into(),
            t_max: ray.t_max.into(),
            best: (*under).best,
        };
        let quad = tree.quads.as_ptr().add(child.quad()).cast::<f32>();
        let triangles = Triangles::<L>::new(ray);
        let goes_on = triangles.test(quad, child.places(), &ray.watertight, &mut search, &mut ());
        let t_max = search.t_max as f32;
        if t_max < ray.t_max || search.best.is_some() != (*under).best.is_some() {
            ray.t_max = t_max;
            let children = (&raw mut (*under).children).cast::<Child>();
            let entries = (&raw mut (*under).entries).cast::<f32>();
            (*under).waiting = L::keep(children, entries, (*under).waiting, t_max);
        }
        (*under).best = search.best;
        goes_on
    }
}

/// Asks memory for what comes next.
#[inline(always)]
fn ask_for(tree: &Tree<'_>, child: Child) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // Addresses of what is not there do no harm.
        let quads = tree.quads.as_ptr().cast::<i8>();
        let nodes = tree.nodes.as_ptr().cast::<i8>();
        let at = if child.is_leaf() {
            quads.wrapping_add(child.quad() * 160)
        } else {
            nodes.wrapping_add(child.index() * 256)
        };
        for line in 0..4 {
            // SAFETY: a prefetch reads nothing that a program can see.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(64 * line)) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (tree, child);
}

const _: () = assert!(FLIGHT.is_power_of_two() && FLIGHT <= 256 && WIDTH == 8);
const _: () = assert!(matches!(AnyHit::Accept, AnyHit::Accept));
