//! The triangles of leaves, side by side as the kernel wants them.

use bytemuck::{Pod, Zeroable};
use ombra_geometry::TriangleMesh;

/// Ten components of four triangles.
pub(crate) const NUMBERS: usize = 40;

/// Four triangles, component by component: `numbers[4 c + k]` is component `c` of triangle `k`.
/// Components 0 to 8 are the three corners' x, y and z, component 9 is the number of the triangle
/// as bits. A leaf of up to eight triangles is two quads that are read as one list with eight a
/// component, `numbers[8 c + k]`.
///
/// A place without a triangle has NaN corners: no test says that a ray crosses it.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(32))]
pub(crate) struct Quad {
    pub(crate) numbers: [f32; NUMBERS],
}

const _: () = assert!(size_of::<Quad>() == 160);

impl Quad {
    const EMPTY: Self = Self {
        numbers: [f32::NAN; NUMBERS],
    };

    /// Appends the quads of a leaf, one or two, and says whether they are two.
    pub(crate) fn lay(quads: &mut Vec<Self>, mesh: &TriangleMesh, triangles: &[u32]) -> bool {
        let eight = triangles.len() > 4;
        let stride = if eight { 8 } else { 4 };
        let first = quads.len();
        quads.resize(first + stride / 4, Self::EMPTY);
        let mut put = |place: usize, number: f32| {
            let at = place / NUMBERS;
            quads[first + at].numbers[place % NUMBERS] = number;
        };
        for (k, &triangle) in triangles.iter().enumerate() {
            for (corner, point) in mesh.corners(triangle as usize).into_iter().enumerate() {
                for (axis, coordinate) in point.to_array().into_iter().enumerate() {
                    put(stride * (3 * corner + axis) + k, coordinate);
                }
            }
            put(stride * 9 + k, f32::from_bits(triangle));
        }
        for k in triangles.len()..stride {
            put(stride * 9 + k, f32::from_bits(u32::MAX));
        }
        eight
    }
}
