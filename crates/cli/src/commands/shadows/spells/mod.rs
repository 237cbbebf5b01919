//! From when to when, and of whose shadow: what is found, kept in a file, and summed up by building.

mod answer;
mod buildings;
mod counted;
pub(super) mod query;

use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::time::Instant;

use anyhow::bail;
use clap::Args;
use ombra::accrual::{Counted, Occluders, Share, Spells, Stretches, Summary};
use ombra::city::{City, Facet};
use ombra::formats::FormatError;
use ombra::formats::places::PlaceShare;
use ombra::formats::spells::{SpellsAbout, SpellsGroup, write_spells};

use super::args::{Method, OutputKind, ShadowsArgs, csv, parquet};
use super::measure::{Measured, Pace};
use super::output;
use super::places::{Kind, Places};
use super::rows::position;
use super::when::When;
use super::{Session, wrong_usage};
use crate::commands::Talk;
use crate::progress::Jobs;
pub(super) use buildings::BuildingRow;
use buildings::Buildings;

/// From when to when, and of whose shadow.
#[derive(Clone, Debug, Args)]
pub(crate) struct SpellsArgs {
    /// Where to write from when to when each place lies in shadow, and of which building (.parquet): `ombra shadows query`
    /// answers from it without measuring again
    #[arg(long, value_name = "OUT", value_parser = parquet)]
    pub(crate) spells: Option<PathBuf>,

    /// Who shades whom: minutes by building, in all (--json), and of each place in .geojson and .parquet; a moment counts for
    /// the building that the ray toward the sun meets first
    #[arg(long)]
    pub(crate) attribute: bool,

    /// The same as a table of buildings (.csv): how many places each shades, for how long, and what it takes alone
    #[arg(long, value_name = "OUT", value_parser = csv)]
    pub(crate) by_building: Option<PathBuf>,
}

impl SpellsArgs {
    /// Whether stretches are to be found, and not minutes alone.
    pub(super) const fn is_asked(&self) -> bool {
        self.spells.is_some() || self.is_attribution()
    }

    const fn is_attribution(&self) -> bool {
        self.attribute || self.by_building.is_some()
    }
}

/// What stretches cannot be found of.
pub(super) fn refuse(args: &ShadowsArgs) {
    let option = match &args.spells {
        _ if !args.spells.is_asked() => return,
        SpellsArgs {
            spells: Some(_), ..
        } => "--spells",
        SpellsArgs {
            by_building: Some(_),
            ..
        } => "--by-building",
        _ => "--attribute",
    };
    if args.method != Method::Exact {
        wrong_usage(&format!(
            "{option}: stretches of shadow are exact; leave out --method {}",
            args.method.name()
        ));
    }
    let is_shown = args.json || args.spells.by_building.is_some() || args.spells.spells.is_some();
    let is_list = |path: &PathBuf| OutputKind::of(path) != OutputKind::GeoTiff;
    if args.spells.attribute && !is_shown && !args.output.as_ref().is_some_and(is_list) {
        wrong_usage(
            "--attribute is shown by --json, and by -o with .geojson or .parquet; --by-building is a table of buildings",
        );
    }
    if args.sun.disc {
        wrong_usage(&format!("{option}: the sun is a point; leave out --disc"));
    }
    if args.resume {
        wrong_usage(&format!(
            "{option}: an interrupted run is not gone on with; leave out --resume"
        ));
    }
}

/// Whose shadow it is.
pub(super) struct Attribution {
    pub(super) buildings: Vec<BuildingRow>,
    /// By place, of those that were measured.
    shares: Vec<Vec<Share>>,
}

impl Attribution {
    /// By place, measured or not, as rows of a table have it.
    pub(super) fn spread<'a>(&self, places: &Places, city: &'a City) -> Vec<Vec<PlaceShare<'a>>> {
        let mut all = vec![Vec::new(); places.count()];
        for (index, shares) in places.numbers(0..self.shares.len()).zip(&self.shares) {
            all[index as usize] = shares.iter().map(|share| named(share, city)).collect();
        }
        all
    }
}

/// What one building takes from a place, as a row has it.
fn named<'a>(share: &Share, city: &'a City) -> PlaceShare<'a> {
    PlaceShare {
        building: (share.owner < Facet::CONTEXT).then_some(share.owner),
        building_id: match share.owner {
            Facet::CONTEXT => Some("other"),
            Facet::TERRAIN => Some("terrain"),
            number => city.buildings[number as usize].id.as_deref(),
        },
        minutes: (share.seconds / 60.0) as f32,
        alone: (share.alone / 60.0) as f32,
    }
}

