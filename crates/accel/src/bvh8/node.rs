//! The nodes, to the byte.

use bytemuck::{Pod, Zeroable};
use ombra_geometry::{Aabb, Point3};

/// How many children a node has room for.
pub(crate) const WIDTH: usize = 8;

/// A node: the boxes of up to eight children, what each child is, and in which order a ray looks at
/// them. All of it 32-bit numbers:
///
/// | bytes    | field    | holds                                                        |
/// |----------|----------|--------------------------------------------------------------|
/// | 0..96    | `lower`  | lowest x of the eight children, lowest y, lowest z           |
/// | 96..192  | `upper`  | highest x of the eight children, highest y, highest z        |
/// | 192..224 | `child`  | eight [`Child`]s                                             |
/// | 224..256 | `order`  | by octant of the ray's direction: eight times three bits, the number of a child each; the last one is the nearest |
///
/// A place without a child has a box that no ray meets: from ∞ to −∞.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C, align(64))]
pub(crate) struct Node {
    pub(crate) lower: [[f32; WIDTH]; 3],
    pub(crate) upper: [[f32; WIDTH]; 3],
    pub(crate) child: [Child; WIDTH],
    pub(crate) order: [u32; WIDTH],
}

const _: () = assert!(size_of::<Node>() == 256);

/// What a child is: a node by its index, or a leaf. In 32 bits, from the highest:
///
/// | a node           | 0   | 31 bits: 8 times its index                                |
/// | a leaf of a list | 1   | 3 bits: how many primitives, less 1; 28 bits: the first   |
/// | a leaf of triangles | 1 | 1 bit: whether it has eight places and not four; 30 bits: 5 times the index of its first [`Quad`](super::Quad) |
/// | a compact leaf | 1      | 31 bits: half the index of its first word in [`Blocks`](super::compact::Blocks) |
///
/// Of a tree with all numbers as they are, those of nodes and quads count 32 bytes before them, so
/// that kernels find the address of either in the same way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(transparent)]
pub(crate) struct Child(pub(crate) u32);

/// The most primitives in a leaf.
pub(crate) const MAX_LEAF: usize = 8;

impl Child {
    const LEAF: u32 = 1 << 31;
    const EIGHT: u32 = 1 << 30;
    /// Where there is no child.
    pub(crate) const NONE: Self = Self(0);

    /// A node.
    pub(crate) fn node(index: usize) -> Self {
        debug_assert!(index < 1 << 28, "a node is found with 31 bits");
        Self(8 * index as u32)
    }

    /// A leaf of a list.
    pub(crate) fn list(first: usize, count: usize) -> Self {
        debug_assert!((1..=MAX_LEAF).contains(&count) && first < 1 << 28);
        Self(Self::LEAF | (count as u32 - 1) << 28 | first as u32)
    }

    /// A leaf of triangles.
    pub(crate) fn triangles(quad: usize, eight: bool) -> Self {
        debug_assert!(quad < (1 << 30) / 5, "a quad is found with 30 bits");
        let eight = if eight { Self::EIGHT } else { 0 };
        Self(Self::LEAF | eight | (5 * quad as u32))
    }

    /// A compact leaf.
    pub(crate) fn block(word: usize) -> Self {
        debug_assert!(
            word.is_multiple_of(2) && word / 2 < (1 << 31) - 1,
            "a block is found with 31 bits, of which one is not all ones"
        );
        Self(Self::LEAF | (word / 2) as u32)
    }

    /// The compact leaf that has no triangles.
    pub(crate) const EMPTY_BLOCK: Self = Self(Self::LEAF);

    /// The same, not of triangles, where so many nodes and so many primitives come before those
    /// that it counts.
    pub(crate) fn moved(self, [nodes, primitives]: [usize; 2]) -> Self {
        if self.is_leaf() {
            let std::ops::Range { start, end } = self.range();
            Self::list(start + primitives, end - start)
        } else {
            Self::node(self.index() + nodes)
        }
    }

    #[inline(always)]
    pub(crate) const fn is_leaf(self) -> bool {
        self.0 & Self::LEAF != 0
    }

    /// Of a node: its index.
    #[inline(always)]
    pub(crate) const fn index(self) -> usize {
        (self.0 / 8) as usize
    }

