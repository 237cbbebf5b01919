//! `ombra shadows`: from a city to the map of its shadow.

mod args;
mod demo;
mod measure;
mod output;
mod site;
mod when;

use std::io::{self, Write as _};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use anyhow::{Context as _, bail};
use ombra::accrual::Tiles;
use ombra::city::{City, Grid, Origin};
use ombra::formats::can_write_whole;
use ombra::pipeline::Cpu;
use ombra::sun::Place;

use args::Method;
pub(crate) use args::ShadowsArgs;
use measure::{Measured, measure};
use output::{Statistics, summary};
use site::Site;
use when::When;

use super::Talk;
use crate::interrupt;

/// The city that is built in.
const DEMO: &str = "demo";

pub(crate) fn run(args: &ShadowsArgs) -> anyhow::Result<ExitCode> {
    let is_demo = args.city == DEMO;
    let asks_for_files = args.output.is_some() || args.png.is_some();
    let is_tour = is_demo && !asks_for_files && !args.when.names_days();
    if !is_tour && !args.when.names_days() {
        no_days();
    }
    if is_tour && args.json {
        wrong_usage("--json is for one map: name its days, as with --date 2026-12-21");
    }
    let session = Session {
        cpu: Cpu::with_threads(args.threads as usize).context("cannot start the threads")?,
        stop: interrupt::watch(args.quiet)?,
    };
    if is_tour {
        demo::run(args, &session)
    } else {
        one(args, &session)
    }
}

/// What all maps of one run share.
struct Session {
    cpu: Cpu,
    stop: Arc<AtomicBool>,
}

/// One map.
fn one(args: &ShadowsArgs, session: &Session) -> anyhow::Result<ExitCode> {
    let Session { cpu, stop } = session;
    let talk = Talk { quiet: args.quiet };
    for path in [&args.output, &args.png].into_iter().flatten() {
        // What would fail in the end fails at once.
        can_write_whole(path)?;
    }

    let begun = Instant::now();
    let site = cpu.install(|| Site::read(args))?;
    let place = Place::new(site.origin().latitude(), site.origin().longitude(), 0.0)?;
    let step = (args.method == Method::Sampled).then_some(args.step);
    let when = cpu.install(|| When::new(&args.when, place, step))?;
    let grid = match args.area {
        Some(area) => grid_over(area, args.cell, site.origin()),
        None => site.grid(args.cell)?,
    };
    let (city, reach) = cpu.install(|| site.city(&grid, when.lowest_altitude()))?;
    for finding in &city.findings {
        talk.say(&format!("{}: {finding}", args.city));
    }
    let facets = city.facets();
    let tiles = cpu.install(|| Tiles::on_ground(&city, &grid));
    if tiles.is_empty() {
        bail!(
            "{}: no place of the grid lies on the ground outside of buildings; take smaller cells",
            args.city
        );
    }
    let load_seconds = begun.elapsed().as_secs_f64();
    talk.say(&format!(
        "{}: {} buildings, {} x {} cells of {} m, {} outside; {} day{}, {:.1} h of sun ({})",
        args.city,
        city.buildings.len(),
        grid.width,
        grid.height,
        grid.cell,
        tiles.places().len(),
        when.days,
        if when.days == 1 { "" } else { "s" },
        when.hours(),
        when.zone,
    ));
    if !city.terrain.is_empty() {
        talk.say(&surface_line(&city, reach));
    }

    let measured = measure(args, &facets, &when, &tiles, cpu, stop);
    let Measured { minutes, done, .. } = &measured;
    if *done == 0 {
        talk.say("interrupted before there was anything to keep; nothing written");
        return Ok(ExitCode::from(interrupt::EXIT_CODE));
    }
    output::write(args, &city, &grid, &when, &tiles, minutes)?;
    let statistics = Statistics::new(
        args,
        &city,
        &grid,
        &when,
        &measured,
        load_seconds,
        cpu.threads(),
    );
    talk.say(&summary(&statistics));
    if args.output.is_none() && args.png.is_none() && !args.json {
        talk.say("nothing was written: -o shadow.tif keeps the minutes, --png shadow.png a map");
    }
    if args.json {
        let json = serde_json::to_string_pretty(&statistics)?;
        writeln!(io::stdout(), "{json}")?;
    }
    let is_whole = *done == minutes.len();
    Ok(ExitCode::from(if is_whole {
        0
    } else {
        interrupt::EXIT_CODE
    }))
}

/// How much surface there is, for people.
fn surface_line(city: &City, reach: f64) -> String {
    let within = if reach.is_finite() {
        format!("; shadows reach {:.1} km", reach / 1000.0)
    } else {
        "; the sun comes down to the horizon, so all of it counts".to_owned()
    };
    let (ground, above) = (city.terrain.len(), city.context.len());
    format!("{ground} triangles of ground, {above} of what stands on it{within}")
}

fn grid_over([west, south, east, north]: [f64; 4], cell: f64, origin: &Origin) -> Grid {
    // The sides of an area of the map need not be straight here: its corners and the middles of its sides.
    let (x, y) = (0.5 * (west + east), 0.5 * (south + north));
    let around = [
        [west, south],
        [x, south],
        [east, south],
        [east, y],
        [east, north],
        [x, north],
        [west, north],
        [west, y],
    ];
    let local = around.map(|map| origin.to_local(map));
    if local.iter().flatten().any(|x| !x.is_finite()) {
        wrong_usage(&format!(
            "--area: the map of the city has no such place; its coordinates are those of {}",
            origin.crs().name()
        ));
    }
    let least = |axis: usize| local.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
    let most = |axis: usize| {
        local
            .iter()
            .map(|p| p[axis])
            .fold(f64::NEG_INFINITY, f64::max)
    };
    let within = Grid::within([least(0), least(1)], [most(0), most(1)], cell);
    within.unwrap_or_else(|error| wrong_usage(&format!("--area: {error}")))
}

fn wrong_usage(message: &str) -> ! {
    super::wrong_usage("shadows", message)
}

fn no_days() -> ! {
    wrong_usage("say which days: --date 2026-12-21, --season winter, or --from DAY --to DAY")
}
