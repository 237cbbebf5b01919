//! What is measured again when a city changes: only what the change can touch.
//!
//! The shadow of a place is a union of what polygons cover, and a union does not depend on the order of what it is of. So where
//! the polygons that come and go cover nothing, or only what all others cover anyway, it is what it was, to the bit.
//! Whether they cover anything is looked at for many tiles at once first, as boxes; then tile by tile whether that makes a
//! difference.

use std::ops::Range;

use arrayvec::ArrayVec;
use ombra_city::Change;
use ombra_geometry::{Aabb, Point3};
use ombra_sun::Sheet;
use rayon::prelude::*;

use crate::dark::Dark;
use crate::exact::{Exact, TILES};
use crate::kernel::{Room, may_cover};
use crate::occluder::Occluders;
use crate::tile::{Tile, is_somewhere};
use crate::tiles::Tiles;

/// Tiles that are looked at as one box first: those of a square of the ground.
const BLOCK: usize = 64;

/// The places that are measured again after a change of the city.
#[derive(Clone, Debug)]
pub struct Again {
    /// What stays of the city.
    kept: Occluders,
    /// What is new of it.
    added: Occluders,
    tiles: Tiles,
    /// Which places, by their indices, do not keep what they had: they are measured again or lie in a building now.
    unsettled: Vec<u32>,
}

impl Again {
    /// After a change of what throws shadow, of what was measured `before` on the same ways of the sun. `fresh` are the places that lie
    /// in no building after it, of all those that it may put into one or out of one ([`Change::is_within`]). It is quicker with
    /// what was `dark` before, see [`Exact::seconds_and_dark`].
    #[must_use]
    pub fn new(
        occluders: &Occluders,
        change: &Change,
        sheets: &[Sheet],
        before: &Tiles,
        dark: Option<&Dark>,
        fresh: Tiles,
    ) -> Self {
        let kept = occluders.without(change.removed());
        let changed = Occluders::new(change.facets());
        let gone = Occluders::new(change.removed());
        let exact = Exact::new(&kept, sheets).with(&changed);
        let look = Look {
            exact: &exact,
            changed: &changed,
            gone: &gone,
            tiles: before,
            dark,
        };
        let is_within = |place: Point3| change.is_within([place.x, place.y]);
        let blocks = (0..before.len()).into_par_iter().step_by(BLOCK);
        let found: Vec<(Vec<usize>, Vec<u32>)> = blocks
            .map_init(Room::new, |room, first| {
                let block = first..before.len().min(first + BLOCK);
                let around = look.around(block.clone());
                let [low, high] = [around.min, around.max].map(Point3::to_array);
                let meets = |[from, to]: &[[f32; 2]; 2]| {
                    (0..2).all(|k| low[k] <= to[k] && from[k] <= high[k])
                };
                let mut unsettled = Vec::new();
                if change.bounds().iter().any(meets) {
                    let all = before.range(block.clone());
                    let within = all.filter(|&place| is_within(before.places()[place]));
                    unsettled.extend(within.map(|place| before.indices()[place]));
                }
                (look.changed_tiles(block, around, room), unsettled)
            })
            .collect();
        let (touched, unsettled): (Vec<_>, Vec<_>) = found.into_iter().unzip();
        let mut tiles = before.some(&touched.concat(), |place| !is_within(place));
        tiles.append(fresh);
        Self {
            kept,
            added: Occluders::new(change.added()),
            tiles,
            unsettled: unsettled.concat(),
        }
    }

    /// Measures the shadow of the city as it is now.
    #[must_use]
    pub fn exact(&self, sheets: &[Sheet]) -> Exact<'_> {
        Exact::new(&self.kept, sheets).with(&self.added)
    }

    /// What is to be measured, of the city as it is now.
    #[must_use]
    pub fn tiles(&self) -> &Tiles {
        &self.tiles
    }

    /// What holds after the change: `before` are all values by index, `measured` those of [`tiles`](Self::tiles). A place that lies in
    /// a building now has `nothing`.
    #[must_use]
    pub fn after<T: Copy + Send + Sync>(&self, before: &[T], measured: &[T], nothing: T) -> Vec<T> {
        // Of a large city these are hundreds of megabytes.
        let mut after: Vec<T> = before.par_iter().copied().collect();
        for &index in &self.unsettled {
            after[index as usize] = nothing;
        }
        for (&index, &value) in self.tiles.indices().iter().zip(measured) {
            after[index as usize] = value;
        }
        after
    }
}

/// Looks for tiles for which the changed polygons make a difference.
struct Look<'a> {
    /// With what stays, and besides with what is changed.
    exact: &'a Exact<'a>,
    changed: &'a Occluders,
    /// Those of the changed that are not there any more.
    gone: &'a Occluders,
    tiles: &'a Tiles,
    dark: Option<&'a Dark>,
}

