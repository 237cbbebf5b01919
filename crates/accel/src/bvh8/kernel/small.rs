//! The compact layout as the walks see it.

use super::super::compact::{SHARED, SmallNode, counts};
use super::super::node::Child;
use super::layout::{Layout, Leaf};
use super::level::Lanes;

/// Where the parts of a compact tree lie.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Small<'a> {
    pub(crate) nodes: &'a [SmallNode],
    /// Of the leaves.
    pub(crate) words: &'a [u32],
}

impl Layout for Small<'_> {
    type Node = SmallNode;
    type Leaf = Block;
    const LINES: usize = 3;

    #[inline(always)]
    fn node(&self, child: Child) -> *const SmallNode {
        self.nodes.as_ptr().wrapping_add(child.index())
    }

    #[inline(always)]
    fn begin(&self, child: Child) -> *const u8 {
        if child.is_leaf() {
            self.words.as_ptr().wrapping_add(child.word()).cast()
        } else {
            self.node(child).cast()
        }
    }

    #[inline(always)]
    unsafe fn leaf(&self, child: Child) -> Block {
        let first = self.words.as_ptr().wrapping_add(child.word());
        // SAFETY: the caller's promise.
        let (triangles, corners) = counts(unsafe { *first });
        Block {
            x: first.wrapping_add(1).cast(),
            triangles,
            corners,
        }
    }

    #[inline(always)]
    unsafe fn planes<L: Lanes>(node: *const SmallNode, first: usize, axis: usize) -> L {
        // SAFETY: the two lists of planes lie side by side; the product is exact, so it does not
        // matter how often there is rounding.
        unsafe {
            let planes = (&raw const (*node).lower).cast::<u8>().add(first);
            let origin = L::splat((*node).origin[axis]);
            L::load_bytes(planes).multiply_add(L::splat((*node).step[axis]), origin)
        }
    }

    #[inline(always)]
    unsafe fn plane(node: *const SmallNode, plane: usize, axis: usize) -> f32 {
        // SAFETY: as above.
        unsafe {
            let q = *(&raw const (*node).lower).cast::<u8>().add(plane);
            (*node).origin[axis] + f32::from(q) * (*node).step[axis]
        }
    }

    #[inline(always)]
    unsafe fn children(node: *const SmallNode) -> *const Child {
        // SAFETY: the caller's promise.
        unsafe { (&raw const (*node).child).cast() }
    }

    #[inline(always)]
    unsafe fn order(node: *const SmallNode, octant: u32) -> u32 {
        // SAFETY: eight times three bytes, and after them those of the children.
        unsafe {
            let orders = (&raw const (*node).order).cast::<u8>();
            let order = orders.add(3 * (octant & 7) as usize).cast::<u32>();
            u32::from_le(order.read_unaligned()) & 0x00ff_ffff
        }
    }
}

/// A leaf.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    /// Where the corners begin.
    x: *const f32,
    triangles: usize,
    corners: usize,
}

impl Block {
    /// Which corners of the leaf are corners of the triangles, a byte each.
    ///
    /// # Safety
    /// - The leaf is one of a tree, and the corner is below 3.
    #[inline(always)]
    unsafe fn which(self, corner: usize) -> *const u8 {
        // SAFETY: the caller's promise.
        unsafe {
            self.numbers()
                .add(self.triangles)
                .cast::<u8>()
                .add(corner * self.triangles)
        }
    }
}

impl Leaf for Block {
    #[inline(always)]
    fn places(self) -> usize {
        self.triangles
    }

    #[inline(always)]
    fn numbers(self) -> *const f32 {
        self.x.wrapping_add(3 * self.corners)
    }

    #[inline(always)]
    unsafe fn corners<L: Lanes>(self, corner: usize, axes: [usize; 3]) -> [L; 3] {
        let [a, b, c] = [
            self.x.wrapping_add(axes[0] * self.corners),
            self.x.wrapping_add(axes[1] * self.corners),
            self.x.wrapping_add(axes[2] * self.corners),
        ];
        // SAFETY: there are words behind the last leaf to be read with it.
        unsafe {
            if self.corners > SHARED {
                let first = corner * self.triangles;
                return [
                    L::load(a.add(first)),
                    L::load(b.add(first)),
                    L::load(c.add(first)),
                ];
            }
            let which = self.which(corner);
            [
                L::chosen(a, which),
                L::chosen(b, which),
                L::chosen(c, which),
            ]
        }
    }

    #[inline(always)]
    unsafe fn coordinate(self, corner: usize, axis: usize, triangle: usize) -> f32 {
        // SAFETY: the caller's promise.
        unsafe {
            let which = *self.which(corner).add(triangle);
            *self.x.add(axis * self.corners + usize::from(which))
        }
    }
}
