//! Cuts where the surface area heuristic expects rays to cost least, tried at the borders of bins.
//!
//! Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", IEEE Symposium on
//! Interactive Ray Tracing 2007. Unlike there, all three axes are tried. Boxes and counts of bins
//! do not depend on the order in which primitives come, so neither does the tree on threads.

use ombra_geometry::{Aabb, Axis, Point3};
use rayon::prelude::*;

use super::Builder;
use crate::Bounded;
use crate::partition::{halve, partition};

/// Bins an axis, for many primitives and for few.
const BINS: usize = 16;
const FEW_BINS: usize = 8;
/// What few means.
const FEW: usize = 64;
/// Lists longer than this are put into bins by several threads.
const PARALLEL: usize = 1 << 16;

/// Cuts by the surface area heuristic.
#[derive(Clone, Copy, Debug)]
pub enum Sah {}

impl Builder for Sah {
    type Item = Bounded;

    fn items(primitives: &[Bounded]) -> Vec<Bounded> {
        primitives.to_vec()
    }

    fn bounded(item: &Bounded) -> &Bounded {
        item
    }

    fn split(items: &mut [Bounded]) -> Option<usize> {
        let centres = around_centres(items);
        if items.len() < 4 {
            return Some(halve(items, centres.extent().dominant_axis()));
        }
        let cut = if items.len() < FEW {
            best_cut::<FEW_BINS>(items, &centres)
        } else {
            best_cut::<BINS>(items, &centres)
        };
        let Some(cut) = cut else {
            return Some(halve(items, centres.extent().dominant_axis()));
        };
        Some(partition(items, |item| {
            cut.binning.bin(item.bounds.centre(), cut.axis) < cut.first_right
        }))
    }
}

/// A border between two bins.
struct Cut {
    axis: Axis,
    first_right: usize,
    binning: Binning,
}

/// The cheapest border: the least sum of half area · count over both sides. `None` if all centres
/// lie in one bin, or areas are beyond the range of numbers.
fn best_cut<const N: usize>(items: &[Bounded], centres: &Aabb) -> Option<Cut> {
    let binning = Binning::new::<N>(centres);
    let bins = fill::<N>(items, &binning);
    let mut best_cost = f32::INFINITY;
    let mut best = None;
    for (axis, bins) in Axis::ALL.into_iter().zip(&bins) {
        let mut right_cost = [0.0; N];
        let mut right = Bin::EMPTY;
        for i in (1..N).rev() {
            right.add(&bins[i]);
            right_cost[i] = right.cost();
        }
        let mut left = Bin::EMPTY;
        for i in 1..N {
            left.add(&bins[i - 1]);
            let cost = left.cost() + right_cost[i];
            if cost < best_cost && left.count > 0 && (left.count as usize) < items.len() {
                best_cost = cost;
                best = Some((axis, i));
            }
        }
    }
    best.map(|(axis, first_right)| Cut {
        axis,
        first_right,
        binning,
    })
}

/// Puts every item into one bin an axis.
fn fill<const N: usize>(items: &[Bounded], binning: &Binning) -> [[Bin; N]; 3] {
    if items.len() > PARALLEL {
        let (left, right) = items.split_at(items.len() / 2);
        let (mut bins, others) =
            rayon::join(|| fill::<N>(left, binning), || fill::<N>(right, binning));
        for (bin, other) in bins.iter_mut().flatten().zip(others.iter().flatten()) {
            bin.add(other);
        }
        return bins;
    }
    let mut bins = [[Bin::EMPTY; N]; 3];
    for item in items {
        let one = Bin::of(&item.bounds);
        let centre = item.bounds.centre();
        for (axis, bins) in Axis::ALL.into_iter().zip(&mut bins) {
            bins[binning.bin(centre, axis).min(N - 1)].add(&one);
        }
    }
    bins
}

/// The box around the centres.
fn around_centres(items: &[Bounded]) -> Aabb {
    let serial = |items: &[Bounded]| {
        let mut all = Bin::EMPTY;
        for item in items {
            let centre = item.bounds.centre();
            all.add(&Bin::of(&Aabb {
                min: centre,
                max: centre,
            }));
        }
        all
    };
    if items.len() <= PARALLEL {
        return serial(items).bounds();
    }
    items
        .par_chunks(PARALLEL)
        .map(serial)
        .reduce(
            || Bin::EMPTY,
            |mut a, b| {
                a.add(&b);
                a
            },
        )
        .bounds()
}

/// Which bin a centre lies in.
#[derive(Clone, Copy)]
struct Binning {
    min: Point3,
    scale: [f32; 3],
    last: usize,
}

impl Binning {
    fn new<const N: usize>(centres: &Aabb) -> Self {
        // An axis without extent makes an infinite scale; its centres give 0 · ∞, which converts
        // to bin 0. An extent beyond the range of numbers makes scale 0, and bin 0 for all.
        let scale = centres.extent().to_array().map(|extent| N as f32 / extent);
        Self {
            min: centres.min,
            scale,
            last: N - 1,
        }
    }

    #[inline]
    fn bin(&self, centre: Point3, axis: Axis) -> usize {
        let along = (centre[axis] - self.min[axis]) * self.scale[axis as usize];
        (along as i32 as usize).min(self.last)
    }
}

/// A box and how many primitives it is around. Four lanes a corner, the last one idle, so that the
/// compiler can use vector instructions.
#[derive(Clone, Copy)]
struct Bin {
    min: [f32; 4],
    max: [f32; 4],
    count: u32,
}

impl Bin {
    const EMPTY: Self = Self {
        min: [f32::INFINITY; 4],
        max: [f32::NEG_INFINITY; 4],
        count: 0,
    };

    #[inline]
    fn of(bounds: &Aabb) -> Self {
        let (min, max) = (bounds.min, bounds.max);
        Self {
            min: [min.x, min.y, min.z, 0.0],
            max: [max.x, max.y, max.z, 0.0],
            count: 1,
        }
    }

    #[inline]
    fn add(&mut self, other: &Self) {
        // Not `f32::min`: boxes have no NaN, and without care for it this is one instruction.
        for i in 0..4 {
            self.min[i] = if other.min[i] < self.min[i] {
                other.min[i]
            } else {
                self.min[i]
            };
            self.max[i] = if other.max[i] > self.max[i] {
                other.max[i]
            } else {
                self.max[i]
            };
        }
        self.count += other.count;
    }

    fn bounds(&self) -> Aabb {
        let [x, y, z, _] = self.min;
        let min = Point3::new(x, y, z);
        let [x, y, z, _] = self.max;
        let max = Point3::new(x, y, z);
        Aabb { min, max }
    }

    /// Half area · count; 0 if empty.
    #[inline]
    fn cost(&self) -> f32 {
        if self.count == 0 {
            return 0.0;
        }
        let [x, y, z] = std::array::from_fn(|i| self.max[i] - self.min[i]);
        (x * y + y * z + z * x) * self.count as f32
    }
}
