//! From a list that can be cut in two to a wide tree, for any way of cutting.

use arrayvec::ArrayVec;
use rayon::prelude::*;

use super::super::node::{Child, MAX_LEAF, Node, WIDTH};
use super::super::wide::WideTree;
use super::collapse::Binary;
use super::item::Item;

/// Lists shorter than this are one task.
pub(super) const TASK: usize = 1 << 13;

/// A list of primitives that can be cut.
pub(super) trait Part: Sized + Send {
    /// Lists that are no longer are not cut.
    const SHORTEST: usize;

    /// How many primitives.
    fn count(&self) -> usize;

    /// The box around them.
    fn bounds(&self) -> &Item;

    /// Cuts a list that is longer than the shortest in two, neither empty.
    ///
    /// It keeps cuts + ⌈log₂ items⌉ ≤ [`MAX_DEPTH`](super::super::kernel::MAX_DEPTH): any cut keeps
    /// that below the limit, halving keeps it at the limit.
    fn cut(self) -> [Self; 2];

    /// Appends the numbers of the primitives.
    fn write(&self, numbers: &mut Vec<u32>);
}

/// Builds the tree over a list, and the list of primitives that its leaves name.
pub(super) fn grow(list: impl Part) -> (WideTree, Vec<u32>) {
    if list.count() == 0 {
        return (WideTree::nothing(), Vec::new());
    }
    let mut grown = Grown::default();
    let root = grown.grow(list, 1);
    let tree = WideTree {
        root,
        nodes: grown.nodes,
        depth: grown.depth.max(1),
    };
    (tree, grown.numbers)
}

/// What is made so far.
#[derive(Default)]
struct Grown {
    nodes: Vec<Node>,
    numbers: Vec<u32>,
    depth: usize,
}

impl Grown {
    /// Appends the tree over a list; its node would lie at a depth.
    fn grow(&mut self, list: impl Part, depth: usize) -> Child {
        if list.count() < TASK {
            let mut binary = Binary::default();
            let root = halves(list, &mut binary, &mut self.numbers);
            return binary.lay(root, depth, &mut self.nodes, &mut self.depth);
        }
        self.depth = self.depth.max(depth);
        let lists = eight(list);
        let place = self.nodes.len();
        let mut node = Node::EMPTY;
        for (k, list) in lists.iter().enumerate() {
            node.set(k, &list.bounds().bounds(), Child::NONE);
        }
        node.sort();
        self.nodes.push(node);
        let branches: Vec<(Child, Self)> = Vec::from_iter(lists)
            .into_par_iter()
            .map(|list| {
                let mut grown = Self::default();
                let root = grown.grow(list, depth + 1);
                (root, grown)
            })
            .collect();
        let sum = |of: fn(&Self) -> usize| branches.iter().map(|(_, b)| of(b)).sum();
        self.nodes.reserve_exact(sum(|branch| branch.nodes.len()));
        self.numbers
            .reserve_exact(sum(|branch| branch.numbers.len()));
        for (k, (root, branch)) in branches.into_iter().enumerate() {
            let before = [self.nodes.len(), self.numbers.len()];
            self.nodes[place].child[k] = root.moved(before);
            self.nodes.extend(branch.nodes.into_iter().map(|mut node| {
                for (child, _) in node
                    .child
                    .iter_mut()
                    .zip(node.lower[0])
                    .filter(|(_, x)| *x < f32::INFINITY)
                {
                    *child = child.moved(before);
                }
                node
            }));
            self.numbers.extend(branch.numbers);
            self.depth = self.depth.max(branch.depth);
        }
        Child::node(place)
    }
}

/// Cuts a list in two again and again, and adds what it becomes to a binary tree.
fn halves<P: Part>(list: P, binary: &mut Binary, numbers: &mut Vec<u32>) -> usize {
    let bounds = *list.bounds();
    if list.count() <= P::SHORTEST {
        let first = numbers.len();
        list.write(numbers);
        return binary.leaf(&bounds, first, list.count());
    }
    let children = list.cut().map(|list| halves(list, binary, numbers));
    binary.join(&bounds, children)
}

/// Cuts a list that is no leaf in up to eight: again and again the part with the largest surface.
fn eight<P: Part>(list: P) -> ArrayVec<P, WIDTH> {
    let mut lists = ArrayVec::new();
    // Of lists that are leaves, less than that of any other.
    let mut areas = ArrayVec::<f32, WIDTH>::new();
    let area = |list: &P| match list.count() {
        ..=MAX_LEAF => -1.0,
        _ => list.bounds().half_area(),
    };
    areas.push(area(&list));
    lists.push(list);
    while !lists.is_full() {
        let k = (1..lists.len()).fold(0, |a, b| if areas[b] > areas[a] { b } else { a });
        if areas[k] < 0.0 {
            break;
        }
        areas.swap_remove(k);
        for list in lists.swap_remove(k).cut() {
            areas.push(area(&list));
            lists.push(list);
        }
    }
    lists
}
