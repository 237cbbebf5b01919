//! The walk of many rays at once, for rays that go much the same way.
//!
//! Thirty-two rays go down the tree together:
//!
//! ```text
//! while something waits:
//!     take the nearest; leave it if no ray of the packet meets its box
//!     a node: test the boxes of its eight children against the whole packet at once, push those that
//!         some ray may enter
//!     a leaf: find which rays meet its box, eight at a time; test its triangles one by one, each
//!         against eight rays at a time
//! ```
//!
//! A box is tested against the whole packet by interval arithmetic: of origins and of reciprocals of
//! directions only the least and the largest are kept, which says where the first ray of the packet may
//! enter a box and where the last one may leave it. Boulos, Wald, Shirley, "Geometric and Arithmetic
//! Culling Methods for Entire Ray Packets", 2006; Reshetov, Soupikov, Hurley, "Multi-Level Ray Tracing
//! Algorithm", 2005. That is sharp as long as the rays have much in common; [`Packet::ready`] decides
//! whether they have, so nobody has to declare it.
//!
//! Triangles are tested as in `walk`: the first half to the bit as the scalar test, the second half as
//! its second half. So each ray gets the answer that it would get alone.

use std::mem::MaybeUninit;

use ombra_geometry::triangle::{TriangleKernel as _, Watertight};
use ombra_geometry::{Ray, Vector3};

use super::super::node::{Child, WIDTH};
use super::layout::{Layout, Leaf};
use super::level::{Lanes, WideLanes as _};
use super::ray::{LEAST, Near, PAD, PAD_AT};
use super::walk::{Found, STACK, Tree, Word, edge};

/// How many rays go together.
pub(super) const PACKET: usize = 32;
/// Rays that are tested at once.
const GROUP: usize = 8;
const GROUPS: usize = PACKET / GROUP;

/// Rays whose directions, scaled to a largest component of 1, differ by more than this in some
/// component do not go together.
const WIDTH_OF_DIRECTIONS: f32 = 0.6;
/// Nor do those whose origins differ by more than this part of the extent of the structure.
const WIDTH_OF_ORIGINS: f32 = 0.2;

/// Numbers of all rays.
type Each = [f32; PACKET];

/// Rays that go together, component by component.
#[repr(align(64))]
pub(super) struct Packet {
    /// By the axes of space.
    inverse: [Each; 3],
    near: [Each; 3],
    far: [Each; 3],
    t_min: Each,
    t_max: Each,
    /// By the axes that take the places of x, y and z where the rays are the z axis.
    origin: [Each; 3],
    shear: [Each; 3],
    u: Each,
    v: Each,
    /// As bits.
    triangle: Each,
    axes: [usize; 3],
    /// Whether all origins are one.
    one_origin: bool,
    octant: u32,
    /// Of the packet: what is taken from planes on the side where rays enter boxes and on the other;
    /// the least and the largest reciprocal.
    enter_from: [f32; 3],
    leave_from: [f32; 3],
    least: [f32; 3],
    most: [f32; 3],
    /// The least of all.
    first: f32,
}

/// Whether four of the chosen rays go much the same way: if not there is no need to look at the
/// others.
#[inline(always)]
pub(super) fn may_go_together(rays: &[Ray], chosen: &[u16; PACKET], near: &Near) -> bool {
    let ray = |k: usize| &rays[usize::from(chosen[k])];
    let widest = WIDTH_OF_ORIGINS * 2.0 * near.half;
    let way = |ray: &Ray| ray.direction * (1.0 / ray.direction.max_norm());
    let first = ray(0);
    [PACKET / 3, 2 * PACKET / 3, PACKET - 1]
        .into_iter()
        .all(|k| {
            let other = ray(k);
            let turned = way(other) - way(first);
            let moved = other.origin - first.origin;
            (turned.max_norm() <= WIDTH_OF_DIRECTIONS) & (moved.max_norm() <= widest)
        })
}

/// Bit k: the direction's component k is negative.
#[inline(always)]
pub(super) fn octant(ray: &Ray) -> u32 {
    let Vector3 { x, y, z } = ray.direction;
    x.to_bits() >> 31 | y.to_bits() >> 31 << 1 | z.to_bits() >> 31 << 2
}

