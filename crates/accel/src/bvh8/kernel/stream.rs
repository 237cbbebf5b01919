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

use super::super::node::Child;
use super::level::Lanes;
use super::ray::{Near, SingleRay};
use super::walk::{After, Found, STACK, Slabs, Tree, Word, leaf};

/// How many rays are under way.
const FLIGHT: usize = 16;

/// What lies below all that waits: the end.
const END: Child = Child(u32::MAX);

/// A ray under way.
struct Under {
    ray: SingleRay,
    best: Found,
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
    mut answer: impl FnMut(usize, Found),
    slow: &mut dyn FnMut(usize),
) {
    let mut flight = [const { MaybeUninit::<Under>::uninit() }; FLIGHT];
    let flight = flight.as_mut_ptr().cast::<Under>();
    let mut next = 0;
    // The slots whose rays are at nodes and those whose rays are at leaves or the end, a bit each.
    let (mut at_nodes, mut at_leaves) = (0_u32, 0_u32);
    // SAFETY: bits are of slots that were written; stacks stay below their size as in `walk`.
    unsafe {
        for slot in 0..FLIGHT {
            if !begin(tree, near, rays, &mut next, slow, flight.add(slot)) {
                break;
            }
            // Whether it is a leaf shows when it is taken.
            at_leaves |= 1 << slot;
        }
        while at_nodes | at_leaves != 0 {
            let mut turn = at_nodes;
            while turn != 0 {
                let slot = turn.trailing_zeros();
                turn &= turn - 1;
                let child = step::<L, W>(tree, flight.add(slot as usize));
                at_leaves |= (child.0 >> 31) << slot;
            }
            at_nodes &= !at_leaves;
            if at_nodes.count_ones() as usize > FLIGHT / 2 {
                continue;
            }
            let mut turn = at_leaves;
            at_leaves = 0;
            while turn != 0 {
                let slot = turn.trailing_zeros();
                turn &= turn - 1;
                let under = flight.add(slot as usize);
                let mut child = top(under);
                if child.is_leaf() {
                    let mut over = child == END;
                    if !over {
                        (*under).waiting -= 1;
                        over = test::<L, W>(tree, child, under) == After::Over;
                        child = top(under);
                    }
                    if over {
                        answer((*under).index, (*under).best);
                        if !begin(tree, near, rays, &mut next, slow, under) {
                            continue;
                        }
                        child = tree.root;
                    }
                    ask_for(tree, child);
                }
                let is_leaf = child.0 >> 31;
                at_leaves |= is_leaf << slot;
                at_nodes |= (1 - is_leaf) << slot;
            }
        }
    }
}

/// What comes next.
///
/// # Safety
/// - The slot was written.
#[inline(always)]
unsafe fn top(under: *const Under) -> Child {
    // SAFETY: the caller's promise; the end at least waits.
    unsafe {
        let children = (&raw const (*under).children).cast::<Child>();
        *children.add((*under).waiting - 1)
    }
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
            (*slot).best = Found::NONE;
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
        let to = children.add(waiting);
        let node = tree.node(*to);
        let ray = &(*under).ray;
        let (near, far) = Slabs::<L>::new(ray).entries(node, L::splat(ray.t_max));
        let what: *const Child = (&raw const (*node).child).cast();
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

/// Tests the triangles of a leaf.
///
/// # Safety
/// - As for [`stream`].
#[inline(always)]
unsafe fn test<L: Lanes, W: Word + Default>(
    tree: &Tree<'_>,
    child: Child,
    under: *mut Under,
) -> After {
    // SAFETY: the caller's promise.
    unsafe {
        let ray = &mut (*under).ray;
        let best = &mut (*under).best;
        let (from, places) = (tree.leaf(child), child.places());
        let word = &mut W::default();
        let after = leaf::<L, W, ()>(from, places, ray, best, EdgeRule::Closed, word, &mut ());
        if after == After::Hit {
            let children = (&raw mut (*under).children).cast::<Child>();
            let entries = (&raw mut (*under).entries).cast::<f32>();
            (*under).waiting = L::keep(children, entries, (*under).waiting, ray.t_max);
        }
        after
    }
}

/// Asks memory for what comes next.
#[inline(always)]
fn ask_for(tree: &Tree<'_>, child: Child) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let (nodes, quads) = (tree.nodes.as_ptr().cast::<i8>(), tree.quads.as_ptr().cast());
        let at = if child.is_leaf() { quads } else { nodes };
        // Addresses of what is not there do no harm.
        let at = at.wrapping_add(child.offset());
        for line in 0..4 {
            // SAFETY: a prefetch reads nothing that a program can see.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(64 * line)) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (tree, child);
}

const _: () = assert!(FLIGHT <= 32);
