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
    fn bounds(&self) -> Item;

    /// How much it matters that a list is cut, far from the leaves.
    fn size(&self) -> f32;

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
    let (root, _) = grown.grow(list, 1);
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
    /// Appends the tree over a list; its node would lie at a depth. Says what box it has.
    fn grow(&mut self, list: impl Part, depth: usize) -> (Child, Item) {
        if list.count() < TASK {
            let mut binary = Binary::default();
            let root = halves(list, &mut binary, &mut self.numbers);
            let child = binary.lay(root, depth, &mut self.nodes, &mut self.depth);
            return (child, *binary.bounds(root));
        }
        self.depth = self.depth.max(depth);
        let lists = eight(list);
        let place = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        let branches: Vec<((Child, Item), Self)> = Vec::from_iter(lists)
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
        let mut node = Node::EMPTY;
        let mut bounds = Item::EMPTY;
        for (k, ((root, own), branch)) in branches.into_iter().enumerate() {
            let before = [self.nodes.len(), self.numbers.len()];
            bounds.add(&own);
            node.set(k, &own.bounds(), root.moved(before));
            self.nodes.extend(branch.nodes.into_iter().map(|mut node| {
                node.move_children(before);
                node
            }));
            self.numbers.extend(branch.numbers);
            self.depth = self.depth.max(branch.depth);
        }
        node.sort();
        self.nodes[place] = node;
        (Child::node(place), bounds)
    }
}

/// Cuts a list in two again and again, and adds what it becomes to a binary tree.
fn halves<P: Part>(list: P, binary: &mut Binary, numbers: &mut Vec<u32>) -> usize {
    if list.count() <= P::SHORTEST {
        let first = numbers.len();
        list.write(numbers);
        return binary.leaf(&list.bounds(), first, list.count());
    }
    let children = list.cut().map(|list| halves(list, binary, numbers));
    binary.join(children)
}

/// Cuts a list that is no leaf in up to eight: again and again the largest part.
fn eight<P: Part>(list: P) -> ArrayVec<P, WIDTH> {
    let mut lists = ArrayVec::new();
    // Of lists that are leaves, less than that of any other.
    let mut sizes = ArrayVec::<f32, WIDTH>::new();
    let size = |list: &P| match list.count() {
        ..=MAX_LEAF => -1.0,
        _ => list.size(),
    };
    sizes.push(size(&list));
    lists.push(list);
    while !lists.is_full() {
        let k = (1..lists.len()).fold(0, |a, b| if sizes[b] > sizes[a] { b } else { a });
        if sizes[k] < 0.0 {
            break;
        }
        sizes.swap_remove(k);
        for list in lists.swap_remove(k).cut() {
            sizes.push(size(&list));
            lists.push(list);
        }
    }
    lists
}
