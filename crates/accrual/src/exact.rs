//! Shadow time, exact: no instant is looked at, only when it begins and ends.
//!
//! A polygon covers the sun, seen from a place, from when the sun crosses the plane through the place and one edge until it crosses that
//! of another one. So each polygon is turned into a stretch of time, and the shadow of a day is the union of these. The
//! sun's way is a chain of conic arcs, see [`Sheet`] for how little they depart from its true one.

use arrayvec::ArrayVec;
use ombra_accel::Level;
use ombra_geometry::Point3;
use ombra_sun::Sheet;
use rayon::prelude::*;

use crate::dark::Dark;
use crate::kernel::{Job, Room, add_seconds, changes};
use crate::occluder::Occluders;
use crate::tile::{PLACES, Tile, is_somewhere};
use crate::tiles::Tiles;
use crate::way::Way;
use crate::ways::{TOGETHER, Ways};

/// Tiles in whose sight the same is near are looked at together. Those are at most so many, in a box no longer than so many metres.
pub(crate) const TILES: usize = 4;
const NEAR: f32 = 16.0;

/// Measures the shadow of polygons at places, exactly in time.
#[derive(Debug)]
pub struct Exact<'a> {
    occluders: &'a Occluders,
    /// What throws shadow besides.
    more: Option<&'a Occluders>,
    ways: Vec<Ways>,
    level: Level,
}

impl<'a> Exact<'a> {
    /// For stretches of time that do not overlap; those of several suns, as the points of a [`Disc`](ombra_sun::Disc), may: then
    /// seconds are the sum of all.
    #[must_use]
    pub fn new(occluders: &'a Occluders, sheets: &[Sheet]) -> Self {
        Self {
            occluders,
            more: None,
            ways: Ways::together(sheets.par_iter().map(Way::new).collect()),
            level: Level::detect(),
        }
    }

    /// The same at another level of instructions, with the same answers to the bit.
    ///
    /// # Panics
    /// If this machine does not have the level, see [`Level::available`].
    #[must_use]
    pub fn at_level(self, level: Level) -> Self {
        let level = checked(level);
        Self { level, ..self }
    }

    /// The same with more polygons besides.
    pub(crate) fn with(self, more: &'a Occluders) -> Self {
        Self {
            more: Some(more),
            ..self
        }
    }

    /// How many seconds each place lies in shadow. Places that come one after another, sixteen each,
    /// should lie near one another: it is quicker then.
    #[must_use]
    pub fn seconds(&self, places: &[Point3]) -> Vec<f64> {
        self.each(&places.chunks(PLACES).collect::<Vec<_>>())
    }

    /// The same for some of the tiles: place after place, see [`Tiles::range`].
    #[must_use]
    pub fn seconds_of(&self, tiles: &Tiles, which: std::ops::Range<usize>) -> Vec<f64> {
        self.each(&tiles.lists(which))
    }

    /// The same, and keeps what [`Again`](crate::Again) is quicker with.
    #[must_use]
    pub fn seconds_and_dark(
        &self,
        tiles: &Tiles,
        which: std::ops::Range<usize>,
        dark: &Dark,
    ) -> Vec<f64> {
        let begin = which.start;
        by_tiles(&tiles.lists(which), |first, tiles, room| {
            let mut sums: Sums = tiles.iter().map(|_| [0.0; PLACES]).collect();
            self.by_way(tiles, room, |tile, sheet, seconds, full| {
                add(&mut sums[tile], seconds);
                dark.set(begin + first + tile, sheet, full);
            });
            sums
        })
    }

    fn each(&self, lists: &[&[Point3]]) -> Vec<f64> {
        by_tiles(lists, |_, tiles, room| self.sums(tiles, room))
    }

    /// The ways of the sun.
    pub(crate) fn ways(&self) -> &[Ways] {
        &self.ways
    }

    /// For which tiles, by bits, the polygons that it has besides make a difference; some of them are `gone` now, and the others are new.
    /// There are [`TILES`] at most. `dark_of` are the arcs of a tile and a sheet that were covered wholly.
    pub(crate) fn changes(
        &self,
        tiles: &[Tile],
        gone: &Occluders,
        dark_of: impl Fn(usize, usize) -> u64,
        room: &mut Room,
    ) -> u32 {
        let jobs = self.jobs(tiles);
        jobs.fold(0, |found, (first, job)| {
            let tiles = first..first + job.tiles.len();
            let dark = tiles.flat_map(|tile| job.ways.which.iter().map(move |&way| (tile, way)));
            let dark: ArrayVec<u64, TOGETHER> =
                dark.map(|(tile, way)| dark_of(tile, way)).collect();
            found | changes(self.level, job, gone, &dark, room) << first
        })
    }

