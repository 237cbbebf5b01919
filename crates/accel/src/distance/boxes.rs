//! How far boxes are from a point, eight at a time.
//!
//! # Why nothing is lost by rounding
//! A box must never seem farther away than what is in it.
//!
//! Where nothing is moved, that holds to the bit without an epsilon: an offset to a point in the box
//! lies, coordinate by coordinate, between the box's own two differences to the query point, since
//! rounding is monotone, and length is computed from coordinates by monotone steps in the same order.
//!
//! Where boxes are placed, each is replaced by the box of the world around it, and that is made
//! larger by what rounding in double precision can do. To place the middle m and the half extent h of
//! a box, or a point in it, rounds numbers no larger than Σ |M| c + |o|, with M the linear part, c
//! the largest coordinate of all boxes and o the translation less the query point; each of fewer than
//! 16 times, by half of ε. `PAD` is 16 ε. What M is not known to exactly matters to both sides alike.

use crate::Reach;
use crate::bvh8::{Node, WIDTH};
use crate::distance::Place;

/// See above.
const PAD: f64 = 16.0 * f64::EPSILON;

/// The boxes of a structure, as a point sees them.
pub(crate) enum Boxes {
    /// Where they are.
    Unmoved([f64; 3]),
    /// Placed: the rows of the linear part, each with the translation less the point, and the pad.
    Placed([([f64; 3], f64, f64); 3]),
}

impl Boxes {
    pub(crate) fn new(place: &Place<'_>, reach: &Reach) -> Self {
        let point = place.point.to_array();
        match place.placed {
            None => Self::Unmoved(point),
            Some(placed) => {
                let rows = placed.world_from_object.rows();
                Self::Placed(std::array::from_fn(|axis| {
                    let [x, y, z, offset] = rows[axis];
                    let moved = (x.abs() + y.abs() + z.abs()) * reach.coordinate();
                    let pad = PAD * (moved + offset.abs() + point[axis].abs());
                    ([x, y, z], offset - point[axis], pad)
                }))
            }
        }
    }

    /// No more than the distances to the children of a node. Of a child that is not there it means
    /// nothing; NaN is "may be near".
    #[inline]
    pub(crate) fn distances(&self, node: &Node) -> [f64; WIDTH] {
        let mut squared = [0.0; WIDTH];
        match self {
            Self::Unmoved(point) => {
                for ((point, lower), upper) in point.iter().zip(&node.lower).zip(&node.upper) {
                    for (k, squared) in squared.iter_mut().enumerate() {
                        let below = f64::from(lower[k]) - point;
                        let above = point - f64::from(upper[k]);
                        let off = larger(larger(below, above), 0.0);
                        *squared += off * off;
                    }
                }
            }
            Self::Placed(rows) => {
                let mut middle = [[0.0; WIDTH]; 3];
                let mut half = [[0.0; WIDTH]; 3];
                for axis in 0..3 {
                    for k in 0..WIDTH {
                        let lower = f64::from(node.lower[axis][k]);
                        let upper = f64::from(node.upper[axis][k]);
                        middle[axis][k] = 0.5 * (lower + upper);
                        half[axis][k] = 0.5 * (upper - lower);
                    }
                }
                for ([x, y, z], offset, pad) in rows {
                    for k in 0..WIDTH {
                        let at = x * middle[0][k] + y * middle[1][k] + z * middle[2][k] + offset;
                        let reach =
                            x.abs() * half[0][k] + y.abs() * half[1][k] + z.abs() * half[2][k];
                        let off = larger(at.abs() - reach - pad, 0.0);
                        squared[k] += off * off;
                    }
                }
            }
        }
        squared.map(f64::sqrt)
    }
}

/// Without care for NaN, so that it is one instruction.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
