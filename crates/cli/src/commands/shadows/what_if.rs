//! What if: the shadow before and after a change of the city, and what of it is new.

mod edits;
mod told;
mod written;

use std::ops::Range;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use ombra::accrual::{Again, Dark, Exact, Occluders, Tiles};
use ombra::city::{Change, City, Edited, Extent};
use ombra::pipeline::Cpu;
use ombra::sun::{Place, Sheet};

pub(crate) use edits::WhatIfArgs;
use told::Statistics;

use super::args::{Method, ShadowsArgs};
use super::bound::Bound;
use super::measure::in_parts;
use super::places::{Asked, Kind, Places};
use super::site::Site;
use super::when::When;
use super::{Session, products, wrong_usage};
use crate::commands::{Talk, print_json};
use crate::interrupt;

/// Minutes by place: by cell of a grid, or by point of a list; NaN where there are none.
struct Minutes {
    before: Vec<f32>,
    after: Vec<f32>,
    net: Vec<f32>,
}

/// How long it took, and how much was done again.
struct Effort {
    full_seconds: f64,
    again_seconds: f64,
    places: usize,
    again: usize,
}

pub(super) fn run(args: &ShadowsArgs, session: &Session) -> anyhow::Result<ExitCode> {
    refuse(args);
    let Session { cpu, stop } = session;
    let talk = Talk { quiet: args.quiet };
    super::can_write(args)?;
    let mut site = cpu.install(|| Site::read(args))?;
    edit(args, &mut site, cpu, &talk)?;
    let place = Place::new(site.origin().latitude(), site.origin().longitude(), 0.0)?;
    let when = cpu.install(|| When::new(&args.when, args.sun, place, None))?;
    let all = cpu.install(|| site.extent());
    let ask = |talk: &Talk, site: &Site<'_>| Asked::read(&args.places, site.origin(), all, talk);
    let (asked, asked_after) = (ask(&talk, &site)?, ask(&Talk { quiet: true }, &site)?);
    let (extent, lowest) = (asked.extent(all), when.lowest_altitude());
    let (before, edited, _) = cpu.install(|| site.cities(extent, lowest))?;
    let edited = edited.expect("what has buildings was edited");
    let others = edited.city.findings.iter();
    let others = others.filter(|finding| !before.findings.contains(finding));
    for finding in before.findings.iter().chain(others) {
        talk.say(&format!("{}: {finding}", args.city));
    }
    let places = cpu.install(|| Places::new(&args.places, asked, &before, all, &talk))?;
    products::check(args, &before, &places, &when)?;
    talk.say(&format!(
        "{}: {} buildings before, {} after; {}; {} day{}, {:.1} h of sun ({})",
        args.city,
        before.buildings.len(),
        edited.city.buildings.len(),
        places.describe(),
        when.days,
        if when.days == 1 { "" } else { "s" },
        when.hours(),
        when.zone,
    ));
    let job = Job {
        args,
        cpu,
        stop,
        when: &when,
        sheets: cpu.install(|| when.sheets().concat()),
    };
    let Some((minutes, after, effort)) = job.measure(&before, &edited, places, asked_after, all)?
    else {
        talk.say("interrupted; nothing written");
        return Ok(ExitCode::from(interrupt::EXIT_CODE));
    };
    written::write(args, &edited.city, &after, &when, &minutes)?;
    let are_written = products::write(&products::Job {
        args,
        session,
        before: Some(&before),
        city: &edited.city,
        places: &after,
        when: &when,
        minutes: products::Minutes::Change([&minutes.before, &minutes.after, &minutes.net]),
        metadata: written::of_run(args, &when),
        talk: &talk,
    })?;
    let statistics = Statistics::new(args, [&before, &edited.city], &when, &minutes, &effort);
    talk.say(&statistics.line());
    if args.json {
        print_json(&statistics)?;
    }
    Ok(ExitCode::from(if are_written {
        0
    } else {
        interrupt::EXIT_CODE
    }))
}

/// Makes the change: the site has two cities from now on.
pub(super) fn edit(
    args: &ShadowsArgs,
    site: &mut Site<'_>,
    cpu: &Cpu,
    talk: &Talk,
) -> anyhow::Result<()> {
    if site.surface().is_some() {
        wrong_usage(
            "--with, --without and --height change the buildings of a city, and a surface model has none",
        );
    }
    let edits = cpu.install(|| args.what_if.read(args, site.origin(), talk))?;
    cpu.install(|| site.edit(&edits))
}

