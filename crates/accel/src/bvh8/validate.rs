//! Whether a wide tree is one. For tests: it stops at the first thing that is wrong.

use ombra_geometry::Aabb;

use super::kernel::MAX_DEPTH;
use super::node::{Child, MAX_LEAF};
use super::{Body, Wide};

/// What a valid tree is like.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Valid {
    /// How many primitives leaves name, each as often as it is named.
    pub(super) named: usize,
    pub(super) leaves: usize,
    pub(super) depth: usize,
}

/// Holds a tree against the boxes of its primitives, by number; those with an empty box are in no
/// leaf. If some are in several leaves, each leaf's box is held to meet its primitives' boxes only.
pub(super) fn validate(tree: &Wide, boxes: &[Aabb]) -> Valid {
    let mut walk = Walk {
        tree,
        boxes,
        found: vec![Vec::new(); boxes.len()],
        valid: Valid::default(),
    };
    walk.child(tree.root(), &Aabb::UNBOUNDED, 1);
    for (primitive, (bounds, found)) in boxes.iter().zip(&walk.found).enumerate() {
        if bounds.is_empty() {
            assert!(found.is_empty(), "{primitive} is not to be found");
            continue;
        }
        assert!(!found.is_empty(), "{primitive} is in no leaf");
        assert!(
            tree.repeats || found.len() == 1,
            "{primitive} is in several leaves"
        );
        let all = found.iter().fold(Aabb::EMPTY, |all, part| all.union(*part));
        assert!(all.encloses(bounds), "{primitive} sticks out of its leaves");
    }
    let depth = match &tree.body {
        Body::Full(tree, _) => tree.depth,
        Body::Compact(tree, _) => tree.depth,
    };
    assert!(walk.valid.depth <= depth && depth <= MAX_DEPTH);
    walk.valid
}

struct Walk<'a> {
    tree: &'a Wide,
    boxes: &'a [Aabb],
    /// By primitive: the boxes of the leaves that it is in.
    found: Vec<Vec<Aabb>>,
    valid: Valid,
}

impl Walk<'_> {
    fn child(&mut self, child: Child, bounds: &Aabb, depth: usize) {
        if child.is_leaf() {
            return self.leaf(child, bounds);
        }
        self.valid.depth = self.valid.depth.max(depth);
        let node = self.tree.node(child);
        for order in node.order {
            let places = (0..8).fold(0, |places, k| places | 1 << (order >> (3 * k) & 7));
            assert_eq!(places, 255, "an order names each child once");
        }
        for (own, below) in node.children() {
            // Boxes of the compact layout are larger than what is in them, each by its own grid.
            let is_full = matches!(self.tree.body, Body::Full(..));
            assert!(
                !is_full || bounds.encloses(&own),
                "a child sticks out of its node"
            );
            self.child(below, &own.intersection(*bounds), depth + 1);
        }
    }

    fn leaf(&mut self, leaf: Child, bounds: &Aabb) {
        let list = self.tree.list(leaf);
        assert!((1..=MAX_LEAF).contains(&list.len()));
        self.valid.leaves += 1;
        self.valid.named += list.len();
        for primitive in list {
            let own = self.boxes[primitive as usize];
            let meets = !own.intersection(*bounds).is_empty();
            assert!(meets, "a leaf names what does not lie in it");
            let root = *bounds == Aabb::UNBOUNDED;
            let part = if root { own } else { *bounds };
            assert!(
                self.tree.repeats || part.encloses(&own),
                "{primitive} sticks out"
            );
            self.found[primitive as usize].push(part);
        }
    }
}
