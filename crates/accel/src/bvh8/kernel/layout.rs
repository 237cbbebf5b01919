//! How a tree of triangles lies in memory, as the walks see it.
//!
//! A walk is written once over [`Layout`]: where nodes and leaves are, and how eight planes or eight
//! corners come out of them into lanes.

use super::super::node::{Child, Node};
use super::super::quad::Quad;
use super::level::Lanes;

/// Where the parts of a tree lie.
pub(crate) trait Layout: Copy {
    type Node;
    type Leaf: Leaf;

    /// How many lines of 64 bytes are asked for before a child is visited: no node has more, and few
    /// leaves have.
    const LINES: usize;

    /// A node.
    fn node(&self, child: Child) -> *const Self::Node;

    /// What to ask memory for before a child is visited: where it begins.
    fn begin(&self, child: Child) -> *const u8;

    /// A leaf.
    ///
    /// # Safety
    /// - The child is a leaf of this tree.
    unsafe fn leaf(&self, child: Child) -> Self::Leaf;

    /// Eight planes along an axis: those that begin with plane `first` of a node, counted as in
    /// [`Node`].
    ///
    /// # Safety
    /// - The processor has the instructions of `L`.
    /// - The node is one of this tree, and the planes are planes of that axis.
    unsafe fn planes<L: Lanes>(node: *const Self::Node, first: usize, axis: usize) -> L;

    /// One plane along an axis.
    ///
    /// # Safety
    /// - The node is one of this tree, and the plane is one of that axis.
    unsafe fn plane(node: *const Self::Node, plane: usize, axis: usize) -> f32;

    /// What the eight children are.
    ///
    /// # Safety
    /// - The node is one of this tree.
    unsafe fn children(node: *const Self::Node) -> *const Child;

    /// In which order a ray of an octant looks at them, see [`Node`].
    ///
    /// # Safety
    /// - The node is one of this tree, and the octant is below 8.
    unsafe fn order(node: *const Self::Node, octant: u32) -> u32;
}

/// A leaf of up to eight triangles.
pub(crate) trait Leaf: Copy {
    /// How many places for triangles it has.
    fn places(self) -> usize;

    /// The numbers of the triangles, as bits; `u32::MAX` where there is none.
    fn numbers(self) -> *const f32;

    /// Corner 0, 1 or 2 of the triangles, axis by axis in the given order.
    ///
    /// # Safety
    /// - The processor has the instructions of `L`.
    /// - The leaf is one of a tree; corners and axes are below 3.
    unsafe fn corners<L: Lanes>(self, corner: usize, axes: [usize; 3]) -> [L; 3];

    /// One coordinate of a corner of one triangle.
    ///
    /// # Safety
    /// - The leaf is one of a tree; corner and axis are below 3, and the triangle has a place.
    unsafe fn coordinate(self, corner: usize, axis: usize, triangle: usize) -> f32;
}

/// All numbers as they are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Full<'a> {
    pub(crate) nodes: &'a [Node],
    pub(crate) quads: &'a [Quad],
}

impl Layout for Full<'_> {
    type Node = Node;
    type Leaf = Quads;
    const LINES: usize = 4;

    #[inline(always)]
    fn node(&self, child: Child) -> *const Node {
        self.nodes.as_ptr().wrapping_byte_add(child.offset())
    }

    #[inline(always)]
    fn begin(&self, child: Child) -> *const u8 {
        let (nodes, quads) = (self.nodes.as_ptr().cast::<u8>(), self.quads.as_ptr().cast());
        let at = if child.is_leaf() { quads } else { nodes };
        at.wrapping_add(child.offset())
    }

    #[inline(always)]
    unsafe fn leaf(&self, child: Child) -> Quads {
        let quads = self.quads.as_ptr();
        Quads {
            numbers: quads.wrapping_byte_add(child.offset()).cast(),
            places: child.places(),
        }
    }

    #[inline(always)]
    unsafe fn planes<L: Lanes>(node: *const Node, first: usize, _axis: usize) -> L {
        // SAFETY: the planes are the first numbers of a node.
        unsafe { L::load(node.cast::<f32>().add(first)) }
    }

    #[inline(always)]
    unsafe fn plane(node: *const Node, plane: usize, _axis: usize) -> f32 {
        // SAFETY: as above.
        unsafe { *node.cast::<f32>().add(plane) }
    }

    #[inline(always)]
    unsafe fn children(node: *const Node) -> *const Child {
        // SAFETY: the caller's promise.
        unsafe { (&raw const (*node).child).cast() }
    }

    #[inline(always)]
    unsafe fn order(node: *const Node, octant: u32) -> u32 {
        // SAFETY: the caller's promise.
        unsafe { (*node).order[(octant & 7) as usize] }
    }
}

/// A leaf of one quad or two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quads {
    numbers: *const f32,
    places: usize,
}

impl Leaf for Quads {
    #[inline(always)]
    fn places(self) -> usize {
        self.places
    }

    #[inline(always)]
    fn numbers(self) -> *const f32 {
        self.numbers.wrapping_add(9 * self.places)
    }

    #[inline(always)]
    unsafe fn corners<L: Lanes>(self, corner: usize, axes: [usize; 3]) -> [L; 3] {
        let Self { numbers, places } = self;
        // SAFETY: of a leaf of four places eight numbers are read from the beginning of each of nine
        // components, the last four of them not being those of triangles; after the nine comes a
        // tenth, so all lie in the leaf.
        unsafe {
            let from = numbers.add(3 * corner * places);
            [
                L::load(from.add(axes[0] * places)),
                L::load(from.add(axes[1] * places)),
                L::load(from.add(axes[2] * places)),
            ]
        }
    }

    #[inline(always)]
    unsafe fn coordinate(self, corner: usize, axis: usize, triangle: usize) -> f32 {
        // SAFETY: the caller's promise.
        unsafe {
            *self
                .numbers
                .add((3 * corner + axis) * self.places + triangle)
        }
    }
}
