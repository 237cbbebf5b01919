//! Whether more polygons make a difference to a tile.
//!
//! Far from a tower its shadow falls where the sun is low, and there others stand before the sun anyway. So only the arcs that
//! the tower covers at all are looked at: what the others cover of them, and whether that is more with the tower. Of those that are known to be
//! dark there is nothing to look at.

use arrayvec::ArrayVec;

use super::bits::bits;
use super::dispatch::Job;
use super::lanes::Lanes;
use super::walk::{Waiting, clear, walk};
use crate::cover::Cover;
use crate::occluder::Occluders;
use crate::tile::PLACES;
use crate::way::{MOST, Way};
use crate::ways::TOGETHER;

/// For which tiles `more` covers anything of an arc, for any place, that the occluders of the job do not cover: bit k is set for tile k.
///
/// `dark` are, by way of each tile, arcs that the occluders covered wholly for all places while what is `gone`, which is a part of `more`, was among
/// them. Where that covers nothing of an arc they still do, and nobody needs to look again.
///
/// # Safety
/// - The processor has the instructions of both.
#[inline(always)]
pub(super) unsafe fn differs<N: Lanes, P: Lanes>(
    job: Job<'_>,
    gone: &Occluders,
    dark: &[u64],
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
    let lengths = || ways.list().iter().map(Way::len).cycle();
    let mut dark: ArrayVec<u64, TOGETHER> = dark.iter().copied().collect();
    if !gone.is_empty() {
        clear(ways, covers);
        // SAFETY: the caller's promise.
        unsafe { walk::<N, P>(gone, ways, tiles, covers, waiting) };
        for ((dark, cover), arcs) in dark.iter_mut().zip(&*covers).zip(lengths()) {
            *dark &= !touched(cover, arcs);
        }
    }
    clear(ways, covers);
    // SAFETY: the caller's promise.
    unsafe { walk::<N, P>(more, ways, tiles, covers, waiting) };
    let mut is_full = true;
    for ((dark, cover), arcs) in dark.iter().zip(&mut *covers).zip(lengths()) {
        ask(cover, arcs);
        cover.full |= dark;
        is_full &= cover.full == u64::MAX;
    }
    if is_full {
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

/// The arcs of which anything is covered for any place.
fn touched(cover: &Cover, arcs: usize) -> u64 {
    (0..arcs).fold(0, |touched, arc| {
        touched | (u64::from(covered(cover, arc).contains(&true)) << arc)
    })
}

/// For which places anything of an arc is covered, even a share too small to be counted.
fn covered(cover: &Cover, arc: usize) -> [bool; PLACES] {
    let mut pieces = [0.0; PLACES];
    if cover.in_pieces >> arc & 1 == 1 {
        pieces = cover.shares(arc)[1];
    }
    std::array::from_fn(|place| {
        cover.before[arc][place] > 0.0 || cover.after[arc][place] < 1.0 || pieces[place] > 0.0
    })
}

/// Makes a cover ready to be asked about what it holds: nothing is covered of those arcs of those places of which it covers anything,
/// and all else is.
fn ask(cover: &mut Cover, arcs: usize) {
    let mut asked = 0;
    let mut places = [[1.0_f32; PLACES]; MOST];
    for (arc, places) in places.iter_mut().enumerate().take(arcs) {
        let covered = covered(cover, arc);
        for (place, is_covered) in places.iter_mut().zip(covered) {
            if is_covered {
                *place = 0.0;
                asked |= 1 << arc;
            }
        }
    }
    cover.clear(arcs);
    for arc in bits(asked) {
        cover.before[arc] = places[arc];
    }
    cover.full |= !asked;
}