impl Packet {
    /// Makes the chosen rays, which are of one octant and along one axis, ready in `packet`; no if
    /// they are not to be traced together.
    ///
    /// # Safety
    /// - The processor has the instructions of `L`.
    /// - `packet` may be written.
    #[inline(always)]
    unsafe fn ready<L: Lanes>(
        packet: *mut Self,
        rays: &[Ray],
        chosen: &[u16; PACKET],
        near: &Near,
    ) -> bool {
        let one = &rays[usize::from(chosen[0])];
        let octant = octant(one);
        let [x, y, z] = Watertight::new(one).axes();
        let axes = [x as usize, y as usize, z as usize];
        // SAFETY: the caller's promise; every number is written before it is read.
        unsafe {
            let packet = &mut *packet;
            packet.axes = axes;
            packet.octant = octant;
            let mut direction = [[0.0; PACKET]; 3];
            for (k, &number) in chosen.iter().enumerate() {
                let ray = &rays[usize::from(number)];
                let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
                for axis in 0..3 {
                    packet.origin[axis][k] = o[axes[axis]];
                    direction[axis][k] = d[axes[axis]];
                }
                packet.t_min[k] = ray.t_min;
                packet.t_max[k] = ray.t_max;
            }
            // From here on by the axes where the rays are the z axis, until boxes are met.
            let (zero, one) = (L::splat(0.0), L::splat(1.0));
            let mut origins = [[L::splat(f32::INFINITY); 2]; 3];
            let mut ways = [[L::splat(f32::INFINITY); 2]; 3];
            let (mut fits, mut first) = (255, L::splat(f32::INFINITY));
            for from in (0..PACKET).step_by(GROUP) {
                let d = [
                    L::load(direction[0].as_ptr().add(from)),
                    L::load(direction[1].as_ptr().add(from)),
                    L::load(direction[2].as_ptr().add(from)),
                ];
                let size = [
                    d[0].larger(zero.minus(d[0])),
                    d[1].larger(zero.minus(d[1])),
                    d[2].larger(zero.minus(d[2])),
                ];
                // The same axis is the dominant one, and sizes are those of plain rays.
                fits &= size[0].at_most(size[2]) & size[1].at_most(size[2]);
                fits &= L::splat(1e-10).at_most(size[2]) & size[2].at_most(L::splat(1e10));
                let (from_t, to_t) = (
                    L::load(packet.t_min.as_ptr().add(from)),
                    L::load(packet.t_max.as_ptr().add(from)),
                );
                fits &= from_t.at_most(to_t);
                first = first.smaller(from_t);
                for axis in 0..3 {
                    let o = L::load(packet.origin[axis].as_ptr().add(from));
                    let [low, high] = origins[axis];
                    origins[axis] = [low.smaller(o), high.smaller(zero.minus(o))];
                    fits &= o.at_most(L::splat(f32::MAX));
                    let way = d[axis].over(size[2]);
                    let [low, high] = ways[axis];
                    ways[axis] = [low.smaller(way), high.smaller(zero.minus(way))];
                }
                d[0].over(d[2])
                    .store(packet.shear[0].as_mut_ptr().add(from));
                d[1].over(d[2])
                    .store(packet.shear[1].as_mut_ptr().add(from));
                one.over(d[2]).store(packet.shear[2].as_mut_ptr().add(from));
            }
            if fits != 255 {
                return false;
            }
            let (mut away, mut at) = (0.0_f32, 0.0_f32);
            let (mut wide, mut turned) = (0.0_f32, 0.0_f32);
            let mut between = [[0.0; 2]; 3];
            for axis in 0..3 {
                let [low, high] = origins[axis];
                let (low, high) = (least::<L>(low), -least::<L>(high));
                let centre = near.centre[axes[axis]];
                away = away.max((low - centre).abs()).max((high - centre).abs());
                at = at.max(low.abs()).max(high.abs());
                wide = wide.max(high - low);
                let [slow, fast] = ways[axis];
                turned = turned.max(-least::<L>(fast) - least::<L>(slow));
                between[axis] = [low, high];
            }
            let together = (away <= near.limit)
                & (wide <= WIDTH_OF_ORIGINS * 2.0 * near.half)
                & (turned <= WIDTH_OF_DIRECTIONS);
            if !together {
                return false;
            }
            packet.first = least::<L>(first);
            let pad = PAD * (away + near.half) + PAD_AT * at + f32::MIN_POSITIVE;
            for axis in 0..3 {
                let space = axes[axis];
                let backward = octant >> space & 1 == 1;
                let signed = if backward { -pad } else { pad };
                let sign = L::splat(if backward { -1.0 } else { 1.0 });
                let (mut slow, mut fast) = (L::splat(f32::INFINITY), L::splat(f32::INFINITY));
                for from in (0..PACKET).step_by(GROUP) {
                    let d = L::load(direction[axis].as_ptr().add(from));
                    let major = L::load(direction[2].as_ptr().add(from));
                    let smallest = major.larger(zero.minus(major)).times(L::splat(LEAST));
                    let size = d.larger(zero.minus(d)).larger(smallest);
                    let inverse = sign.over(size);
                    let o = L::load(packet.origin[axis].as_ptr().add(from));
                    inverse.store(packet.inverse[space].as_mut_ptr().add(from));
                    let near = zero.minus(o.minus(L::splat(-signed))).times(inverse);
                    near.store(packet.near[space].as_mut_ptr().add(from));
                    let far = zero.minus(o.minus(L::splat(signed))).times(inverse);
                    far.store(packet.far[space].as_mut_ptr().add(from));
                    slow = slow.smaller(inverse);
                    fast = fast.smaller(zero.minus(inverse));
                }
                packet.least[space] = least::<L>(slow);
                packet.most[space] = -least::<L>(fast);
                let [low, high] = between[axis];
                let (enter, leave) = if backward { (low, high) } else { (high, low) };
                packet.enter_from[space] = enter + signed;
                packet.leave_from[space] = leave - signed;
            }
            packet.one_origin = wide == 0.0;
            packet.triangle = [f32::from_bits(u32::MAX); PACKET];
        }
        true
    }