impl Look<'_> {
    fn changed_tiles(&self, block: Range<usize>, around: Aabb, room: &mut Room) -> Vec<usize> {
        let mut found = Vec::new();
        if !self.may_shade(block.clone(), around, room) {
            return found;
        }
        for first in block.clone().step_by(TILES) {
            let part = first..block.end.min(first + TILES);
            if self.may_shade(part.clone(), self.around(part.clone()), room) {
                let lists = self.tiles.lists(part.clone());
                let tiles: ArrayVec<Tile, TILES> =
                    lists.iter().map(|list| Tile::new(list)).collect();
                let dark = |tile, sheet| self.dark.map_or(0, |dark| dark.get(first + tile, sheet));
                let changed = self.exact.changes(&tiles, self.gone, dark, room);
                found.extend(part.filter(|tile| changed >> (tile - first) & 1 == 1));
            }
        }
        found
    }

    /// The box around the places of some tiles.
    fn around(&self, which: Range<usize>) -> Aabb {
        let places = self.tiles.places()[self.tiles.range(which)].iter();
        Aabb::around(places.filter(|place| is_somewhere(place)).copied())
    }

    /// Whether the change may make a difference to any of some tiles, which lie in a box. What was dark for all of them stays so unless what made it
    /// dark is gone.
    fn may_shade(&self, tiles: Range<usize>, around: Aabb, room: &mut Room) -> bool {
        let level = self.exact.level();
        self.exact.ways().iter().any(|ways| {
            let mut may =
                |which: &Occluders, dark| may_cover(level, which, ways, around, dark, room);
            if !may(self.changed, 0) {
                return false;
            }
            let Some(dark) = self.dark else {
                return true;
            };
            let of_tile = |tile| ways.which.iter().map(move |&sheet| dark.get(tile, sheet));
            let dark = tiles
                .clone()
                .flat_map(of_tile)
                .fold(u64::MAX, |all, own| all & own);
            may(self.gone, 0) || may(self.changed, dark)
        })
    }
}

#[cfg(test)]
mod tests {
    use ombra_city::{City, Edited, Edits, Grid, demo_city, procedural_city};
    use ombra_sun::{Hours, Place, Refraction, Sky};

    use super::*;

    fn sheets(city: &City, dates: &[(i16, i8, i8)]) -> Vec<Sheet> {
        let place = Place::new(city.origin.latitude(), city.origin.longitude(), 0.0).unwrap();
        let sky = Sky::new(place, Refraction::None).unwrap();
        let zone = place.time_zone().unwrap();
        let spans = (dates.iter())
            .flat_map(|&(y, m, d)| Hours::default().spans(&sky, &zone, jiff::civil::date(y, m, d)));
        spans.flat_map(|span| Sheet::cover(&sky, span)).collect()
    }

    /// By cell; NaN in buildings.
    fn whole(
        city: &City,
        occluders: &Occluders,
        grid: &Grid,
        sheets: &[Sheet],
    ) -> (Tiles, Vec<f64>) {
        let tiles = Tiles::on_ground(city, grid, |_| true);
        let seconds = Exact::new(occluders, sheets).seconds_of(&tiles, 0..tiles.len());
        let mut cells = vec![f64::NAN; grid.count()];
        for (&index, seconds) in tiles.indices().iter().zip(seconds) {
            cells[index as usize] = seconds;
        }
        (tiles, cells)
    }

    fn check(before: &City, after: &Edited, grid: &Grid, sheets: &[Sheet]) -> [usize; 2] {
        let occluders = Occluders::new(&before.facets());
        let (tiles, seconds) = whole(before, &occluders, grid, sheets);
        let dark = Dark::new(tiles.len(), sheets.len()).unwrap();
        let kept = Exact::new(&occluders, sheets).seconds_and_dark(&tiles, 0..tiles.len(), &dark);
        let kept = tiles.indices().iter().zip(kept);
        assert!(
            kept.into_iter()
                .all(|(&index, own)| own.to_bits() == seconds[index as usize].to_bits())
        );
        let anew = Occluders::new(&after.city.facets());
        let (_, expected) = whole(&after.city, &anew, grid, sheets);
        let change = Change::between(before, after);
        let fresh = Tiles::on_changed_ground(&after.city, grid, &change, |_| true);
        let again = |dark| Again::new(&occluders, &change, sheets, &tiles, dark, fresh.clone());
        let [again, slowly] = [again(Some(&dark)), again(None)];
        assert_eq!(again.tiles.indices(), slowly.tiles.indices());
        let exact = again.exact(sheets);
        let measured = exact.seconds_of(again.tiles(), 0..again.tiles().len());
        let found = again.after(&seconds, &measured, f64::NAN);
        let bits = |values: &[f64]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert!(bits(&found) == bits(&expected), "not as measured anew");
        let differ = |a: &f64, b: &f64| a.to_bits() != b.to_bits();
        let changed = seconds.iter().zip(&expected);
        let changed = changed.filter(|(a, b)| differ(a, b)).count();
        [changed, again.tiles().places().len()]
    }

