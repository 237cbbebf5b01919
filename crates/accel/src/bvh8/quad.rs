//! The triangles of leaves, side by side as the kernel wants them.

use arrayvec::ArrayVec;
use bytemuck::{Pod, Zeroable};
use ombra_geometry::{Point3, TriangleMesh};

use super::node::MAX_LEAF;

/// Ten components of four triangles.
pub(crate) const NUMBERS: usize = 4 * Quad::COMPONENTS;

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
    /// Components of a triangle.
    pub(crate) const COMPONENTS: usize = 10;

    /// The numbers of a leaf's triangles.
    pub(crate) fn triangles(quads: &[Self]) -> ArrayVec<u32, MAX_LEAF> {
        let places = 4 * quads.len();
        let number = |k: usize| {
            let at = (Self::COMPONENTS - 1) * places + k;
            quads[at / NUMBERS].numbers[at % NUMBERS].to_bits()
        };
        (0..places).map(number).filter(|&n| n != u32::MAX).collect()
    }

    /// Fills the quads of a leaf: one of up to four triangles, two of up to eight.
    pub(crate) fn lay(quads: &mut [Self], mesh: &TriangleMesh, triangles: &[u32]) {
        match quads {
            [one] => Self::fill::<4>(&mut [&mut one.numbers], mesh, triangles),
            [one, two] => {
                Self::fill::<8>(&mut [&mut one.numbers, &mut two.numbers], mesh, triangles);
            }
            _ => debug_assert!(false, "leaves have one quad or two"),
        }
    }

    /// Fills a leaf with so many places.
    #[inline(always)]
    fn fill<const PLACES: usize>(
        quads: &mut [&mut [f32; NUMBERS]],
        mesh: &TriangleMesh,
        triangles: &[u32],
    ) {
        // How many components one quad holds.
        let components = NUMBERS / PLACES;
        for k in 0..PLACES {
            let mut put = |component: usize, number: f32| {
                quads[component / components][component % components * PLACES + k] = number;
            };
            let number = triangles.get(k).copied();
            let corners = match number {
                Some(triangle) => mesh.corners(triangle as usize),
                None => [Point3::new(f32::NAN, f32::NAN, f32::NAN); 3],
            };
            for (corner, point) in corners.into_iter().enumerate() {
                for (axis, coordinate) in point.to_array().into_iter().enumerate() {
                    put(3 * corner + axis, coordinate);
                }
            }
            put(9, f32::from_bits(number.unwrap_or(u32::MAX)));
        }
    }
}
