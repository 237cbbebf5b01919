//! Along a curve through space: the quickest way to a tree.
//!
//! Lauterbach et al., "Fast BVH Construction on GPUs", Eurographics 2009: primitives are sorted by
//! the Morton codes of their centres, and lists are cut where the highest digit of the codes changes;
//! lists of one code are halved. Each digit of a code belongs to the axis along which cells are
//! longest so far (Vinkler, Bittner, Havran, "Extended Morton Codes for High Performance Bounding
//! Volume Hierarchy Construction", High-Performance Graphics 2017): a flat city has no digits to
//! spare for its height.

use rayon::prelude::*;

use super::super::kernel::MAX_DEPTH;
use super::super::node::MAX_LEAF;
use super::super::wide::WideTree;
use super::grow::{self, Part};
use super::item::Item;
use super::items::Items;
use super::radix;

/// Digits of a code.
const DIGITS: u32 = 32;
/// The most of one axis: singles have no more to tell.
const MOST: u32 = 20;

/// Builds the tree, and the list of primitives that its leaves name.
pub(crate) fn build(items: &Items) -> (WideTree, Vec<u32>) {
    let curve = Curve::new(&items.centres);
    let coded = items.list.par_iter().enumerate();
    let coded = coded.map(|(place, item)| u64::from(curve.code(item)) << 32 | place as u64);
    let sorted = radix::sort(coded.collect());
    grow::grow(List {
        items: &items.list,
        coded: &sorted,
        cuts: 0,
    })
}

/// A part of the sorted list.
struct List<'a> {
    items: &'a [Item],
    /// Codes, and below them places in the list of items.
    coded: &'a [u64],
    cuts: usize,
}

impl List<'_> {
    fn all(&self) -> impl Iterator<Item = &Item> {
        let item = |&coded: &u64| &self.items[coded as u32 as usize];
        self.coded.iter().map(item)
    }
}

impl Part for List<'_> {
    const SHORTEST: usize = MAX_LEAF;

    fn count(&self) -> usize {
        self.coded.len()
    }

    fn bounds(&self) -> Item {
        let mut bounds = Item::EMPTY;
        self.all().for_each(|item| bounds.add(item));
        bounds
    }

    /// To know the box would take a pass over the list.
    fn size(&self) -> f32 {
        self.coded.len() as f32
    }

    fn cut(self) -> [Self; 2] {
        let count = self.coded.len();
        let levels = count.next_power_of_two().ilog2() as usize;
        let code = |coded: u64| (coded >> 32) as u32;
        let differ = code(self.coded[0]) ^ code(self.coded[count - 1]);
        let at = match differ.checked_ilog2() {
            Some(digit) if self.cuts + levels < MAX_DEPTH => {
                let is_left = |&coded: &u64| code(coded) >> digit & 1 == 0;
                self.coded.partition_point(is_left)
            }
            _ => count / 2,
        };
        let (left, right) = self.coded.split_at(at);
        [left, right].map(|coded| Self {
            coded,
            cuts: self.cuts + 1,
            ..self
        })
    }

    fn write(&self, numbers: &mut Vec<u32>) {
        numbers.extend(self.all().map(Item::primitive));
    }
}

/// The curve through the box around all centres.
struct Curve {
    low: [f32; 3],
    scale: [f32; 3],
    /// The last cell of each axis.
    last: [u32; 3],
    /// By axis, by byte of a cell's number, by value: the digits of the code that it makes.
    digits: Box<[[[u32; 256]; BYTES]; 3]>,
}

/// Bytes of a cell's number.
const BYTES: usize = MOST.div_ceil(8) as usize;

impl Curve {
    fn new(centres: &Item) -> Self {
        let low = [0, 1, 2].map(|k| centres.lanes[k]);
        let mut cell = [0, 1, 2].map(|k| -centres.lanes[k + 4] - low[k]);
        let extent = cell;
        let mut bits = [0; 3];
        let mut places = [[0; MOST as usize]; 3];
        for place in (0..DIGITS).rev() {
            let usable = |k: &usize| bits[*k] < MOST && cell[*k] > 0.0 && cell[*k].is_finite();
            let Some(axis) = (0..3)
                .filter(usable)
                .reduce(|a, b| if cell[b] > cell[a] { b } else { a })
            else {
                break;
            };
            cell[axis] *= 0.5;
            // From the highest down.
            places[axis][bits[axis] as usize] = place;
            bits[axis] += 1;
        }
        let mut digits = Box::new([[[0; 256]; BYTES]; 3]);
        for axis in 0..3 {
            for bit in 0..bits[axis] {
                let digit = 1 << places[axis][(bits[axis] - 1 - bit) as usize];
                for value in (0..256).filter(|value| value >> (bit % 8) & 1 == 1) {
                    digits[axis][bit as usize / 8][value] |= digit;
                }
            }
        }
        let scale = [0, 1, 2].map(|k| {
            let scale = (1_u32 << bits[k]) as f32 / extent[k];
            if scale.is_finite() { scale } else { 0.0 }
        });
        Self {
            low,
            scale,
            last: bits.map(|bits| (1 << bits) - 1),
            digits,
        }
    }

    #[inline]
    fn code(&self, item: &Item) -> u32 {
        let mut code = 0;
        for axis in 0..3 {
            let cell = (item.twice_centre(axis) - self.low[axis]) * self.scale[axis];
            // What is NaN becomes 0.
            let cell = (cell as u32).min(self.last[axis]);
            for byte in 0..BYTES {
                code |= self.digits[axis][byte][(cell >> (8 * byte)) as usize & 255];
            }
        }
        code
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f32, y: f32, z: f32) -> Item {
        let point = ombra_geometry::Point3::new(x, y, z);
        Item::new(&ombra_geometry::Aabb::around([point]), 0)
    }

    #[test]
    fn codes_run_from_corner_to_corner() {
        let mut centres = Item::EMPTY;
        let corners = [point(0.0, -1.0, 2.0), point(8.0, 1.0, 3.0)];
        corners.iter().for_each(|corner| centres.add_centre(corner));
        let curve = Curve::new(&centres);
        assert_eq!(curve.code(&corners[0]), 0);
        assert_eq!(curve.code(&corners[1]), u32::MAX);
        // Its longest side is cut first, and again.
        assert_eq!(curve.code(&point(4.5, -1.0, 2.0)) >> 29, 0b100);
        assert_eq!(curve.code(&point(2.5, -1.0, 2.0)) >> 29, 0b010);
    }

    #[test]
    fn what_has_no_extent_has_one_code() {
        let mut centres = Item::EMPTY;
        centres.add_centre(&point(1e7, 0.0, 3.0));
        assert_eq!(Curve::new(&centres).code(&point(1e7, 0.0, 3.0)), 0);
    }
}