    /// What is looked at together, and which of the tiles its first one is.
    fn jobs<'t>(&'t self, tiles: &'t [Tile]) -> impl Iterator<Item = (usize, Job<'t>)> {
        self.ways.iter().flat_map(move |ways| {
            let together = TOGETHER / ways.list().len();
            let parts = tiles.chunks(together).enumerate();
            parts.map(move |(part, tiles)| {
                let job = Job {
                    occluders: self.occluders,
                    more: self.more,
                    ways,
                    tiles,
                };
                (part * together, job)
            })
        })
    }

    pub(crate) const fn level(&self) -> Level {
        self.level
    }

    /// How many seconds each place of some tiles lies in shadow.
    pub(crate) fn sums(&self, tiles: &[Tile], room: &mut Room) -> Sums {
        let mut sums: Sums = tiles.iter().map(|_| [0.0; PLACES]).collect();
        self.by_way(tiles, room, |tile, _, seconds, _| {
            add(&mut sums[tile], seconds);
        });
        sums
    }

    /// Shows how many seconds of each sheet, by its number, lie in shadow for each place of each tile, and which of its arcs do so wholly
    /// for all of them.
    pub(crate) fn by_way(
        &self,
        tiles: &[Tile],
        room: &mut Room,
        mut show: impl FnMut(usize, usize, &[f64; PLACES], u64),
    ) {
        for (first, job) in self.jobs(tiles) {
            let mut seconds = [[0.0; PLACES]; TOGETHER];
            add_seconds(self.level, job, room, &mut seconds);
            let count = job.ways.list().len();
            let by_tile = seconds.chunks_exact(count);
            for (tile, seconds) in by_tile.take(job.tiles.len()).enumerate() {
                for (way, (&which, seconds)) in job.ways.which.iter().zip(seconds).enumerate() {
                    show(first + tile, which, seconds, room.full(tile * count + way));
                }
            }
        }
    }
}

fn add(sums: &mut [f64; PLACES], seconds: &[f64; PLACES]) {
    for (sum, seconds) in sums.iter_mut().zip(seconds) {
        *sum += seconds;
    }
}

/// How many tiles at a time are looked at together: all that lie near one another, or each by itself.
pub(crate) fn together(tiles: &[Tile]) -> usize {
    if Tile::length(tiles) <= NEAR {
        TILES
    } else {
        1
    }
}

/// A level, if this machine has it.
pub(crate) fn checked(level: Level) -> Level {
    assert!(
        Level::available().contains(&level),
        "this machine does not have {level:?}"
    );
    level
}

/// By tile the seconds of its places.
pub(crate) type Sums = ArrayVec<[f64; PLACES], TILES>;

