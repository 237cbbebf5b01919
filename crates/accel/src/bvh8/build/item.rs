//! What the builder sees of a primitive: a box and a number, made for vector instructions.

use ombra_geometry::{Aabb, Point3};

/// A box and a number. Lanes 0 to 2 hold the lowest corner, lanes 4 to 6 the highest with its sign
/// changed: so the union of two boxes is the smaller of each lane, one instruction. Lane 3 holds the
/// number as bits; as a single it is mostly too small to be normal, and sums and products of such take
/// long, so lane 7 is NaN, which makes NaN of every sum that has both.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Item {
    pub(crate) lanes: [f32; 8],
}

impl Item {
    /// Around nothing.
    pub(crate) const EMPTY: Self = Self {
        lanes: [f32::INFINITY; 8],
    };

    pub(crate) fn new(bounds: &Aabb, primitive: u32) -> Self {
        let (min, max) = (bounds.min, bounds.max);
        let number = f32::from_bits(primitive);
        Self {
            lanes: [
                min.x,
                min.y,
                min.z,
                number,
                -max.x,
                -max.y,
                -max.z,
                f32::NAN,
            ],
        }
    }

    /// Which primitive.
    #[inline(always)]
    pub(crate) const fn primitive(&self) -> u32 {
        self.lanes[3].to_bits()
    }

    pub(crate) const fn bounds(&self) -> Aabb {
        let [a, b, c, _, x, y, z, _] = self.lanes;
        Aabb {
            min: Point3::new(a, b, c),
            max: Point3::new(-x, -y, -z),
        }
    }

    /// Grows to hold another box; the number means nothing any more.
    #[inline(always)]
    pub(crate) fn add(&mut self, other: &Self) {
        // Not `f32::min`: boxes have no NaN, and without care for it this is one instruction.
        for k in 0..8 {
            let (a, b) = (self.lanes[k], other.lanes[k]);
            self.lanes[k] = if b < a { b } else { a };
        }
    }

    /// Grows to hold the middle of another box, in lanes that hold twice the coordinates.
    #[inline(always)]
    pub(crate) fn add_centre(&mut self, of: &Self) {
        for k in 0..4 {
            let twice = of.lanes[k] - of.lanes[k + 4];
            let (a, b) = (self.lanes[k], self.lanes[k + 4]);
            self.lanes[k] = if twice < a { twice } else { a };
            self.lanes[k + 4] = if -twice < b { -twice } else { b };
        }
    }

    /// Twice the middle, along one axis.
    #[inline(always)]
    pub(crate) fn twice_centre(&self, axis: usize) -> f32 {
        self.lanes[axis] - self.lanes[axis + 4]
    }

    /// Half the surface; not for what is around nothing.
    #[inline(always)]
    pub(crate) fn half_area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|k| -self.lanes[k + 4] - self.lanes[k]);
        x * (y + z) + y * z
    }
}
