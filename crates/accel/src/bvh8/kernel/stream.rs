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

use ombra_geometry::Ray;

use super::super::node::Child;
use super::layout::{Layout, Leaf as _};
use super::level::{Lanes, WideLanes as _};
use super::prefetch::prefetch;
use super::ray::{Near, SingleRay};
use super::walk::{Found, STACK, Sheared, Slabs, Tree, Word, shear};

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
    children: *mut Child,
    entries: *mut f32,
    /// Of the leaf that it is at: what is left to be tested or taken in, a bit each.
    left: u32,
    /// The numbers of its triangles.
    numbers: *const f32,
    /// Its sheared corners, then the t, u and v of its hits.
    sheared: [MaybeUninit<[f32; 8]>; 9],
}

/// Walks with each of the chosen rays, and tells the answers by the numbers of the rays, in no
/// promised order. `slow` is told which rays are not for the kernels.
///
/// # Safety
/// - As for [`walk`](super::walk::walk).
#[inline(always)]
pub(crate) unsafe fn stream<L: Lanes, Y: Layout, W: Word + Default>(
    tree: &Tree<Y>,
    near: &Near,
    rays: &[Ray],
    chosen: &[u16],
    mut answer: impl FnMut(usize, Found),
    slow: &mut dyn FnMut(usize),
) {
    let mut flight = [const { MaybeUninit::<Under>::uninit() }; FLIGHT];
    let flight = flight.as_mut_ptr().cast::<Under>();
    // Stacks lie as near to one another as this tree allows, so that they stay in the nearest cache.
    let mut children = [const { MaybeUninit::<Child>::uninit() }; FLIGHT * STACK];
    let mut entries = [const { MaybeUninit::<f32>::uninit() }; FLIGHT * STACK];
    let stack = tree.stack.min(STACK);
    let mut chosen = chosen.iter();
    // The slots whose rays are at nodes, at leaves, at their end, and the free ones: a bit each.
    let (mut at_nodes, mut at_leaves, mut over) = (0_u32, 0_u32, 0_u32);
    let mut free = ALL;
    // SAFETY: bits are of slots that were written; stacks stay below their size as in `walk`.
    unsafe {
        for slot in 0..FLIGHT {
            let under = flight.add(slot);
            (*under).children = children.as_mut_ptr().cast::<Child>().add(slot * stack);
            (*under).entries = entries.as_mut_ptr().cast::<f32>().add(slot * stack);
        }
        loop {
            while free != 0 {
                let slot = free.trailing_zeros();
                let begun = begin(
                    tree,
                    near,
                    rays,
                    &mut chosen,
                    slow,
                    flight.add(slot as usize),
                );
                if !begun {
                    break;
                }
                free &= free - 1;
                let is_leaf = tree.root.0 >> 31;
                at_leaves |= is_leaf << slot;
                at_nodes |= (1 - is_leaf) << slot;
            }
            if free == ALL {
                return;
            }
            // Until few are at nodes, so that those at leaves are many.
            while at_nodes.count_ones() as usize > FLIGHT / 4 || (at_leaves | over == 0) {
                let mut turn = at_nodes;
                at_nodes = 0;
                while turn != 0 {
                    let slot = turn.trailing_zeros();
                    turn &= turn - 1;
                    let child = step::<L, Y, W>(tree, flight.add(slot as usize));
                    sort_in(child, slot, [&mut at_nodes, &mut at_leaves, &mut over]);
                }
            }
            let (leaves, mut left, mut hit) = (at_leaves, 0, 0);
            let mut turn = leaves;
            while turn != 0 {
                let slot = turn.trailing_zeros();
                turn &= turn - 1;
                let some = first_half::<L, Y>(tree, flight.add(slot as usize));
                left |= u32::from(some) << slot;
            }
            while left != 0 {
                let slot = left.trailing_zeros();
                left &= left - 1;
                let some = second_half::<L>(flight.add(slot as usize));
                hit |= u32::from(some) << slot;
            }
            let mut turn = hit;
            while turn != 0 {
                let slot = turn.trailing_zeros();
                turn &= turn - 1;
                take_in::<L, W>(flight.add(slot as usize));
            }
            at_leaves = 0;
            // Without an order one hit is enough.
            let enough = if W::ORDERED { 0 } else { hit };
            over |= enough;
            let mut turn = leaves & !enough;
            while turn != 0 {
                let slot = turn.trailing_zeros();
                turn &= turn - 1;
                let child = top(flight.add(slot as usize));
                ask_for(tree, child);
                sort_in(child, slot, [&mut at_nodes, &mut at_leaves, &mut over]);
            }
            free |= over;
            while over != 0 {
                let slot = over.trailing_zeros();
                over &= over - 1;
                let under = flight.add(slot as usize);
                answer((*under).index, (*under).best);
            }
        }
    }
}

