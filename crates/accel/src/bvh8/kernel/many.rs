//! Many rays: those that go much the same way together, the others in a stream.

use ombra_geometry::Ray;

use super::level::Lanes;
use super::packet::{PACKET, may_go_together, packet};
use super::ray::Near;
use super::stream::stream;
use super::walk::{Found, Tree, Word};

/// Walks with each of many rays, and tells the answers by the numbers of the rays, in no promised
/// order. `slow` is told which rays are not for the kernels.
///
/// # Safety
/// - As for [`walk`](super::walk::walk).
#[inline(always)]
pub(crate) unsafe fn many<L: Lanes, W: Word + Default>(
    tree: &Tree<'_>,
    near: &Near,
    rays: &[Ray],
    mut answer: impl FnMut(usize, Found),
    slow: &mut dyn FnMut(usize),
) {
    // Rays from here to the present ones have nothing to do with one another.
    let mut alone = 0;
    let (packets, _) = rays.as_chunks::<PACKET>();
    for (number, together) in packets.iter().enumerate() {
        let first = number * PACKET;
        // SAFETY: the caller's promise.
        let traced = may_go_together(together, near)
            && unsafe { packet::<L, W>(tree, near, together, |k, found| answer(first + k, found)) };
        if traced {
            if alone < first {
                let rays = &rays[alone..first];
                // SAFETY: the caller's promise.
                unsafe {
                    stream::<L, W>(
                        tree,
                        near,
                        rays,
                        |k, found| answer(alone + k, found),
                        &mut |k| slow(alone + k),
                    );
                }
            }
            alone = first + PACKET;
        }
    }
    if alone < rays.len() {
        // SAFETY: the caller's promise.
        unsafe {
            stream::<L, W>(
                tree,
                near,
                &rays[alone..],
                |k, found| answer(alone + k, found),
                &mut |k| slow(alone + k),
            );
        }
    }
}
