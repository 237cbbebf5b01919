//! What a ray needs to be tested against boxes, eight at once; `ray.rs` says why no box is missed.

use super::ray::{LEAST, Near, PAD, PAD_AT};

/// A ray made ready for boxes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoxRay {
    /// Where the ray meets plane p of an axis: p · `inverse` + `near`, or + `far` for the side where
    /// it leaves a box. The fourth numbers mean nothing; so below.
    pub(super) inverse: [f32; 4],
    pub(super) near: [f32; 4],
    pub(super) far: [f32; 4],
    /// Where in a node the planes begin at which the ray enters boxes, by axis, in numbers; and those
    /// at which it leaves them.
    pub(super) enter: [u32; 3],
    pub(super) leave: [u32; 3],
    /// Bit k: the direction's component k is negative.
    pub(super) octant: u32,
    pub(super) t_min: f32,
}

impl BoxRay {
    /// `None` if boxes are to be tested in double precision. No number is NaN; what is infinite is not
    /// near, or too large.
    #[inline(always)]
    pub(super) fn new(
        [ox, oy, oz]: [f32; 3],
        [dx, dy, dz]: [f32; 3],
        t_min: f32,
        near: &Near,
    ) -> Option<Self> {
        // Four lanes each, so that one instruction sees to all.
        let (origin, direction) = ([ox, oy, oz, 0.0], [dx, dy, dz, 1.0]);
        let away = largest(each(|k| (origin[k] - near.centre[k]).abs()));
        let size = each(|k| direction[k].abs());
        let unit = largest(size);
        let plain = (away <= near.limit) & (1e-10..=1e10).contains(&unit);
        if !plain {
            return None;
        }
        let at = largest(each(|k| origin[k].abs()));
        let pad = PAD * (away + near.half) + PAD_AT * at + f32::MIN_POSITIVE;
        let least = LEAST * unit;
        let larger = each(|k| if size[k] > least { size[k] } else { least });
        let inverse = each(|k| 1.0 / larger[k].copysign(direction[k]));
        let pad = each(|k| pad.copysign(direction[k]));
        let octant = [dx.to_bits() >> 31, dy.to_bits() >> 31, dz.to_bits() >> 31];
        Some(Self {
            inverse,
            near: each(|k| -(origin[k] + pad[k]) * inverse[k]),
            far: each(|k| -(origin[k] - pad[k]) * inverse[k]),
            enter: [24 * octant[0], 8 + 24 * octant[1], 16 + 24 * octant[2]],
            leave: [
                24 - 24 * octant[0],
                32 - 24 * octant[1],
                40 - 24 * octant[2],
            ],
            octant: octant[0] | octant[1] << 1 | octant[2] << 2,
            t_min,
        })
    }
}

/// Four numbers by their places.
#[inline(always)]
fn each(of: impl Fn(usize) -> f32) -> [f32; 4] {
    [of(0), of(1), of(2), of(3)]
}

/// The largest of the first three.
#[inline(always)]
fn largest([x, y, z, _]: [f32; 4]) -> f32 {
    let larger = |a: f32, b: f32| if a > b { a } else { b };
    larger(larger(x, y), z)
}