/// What a change cannot be asked of.
fn refuse(args: &ShadowsArgs) {
    if args.method != Method::Exact {
        wrong_usage(&format!(
            "--method {}: before and after are exact; leave it out with --with, --without and --height",
            args.method.name()
        ));
    }
    if args.places.on != super::places::On::Ground {
        wrong_usage(
            "--on roofs and --on facades: with --with, --without and --height faces come and go; \
             places are wanted that stay, the ground or --points",
        );
    }
    if args.resume {
        wrong_usage(
            "--resume: a run with --with, --without or --height is not kept when it is interrupted",
        );
    }
}

struct Job<'a> {
    args: &'a ShadowsArgs,
    cpu: &'a Cpu,
    stop: &'a AtomicBool,
    when: &'a When,
    sheets: Vec<Sheet>,
}

impl Job<'_> {
    /// Minutes, and the places as they are after the change; `None` if it was interrupted.
    fn measure(
        &self,
        before: &City,
        after: &Edited,
        places: Places,
        asked: Asked,
        all: Extent,
    ) -> anyhow::Result<Option<(Minutes, Places, Effort)>> {
        let cpu = self.cpu;
        let begun = Instant::now();
        let occluders = cpu.install(|| Occluders::new(&before.facets()));
        let exact = cpu.install(|| Exact::new(&occluders, &self.sheets));
        let tiles = &places.tiles;
        let dark = Dark::new(tiles.len(), self.sheets.len());
        let part = |which| match &dark {
            Some(dark) => exact.seconds_and_dark(tiles, which, dark),
            None => exact.seconds_of(tiles, which),
        };
        let Some(measured) = self.minutes(tiles, part) else {
            return Ok(None);
        };
        let full_seconds = begun.elapsed().as_secs_f64();
        let minutes = places.spread(&measured);

        let begun = Instant::now();
        let change = cpu.install(|| Change::between(before, after));
        let again = |tiles: &Tiles, fresh| {
            cpu.install(|| {
                Again::new(
                    &occluders,
                    &change,
                    &self.sheets,
                    tiles,
                    dark.as_ref(),
                    fresh,
                )
            })
        };
        let (again, places) = match &places.kind {
            Kind::Points { outside, .. } => {
                let tiles = places.tiles.renamed(outside);
                let quiet = Talk { quiet: true };
                let places = Places::new(&self.args.places, asked, &after.city, all, &quiet)?;
                let fresh = changed_points(&places, &change);
                (again(&tiles, fresh), places)
            }
            Kind::Grid { grid, bound } => {
                let kept = |at| !matches!(bound, Bound::Study(_)) || bound.contains(at);
                let fresh =
                    cpu.install(|| Tiles::on_changed_ground(&after.city, grid, &change, kept));
                (again(&places.tiles, fresh), places)
            }
            Kind::Faces { .. } => unreachable!("refused before anything was read"),
        };
        let exact = cpu.install(|| again.exact(&self.sheets));
        let part = |which| exact.seconds_of(again.tiles(), which);
        let Some(measured) = self.minutes(again.tiles(), part) else {
            return Ok(None);
        };
        let after = again.after(&minutes, &measured, f32::NAN);
        let effort = Effort {
            full_seconds,
            again_seconds: begun.elapsed().as_secs_f64(),
            places: places.tiles.places().len(),
            again: again.tiles().places().len(),
        };
        let net = minutes
            .iter()
            .zip(&after)
            .map(|(before, after)| after - before);
        let minutes = Minutes {
            net: net.collect(),
            before: minutes,
            after,
        };
        Ok(Some((minutes, places, effort)))
    }

    /// Of all places of some tiles; `None` if it was interrupted.
    fn minutes(
        &self,
        tiles: &Tiles,
        part: impl Fn(Range<usize>) -> Vec<f64> + Sync,
    ) -> Option<Vec<f32>> {
        let part = |which| self.cpu.install(|| part(which));
        let measured = in_parts(self.args, self.when, tiles, 0.0, self.stop, &mut None, part);
        (measured.done == measured.minutes.len()).then_some(measured.minutes)
    }
}

/// The points that the change may have put out of a building, and are in none now.
fn changed_points(places: &Places, change: &Change) -> Tiles {
    let Kind::Points { at, outside, .. } = &places.kind else {
        return Tiles::default();
    };
    let is_within = |&&index: &&u32| {
        let at = at[index as usize];
        change.is_within([at.x, at.y])
    };
    let names: Vec<u32> = outside.iter().filter(is_within).copied().collect();
    let within: Vec<_> = names.iter().map(|&index| at[index as usize]).collect();
    Tiles::near(&within).renamed(&names)
}