/// Every slot.
const ALL: u32 = (1_u64 << FLIGHT).wrapping_sub(1) as u32;

/// Sets the bit of a slot by what comes next, without a branch.
#[inline(always)]
fn sort_in(child: Child, slot: u32, [at_nodes, at_leaves, over]: [&mut u32; 3]) {
    let is_end = u32::from(child == END);
    let is_leaf = child.0 >> 31;
    *over |= is_end << slot;
    *at_leaves |= (is_leaf - is_end) << slot;
    *at_nodes |= (1 - is_leaf) << slot;
}

/// What comes next.
///
/// # Safety
/// - The slot was written.
#[inline(always)]
unsafe fn top(under: *const Under) -> Child {
    // SAFETY: the caller's promise; the end at least waits.
    unsafe { *(*under).children.add((*under).waiting - 1) }
}

/// Begins with the next ray; no if there is none.
///
/// # Safety
/// - The slot may be written.
#[inline(always)]
unsafe fn begin<Y>(
    tree: &Tree<Y>,
    near: &Near,
    rays: &[Ray],
    chosen: &mut std::slice::Iter<'_, u16>,
    slow: &mut dyn FnMut(usize),
    slot: *mut Under,
) -> bool {
    for &number in chosen {
        let index = usize::from(number);
        let Some(ready) = SingleRay::new(&rays[index], near) else {
            slow(index);
            continue;
        };
        // SAFETY: the caller's promise; a stack has more than two places.
        unsafe {
            (*slot).ray = ready;
            (*slot).best = Found::NONE;
            (*slot).index = index;
            (*slot).waiting = 2;
            *(*slot).children = END;
            *(*slot).children.add(1) = tree.root;
            *(*slot).entries = f32::NEG_INFINITY;
            *(*slot).entries.add(1) = f32::NEG_INFINITY;
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
unsafe fn step<L: Lanes, Y: Layout, W: Word>(tree: &Tree<Y>, under: *mut Under) -> Child {
    // SAFETY: the caller's promise.
    unsafe {
        let waiting = (*under).waiting - 1;
        let children = (*under).children;
        let to = children.add(waiting);
        let node = tree.layout.node(*to);
        let ray = &(*under).ray;
        let (near, far) = Slabs::<L>::new(&ray.boxes).entries::<Y>(node, L::splat(ray.t_max));
        let what = Y::children(node);
        let pushed = if W::ORDERED {
            let order = Y::order(node, ray.boxes.octant);
            near.push(far, order, what, to, (*under).entries.add(waiting))
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

/// The first half of the test of the triangles of the leaf that a ray is at; whether any is left.
///
/// # Safety
/// - As for [`stream`].
#[inline(always)]
unsafe fn first_half<L: Lanes, Y: Layout>(tree: &Tree<Y>, under: *mut Under) -> bool {
    // SAFETY: the caller's promise.
    unsafe {
        (*under).waiting -= 1;
        let child = *(*under).children.add((*under).waiting);
        let leaf = tree.layout.leaf(child);
        let Sheared { a, b, c, left } = shear::<L, _>(leaf, &(*under).ray);
        let sheared = (&raw mut (*under).sheared).cast::<f32>();
        a[0].store(sheared);
        a[1].store(sheared.add(8));
        a[2].store(sheared.add(16));
        b[0].store(sheared.add(24));
        b[1].store(sheared.add(32));
        b[2].store(sheared.add(40));
        c[0].store(sheared.add(48));
        c[1].store(sheared.add(56));
        c[2].store(sheared.add(64));
        (*under).left = left;
        (*under).numbers = leaf.numbers();
        left != 0
    }
}

/// The second half, for all that is left at once; whether there is a hit.
///
/// # Safety
/// - After [`first_half`].
#[inline(always)]
unsafe fn second_half<L: Lanes>(under: *mut Under) -> bool {
    // SAFETY: the caller's promise.
    unsafe {
        let sheared = (&raw const (*under).sheared).cast::<f32>();
        let wide = |k: usize| sheared.add(8 * k);
        let (ax, ay, az) = (
            widened::<L>(wide(0)),
            widened::<L>(wide(1)),
            widened::<L>(wide(2)),
        );
        let (bx, by, bz) = (
            widened::<L>(wide(3)),
            widened::<L>(wide(4)),
            widened::<L>(wide(5)),
        );
        let (cx, cy, cz) = (
            widened::<L>(wide(6)),
            widened::<L>(wide(7)),
            widened::<L>(wide(8)),
        );
        let u = cx.times(by).minus(cy.times(bx));
        let v = ax.times(cy).minus(ay.times(cx));
        let w = bx.times(ay).minus(by.times(ax));
        let zero = L::Wide::splat(0.0);
        let least = u.smaller(v).smaller(w);
        let most = u.larger(v).larger(w);
        let outside = least.below(zero) & zero.below(most);
        let det = u.plus(v).plus(w);
        let flat = !(det.below(zero) | zero.below(det));
        let inverse = L::Wide::splat(1.0).over(det);
        let (u, v, w) = (u.times(inverse), v.times(inverse), w.times(inverse));
        let z = u.times(az).plus(v.times(bz)).plus(w.times(cz));
        let per_z = L::Wide::splat((*under).ray.watertight.shear().z.into());
        let t = z.times(per_z).rounded();
        let (t_min, t_max) = (
            L::splat((*under).ray.boxes.t_min),
            L::splat((*under).ray.t_max),
        );
        let in_range = t_min.at_most(t) & t.at_most(t_max) & t.at_most(L::splat(f32::MAX));
        let hits = (*under).left & !outside & !flat & in_range;
        (*under).left = hits;
        let found = (&raw mut (*under).sheared).cast::<f32>();
        t.store(found);
        v.rounded().store(found.add(8));
        w.rounded().store(found.add(16));
        hits != 0
    }
}

/// Eight singles in double precision.
///
/// # Safety
/// - They may be read.
#[inline(always)]
unsafe fn widened<L: Lanes>(from: *const f32) -> L::Wide {
    // SAFETY: the caller's promise.
    unsafe { L::Wide::of(L::load(from)) }
}

/// Makes the best of the hits of a leaf the best of the ray, and drops what waits beyond it.
///
/// # Safety
/// - After [`second_half`] said yes.
#[inline(always)]
unsafe fn take_in<L: Lanes, W: Word>(under: *mut Under) {
    // SAFETY: the caller's promise.
    unsafe {
        let found = (&raw const (*under).sheared).cast::<f32>();
        let mut left = (*under).left;
        while left != 0 {
            let k = left.trailing_zeros() as usize;
            left &= left - 1;
            let (t, triangle) = (*found.add(k), (*(*under).numbers.add(k)).to_bits());
            let best = &mut (*under).best;
            // At the same t the smaller number comes first.
            if t < best.t || (t == best.t && triangle < best.triangle) {
                let (u, v) = (*found.add(8 + k), *found.add(16 + k));
                *best = Found { t, u, v, triangle };
            }
        }
        if W::ORDERED {
            (*under).ray.t_max = (*under).best.t;
            let (children, entries) = ((*under).children, (*under).entries);
            (*under).waiting = L::keep(children, entries, (*under).waiting, (*under).best.t);
        }
    }
}

/// Asks memory for what comes next.
#[inline(always)]
fn ask_for<Y: Layout>(tree: &Tree<Y>, child: Child) {
    // Addresses of what is not there do no harm.
    let at = tree.layout.begin(child).cast::<u8>();
    for line in 0..Y::LINES {
        prefetch(at.wrapping_add(64 * line));
    }
}

const _: () = assert!(FLIGHT <= 32);