    /// Numbers that look random and are always the same (SplitMix64).
    struct Numbers(u64);

    impl Numbers {
        fn below(&mut self, most: usize) -> usize {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = self.0;
            z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((z ^ z >> 31) % most as u64) as usize
        }
    }

    /// A few buildings go, a few get another height, and a few of another city come, where they stand in streets and over others.
    fn edits(city: &City, numbers: &mut Numbers) -> Edits {
        let count = city.buildings.len();
        let mut named: Vec<usize> = (0..5).map(|_| numbers.below(count)).collect();
        named.sort_unstable();
        named.dedup();
        let (gone, other) = named.split_at(numbers.below(named.len() + 1));
        let from = procedural_city(numbers.below(1000) as u64, 60).buildings;
        Edits {
            with: (0..numbers.below(4))
                .map(|_| from[numbers.below(from.len())].clone())
                .collect(),
            without: gone.iter().map(|number| format!("#{number}")).collect(),
            heights: (other.iter())
                .map(|number| (format!("#{number}"), 1.0 + numbers.below(250) as f64))
                .collect(),
        }
    }

    #[test]
    fn it_comes_out_as_if_all_were_measured_again() {
        let mut numbers = Numbers(7);
        let [mut changed, mut measured, mut all] = [0; 3];
        for round in 0..24 {
            let city = match round % 4 {
                0 => demo_city(),
                _ => procedural_city(round, 40 + 60 * (round as usize % 4)),
            };
            let grid = Grid::over(&city.facets(), [3.0, 4.0, 7.0][round as usize % 3]).unwrap();
            let days = [[(2026, 12, 21)], [(2026, 3, 20)], [(2026, 6, 21)]][round as usize % 3];
            let sheets = sheets(&city, &days);
            let after = city.edited(&edits(&city, &mut numbers)).unwrap();
            let [own, again] = check(&city, &after, &grid, &sheets);
            changed += own;
            measured += again;
            all += grid.count();
        }
        assert!(
            changed > 1000 && changed <= measured,
            "{changed} {measured}"
        );
        assert!(measured < all, "{measured} of {all}");
    }

    #[test]
    fn several_days_and_other_edits_of_the_same_city() {
        let city = procedural_city(9, 400);
        let grid = Grid::over(&city.facets(), 6.0).unwrap();
        let dates = [1, 3, 5, 7, 9, 11].map(|month| (2026, month, 21));
        let sheets = sheets(&city, &dates);
        let mut numbers = Numbers(3);
        for _ in 0..4 {
            let after = city.edited(&edits(&city, &mut numbers)).unwrap();
            check(&city, &after, &grid, &sheets);
        }
    }

    #[test]
    fn without_a_change_nothing_is_measured() {
        let city = procedural_city(4, 50);
        let grid = Grid::over(&city.facets(), 5.0).unwrap();
        let sheets = sheets(&city, &[(2026, 6, 21)]);
        assert_eq!(
            check(
                &city,
                &city.edited(&Edits::default()).unwrap(),
                &grid,
                &sheets
            ),
            [0, 0]
        );
    }

    #[test]
    fn all_may_go() {
        let city = procedural_city(4, 12);
        let grid = Grid::over(&city.facets(), 3.0).unwrap();
        let all = Edits {
            without: (0..12).map(|number| format!("#{number}")).collect(),
            ..Edits::default()
        };
        let after = city.edited(&all).unwrap();
        let sheets = sheets(&city, &[(2026, 6, 21)]);
        let [changed, measured] = check(&city, &after, &grid, &sheets);
        assert!(changed > 0 && changed <= measured);
        let back = Edits {
            with: city.buildings.clone(),
            ..Edits::default()
        };
        let back = after.city.edited(&back).unwrap();
        assert_eq!(check(&after.city, &back, &grid, &sheets)[0], changed);
    }

    #[test]
    fn of_two_buildings_in_one_place_one_may_go() {
        let mut city = procedural_city(4, 12);
        city.buildings.push(city.buildings[5].clone());
        let grid = Grid::over(&city.facets(), 3.0).unwrap();
        let one = Edits {
            without: vec!["#5".to_owned()],
            ..Edits::default()
        };
        let after = city.edited(&one).unwrap();
        let sheets = sheets(&city, &[(2026, 6, 21)]);
        assert_eq!(check(&city, &after, &grid, &sheets)[0], 0);
    }
}
