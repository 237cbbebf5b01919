//! What one tower costs that is other than it was: all measured anew, against only what it can touch.

use std::time::Instant;

use anyhow::{Context as _, bail};
use ombra_accrual::{Again, Dark, Exact, Occluders, Tiles};
use ombra_city::{Building, Change, City, Edits, Grid};
use serde::Serialize;

use super::jobs::{Period, Skies};

/// How tall a building becomes, in metres.
const TOWER: f64 = 150.0;

/// And lower than so much it is before, in metres: of the generated city half are.
const LOW: f32 = 25.0;

/// One edit on one day, over the whole grid.
#[derive(Clone, Debug, Serialize)]
pub struct WhatIfRecord {
    /// Which city.
    pub city: String,
    /// The day.
    pub job: String,
    /// Metres.
    pub cell: f64,
    /// Outside of buildings.
    pub places: usize,
    /// Whose minutes change.
    pub changed: usize,
    /// That were measured again.
    pub again: usize,
    /// The wall's seconds of the full run, all threads: its structure and the measuring.
    pub full_seconds: f64,
    /// The same of the edit: the other city, what changed, which places that touches, the measuring, and the numbers of all places.
    pub again_seconds: f64,
    /// Of these the seconds until it was known which places.
    pub find_seconds: f64,
}

impl WhatIfRecord {
    /// What the edit costs, as a share of the full run.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.again_seconds / self.full_seconds
    }
}

/// One low building of a city becomes a tower: three whole days over a grid of such cells.
///
/// # Errors
/// When there is no such grid or no time zone, and when what was measured again is not what a full run gives, to the bit.
pub fn what_if(
    name: &str,
    city: &City,
    cell: f64,
    talk: &mut dyn FnMut(&str),
) -> anyhow::Result<Vec<WhatIfRecord>> {
    let facets = city.facets();
    let grid = Grid::over(&facets, cell)?;
    let tiles = Tiles::on_ground(city, &grid, |_| true);
    let number = a_low_one(city).context("a city without buildings")?;
    let edits = Edits {
        heights: vec![(format!("#{number}"), TOWER)],
        ..Edits::default()
    };
    let [_, days] = Skies::of(city)?.days()?;
    let measure = |period: &Period| {
        talk(&format!("  what if, cells of {cell} m, {}", period.name));
        one(name, city, &edits, &grid, &tiles, period)
    };
    days.iter().map(measure).collect()
}

fn one(
    name: &str,
    city: &City,
    edits: &Edits,
    grid: &Grid,
    tiles: &Tiles,
    period: &Period,
) -> anyhow::Result<WhatIfRecord> {
    let begin = Instant::now();
    let occluders = Occluders::new(&city.facets());
    let dark = Dark::new(tiles.len(), period.sheets.len());
    let before = whole(&occluders, tiles, period, grid.count(), dark.as_ref());
    let full_seconds = begin.elapsed().as_secs_f64();

    let begin = Instant::now();
    let after = city.edited(edits)?;
    let change = Change::between(city, &after);
    let fresh = Tiles::on_changed_ground(&after.city, grid, &change, |_| true);
    let again = Again::new(
        &occluders,
        &change,
        &period.sheets,
        tiles,
        dark.as_ref(),
        fresh,
    );
    let find_seconds = begin.elapsed().as_secs_f64();
    let exact = again.exact(&period.sheets);
    let measured = exact.seconds_of(again.tiles(), 0..again.tiles().len());
    let measured: Vec<f32> = measured.iter().map(|&seconds| seconds as f32).collect();
    let found = again.after(&before, &measured, f32::NAN);
    let again_seconds = begin.elapsed().as_secs_f64();

    let anew = Tiles::on_ground(&after.city, grid, |_| true);
    let occluders = Occluders::new(&after.city.facets());
    let expected = whole(&occluders, &anew, period, grid.count(), None);
    let is_same = |(a, b): (&f32, &f32)| a.to_bits() == b.to_bits();
    if !found.iter().zip(&expected).all(is_same) {
        bail!(
            "{}: what was measured again is not what a full run gives",
            period.name
        );
    }
    Ok(WhatIfRecord {
        city: name.to_owned(),
        job: period.name.clone(),
        cell: grid.cell,
        places: tiles.places().len(),
        changed: before
            .iter()
            .zip(&found)
            .filter(|&pair| !is_same(pair))
            .count(),
        again: again.tiles().places().len(),
        full_seconds,
        again_seconds,
        find_seconds,
    })
}

/// Seconds by cell, NaN in buildings.
fn whole(
    occluders: &Occluders,
    tiles: &Tiles,
    period: &Period,
    cells: usize,
    dark: Option<&Dark>,
) -> Vec<f32> {
    let exact = Exact::new(occluders, &period.sheets);
    let mut values = vec![f32::NAN; cells];
    // Some at a time: all seconds in double precision would take much memory.
    const PART: usize = 1 << 16;
    for first in (0..tiles.len()).step_by(PART) {
        let part = first..tiles.len().min(first + PART);
        let seconds = match dark {
            Some(dark) => exact.seconds_and_dark(tiles, part.clone(), dark),
            None => exact.seconds_of(tiles, part.clone()),
        };
        for (&index, seconds) in tiles.indices()[tiles.range(part)].iter().zip(seconds) {
            values[index as usize] = seconds as f32;
        }
    }
    values
}

/// Of the buildings that are no towers yet the one nearest the middle of the south-western quarter: in the very middle of the generated
/// city others stand so close that a tower more changes little.
fn a_low_one(city: &City) -> Option<usize> {
    let middle = |building: &Building| {
        let [low, high] = building.bounds();
        [0, 1].map(|k| 0.5 * (low[k] + high[k]))
    };
    let mut middles: Vec<[f32; 2]> = city.buildings.iter().map(middle).collect();
    let quarter = [0, 1].map(|k| {
        middles.sort_unstable_by(|a, b| a[k].total_cmp(&b[k]));
        middles.get(middles.len() / 4).map_or(0.0, |at| at[k])
    });
    let away = |building: &Building| {
        let at = middle(building);
        (at[0] - quarter[0]).hypot(at[1] - quarter[1])
    };
    let is_low = |building: &Building| {
        let tops = building.parts.iter().map(|part| part.range()[1]);
        tops.fold(0.0, f32::max) - building.ground < LOW
    };
    let low = city.buildings.iter().enumerate();
    let low = low.filter(|(_, building)| is_low(building));
    let nearest = low.min_by(|a, b| away(a.1).total_cmp(&away(b.1)));
    nearest.map(|(number, _)| number)
}
