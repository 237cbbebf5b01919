//! The nodes of the compact layout, to the byte.

use super::super::node::{Child, Node, WIDTH};

/// A node whose boxes are told by a grid of 256 planes an axis that spans it:
///
/// | bytes   | field    | holds                                                              |
/// |---------|----------|--------------------------------------------------------------------|
/// | 0..12   | `origin` | where plane 0 of the grid is, by axis                              |
/// | 12..24  | `step`   | how far planes of the grid lie apart, by axis: a power of two       |
/// | 24..48  | `lower`  | by axis the lower plane of the eight children                      |
/// | 48..72  | `upper`  | by axis the upper plane                                            |
/// | 72..96  | `order`  | by octant of a ray's direction the order of the children, 24 bits |
/// | 96..128 | `child`  | the eight children                                                 |
///
/// Plane q is at `origin` + q · `step`. The product is exact since the step is a power of two, so
/// there is one rounding, and a plane is the same number at every level of instructions. No box
/// that comes out is smaller than the one that went in.
///
/// Where there is no child there is an empty leaf ([`Blocks`](super::Blocks) begin with one) with the
/// planes 255 and 0. Where an axis has no extent, that is a box like another one; so is it where the whole node
/// is smaller than the pad of a ray. To visit it does no harm.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct SmallNode {
    pub(crate) origin: [f32; 3],
    pub(crate) step: [f32; 3],
    pub(crate) lower: [[u8; WIDTH]; 3],
    pub(crate) upper: [[u8; WIDTH]; 3],
    pub(crate) order: [[u8; 3]; WIDTH],
    pub(crate) child: [Child; WIDTH],
}

const _: () = {
    use std::mem::offset_of;
    assert!(size_of::<SmallNode>() == 128);
    // Walks read planes as one list, and orders in four bytes each.
    assert!(offset_of!(SmallNode, upper) == offset_of!(SmallNode, lower) + 3 * WIDTH);
    assert!(offset_of!(SmallNode, child) == offset_of!(SmallNode, order) + 3 * WIDTH);
};

/// The planes of a grid along one axis.
#[derive(Clone, Copy)]
struct Grid {
    origin: f32,
    step: f32,
}

impl Grid {
    /// The finest one that reaches from the lowest of some planes to the highest.
    fn new(lowest: f32, highest: f32) -> Self {
        let extent = f64::from(highest) - f64::from(lowest);
        // From the exponent: 2 to the power of it is not above extent / 255.
        let exponent = (extent / 255.0).log2().floor().clamp(-126.0, 126.0) as i32;
        let mut grid = Self {
            origin: lowest,
            step: 2_f32.powi(exponent),
        };
        while grid.plane(u8::MAX) < highest {
            grid.step *= 2.0;
        }
        grid
    }

    fn plane(self, q: u8) -> f32 {
        self.origin + f32::from(q) * self.step
    }

    /// Near which plane a number lies.
    fn near(self, x: f32) -> u8 {
        ((f64::from(x) - f64::from(self.origin)) / f64::from(self.step)) as u8
    }

    /// The highest plane that is not above a number, which is not below the origin.
    fn below(self, x: f32) -> u8 {
        // Where the grid is finer than numbers are, many planes are one.
        if self.plane(u8::MAX) <= x {
            return u8::MAX;
        }
        let mut q = self.near(x);
        while self.plane(q) > x {
            q -= 1;
        }
        while q < u8::MAX && self.plane(q + 1) <= x {
            q += 1;
        }
        q
    }

    /// The lowest plane that is not below a number, which is not above the last one.
    fn above(self, x: f32) -> u8 {
        if self.plane(0) >= x {
            return 0;
        }
        let mut q = self.near(x);
        while self.plane(q) < x {
            q += 1;
        }
        while q > 0 && self.plane(q - 1) >= x {
            q -= 1;
        }
        q
    }
}

impl SmallNode {
    /// A node made smaller; what its children are is told by `child`.
    pub(crate) fn new(node: &Node, mut child: impl FnMut(Child) -> Child) -> Self {
        let mut small = Self {
            origin: [0.0; 3],
            step: [f32::MIN_POSITIVE; 3],
            lower: [[u8::MAX; WIDTH]; 3],
            upper: [[0; WIDTH]; 3],
            order: node.order.map(|order| {
                let [a, b, c, _] = order.to_le_bytes();
                [a, b, c]
            }),
            child: [Child::EMPTY_BLOCK; WIDTH],
        };
        let is_there = |k: &usize| node.lower[0][*k] <= node.upper[0][*k];
        for k in (0..WIDTH).filter(is_there) {
            small.child[k] = child(node.child[k]);
        }
        for axis in 0..3 {
            let (lower, upper) = (&node.lower[axis], &node.upper[axis]);
            let there = || (0..WIDTH).filter(is_there);
            let Some(lowest) = there().map(|k| lower[k]).reduce(f32::min) else {
                continue;
            };
            let highest = there().fold(lowest, |highest, k| highest.max(upper[k]));
            let grid = Grid::new(lowest, highest);
            (small.origin[axis], small.step[axis]) = (grid.origin, grid.step);
            for k in there() {
                small.lower[axis][k] = grid.below(lower[k]);
                small.upper[axis][k] = grid.above(upper[k]);
            }
        }
        small
    }