    /// Where the last ray still wants to know of hits.
    ///
    /// # Safety
    /// - The processor has the instructions of `L`.
    #[inline(always)]
    unsafe fn last<L: Lanes>(&self) -> f32 {
        // SAFETY: the caller's promise.
        unsafe {
            let mut last = L::splat(f32::INFINITY);
            for from in (0..PACKET).step_by(GROUP) {
                last = last.smaller(L::splat(0.0).minus(L::load(self.t_max.as_ptr().add(from))));
            }
            -least::<L>(last)
        }
    }
}

/// The least of eight numbers.
///
/// # Safety
/// - The processor has the instructions of `L`.
#[inline(always)]
unsafe fn least<L: Lanes>(of: L) -> f32 {
    let mut all = [0.0_f32; 8];
    // SAFETY: the caller's promise.
    unsafe { of.store(all.as_mut_ptr()) };
    let smaller = |a: f32, b: f32| if a < b { a } else { b };
    let [a, b, c, d, e, f, g, h] = all;
    smaller(
        smaller(smaller(a, b), smaller(c, d)),
        smaller(smaller(e, f), smaller(g, h)),
    )
}

/// The test of eight boxes against the whole packet.
struct Beam<L> {
    enter_from: [L; 3],
    leave_from: [L; 3],
    least: [L; 3],
    most: [L; 3],
    first: L,
    enter: [usize; 3],
}

impl<L: Lanes> Beam<L> {
    /// # Safety
    /// - The processor has the instructions of `L`.
    #[inline(always)]
    unsafe fn new(packet: &Packet) -> Self {
        let octant = packet.octant as usize;
        // SAFETY: the caller's promise.
        unsafe {
            Self {
                enter_from: splat(packet.enter_from),
                leave_from: splat(packet.leave_from),
                least: splat(packet.least),
                most: splat(packet.most),
                first: L::splat(packet.first),
                enter: [
                    3 * (octant & 1) * WIDTH,
                    (1 + 3 * (octant >> 1 & 1)) * WIDTH,
                    (2 + 3 * (octant >> 2 & 1)) * WIDTH,
                ],
            }
        }
    }

    /// Where the first ray may enter each box and the last one may leave it.
    ///
    /// # Safety
    /// - The node may be read.
    #[inline(always)]
    unsafe fn entries<Y: Layout>(&self, node: *const Y::Node, last: f32) -> (L, L) {
        // SAFETY: the caller's promise.
        unsafe {
            let (mut near, mut far) = (self.first, L::splat(last));
            for k in 0..3 {
                let (enter, leave) = (self.enter[k], (3 + 2 * k) * WIDTH - self.enter[k]);
                let way = Y::planes::<L>(node, enter, k).minus(self.enter_from[k]);
                near = near.larger(way.times(self.least[k]).smaller(way.times(self.most[k])));
                let way = Y::planes::<L>(node, leave, k).minus(self.leave_from[k]);
                far = far.smaller(way.times(self.least[k]).larger(way.times(self.most[k])));
            }
            (near, far)
        }
    }
}

