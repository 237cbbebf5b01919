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

#[cfg(test)]
mod tests {
    use ombra_geometry::{Aabb, Point3, TriangleMesh};

    use super::super::level::Portable;
    use super::*;
    use crate::bvh8::compact::pack;
    use crate::bvh8::node::{Node, WIDTH};
    use crate::bvh8::wide::WideTree;

    fn stored(lanes: Portable) -> [f32; 8] {
        let mut to = [0.0; 8];
        // SAFETY: eight may be written, and every processor has this level.
        unsafe { lanes.store(to.as_mut_ptr()) };
        to
    }

    /// So many triangles whose corners are so many steps apart: 1 in a strip, 3 without a corner in
    /// common.
    fn mesh(count: u32, step: u32) -> TriangleMesh {
        let point = |k: u32| Point3::new(k as f32, (k * k) as f32 * 0.1, -0.7 * k as f32);
        let indices = (0..count).map(|k| [step * k, step * k + 1, step * k + 2]);
        let points = (0..step * count + 3).map(point).collect();
        TriangleMesh::new(points, indices.collect()).unwrap()
    }

    #[test]
    fn a_leaf_holds_the_very_corners() {
        for (count, step) in (1..=8).flat_map(|count| [1, 2, 3].map(|step| (count, step))) {
            let mesh = mesh(count, step);
            let list: Vec<u32> = (0..count).collect();
            let tree = WideTree {
                root: Child::list(0, list.len()),
                nodes: Vec::new(),
                depth: 1,
            };
            let (tree, blocks) = pack(&tree, &list, &mesh);
            let layout = Small {
                nodes: &tree.nodes,
                words: blocks.words(),
            };
            // SAFETY: the leaf is one of this tree.
            let leaf = unsafe { layout.leaf(tree.root) };
            assert_eq!(leaf.places(), list.len());
            for corner in 0..3 {
                let axes = [2, 0, 1];
                // SAFETY: as above.
                let lanes = unsafe { leaf.corners::<Portable>(corner, axes) }.map(stored);
                for (k, &triangle) in list.iter().enumerate() {
                    let expected = mesh.corners(triangle as usize)[corner].to_array();
                    // SAFETY: as above; there are so many triangles.
                    let number = unsafe { *leaf.numbers().add(k) };
                    assert_eq!(number.to_bits(), triangle);
                    for (place, axis) in axes.into_iter().enumerate() {
                        // SAFETY: as above.
                        let alone = unsafe { leaf.coordinate(corner, axis, k) };
                        let found = [lanes[place][k], alone];
                        assert_eq!(found, [expected[axis]; 2], "{count} triangles, {step}");
                    }
                }
            }
        }
    }

    #[test]
    fn walks_see_the_planes_that_a_node_says() {
        let mut node = Node::EMPTY;
        for k in 0..WIDTH {
            let at = k as f32;
            let bounds = Aabb {
                min: Point3::new(at, -3.3 * at, 1e6 + at),
                max: Point3::new(at + 0.3, 5.0 - at, 1e6 + 2.0 * at),
            };
            node.set(k, &bounds, Child::node(k + 1));
        }
        node.sort();
        let small = SmallNode::new(&node, |child| child);
        let expanded = small.expanded();
        for axis in 0..3 {
            let sides = [expanded.lower[axis], expanded.upper[axis]];
            for (side, expected) in sides.into_iter().enumerate() {
                let first = (axis + 3 * side) * WIDTH;
                // SAFETY: the node has these planes.
                let lanes = unsafe { Small::planes::<Portable>(&raw const small, first, axis) };
                assert_eq!(stored(lanes), expected);
                for (k, plane) in expected.into_iter().enumerate() {
                    // SAFETY: as above.
                    let found = unsafe { Small::plane(&raw const small, first + k, axis) };
                    assert_eq!(found, plane);
                }
            }
        }
        for octant in 0..8 {
            // SAFETY: the node is there.
            let order = unsafe { Small::order(&raw const small, octant) };
            assert_eq!(order, node.order[octant as usize]);
        }
    }
}
