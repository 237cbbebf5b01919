//! Whether more polygons make a difference to a tile.
//!
//! Far from a tower its shadow falls where the sun is low, and there others stand before the sun anyway. So only the arcs that
//! the tower covers at all are looked at: what the others cover of them, and whether that is more with the tower.

use arrayvec::ArrayVec;

use super::bits::bits;
use super::dispatch::Job;
use super::lanes::Lanes;
use super::walk::{Waiting, clear, walk};
use crate::cover::Cover;
use crate::tile::PLACES;
use crate::ways::TOGETHER;

/// For which tiles `more` covers anything of an arc, for any place, that the occluders of the job do not cover: bit k is set for tile k.
///
/// # Safety
/// - The processor has the instructions of both.
#[inline(always)]
pub(super) unsafe fn differs<N: Lanes, P: Lanes>(
    job: Job<'_>,
    covers: &mut [Cover],
    waiting: &mut Vec<Waiting>,
) -> u32 {
    let Job {
        occluders,
        more: Some(more),
        ways,
        tiles,
    } = job
    else {
        return 0;
    };
    let count = ways.list().len();
    let covers = &mut covers[..count * tiles.len()];
    clear(ways, covers);
    // SAFETY: the caller's promise.
    unsafe { walk::<N, P>(more, ways, tiles, covers, waiting) };
    let mut asked = 0;
    for (cover, way) in covers.iter_mut().zip(ways.list().iter().cycle()) {
        asked |= ask(cover, way.len());
    }
    if asked == 0 {
        return 0;
    }
    // SAFETY: the caller's promise.
    unsafe { walk::<N, P>(occluders, ways, tiles, covers, waiting) };
    // What is covered wholly cannot be covered more.
    let left: ArrayVec<u64, TOGETHER> = covers.iter().map(|cover| !cover.full).collect();
    if left.iter().all(|&left| left == 0) {
        return 0;
    }
    let shares = |covers: &[Cover]| -> Vec<[[f64; PLACES]; 2]> {
        let each = covers.iter().zip(&left);
        each.flat_map(|(cover, &left)| bits(left).map(|arc| cover.shares(arc)))
            .collect()
    };
    let without = shares(covers);
    // SAFETY: the caller's promise.
    unsafe { walk::<N, P>(more, ways, tiles, covers, waiting) };
    let with = shares(covers);
    let mut pairs = without.iter().zip(&with);
    let mut found = 0;
    for (index, left) in left.iter().enumerate() {
        for _ in bits(*left) {
            let is_more = pairs.next().is_some_and(|(without, with)| without != with);
            found |= u32::from(is_more) << (index / count);
        }
    }
    found
}

/// Makes a cover ready to be asked about what it holds: nothing is covered of those arcs of those places of which it covers anything,
/// and all else is. Gives the arcs.
fn ask(cover: &mut Cover, arcs: usize) -> u64 {
    let mut asked = 0;
    let mut places = [[1.0_f32; PLACES]; crate::way::MOST];
    for (arc, places) in places.iter_mut().enumerate().take(arcs) {
        let [ends, pieces] = cover.shares(arc);
        for place in 0..PLACES {
            // Even a share too small to be counted.
            let is_touched = ends[place] > 0.0
                || pieces[place] > 0.0
                || cover.before[arc][place] > 0.0
                || cover.after[arc][place] < 1.0;
            if is_touched {
                places[place] = 0.0;
                asked |= 1 << arc;
            }
        }
    }
    cover.clear(arcs);
    for arc in bits(asked) {
        cover.before[arc] = places[arc];
    }
    cover.full |= !asked;
    asked
}