/// Three numbers, each eight times.
///
/// # Safety
/// - The processor has the instructions of `L`.
#[inline(always)]
unsafe fn splat<L: Lanes>([x, y, z]: [f32; 3]) -> [L; 3] {
    // SAFETY: the caller's promise.
    unsafe { [L::splat(x), L::splat(y), L::splat(z)] }
}

/// One box, to be met by rays eight at a time.
struct Slab<L> {
    enter: [L; 3],
    leave: [L; 3],
}

impl<L: Lanes> Slab<L> {
    /// The box of a child of a node.
    ///
    /// # Safety
    /// - The node may be read.
    #[inline(always)]
    unsafe fn new<Y: Layout>(node: *const Y::Node, slot: usize, enter: &[usize; 3]) -> Self {
        // SAFETY: the caller's promise.
        unsafe {
            let mut slab = Self {
                enter: [L::splat(0.0); 3],
                leave: [L::splat(0.0); 3],
            };
            for (k, &enter) in enter.iter().enumerate() {
                let leave = (3 + 2 * k) * WIDTH - enter;
                slab.enter[k] = L::splat(Y::plane(node, enter + slot, k));
                slab.leave[k] = L::splat(Y::plane(node, leave + slot, k));
            }
            slab
        }
    }

    /// Which rays of a group enter.
    ///
    /// # Safety
    /// - `from` is that of a group.
    #[inline(always)]
    unsafe fn entered(&self, packet: &Packet, from: usize) -> u32 {
        // SAFETY: the caller's promise.
        unsafe {
            let mut near = L::load(packet.t_min.as_ptr().add(from));
            let mut far = L::load(packet.t_max.as_ptr().add(from));
            for k in 0..3 {
                let inverse = L::load(packet.inverse[k].as_ptr().add(from));
                let offset = L::load(packet.near[k].as_ptr().add(from));
                near = self.enter[k].multiply_add(inverse, offset).larger(near);
                let offset = L::load(packet.far[k].as_ptr().add(from));
                far = self.leave[k].multiply_add(inverse, offset).smaller(far);
            }
            near.at_most(far)
        }
    }
}

/// Walks down the tree with some of the rays, which are of one octant and along one axis, and tells
/// the answers by their numbers; no, and nothing done, if they do not go the same way.
///
/// # Safety
/// - As for [`walk`](super::walk::walk).
#[inline(always)]
pub(super) unsafe fn packet<L: Lanes, Y: Layout, W: Word>(
    tree: &Tree<Y>,
    near: &Near,
    rays: &[Ray],
    chosen: &[u16; PACKET],
    mut answer: impl FnMut(usize, Found),
) -> bool {
    let mut packet = MaybeUninit::<Packet>::uninit();
    let mut children = [const { MaybeUninit::<Child>::uninit() }; STACK];
    let mut entries = [const { MaybeUninit::<f32>::uninit() }; STACK];
    let children = children.as_mut_ptr().cast::<Child>();
    let entries = entries.as_mut_ptr().cast::<f32>();
    // SAFETY: as in `walk`. What waits are numbers of places in nodes (see `place`), written before
    // they are read.
    unsafe {
        // At a root that is a leaf there is nothing to be saved.
        if tree.root.is_leaf() || !Packet::ready::<L>(packet.as_mut_ptr(), rays, chosen, near) {
            return false;
        }
        let packet = packet.assume_init_mut();
        let beam = Beam::<L>::new(packet);
        let mut last = packet.last::<L>();
        let mut waiting = 0;
        let mut node = tree.layout.node(tree.root);
        let mut offset = tree.root.0;
        'search: loop {
            let (near, far) = beam.entries::<Y>(node, last);
            // A node's number is a multiple of eight: the places of its children are numbered within.
            let mut places = [offset; WIDTH];
            for (k, place) in places.iter_mut().enumerate() {
                *place |= k as u32;
            }
            let order = Y::order(node, packet.octant);
            let to = children.add(waiting);
            let pushed = near.push(far, order, places.as_ptr().cast(), to, entries.add(waiting));
            waiting += pushed.count_ones() as usize;
            loop {
                if waiting == 0 {
                    break 'search;
                }
                waiting -= 1;
                if *entries.add(waiting) > last {
                    continue;
                }
                let place = (*children.add(waiting)).0;
                let parent = tree.layout.node(Child(place & !7));
                let slot = (place & 7) as usize;
                let child = *Y::children(parent).add(slot);
                let slab = Slab::<L>::new::<Y>(parent, slot, &beam.enter);
                if child.is_leaf() {
                    let triangles = tree.layout.leaf(child);
                    let hit = if packet.one_origin {
                        leaf::<L, _, W, true>(triangles, &slab, packet)
                    } else {
                        leaf::<L, _, W, false>(triangles, &slab, packet)
                    };
                    if hit {
                        last = packet.last::<L>();
                        if last == f32::NEG_INFINITY {
                            break 'search;
                        }
                    }
                } else if meets(&slab, packet) {
                    node = tree.layout.node(child);
                    offset = child.0;
                    break;
                }
            }
        }
        for (k, &number) in chosen.iter().enumerate() {
            let triangle = packet.triangle[k].to_bits();
            let (t, u, v) = (packet.t_max[k], packet.u[k], packet.v[k]);
            let found = match triangle {
                u32::MAX => Found::NONE,
                _ => Found { t, u, v, triangle },
            };
            answer(usize::from(number), found);
        }
    }
    true
}