    /// Bytes of nodes, or of quads, before it.
    #[inline(always)]
    pub(crate) const fn offset(self) -> usize {
        ((self.0 & 0x3fff_ffff) as usize) << 5
    }

    /// Of a leaf of a list: which primitives.
    #[inline(always)]
    pub(crate) const fn range(self) -> std::ops::Range<usize> {
        let first = (self.0 & 0x0fff_ffff) as usize;
        first..first + (self.0 >> 28 & 7) as usize + 1
    }

    /// Of a compact leaf: its first word.
    #[inline(always)]
    pub(crate) const fn word(self) -> usize {
        (self.0 & !Self::LEAF) as usize * 2
    }

    /// Of a leaf of triangles: its first quad.
    #[inline(always)]
    pub(crate) const fn quad(self) -> usize {
        ((self.0 & 0x3fff_ffff) / 5) as usize
    }

    /// Of a leaf of triangles: how many places it has, 4 or 8.
    #[inline(always)]
    pub(crate) const fn places(self) -> usize {
        if self.0 & Self::EIGHT != 0 { 8 } else { 4 }
    }
}

impl Node {
    /// Without children.
    pub(crate) const EMPTY: Self = Self {
        lower: [[f32::INFINITY; WIDTH]; 3],
        upper: [[f32::NEG_INFINITY; WIDTH]; 3],
        child: [Child::NONE; WIDTH],
        order: [0; WIDTH],
    };

    /// The box of a child.
    pub(crate) fn bounds(&self, child: usize) -> Aabb {
        Aabb {
            min: Point3::from(self.lower.map(|lower| lower[child])),
            max: Point3::from(self.upper.map(|upper| upper[child])),
        }
    }

    /// Puts a child in its place.
    pub(crate) fn set(&mut self, child: usize, bounds: &Aabb, what: Child) {
        let (min, max) = (bounds.min.to_array(), bounds.max.to_array());
        for axis in 0..3 {
            self.lower[axis][child] = min[axis];
            self.upper[axis][child] = max[axis];
        }
        self.child[child] = what;
    }

    /// Makes room for what comes before children, none of them triangles (see [`Child::moved`]).
    pub(crate) fn move_children(&mut self, before: [usize; 2]) {
        for (child, lower) in self.child.iter_mut().zip(self.lower[0]) {
            if lower < f32::INFINITY {
                *child = child.moved(before);
            }
        }
    }

    /// The children that are there.
    pub(crate) fn children(&self) -> impl Iterator<Item = (Aabb, Child)> + '_ {
        (0..WIDTH)
            .map(|i| (self.bounds(i), self.child[i]))
            .filter(|(bounds, _)| !bounds.is_empty())
    }

    /// Works out in which order rays look at the children: by how far their middles lie along the
    /// diagonal of each octant, the farthest first.
    pub(crate) fn sort(&mut self) {
        let middle: [[f32; WIDTH]; 3] = std::array::from_fn(|axis| {
            std::array::from_fn(|i| 0.5 * self.lower[axis][i] + 0.5 * self.upper[axis][i])
        });
        for octant in 0..WIDTH / 2 {
            let signs = [0, 1, 2].map(|axis| if octant >> axis & 1 == 1 { -1.0 } else { 1.0 });
            let keys: [f32; WIDTH] = std::array::from_fn(|i| {
                let [x, y, z] = [0, 1, 2].map(|axis| signs[axis] * middle[axis][i]);
                let there = self.lower[0][i] <= self.upper[0][i];
                // Not where sums are of infinities.
                if there { x + y + z } else { f32::INFINITY }
            });
            // How many come before each one: no branch hangs on what is as good as random.
            let mut ranks = [0_u32; WIDTH];
            for j in 0..WIDTH {
                for i in 0..WIDTH {
                    let before = if j < i {
                        keys[j] <= keys[i]
                    } else {
                        keys[j] < keys[i]
                    };
                    ranks[i] += u32::from(before);
                }
            }
            let (mut forward, mut backward) = (0, 0);
            for (i, rank) in (0..).zip(ranks) {
                forward |= i << (3 * (7 - rank));
                backward |= i << (3 * rank);
            }
            self.order[octant] = forward;
            self.order[octant ^ 7] = backward;
        }
    }
}
