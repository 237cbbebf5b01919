//! The linear BVH: primitives sorted along a curve that fills space, cut where its digits change.
//!
//! Lauterbach et al., "Fast BVH Construction on GPUs", Eurographics 2009: the tree is the radix
//! tree of the Morton codes. Karras, "Maximizing Parallelism in the Construction of BVHs, Octrees,
//! and k-d Trees", HPG 2012, section 4: runs of equal codes are cut as if the position in the list
//! were appended to the code; here they are halved, which is the same but for the place of the cut.

use ombra_geometry::{Aabb, Point3};
use rayon::prelude::*;

use super::{Builder, centre_bounds};
use crate::Bounded;

/// Bits a coordinate: three times 21 are 63.
const BITS: u32 = 21;

/// Cuts where the Morton codes of the centres change their highest digit.
#[derive(Clone, Copy, Debug)]
pub enum Lbvh {}

/// A primitive with the Morton code of its centre.
#[derive(Clone, Copy, Debug)]
pub struct Coded {
    code: u64,
    bounded: Bounded,
}

impl Builder for Lbvh {
    type Item = Coded;

    fn items(primitives: &[Bounded]) -> Vec<Coded> {
        let centres = centre_bounds(primitives);
        let coded = |&bounded: &Bounded| Coded {
            code: morton_code(bounded.bounds.centre(), &centres),
            bounded,
        };
        let mut items: Vec<_> = primitives.par_iter().map(coded).collect();
        items.par_sort_unstable_by_key(|item| (item.code, item.bounded.primitive));
        items
    }

    fn bounded(item: &Coded) -> &Bounded {
        &item.bounded
    }

    fn split(items: &mut [Coded]) -> Option<usize> {
        let (first, last) = (items.first()?.code, items.last()?.code);
        let highest = (first ^ last).checked_ilog2()?;
        Some(items.partition_point(|item| item.code >> highest & 1 == 0))
    }
}

/// Where a point lies along the Morton curve through a box: the bits of its coordinates, interleaved.
fn morton_code(point: Point3, within: &Aabb) -> u64 {
    let (point, within) = (point.wide(), within.wide());
    let cells = f64::from(1 << BITS);
    // One scale for all axes, so that cells are cubes.
    let scale = cells / within.extent().max_norm();
    let offset = point - within.min;
    let cell = |offset: f64| {
        // An extent of 0 makes NaN, which converts to 0.
        ((offset * scale) as u64).min((1 << BITS) - 1)
    };
    spread(cell(offset.x)) << 2 | spread(cell(offset.y)) << 1 | spread(cell(offset.z))
}

/// Moves bit i of a 21-bit number to bit 3i.
const fn spread(x: u64) -> u64 {
    let x = (x | x << 32) & 0x001f_0000_0000_ffff;
    let x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    let x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    let x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreading_moves_every_bit_to_its_place() {
        for bit in 0..BITS {
            assert_eq!(spread(1 << bit), 1 << (3 * bit));
        }
        assert_eq!(spread((1 << BITS) - 1).count_ones(), BITS);
    }

    #[test]
    fn codes_run_from_corner_to_corner() {
        let cube = Aabb::around([Point3::ORIGIN, Point3::new(1.0, 1.0, 1.0)]);
        assert_eq!(morton_code(cube.min, &cube), 0);
        assert_eq!(morton_code(cube.max, &cube), (1 << 63) - 1);
        let point = Aabb::around([cube.max]);
        assert_eq!(morton_code(cube.max, &point), 0);
    }
}