/// Whether some ray enters a box.
///
/// # Safety
/// - As for [`packet`].
#[inline(always)]
unsafe fn meets<L: Lanes>(slab: &Slab<L>, packet: &Packet) -> bool {
    for group in 0..GROUPS {
        // SAFETY: the caller's promise.
        if unsafe { slab.entered(packet, GROUP * group) } != 0 {
            return true;
        }
    }
    false
}

/// Tests the triangles of a leaf; whether there was a hit.
///
/// # Safety
/// - As for [`packet`]; and the leaf is one of the tree.
#[inline(always)]
unsafe fn leaf<L: Lanes, F: Leaf, W: Word, const ONE_ORIGIN: bool>(
    leaf: F,
    slab: &Slab<L>,
    packet: &mut Packet,
) -> bool {
    let mut hit = false;
    // SAFETY: the caller's promise.
    unsafe {
        let mut groups = [(0_usize, 0_u32); GROUPS];
        let mut count = 0;
        for group in 0..GROUPS {
            let entered = slab.entered(packet, GROUP * group);
            groups[count] = (GROUP * group, entered);
            count += usize::from(entered != 0);
        }
        if count == 0 {
            return false;
        }
        for k in 0..leaf.places() {
            let triangle = *leaf.numbers().add(k);
            if triangle.to_bits() == u32::MAX {
                break;
            }
            let corner = |which: usize| {
                let [x, y, z] = packet.axes;
                [
                    leaf.coordinate(which, x, k),
                    leaf.coordinate(which, y, k),
                    leaf.coordinate(which, z, k),
                ]
            };
            let mut corners = [corner(0), corner(1), corner(2)];
            if ONE_ORIGIN {
                // Once for all rays.
                let [[x, ..], [y, ..], [z, ..]] = packet.origin;
                for corner in &mut corners {
                    corner[0] -= x;
                    corner[1] -= y;
                    corner[2] -= z;
                }
            }
            for &(from, entered) in groups.get_unchecked(..count) {
                hit |= test::<L, W, ONE_ORIGIN>(corners, triangle, packet, from, entered);
            }
        }
    }
    hit
}