/// The same as [`measure`](super::measure::measure), by stretches; none if it was interrupted before there was anything.
pub(super) fn measure(
    args: &ShadowsArgs,
    session: &Session,
    city: &City,
    facets: &[Facet],
    when: &When,
    places: &Places,
    talk: &Talk,
) -> anyhow::Result<Option<(Measured, Option<Attribution>)>> {
    let begun = Instant::now();
    let cpu = &session.cpu;
    let occluders = cpu.install(|| Occluders::new(facets));
    let spells = cpu.install(|| Spells::new(&occluders, &when.sheets().concat()));
    let mut run = Run {
        args,
        session,
        spells,
        counted: when
            .spans
            .iter()
            .map(|&span| Counted::plainly(span))
            .collect(),
        city,
        places,
        measured: Measured::begun(begun.elapsed().as_secs_f64()),
        stretches: 0,
        shares: Vec::new(),
    };
    let begun = Instant::now();
    match &args.spells.spells {
        None => run.all(&mut |_| Ok(()))?,
        Some(path) => {
            let about = about(city, when, places);
            let metadata = output::metadata(
                when,
                args.method,
                format!("{}; the sun is {}", output::EXACT, when.sun()),
                "stretches of shadow",
            );
            let written = write_spells(path, &about, &metadata, |writer| {
                run.all(&mut |group| writer.write(group))?;
                if run.measured.minutes.is_empty() {
                    bail!("interrupted");
                }
                Ok(())
            });
            if run.measured.minutes.is_empty() {
                return Ok(None);
            }
            written?;
            let bytes = std::fs::metadata(path).map_or(0, |file| file.len());
            let count = run.measured.minutes.len();
            talk.say(&format!(
                "{}: {} stretches of shadow at {count} places, {:.1} bytes a place",
                path.display(),
                run.stretches,
                bytes as f64 / count as f64,
            ));
        }
    }
    let total = places.tiles.places().len();
    let Run {
        mut measured,
        shares,
        ..
    } = run;
    measured.end(total, begun.elapsed().as_secs_f64());
    let attribution = args.spells.is_attribution().then(|| {
        let mut buildings = Buildings::default();
        shares.iter().for_each(|shares| buildings.add(shares));
        let cell = matches!(places.kind, Kind::Grid { .. }).then_some(args.places.cell);
        let id = |number: usize| city.buildings[number].id.clone();
        Attribution {
            buildings: buildings.rows(cell, id),
            shares,
        }
    });
    if let (Some(path), Some(found)) = (&args.spells.by_building, &attribution) {
        buildings::write(path, &found.buildings)?;
    }
    Ok(Some((measured, attribution)))
}

struct Run<'a> {
    args: &'a ShadowsArgs,
    session: &'a Session,
    spells: Spells<'a>,
    counted: Vec<Counted>,
    city: &'a City,
    places: &'a Places,
    measured: Measured,
    stretches: usize,
    shares: Vec<Vec<Share>>,
}

/// Places that are written together.
const GROUP: usize = 1 << 14;

impl Run<'_> {
    /// Finds the stretches of all places, a group after another, until it is interrupted.
    fn all(
        &mut self,
        write: &mut dyn FnMut(&SpellsGroup) -> Result<(), FormatError>,
    ) -> Result<(), FormatError> {
        let bar = Jobs::unless(self.args.quiet);
        let tiles = &self.places.tiles;
        let (stop, total) = (&self.session.stop, tiles.places().len());
        let mut group = Stretches::default();
        let (mut tile, mut first) = (0, 0);
        let mut pace = Pace::new();
        loop {
            let is_over = tile >= tiles.len() || stop.load(Ordering::Relaxed);
            // Always as many, however long a part took: then the file is the same.
            while group.len() >= GROUP || is_over && !group.is_empty() {
                let own = group.take_first(GROUP);
                let next = first + own.len();
                write(&self.group(first..next, own))?;
                first = next;
            }
            if is_over {
                break;
            }
            let end = pace.begin(tile, tiles.len());
            let found = (self.session.cpu).install(|| self.spells.stretches_of(tiles, tile..end));
            for stretches in found.iter() {
                let seconds = Summary::new(stretches, &self.counted).shadow;
                self.measured.minutes.push((seconds / 60.0) as f32);
                self.stretches += stretches.len();
                if self.args.spells.is_attribution() {
                    self.shares.push(Share::all(stretches, &self.counted));
                }
            }
            group.append(&found);
            tile = end;
            pace.end();
            bar.update(self.measured.minutes.len() as u64, total as u64, "places");
        }
        bar.finish();
        Ok(())
    }

    fn group(&self, which: std::ops::Range<usize>, stretches: Stretches) -> SpellsGroup {
        let at = &self.places.tiles.places()[which.clone()];
        SpellsGroup {
            places: self.places.numbers(which).collect(),
            positions: at.iter().map(|&at| position(self.city, at)).collect(),
            stretches,
        }
    }
}

fn about(city: &City, when: &When, places: &Places) -> SpellsAbout {
    let mut about = SpellsAbout {
        version: 1,
        latitude: city.origin.latitude(),
        longitude: city.origin.longitude(),
        time_zone: when.zone.clone(),
        refraction: when.is_refracted,
        windows: Vec::new(),
        on: places.name().to_owned(),
        cell: None,
        grid: None,
        places: places.tiles.places().len() as u64,
        buildings: city.buildings.iter().map(|own| own.id.clone()).collect(),
    };
    about.set_spans(&when.spans);
    if let Kind::Grid { grid, .. } = &places.kind {
        about.set_grid(*grid);
    }
    about
}
