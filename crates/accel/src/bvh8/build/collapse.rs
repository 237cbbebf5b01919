//! From two children a node to eight, in the best way there is.
//!
//! Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs",
//! High-Performance Graphics 2017, section 3.2: for each node of a binary tree and each number of
//! places it is worked out what it would cost at least to put what is below the node into so many
//! places of a wide node, from what it would cost for its two children. What costs is area: each
//! node and each leaf is met by a ray as often as its box is large.

use super::super::node::{Child, MAX_LEAF, Node, WIDTH};
use super::item::Item;

/// What a leaf costs, if a node costs 1.
const LEAF: f32 = 1.0;

/// A binary tree over a part of the list, children before what is above them.
#[derive(Debug, Default)]
pub(super) struct Binary {
    nodes: Vec<Branch>,
}

#[derive(Debug)]
struct Branch {
    bounds: Item,
    children: [u32; 2],
    /// The part of the list below it.
    first: u32,
    count: u32,
    /// The least cost with up to k + 1 places.
    costs: [f32; WIDTH - 1],
    /// How many of k + 1 places the left child has; 0 if one place less is no worse. Of the last
    /// one, as a node of its own.
    left: [u8; WIDTH],
    /// Whether in one place this is a leaf.
    is_leaf: bool,
}

impl Binary {
    /// Adds a leaf over a part of the list.
    pub(super) fn leaf(&mut self, bounds: &Item, first: usize, count: usize) -> usize {
        self.add(Branch {
            bounds: *bounds,
            children: [0; 2],
            first: first as u32,
            count: count as u32,
            costs: [LEAF * bounds.half_area(); WIDTH - 1],
            left: [0; WIDTH],
            is_leaf: true,
        })
    }

    /// Adds a node over two others whose parts of the list lie side by side.
    pub(super) fn join(&mut self, children: [usize; 2]) -> usize {
        let [a, b] = children.map(|child| &self.nodes[child]);
        let mut left = [0; WIDTH];
        let mut parted = [0.0; WIDTH];
        for k in 1..WIDTH {
            // With k + 1 places: each child has one at least.
            let (mut best, mut places) = (a.costs[0] + b.costs[k - 1], 1);
            for own in 2..=k {
                let cost = a.costs[own - 1] + b.costs[k - own];
                if cost < best {
                    (best, places) = (cost, own as u8);
                }
            }
            (parted[k], left[k]) = (best, places);
        }
        let mut bounds = a.bounds;
        bounds.add(&b.bounds);
        let area = bounds.half_area();
        let count = a.count + b.count;
        let (leaf, node) = (LEAF * area, parted[WIDTH - 1] + area);
        let is_leaf = count as usize <= MAX_LEAF && leaf <= node;
        let mut costs = [if is_leaf { leaf } else { node }; WIDTH - 1];
        for k in 1..WIDTH - 1 {
            if parted[k] < costs[k - 1] {
                costs[k] = parted[k];
            } else {
                costs[k] = costs[k - 1];
                left[k] = 0;
            }
        }
        let first = a.first;
        self.add(Branch {
            bounds,
            children: children.map(|child| child as u32),
            first,
            count,
            costs,
            left,
            is_leaf,
        })
    }

    /// The box of a node.
    pub(super) fn bounds(&self, index: usize) -> &Item {
        &self.nodes[index].bounds
    }

    fn add(&mut self, branch: Branch) -> usize {
        self.nodes.push(branch);
        self.nodes.len() - 1
    }

    /// Appends the wide tree below a node, which lies at a depth, and notes the depth of what is
    /// deepest.
    pub(super) fn lay(
        &self,
        index: usize,
        depth: usize,
        nodes: &mut Vec<Node>,
        deepest: &mut usize,
    ) -> Child {
        let branch = &self.nodes[index];
        if branch.is_leaf {
            return Child::list(branch.first as usize, branch.count as usize);
        }
        *deepest = depth.max(*deepest);
        let mut below = Below {
            of: [0; WIDTH],
            count: 0,
        };
        self.open(index, WIDTH, &mut below);
        let below = &below.of[..below.count];
        let place = nodes.len();
        let mut node = Node::EMPTY;
        for (k, &child) in below.iter().enumerate() {
            node.set(k, &self.nodes[child].bounds.bounds(), Child::NONE);
        }
        node.sort();
        nodes.push(node);
        for (k, &child) in below.iter().enumerate() {
            let child = self.lay(child, depth + 1, nodes, deepest);
            nodes[place].child[k] = child;
        }
        Child::node(place)
    }

    /// Puts what is below a node into up to so many places.
    fn open(&self, index: usize, places: usize, below: &mut Below) {
        let branch = &self.nodes[index];
        let mut places = places;
        while places > 1 && branch.left[places - 1] == 0 {
            places -= 1;
        }
        if places == 1 {
            below.of[below.count] = index;
            below.count += 1;
            return;
        }
        let left = branch.left[places - 1] as usize;
        self.open(branch.children[0] as usize, left, below);
        self.open(branch.children[1] as usize, places - left, below);
    }
}

/// The children of a node.
struct Below {
    of: [usize; WIDTH],
    count: usize,
}
