//! The tree over boxes alone, for walks that are not rays.

use ombra_geometry::Aabb;

use crate::Bounded;
use crate::bvh8::{Items, Node, WIDTH, tree_over_boxes};

/// Boxes within boxes, eight to a node, over a list of boxes: the tree of
/// [`StructureKind::Bvh8`](crate::StructureKind::Bvh8) over primitives that are no triangles. For
/// walks of another kind than a ray's, such as that of a tile of places and the whole way of the sun.
#[derive(Clone, Debug)]
pub struct BoxTree {
    nodes: Vec<BoxNode>,
    depth: usize,
}

/// The boxes of up to eight children, and what they are.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct BoxNode {
    /// By axis: where the boxes begin; ∞ where there is no child.
    pub lower: [[f32; WIDTH]; 3],
    /// By axis: where they end; −∞ where there is no child.
    pub upper: [[f32; WIDTH]; 3],
    /// What is in them; anything where there is no child.
    pub child: [BoxChild; WIDTH],
}

/// A node by its index, or a box of the list by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoxChild(u32);

impl BoxChild {
    const LEAF: u32 = 1 << 31;

    /// The number of a box in the list; `None` if this is a node.
    #[must_use]
    #[inline(always)]
    pub const fn leaf(self) -> Option<usize> {
        if self.0 & Self::LEAF != 0 {
            Some((self.0 & !Self::LEAF) as usize)
        } else {
            None
        }
    }

    /// Of a node: its index.
    #[must_use]
    #[inline(always)]
    pub const fn node(self) -> usize {
        self.0 as usize
    }
}

impl BoxTree {
    /// Builds the tree. Boxes that are empty, or not finite, are left out.
    ///
    /// # Panics
    /// If there are 2²⁸ boxes or more.
    #[must_use]
    pub fn build(boxes: &[Aabb]) -> Self {
        assert!(boxes.len() < 1 << 28, "a tree has less than 2^28 boxes");
        let bounded: Vec<Bounded> = (0..)
            .zip(boxes)
            .map(|(primitive, &bounds)| Bounded { bounds, primitive })
            .collect();
        let (tree, list) = tree_over_boxes(Items::bounded(&bounded), boxes);
        let node = |node: &Node| BoxNode {
            lower: node.lower,
            upper: node.upper,
            child: node.child.map(|child| {
                if child.is_leaf() {
                    BoxChild(BoxChild::LEAF | list[child.range().start])
                } else {
                    BoxChild(child.index() as u32)
                }
            }),
        };
        // The root is a node, and the first one.
        Self {
            nodes: tree.nodes.iter().map(node).collect(),
            depth: tree.depth,
        }
    }

    /// All nodes; the root is at [`root`](Self::root).
    #[must_use]
    #[inline]
    pub fn nodes(&self) -> &[BoxNode] {
        &self.nodes
    }

    /// Where the root is.
    #[must_use]
    #[inline]
    pub const fn root(&self) -> usize {
        0
    }

    /// How many levels of nodes there are: at most 64.
    #[must_use]
    pub const fn depth(&self) -> usize {
        self.depth
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ombra_geometry::Point3;

    /// Which boxes are below a node; all must lie within the boxes above them.
    fn named(tree: &BoxTree, node: usize, depth: usize, found: &mut Vec<usize>, boxes: &[Aabb]) {
        assert!(depth <= tree.depth());
        let node = &tree.nodes()[node];
        for k in (0..WIDTH).filter(|&k| node.lower[0][k] <= node.upper[0][k]) {
            let bounds = Aabb {
                min: Point3::from(node.lower.map(|lower| lower[k])),
                max: Point3::from(node.upper.map(|upper| upper[k])),
            };
            let first = found.len();
            match node.child[k].leaf() {
                Some(primitive) => found.push(primitive),
                None => named(tree, node.child[k].node(), depth + 1, found, boxes),
            }
            assert!(
                found[first..]
                    .iter()
                    .all(|&own| bounds.encloses(&boxes[own]))
            );
        }
    }

    #[test]
    fn every_box_is_in_one_leaf_and_within_what_is_above() {
        for (name, list) in crate::bvh::tests::hostile() {
            let boxes: Vec<Aabb> = list.iter().map(|own| own.bounds).collect();
            let tree = BoxTree::build(&boxes);
            let mut found = Vec::new();
            named(&tree, tree.root(), 1, &mut found, &boxes);
            found.sort_unstable();
            let expected: Vec<usize> = (0..boxes.len()).collect();
            assert_eq!(found, expected, "{name}");
        }
    }

    #[test]
    fn what_has_no_place_is_left_out() {
        let tree = BoxTree::build(&[Aabb::EMPTY, Aabb::UNBOUNDED]);
        let mut found = Vec::new();
        named(&tree, tree.root(), 1, &mut found, &[]);
        assert!(found.is_empty());
    }
}