    /// With all numbers as walks see them.
    pub(crate) fn expanded(&self) -> Node {
        let mut node = Node::EMPTY;
        let is_there = |k: &usize| self.child[*k] != Child::EMPTY_BLOCK;
        for k in (0..WIDTH).filter(is_there) {
            node.child[k] = self.child[k];
            for axis in 0..3 {
                let grid = Grid {
                    origin: self.origin[axis],
                    step: self.step[axis],
                };
                node.lower[axis][k] = grid.plane(self.lower[axis][k]);
                // A grid may end beyond the largest number.
                node.upper[axis][k] = grid.plane(self.upper[axis][k]).min(f32::MAX);
            }
        }
        node.order = self.order.map(|[a, b, c]| u32::from_le_bytes([a, b, c, 0]));
        node
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ombra_geometry::{Aabb, Point3};

    fn around(boxes: &[Aabb]) -> Node {
        let mut node = Node::EMPTY;
        for (k, bounds) in boxes.iter().enumerate() {
            node.set(k, bounds, Child::node(k + 1));
        }
        node.sort();
        node
    }

    fn cube(centre: [f32; 3], half: [f32; 3]) -> Aabb {
        let [x, y, z] = centre;
        let [a, b, c] = half;
        Aabb {
            min: Point3::new(x - a, y - b, z - c),
            max: Point3::new(x + a, y + b, z + c),
        }
    }

    /// What comes out encloses what went in, and not much more.
    fn assert_snug(boxes: &[Aabb]) {
        let node = around(boxes);
        let small = SmallNode::new(&node, |child| child);
        let out = small.expanded();
        assert_eq!(
            (out.child, out.order),
            (node.child, node.order),
            "{boxes:?}"
        );
        let all = boxes.iter().fold(Aabb::EMPTY, |all, own| all.union(*own));
        let (low, high) = (all.min.to_array(), all.max.to_array());
        for (k, own) in boxes.iter().enumerate() {
            let found = out.bounds(k);
            assert!(found.encloses(own), "{found:?} around {own:?}");
            for axis in 0..3 {
                let extent = f64::from(high[axis]) - f64::from(low[axis]);
                let at = f64::from(low[axis].abs().max(high[axis].abs()));
                let most = extent / 127.0 + f64::from(f32::EPSILON) * at + 1e-36;
                let below =
                    f64::from(own.min.to_array()[axis]) - f64::from(found.min.to_array()[axis]);
                let above =
                    f64::from(found.max.to_array()[axis]) - f64::from(own.max.to_array()[axis]);
                assert!(below <= most && above <= most, "{found:?} around {own:?}");
            }
        }
    }

    #[test]
    fn boxes_are_enclosed_and_not_by_much() {
        let step = |k: usize, by: f32| (k as f32 * by).fract();
        for scale in [1.0, 1e-6, 1e-30, 1e-42, 1e7, 1e15, 1e31] {
            for away in [0.0, 1.0, 1e3, 1e6] {
                let boxes: Vec<Aabb> = (0..8)
                    .map(|k| {
                        let centre = [0.31, 0.77, 0.13].map(|by| scale * (step(k, by) + away));
                        cube(centre, [0.05, 0.2, 0.0].map(|half| scale * half))
                    })
                    .collect();
                for count in 1..=8 {
                    assert_snug(&boxes[..count]);
                }
            }
        }
    }

    #[test]
    fn the_whole_range_of_numbers_is_spanned() {
        assert_snug(&[cube([0.0; 3], [f32::MAX; 3])]);
        assert_snug(&[cube([0.0; 3], [0.0; 3]), cube([1e-45; 3], [0.0; 3])]);
        // Half the planes of the grid lie beyond the largest number.
        let boxes = [f32::MAX, f32::MIN].map(|x| cube([x; 3], [0.0; 3]));
        let out = SmallNode::new(&around(&boxes), |child| child).expanded();
        for (k, own) in boxes.iter().enumerate() {
            assert!(out.bounds(k).encloses(own));
        }
    }

    #[test]
    fn a_node_without_children_stays_without() {
        let small = SmallNode::new(&Node::EMPTY, |child| child);
        assert_eq!(small.expanded().children().count(), 0);
    }
}
