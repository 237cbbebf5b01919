//! Many rays: those that go much the same way together, the others in a stream.
//!
//! Rays come in the order in which somebody thought of them, of pixels for example: neighbours are
//! tried first, [`PACKET`] at a time. Of the others those that start off in the same octant and along
//! the same axis are put next to each other, and tried again. Whether rays go together the packet
//! itself decides.

use ombra_geometry::Ray;

use super::layout::Layout;
use super::level::Lanes;
use super::packet::{PACKET, may_go_together, octant, packet};
use super::ray::Near;
use super::stream::stream;
use super::walk::{Found, Tree, Word};

/// Rays that are looked at at once.
const BLOCK: usize = 2048;

/// Eight octants by three axes, and room for a fourth, since numbers have two bits.
const KINDS: usize = 32;

/// Walks with each of many rays, and tells the answers by the numbers of the rays, in no promised
/// order. `slow` is told which rays are not for the kernels.
///
/// # Safety
/// - As for [`walk`](super::walk::walk).
#[inline(always)]
pub(crate) unsafe fn many<L: Lanes, Y: Layout, W: Word + Default>(
    tree: &Tree<Y>,
    near: &Near,
    rays: &[Ray],
    mut answer: impl FnMut(usize, Found),
    slow: &mut dyn FnMut(usize),
) {
    let mut kinds = [0_u8; BLOCK];
    let (mut left, mut sorted) = ([0_u16; BLOCK], [0_u16; BLOCK]);
    let numbers: [u16; BLOCK] = std::array::from_fn(|k| k as u16);
    for (number, block) in rays.chunks(BLOCK).enumerate() {
        let first = number * BLOCK;
        let mut answer = |k: usize, found| answer(first + k, found);
        for (k, ray) in block.iter().enumerate() {
            kinds[k] = kind_of(ray);
        }
        let mut count = 0;
        for chosen in numbers[..block.len()].chunks(PACKET) {
            let kinds = &kinds[usize::from(chosen[0])..][..chosen.len()];
            // SAFETY: the caller's promise; so below.
            let traced = kinds.iter().all(|kind| *kind == kinds[0])
                && unsafe { together::<L, Y, W>(tree, near, block, chosen, &mut answer) };
            if !traced {
                left[count..count + chosen.len()].copy_from_slice(chosen);
                count += chosen.len();
            }
        }
        let ends = sort(&left[..count], &kinds, &mut sorted);
        let mut begin = 0;
        count = 0;
        for end in ends {
            for chosen in sorted[begin..end].chunks(PACKET) {
                // SAFETY: as above.
                let traced = unsafe { together::<L, Y, W>(tree, near, block, chosen, &mut answer) };
                if !traced {
                    left[count..count + chosen.len()].copy_from_slice(chosen);
                    count += chosen.len();
                }
            }
            begin = end;
        }
        // SAFETY: as above.
        unsafe {
            stream::<L, Y, W>(tree, near, block, &left[..count], answer, &mut |k| {
                slow(first + k);
            });
        }
    }
}

/// Walks with the chosen rays together; no, and nothing done, if they do not go the same way. Not a
/// closure: it would not have the level's instructions.
///
/// # Safety
/// - As for [`many`].
#[inline(always)]
unsafe fn together<L: Lanes, Y: Layout, W: Word>(
    tree: &Tree<Y>,
    near: &Near,
    rays: &[Ray],
    chosen: &[u16],
    answer: &mut impl FnMut(usize, Found),
) -> bool {
    match <&[u16; PACKET]>::try_from(chosen) {
        Ok(chosen) if may_go_together(rays, chosen, near) => {
            // SAFETY: the caller's promise.
            unsafe { packet::<L, Y, W>(tree, near, rays, chosen, answer) }
        }
        _ => false,
    }
}

/// The octant of a ray and its dominant axis.
#[inline(always)]
fn kind_of(ray: &Ray) -> u8 {
    octant(ray) as u8 | (ray.direction.dominant_axis() as u8) << 3
}

/// Puts rays of one kind next to each other, otherwise as they come, and says where each kind ends.
#[inline(always)]
fn sort(left: &[u16], kinds: &[u8; BLOCK], sorted: &mut [u16; BLOCK]) -> [usize; KINDS] {
    let mut ends = [0_usize; KINDS];
    for &k in left {
        ends[usize::from(kinds[usize::from(k)])] += 1;
    }
    let mut sum = 0;
    for end in &mut ends {
        let count = *end;
        *end = sum;
        sum += count;
    }
    for &k in left {
        let end = &mut ends[usize::from(kinds[usize::from(k)])];
        sorted[*end] = k;
        *end += 1;
    }
    ends
}
