//! The bounding volume hierarchy: boxes within boxes.
//!
//! Made in three steps, each a value of its own:
//! 1. a [`Builder`] cuts the list of primitives in two again and again, down to single ones (`build`);
//! 2. small subtrees become leaves where the surface area heuristic says so (`collapse`);
//! 3. the result is written as one flat array (`layout`), along which rays walk (`traverse`).

mod build;
mod collapse;
mod lanes;
mod layout;
mod traverse;
mod validate;

use std::marker::PhantomData;
use std::ops::ControlFlow;

use crate::{Bounded, Reach, Structure, TraversalRay, Visitor};
use layout::Layout;

pub use build::{Builder, Lbvh, Median, Sah};
pub use validate::{BvhStatistics, InvalidBvh};

/// No leaf lies deeper than this many levels below the root, whatever was built: a builder that
/// comes near halves what is left. So the stack of a traversal has a fixed size.
const MAX_DEPTH: usize = 64;

/// A bounding volume hierarchy, made by the builder `B`.
#[derive(Clone, Debug)]
pub struct Bvh<B = Sah> {
    layout: Layout,
    builder: PhantomData<B>,
}

impl<B: Builder> Bvh<B> {
    /// Checks the tree against the primitives that it was built over, and measures it.
    ///
    /// # Errors
    /// The first thing found wrong; a tree that [`Structure::build`] made has nothing wrong.
    pub fn validate(&self, primitives: &[Bounded]) -> Result<BvhStatistics, InvalidBvh> {
        validate::validate(&self.layout, primitives)
    }
}

impl<B: Builder> Structure for Bvh<B> {
    fn build(primitives: &[Bounded], _reach: &Reach) -> Self {
        let binary = build::grow::<B>(primitives);
        let is_leaf = collapse::leaves(&binary);
        Self {
            layout: Layout::new(binary, &is_leaf),
            builder: PhantomData,
        }
    }

    #[inline]
    fn traverse<V: Visitor>(&self, ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()> {
        self.layout.traverse(ray, visitor)
    }

    fn bytes(&self) -> usize {
        self.layout.bytes()
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use ombra_geometry::{Aabb, Point3};

    pub(crate) fn bounded(boxes: impl IntoIterator<Item = Aabb>) -> Vec<Bounded> {
        (0..)
            .zip(boxes)
            .map(|(primitive, bounds)| Bounded { bounds, primitive })
            .collect()
    }

    fn cube(centre: [f32; 3], half: f32) -> Aabb {
        let [x, y, z] = centre;
        Aabb::around([
            Point3::new(x - half, y - half, z - half),
            Point3::new(x + half, y + half, z + half),
        ])
    }

    /// A fixed sequence of numbers in [0, 1) without a pattern (Steele et al. 2014, SplitMix).
    pub(crate) fn scattered(count: u32) -> impl Iterator<Item = Aabb> {
        let number = |i: u32| {
            let mut z = u64::from(i)
                .wrapping_add(1)
                .wrapping_mul(0x9e37_79b9_7f4a_7c15);
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((z ^ (z >> 31)) >> 40) as f32 / 16_777_216.0
        };
        (0..count).map(move |i| cube([3 * i, 3 * i + 1, 3 * i + 2].map(number), 0.003))
    }

    pub(crate) fn hostile() -> Vec<(&'static str, Vec<Bounded>)> {
        let many = 5000;
        let power = |i: i32| 2.0_f32.powi(i);
        vec![
            ("nothing", vec![]),
            ("one", bounded([cube([1.0, 2.0, 3.0], 0.5)])),
            ("two", bounded(scattered(2))),
            ("all the same", bounded(vec![cube([0.0; 3], 1.0); many])),
            ("points", bounded(vec![cube([1e7; 3], 0.0); many])),
            (
                "one centre",
                bounded((0..many).map(|i| cube([0.0; 3], i as f32))),
            ),
            (
                "a line",
                bounded((0..many).map(|i| cube([i as f32, 0.0, 0.0], 0.1))),
            ),
            (
                "ever smaller",
                bounded((-120..120).map(|i| cube([power(i); 3], 0.0))),
            ),
            (
                "ever smaller, many times",
                bounded((0..many).map(|i| cube([power(i as i32 % 120 - 60), 0.0, 0.0], 0.0))),
            ),
            (
                "the ends of the number range",
                bounded((0..100).map(|i| cube([(i as f32 - 50.0) * 6e36; 3], 1e37))),
            ),
            (
                "the smallest numbers",
                bounded((0..100).map(|i| cube([f32::from_bits(i); 3], 0.0))),
            ),
            ("scattered", bounded(scattered(20_000))),
        ]
    }

    fn built<B: Builder>(primitives: &[Bounded]) -> (Bvh<B>, BvhStatistics) {
        let all = primitives
            .iter()
            .fold(Aabb::EMPTY, |all, p| all.union(p.bounds));
        let bvh = Bvh::<B>::build(primitives, &Reach::of(&all));
        let statistics = bvh.validate(primitives);
        (bvh, statistics.unwrap())
    }

    fn every_hostile_list_makes_a_valid_tree<B: Builder>() {
        for (name, primitives) in hostile() {
            let (_, statistics) = built::<B>(&primitives);
            assert!(statistics.depth <= MAX_DEPTH, "{name}: {statistics:?}");
            assert_eq!(statistics.leaves == 0, primitives.is_empty(), "{name}");
        }
    }

    #[test]
    fn every_hostile_list_makes_a_valid_tree_of_medians() {
        every_hostile_list_makes_a_valid_tree::<Median>();
    }

    #[test]
    fn every_hostile_list_makes_a_valid_tree_by_surface_area() {
        every_hostile_list_makes_a_valid_tree::<Sah>();
    }

    #[test]
    fn every_hostile_list_makes_a_valid_tree_of_morton_codes() {
        every_hostile_list_makes_a_valid_tree::<Lbvh>();
    }

    fn the_tree_is_the_same_for_any_number_of_threads<B: Builder>() {
        let primitives = bounded(scattered(100_000));
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.unwrap().install(|| built::<B>(&primitives).0.layout)
        };
        assert!(with(1) == with(4));
    }

    #[test]
    fn trees_are_the_same_for_any_number_of_threads() {
        the_tree_is_the_same_for_any_number_of_threads::<Median>();
        the_tree_is_the_same_for_any_number_of_threads::<Sah>();
        the_tree_is_the_same_for_any_number_of_threads::<Lbvh>();
    }

    #[test]
    fn the_surface_area_heuristic_makes_the_cheapest_tree_of_uneven_primitives() {
        let uneven = scattered(5000).zip(0..).map(|(small, i)| {
            let far = cube(
                [0.01 * i as f32, 0.0, 9.0],
                if i % 50 == 0 { 2.0 } else { 0.01 },
            );
            if i % 2 == 0 { far } else { small }
        });
        let primitives = bounded(uneven);
        let cost = [
            built::<Sah>(&primitives).1.sah_cost,
            built::<Median>(&primitives).1.sah_cost,
            built::<Lbvh>(&primitives).1.sah_cost,
        ];
        assert!(cost[0] < cost[1] && cost[0] < cost[2], "{cost:?}");
    }
}
