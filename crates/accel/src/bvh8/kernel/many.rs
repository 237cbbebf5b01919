//! Many rays in one call.

use ombra_geometry::Ray;

use super::level::Lanes;
use super::ray::Near;
use super::stream::stream;
use super::walk::{Found, Tree, Word};

/// Rays that are looked at at once.
const BLOCK: usize = 2048;

/// The numbers of the rays of a block.
const NUMBERS: [u16; BLOCK] = {
    let mut numbers = [0; BLOCK];
    let mut k = 0;
    while k < BLOCK {
        numbers[k] = k as u16;
        k += 1;
    }
    numbers
};

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
    for (number, block) in rays.chunks(BLOCK).enumerate() {
        let first = number * BLOCK;
        let answer = |k: usize, found| answer(first + k, found);
        // SAFETY: the caller's promise.
        unsafe {
            stream::<L, W>(
                tree,
                near,
                block,
                &NUMBERS[..block.len()],
                answer,
                &mut |k| {
                    slow(first + k);
                },
            );
        }
    }
}
