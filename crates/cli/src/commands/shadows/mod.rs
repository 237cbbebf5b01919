//! `ombra shadows`: from a city to the map of its shadow.

mod args;
mod demo;
mod measure;
mod output;
mod when;

use std::io::{self, Write as _};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use anyhow::{Context as _, bail};
use ombra::accrual::Tiles;
use ombra::city::{City, Facet, Grid};
use ombra::formats::can_write_whole;
use ombra::formats::city::{CityOptions, read_city};
use ombra::pipeline::Cpu;
use ombra::sun::Place;

pub(crate) use args::ShadowsArgs;
use measure::{Measured, measure};
use output::{Statistics, summary};
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
    let city = cpu.install(|| load(args))?;
    for finding in &city.findings {
        talk.say(&format!("{}: {finding}", args.city));
    }
    let place = Place::new(city.origin.latitude(), city.origin.longitude(), 0.0)?;
    let when = cpu.install(|| When::new(&args.when, place, args.step))?;
    let facets = city.facets();
    let grid = grid(args, &city, &facets)?;
    let tiles = cpu.install(|| Tiles::on_ground(&city, &grid));
    if tiles.is_empty() {
        bail!(
            "{}: no place of the grid lies outside of buildings; take smaller cells",
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

fn load(args: &ShadowsArgs) -> anyhow::Result<City> {
    if args.city == DEMO {
        return Ok(ombra::city::demo_city());
    }
    let mut options = CityOptions {
        crs: args.crs.clone(),
        ..CityOptions::default()
    };
    options.heights.attribute.clone_from(&args.height_attribute);
    options.heights.default = args.default_height;
    Ok(read_city(&args.city, &options)?)
}

fn grid(args: &ShadowsArgs, city: &City, facets: &[Facet]) -> anyhow::Result<Grid> {
    let Some([west, south, east, north]) = args.area else {
        return Ok(Grid::over(facets, args.cell)?);
    };
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
    let local = around.map(|map| city.origin.to_local(map));
    if local.iter().flatten().any(|x| !x.is_finite()) {
        wrong_usage(&format!(
            "--area: the map of the city has no such place; its coordinates are those of {}",
            city.origin.crs().name()
        ));
    }
    let least = |axis: usize| local.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
    let most = |axis: usize| {
        local
            .iter()
            .map(|p| p[axis])
            .fold(f64::NEG_INFINITY, f64::max)
    };
    let within = Grid::within([least(0), least(1)], [most(0), most(1)], args.cell);
    Ok(within.unwrap_or_else(|error| wrong_usage(&format!("--area: {error}"))))
}

fn wrong_usage(message: &str) -> ! {
    super::wrong_usage("shadows", message)
}

fn no_days() -> ! {
    wrong_usage("say which days: --date 2026-12-21, --season winter, or --from DAY --to DAY")
}