/// Tests one triangle against a group of rays, of which those of some bits matter; whether there was
/// a hit. If all origins are one the corners are relative to it.
///
/// # Safety
/// - As for [`packet`]; `from` is that of a group.
#[inline(always)]
unsafe fn test<L: Lanes, W: Word, const ONE_ORIGIN: bool>(
    [a, b, c]: [[f32; 3]; 3],
    triangle: f32,
    packet: &mut Packet,
    from: usize,
    entered: u32,
) -> bool {
    // SAFETY: the caller's promise.
    unsafe {
        let s = load::<L>(&packet.shear, from);
        let (mut a, mut b, mut c) = (splat(a), splat(b), splat(c));
        if !ONE_ORIGIN {
            let o = load::<L>(&packet.origin, from);
            (a, b, c) = (moved(a, o), moved(b, o), moved(c, o));
        }
        let (a, b, c) = (sheared(a, s), sheared(b, s), sheared(c, s));
        let (u, v, w) = (edge(c, b), edge(a, c), edge(b, a));
        let (least, most) = (u.smaller(v).smaller(w), u.larger(v).larger(w));
        let zero = L::splat(0.0);
        let left = (zero.at_most(least) | most.at_most(zero)) & entered;
        if left == 0 {
            return false;
        }
        let [ax, ay, az] = widened::<L>(a);
        let [bx, by, bz] = widened::<L>(b);
        let [cx, cy, cz] = widened::<L>(c);
        let u = cx.times(by).minus(cy.times(bx));
        let v = ax.times(cy).minus(ay.times(cx));
        let w = bx.times(ay).minus(by.times(ax));
        let zero = L::Wide::splat(0.0);
        let outside = u.smaller(v).smaller(w).below(zero) & zero.below(u.larger(v).larger(w));
        let det = u.plus(v).plus(w);
        let flat = !(det.below(zero) | zero.below(det));
        let inverse = L::Wide::splat(1.0).over(det);
        let (u, v, w) = (u.times(inverse), v.times(inverse), w.times(inverse));
        let z = u.times(az).plus(v.times(bz)).plus(w.times(cz));
        let t = z.times(L::Wide::of(s[2])).rounded();
        let t_max = L::load(packet.t_max.as_ptr().add(from));
        let near_enough = t.at_most(t_max) & t.at_most(L::splat(f32::MAX));
        let in_range = L::load(packet.t_min.as_ptr().add(from)).at_most(t) & near_enough;
        let mut hits = left & !outside & !flat & in_range;
        // At the same t as the best hit the smaller number comes first.
        let mut tied = hits & t_max.at_most(t);
        while tied != 0 {
            let k = tied.trailing_zeros();
            tied &= tied - 1;
            let best = packet.triangle[from + k as usize].to_bits();
            if best <= triangle.to_bits() && best != u32::MAX {
                hits &= !(1 << k);
            }
        }
        if hits == 0 {
            return false;
        }
        // If any hit will do, the ray wants to know of no other.
        let t = if W::ORDERED {
            t
        } else {
            L::splat(f32::NEG_INFINITY)
        };
        t.store_where(hits, packet.t_max.as_mut_ptr().add(from));
        v.rounded()
            .store_where(hits, packet.u.as_mut_ptr().add(from));
        w.rounded()
            .store_where(hits, packet.v.as_mut_ptr().add(from));
        L::splat(triangle).store_where(hits, packet.triangle.as_mut_ptr().add(from));
        true
    }
}

/// Three components of a group.
///
/// # Safety
/// - `from` is that of a group.
#[inline(always)]
unsafe fn load<L: Lanes>(of: &[Each; 3], from: usize) -> [L; 3] {
    // SAFETY: the caller's promise.
    unsafe {
        [
            L::load(of[0].as_ptr().add(from)),
            L::load(of[1].as_ptr().add(from)),
            L::load(of[2].as_ptr().add(from)),
        ]
    }
}

/// A corner relative to the origins of eight rays.
///
/// # Safety
/// - The processor has the instructions of `L`.
#[inline(always)]
unsafe fn moved<L: Lanes>([x, y, z]: [L; 3], origin: [L; 3]) -> [L; 3] {
    // SAFETY: the caller's promise.
    unsafe { [x.minus(origin[0]), y.minus(origin[1]), z.minus(origin[2])] }
}

/// A corner sheared.
///
/// # Safety
/// - The processor has the instructions of `L`.
#[inline(always)]
unsafe fn sheared<L: Lanes>([x, y, z]: [L; 3], shear: [L; 3]) -> [L; 3] {
    // SAFETY: the caller's promise.
    unsafe { [x.minus(shear[0].times(z)), y.minus(shear[1].times(z)), z] }
}

/// Three components in double precision.
///
/// # Safety
/// - The processor has the instructions of `L`.
#[inline(always)]
unsafe fn widened<L: Lanes>([x, y, z]: [L; 3]) -> [L::Wide; 3] {
    // SAFETY: the caller's promise.
    unsafe { [L::Wide::of(x), L::Wide::of(y), L::Wide::of(z)] }
}