/// Lists of up to sixteen places in parallel: `sum` gives the seconds of tiles that lie near one another, of which it is told which is the first.
pub(crate) fn by_tiles(
    lists: &[&[Point3]],
    sum: impl Fn(usize, &[Tile], &mut Room) -> Sums + Sync,
) -> Vec<f64> {
    let parts: Vec<Vec<f64>> = lists
        .par_chunks(TILES)
        .enumerate()
        .map_init(Room::new, |room, (part, lists)| {
            let first = part * TILES;
            let tiles: ArrayVec<Tile, TILES> = lists.iter().map(|list| Tile::new(list)).collect();
            let count = together(&tiles);
            let each = tiles.chunks(count).enumerate();
            let sums = each.flat_map(|(k, tiles)| sum(first + k * count, tiles, room));
            let mut all = Vec::with_capacity(TILES * PLACES);
            for (places, sums) in lists.iter().zip(sums) {
                all.extend_from_slice(&sums[..places.len()]);
                if !places.iter().all(is_somewhere) {
                    let own = all.len() - places.len();
                    for (place, seconds) in places.iter().zip(&mut all[own..]) {
                        // A place that is nowhere has no shadow.
                        *seconds = if is_somewhere(place) { *seconds } else { 0.0 };
                    }
                }
            }
            all
        })
        .collect();
    parts.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use ombra_city::Facet;
    use ombra_sun::{Hours, Place, Refraction, Sky};

    use super::*;
    use crate::kernel::{Side, covered};

    /// Numbers that look random and are always the same (SplitMix64).
    struct Numbers(u64);

    impl Numbers {
        fn within(&mut self, from: f32, to: f32) -> f32 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = self.0;
            z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
            from + (to - from) * ((z ^ z >> 31) >> 40) as f32 / (1 << 24) as f32
        }
    }

    /// The walls and the roof of a turned box on the ground.
    fn house(numbers: &mut Numbers, side: f32, owner: u32) -> Vec<Facet> {
        let (x, y) = (numbers.within(-side, side), numbers.within(-side, side));
        let (a, b) = (numbers.within(3.0, 15.0), numbers.within(3.0, 15.0));
        let (sin, cos) = numbers.within(0.0, 3.0).sin_cos();
        let top = numbers.within(3.0, 60.0);
        let corner =
            |u: f32, v: f32, z: f32| Point3::new(x + u * cos - v * sin, y + u * sin + v * cos, z);
        let ring = [(a, b), (-a, b), (-a, -b), (a, -b)];
        let facet = |corners| Facet {
            corners,
            is_two_sided: false,
            owner,
        };
        let mut facets: Vec<Facet> = (0..4)
            .map(|k| {
                let ((u, v), (w, z)) = (ring[k], ring[(k + 1) % 4]);
                facet([
                    corner(u, v, 0.0),
                    corner(w, z, 0.0),
                    corner(w, z, top),
                    corner(u, v, top),
                ])
            })
            .collect();
        facets.push(facet(ring.map(|(u, v)| corner(u, v, top))));
        facets
    }

    fn days(latitude: f64) -> Vec<Sheet> {
        let sky = Sky::new(Place::new(latitude, 5.0, 0.0).unwrap(), Refraction::None).unwrap();
        let zone = jiff::tz::TimeZone::UTC;
        let dates = [(2026, 6, 21), (2026, 9, 22), (2026, 12, 21)];
        let spans = dates
            .into_iter()
            .flat_map(|(y, m, d)| Hours::default().spans(&sky, &zone, jiff::civil::date(y, m, d)));
        spans.flat_map(|span| Sheet::cover(&sky, span)).collect()
    }

    /// Every polygon before every arc, one place after another.
    fn plainly(occluders: &Occluders, sheets: &[Sheet], place: [f32; 3]) -> f64 {
        let mut seconds = [0.0; PLACES];
        let mut cover = crate::cover::Cover::new();
        let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        for way in sheets.iter().map(Way::new) {
            cover.clear(way.len());
            for occluder in &occluders.list {
                let away = occluder.corner.map(|c| [0, 1, 2].map(|k| c[k] - place[k]));
                let side = dot(away[0], occluder.normal);
                if !(side < 0.0 || occluder.is_two_sided && side > 0.0) {
                    continue;
                }
                let sign = if side > 0.0 { -1.0 } else { 1.0 };
                let planes = [0, 1, 2, 3].map(|j| {
                    let ([x, y, z], [dx, dy, dz]) = (occluder.edge[j], away[j]);
                    [y * dz - z * dy, z * dx - x * dz, x * dy - y * dx].map(|n| sign * n)
                });
                for arc in 0..way.len() {
                    let sides = planes.map(|plane| Side {
                        from: dot(plane, way.knots[arc]),
                        to: dot(plane, way.knots[arc + 1]),
                        bulge: dot(plane, way.bulges[arc]),
                    });
                    covered(&sides, |from, to| cover.add(arc, 0, from, to));
                }
            }
            cover.add_seconds(&way.seconds, &mut seconds);
        }
        seconds[0]
    }

    #[test]
    fn the_tree_and_the_lanes_change_nothing() {
        for (seed, latitude) in [
            (1, 40.7),
            (2, -33.0),
            (3, 10.0),
            (4, 64.0),
            (5, 78.0),
            (6, 0.0),
        ] {
            let mut numbers = Numbers(seed);
            let mut facets: Vec<Facet> = (0..60)
                .flat_map(|owner| house(&mut numbers, 120.0, owner))
                .collect();
            // Some soup besides, seen from both sides.
            for _ in 0..40 {
                let mut point = || {
                    let [x, y] = [(); 2].map(|()| numbers.within(-150.0, 150.0));
                    Point3::new(x, y, numbers.within(0.0, 50.0))
                };
                let [a, b, c] = [point(), point(), point()];
                facets.push(Facet {
                    corners: [a, b, c, c],
                    is_two_sided: true,
                    owner: 99,
                });
            }
            let occluders = Occluders::new(&facets);
            let sheets = days(latitude);
            let places: Vec<Point3> = (0..100)
                .map(|k| {
                    let (x, y) = ((k % 10) as f32 * 3.0, (k / 10) as f32 * 3.0);
                    Point3::new(x - 14.0, y - 14.0, if k % 7 == 0 { 20.0 } else { 0.0 })
                })
                .collect();
            let exact = Exact::new(&occluders, &sheets);
            let found = exact.seconds(&places);
            let mut shaded = 0;
            for (place, &found) in places.iter().zip(&found) {
                let expected = plainly(&occluders, &sheets, place.to_array());
                shaded += usize::from(expected > 0.0);
                assert!(
                    (found - expected).abs() < 0.02,
                    "latitude {latitude}, {place:?}: {found} and plainly {expected}"
                );
            }
            assert!(shaded > 50);
            for level in Level::available() {
                let exact = Exact::new(&occluders, &sheets).at_level(level);
                assert_eq!(exact.seconds(&places), found, "{level:?}");
            }
        }
    }

    #[test]
    fn nothing_throws_no_shadow_and_no_time_has_none() {
        let nothing = Occluders::new(&[]);
        let places = [Point3::ORIGIN, Point3::new(f32::NAN, 0.0, 0.0)];
        assert_eq!(Exact::new(&nothing, &days(45.0)).seconds(&places), [0.0; 2]);
        let facets = house(&mut Numbers(1), 1.0, 0);
        let some = Occluders::new(&facets);
        assert_eq!(Exact::new(&some, &[]).seconds(&places), [0.0; 2]);
        assert!(Exact::new(&some, &days(45.0)).seconds(&[]).is_empty());
    }
}
