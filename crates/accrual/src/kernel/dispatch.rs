//! One entry a level.

use ombra_accel::Level;
use ombra_geometry::Aabb;

use super::differs::differs;
use super::lanes::{Lanes, Pair, Portable};
use super::near::Nears;
use super::stretches::{Record, Seen, find};
use super::walk::{Waiting, clear, reaches, walk};
use super::whose::{Entry, Group, Whose, whose};
use crate::cover::Cover;
use crate::exact::TILES;
use crate::occluder::Occluders;
use crate::tile::{PLACES, Tile};
use crate::ways::{TOGETHER, Ways};

/// What a search needs besides, kept between searches.
#[derive(Debug)]
pub(crate) struct Room {
    covers: Vec<Cover>,
    waiting: Vec<Waiting>,
}

impl Room {
    pub(crate) fn new() -> Self {
        Self {
            covers: (0..TOGETHER).map(|_| Cover::new()).collect(),
            waiting: Vec::new(),
        }
    }

    /// Which arcs were covered wholly for all places, after [`add_seconds`]: of the ways of each tile, one tile after another.
    pub(crate) fn full(&self, index: usize) -> u64 {
        self.covers[index].full
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::super::lanes::{Avx2, Avx512};
    use super::*;

    /// # Safety
    /// - The processor has AVX2.
    #[target_feature(enable = "avx2")]
    pub(super) unsafe fn avx2(job: Job<'_>, room: &mut Room, seconds: &mut Seconds) {
        // SAFETY: the caller's promise.
        unsafe { add::<Avx2, Pair<Avx2>>(job, room, seconds) }
    }

    /// # Safety
    /// - The processor has AVX2 and AVX-512 F.
    #[target_feature(enable = "avx2,avx512f")]
    pub(super) unsafe fn avx512(job: Job<'_>, room: &mut Room, seconds: &mut Seconds) {
        // SAFETY: the caller's promise.
        unsafe { add::<Avx2, Avx512>(job, room, seconds) }
    }

    /// # Safety
    /// - The processor has AVX2.
    #[target_feature(enable = "avx2")]
    pub(super) unsafe fn may_cover(
        occluders: &Occluders,
        ways: &Ways,
        around: Aabb,
        full: u64,
        room: &mut Room,
    ) -> bool {
        // SAFETY: the caller's promise.
        unsafe { reaches::<Avx2>(occluders, ways, around, full, &mut room.waiting) }
    }

    /// # Safety
    /// - The processor has AVX2.
    #[target_feature(enable = "avx2")]
    pub(super) unsafe fn changes(
        job: Job<'_>,
        gone: &Occluders,
        dark: &[u64],
        room: &mut Room,
    ) -> u32 {
        // SAFETY: the caller's promise.
        unsafe { differs::<Avx2, Pair<Avx2>>(job, gone, dark, &mut room.covers, &mut room.waiting) }
    }

    /// # Safety
    /// - The processor has AVX2.
    #[target_feature(enable = "avx2")]
    pub(super) unsafe fn find_avx2(
        job: Job<'_>,
        room: &mut FindRoom,
        show: &mut dyn FnMut(&Shown<'_>),
    ) {
        // SAFETY: the caller's promise.
        unsafe { find_with::<Avx2, Pair<Avx2>>(job, room, show) }
    }

    /// # Safety
    /// - The processor has AVX2 and AVX-512 F.
    #[target_feature(enable = "avx2,avx512f")]
    pub(super) unsafe fn find_avx512(
        job: Job<'_>,
        room: &mut FindRoom,
        show: &mut dyn FnMut(&Shown<'_>),
    ) {
        // SAFETY: the caller's promise.
        unsafe { find_with::<Avx2, Avx512>(job, room, show) }
    }
}

/// Before what, on which ways, seen from where: of ways and tiles there are at most [`TOGETHER`], multiplied.
#[derive(Clone, Copy)]
pub(crate) struct Job<'a> {
    pub(crate) occluders: &'a Occluders,
    /// What covers the sun besides.
    pub(crate) more: Option<&'a Occluders>,
    pub(crate) ways: &'a Ways,
    pub(crate) tiles: &'a [Tile],
}

/// By way of each tile, one tile after another, how many seconds of it are covered for each place.
pub(crate) type Seconds = [[f64; PLACES]; TOGETHER];

/// Adds to the seconds how long each way is covered.
pub(crate) fn add_seconds(level: Level, job: Job<'_>, room: &mut Room, seconds: &mut Seconds) {
    match level {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: a level is one that this machine has.
        Level::Avx2 => unsafe { x86::avx2(job, room, seconds) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Level::Avx512 => unsafe { x86::avx512(job, room, seconds) },
        // SAFETY: every processor has these.
        _ => unsafe { add::<Portable, Pair<Portable>>(job, room, seconds) },
    }
}

/// Whether any polygon may cover anything of the ways, seen from anywhere in a box, but for the arcs that are covered wholly.
pub(crate) fn may_cover(
    level: Level,
    occluders: &Occluders,
    ways: &Ways,
    around: Aabb,
    full: u64,
    room: &mut Room,
) -> bool {
    match level {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: a level is one that this machine has, and with AVX-512 it has AVX2.
        Level::Avx2 | Level::Avx512 => unsafe {
            x86::may_cover(occluders, ways, around, full, room)
        },
        // SAFETY: every processor has these.
        _ => unsafe { reaches::<Portable>(occluders, ways, around, full, &mut room.waiting) },
    }
}

/// For which tiles of a job, by bits, `more` covers anything that its occluders do not cover anyway. See [`differs`].
pub(crate) fn changes(
    level: Level,
    job: Job<'_>,
    gone: &Occluders,
    dark: &[u64],
    room: &mut Room,
) -> u32 {
    match level {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Level::Avx2 | Level::Avx512 => unsafe { x86::changes(job, gone, dark, room) },
        // SAFETY: every processor has these.
        _ => unsafe {
            let (covers, waiting) = (&mut room.covers, &mut room.waiting);
            differs::<Portable, Pair<Portable>>(job, gone, dark, covers, waiting)
        },
    }
}

/// # Safety
/// - The processor has the instructions of both.
#[inline(always)]
unsafe fn add<N: Lanes, P: Lanes>(job: Job<'_>, room: &mut Room, seconds: &mut Seconds) {
    let Room { covers, waiting } = room;
    let ways = job.ways.list();
    let covers = &mut covers[..ways.len() * job.tiles.len()];
    clear(job.ways, covers);
    for occluders in [Some(job.occluders), job.more].into_iter().flatten() {
        // SAFETY: the caller's promise.
        unsafe { walk::<N, P>(occluders, job.ways, job.tiles, covers, waiting) };
    }
    let ways = ways.iter().cycle();
    for ((cover, way), seconds) in covers.iter().zip(ways).zip(seconds) {
        cover.add_seconds(&way.seconds, seconds);
    }
}

/// What a search for stretches needs besides, kept between searches.
#[derive(Debug)]
pub(crate) struct FindRoom {
    seen: Vec<Seen>,
    waiting: Vec<Waiting>,
    records: Vec<Record>,
    entries: Vec<Entry>,
    groups: Vec<Group>,
    nears: Vec<Nears>,
}

impl FindRoom {
    pub(crate) fn new() -> Self {
        Self {
            seen: (0..TILES).map(|_| Seen::new()).collect(),
            waiting: Vec::new(),
            records: Vec::new(),
            entries: Vec::new(),
            groups: Vec::new(),
            nears: Vec::new(),
        }
    }
}

/// What there is to know of one arc of one tile.
pub(crate) struct Shown<'a> {
    pub(crate) tile: usize,
    pub(crate) arc: usize,
    pub(crate) whose: Whose,
    /// Of all that is nearest to a place at any time it is among them, and something of another owner as well, if there is.
    pub(crate) entries: &'a [Entry],
    /// What the entries are of.
    pub(crate) records: &'a [Record],
    /// How near each of the entries is, if it is not plain for all places whose shadow it is.
    pub(crate) nears: &'a [Nears],
}

/// Finds what covers the way, which is the only one, for tiles: of each, one after another, each arc is shown in order.
pub(crate) fn find_stretches(
    level: Level,
    job: Job<'_>,
    room: &mut FindRoom,
    show: &mut dyn FnMut(&Shown<'_>),
) {
    match level {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: a level is one that this machine has.
        Level::Avx2 => unsafe { x86::find_avx2(job, room, show) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Level::Avx512 => unsafe { x86::find_avx512(job, room, show) },
        // SAFETY: every processor has these.
        _ => unsafe { find_with::<Portable, Pair<Portable>>(job, room, show) },
    }
}

/// # Safety
/// - The processor has the instructions of both.
#[inline(always)]
unsafe fn find_with<N: Lanes, P: Lanes>(
    job: Job<'_>,
    room: &mut FindRoom,
    show: &mut dyn FnMut(&Shown<'_>),
) {
    let FindRoom {
        seen,
        waiting,
        records,
        entries,
        groups,
        nears,
    } = room;
    let (occluders, tiles) = (job.occluders, job.tiles);
    let seen = &mut seen[..tiles.len()];
    // SAFETY: the caller's promise.
    unsafe { find::<N, P>(occluders, job.ways, tiles, seen, waiting, records) };
    let way = &job.ways.list()[0];
    for (tile, seen) in seen.iter().enumerate() {
        for arc in 0..way.len() {
            entries.clear();
            let mut next = seen.last[arc];
            while let Some(index) = next {
                let record = &records[index as usize];
                let owner = record.owner;
                entries.push(Entry { owner, index });
                next = record.before;
            }
            entries.sort_unstable();
            let (list, at) = (&occluders.list, &tiles[tile]);
            // SAFETY: as above; the records were found here.
            let whose = unsafe { whose::<P>(list, at, way, arc, records, entries, groups, nears) };
            show(&Shown {
                tile,
                arc,
                whose,
                entries,
                records,
                nears,
            });
        }
    }
}
