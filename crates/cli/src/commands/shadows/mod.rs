//! `ombra shadows`: from a city to the map of its shadow.

mod args;
mod bound;
mod clock;
mod command;
mod demo;
mod measure;
mod output;
mod partial;
mod places;
mod products;
mod reach;
mod report;
mod rows;
mod site;
mod spells;
mod what_if;
mod when;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use anyhow::Context as _;
use ombra::city::City;
use ombra::formats::can_write_whole;
use ombra::pipeline::Cpu;
use ombra::sun::Place;

use args::Method;
pub(crate) use args::{OutputKind, ShadowsArgs};
pub(crate) use command::ShadowsCommand;
use measure::{Measured, measure};
use output::{Statistics, summary};
use partial::Partial;
use places::{Asked, Places};
use reach::Reach;
use site::Site;
use when::When;

use super::{Talk, print_json};
use crate::interrupt;

/// The city that is built in.
const DEMO: &str = "demo";

pub(crate) fn run(command: &ShadowsCommand) -> anyhow::Result<ExitCode> {
    match command {
        ShadowsCommand::City(args) => of_city(args),
        ShadowsCommand::Query(args) => spells::query::run(args),
    }
}

fn of_city(args: &ShadowsArgs) -> anyhow::Result<ExitCode> {
    if let Some(rule) = args.report.report {
        return report::run(args, rule);
    }
    refuse_unknown_output(args);
    let is_demo = args.city == DEMO;
    let asks_for_files = args.files().next().is_some();
    let is_tour = is_demo && !asks_for_files && !args.when.names_days() && args.places.is_grid();
    let is_tour = is_tour && !args.what_if.is_asked() && !args.spells.is_asked();
    if !is_tour && !args.when.names_days() {
        no_days();
    }
    if is_tour && args.json {
        wrong_usage("--json is for one map: name its days, as with --date 2026-12-21");
    }
    refuse_maps_of_no_grid(args);
    products::refuse(args);
    refuse_what_is_not_used(args);
    refuse_to_write_what_is_read(args.inputs(), args.files());
    spells::refuse(args);
    if args.resume && !asks_for_files && !is_tour {
        wrong_usage("--resume goes on with an output: name it, with -o or --png");
    }
    let session = Session::new(args)?;
    if args.what_if.is_asked() && !args.spells.is_asked() {
        what_if::run(args, &session)
    } else if is_tour {
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

impl Session {
    fn new(args: &ShadowsArgs) -> anyhow::Result<Self> {
        Ok(Self {
            cpu: Cpu::with_threads(args.threads as usize).context("cannot start the threads")?,
            stop: interrupt::watch(args.quiet)?,
        })
    }
}

/// One map.
fn one(args: &ShadowsArgs, session: &Session) -> anyhow::Result<ExitCode> {
    let Session { cpu, stop } = session;
    let talk = Talk { quiet: args.quiet };
    // What would fail in the end fails at once.
    can_write(args)?;

    let begun = Instant::now();
    let mut site = cpu.install(|| Site::read(args))?;
    if args.what_if.is_asked() {
        what_if::edit(args, &mut site, cpu, &talk)?;
        talk.say(&format!("{}: as it is after the change", args.city));
    }
    let place = Place::new(site.origin().latitude(), site.origin().longitude(), 0.0)?;
    let when = cpu.install(|| When::new(&args.when, args.sun, place, args.samples_step()))?;
    let all = cpu.install(|| site.extent());
    let surface = site.surface();
    let asked = Asked::read(&args.places, site.origin(), all, &talk)?;
    let (places, lowest) = (asked.extent(all), when.lowest_altitude());
    let (city, reach) = cpu.install(|| site.city(places, lowest))?;
    for finding in &city.findings {
        talk.say(&format!("{}: {finding}", args.city));
    }
    let facets = city.facets();
    let places = cpu.install(|| Places::new(&args.places, asked, &city, all, &talk))?;
    products::check(args, &city, &places, &when)?;
    let around = cpu.install(|| Reach::new(&facets, surface, &places.tiles, &when));
    let load_seconds = begun.elapsed().as_secs_f64();
    talk.say(&format!(
        "{}: {} building{}, {}; {} day{} ({}), {:.1} h of sun ({})",
        args.city,
        city.buildings.len(),
        if city.buildings.len() == 1 { "" } else { "s" },
        places.describe(),
        when.days,
        if when.days == 1 { "" } else { "s" },
        match when.ends_on {
            [first, last] if first == last => first.to_string(),
            [first, last] => format!("{first} to {last}"),
        },
        when.hours(),
        when.zone,
    ));
    if !city.terrain.is_empty() {
        talk.say(&surface_line(&city, reach));
    }
    if args.places.is_part() {
        talk.say(&format!("{}: {}", args.city, around.describe()));
    }

    let mut kept = if args.spells.is_asked() {
        None
    } else {
        Partial::open(args, &facets, &places.tiles, &when)?
    };
    if let Some((_, before)) = kept.as_ref().filter(|_| args.resume) {
        let all = places.tiles.places().len();
        talk.say(&match before.len() {
            0 => "nothing to go on from: it begins anew".to_owned(),
            done => format!("goes on: {done} of {all} places are done"),
        });
    }
    let found = if args.spells.is_asked() {
        spells::measure(args, session, &city, &facets, &when, &places, &talk)?
    } else {
        let tiles = &places.tiles;
        Some((
            measure(args, &facets, &when, tiles, cpu, stop, &mut kept),
            None,
        ))
    };
    let Some((measured, attribution)) = found else {
        talk.say("interrupted before there was anything to keep; nothing written");
        return Ok(ExitCode::from(interrupt::EXIT_CODE));
    };
    let Measured { minutes, done, .. } = &measured;
    if *done == 0 {
        talk.say("interrupted before there was anything to keep; nothing written");
        return Ok(ExitCode::from(interrupt::EXIT_CODE));
    }
    let is_whole = *done == minutes.len();
    if let Some((partial, _)) = kept.as_ref().filter(|_| !is_whole) {
        partial.keep(&minutes[..*done])?;
    }
    let by = attribution
        .as_ref()
        .map(|found| found.spread(&places, &city));
    output::write(args, &city, &places, &when, &measured, by.as_deref())?;
    let are_written = products::write(&products::Job {
        args,
        session,
        before: None,
        city: &city,
        places: &places,
        when: &when,
        minutes: products::Minutes::Plain(&places.spread(&measured.minutes)),
        metadata: output::of_run(args, &when, &measured),
        talk: &talk,
    })?;
    if let Some((partial, _)) = kept.as_ref().filter(|_| is_whole) {
        partial.remove()?;
    }
    let threads = cpu.threads();
    let mut statistics = Statistics::new(args, &city, &places, around, &when, &measured, threads);
    statistics.load_seconds = load_seconds;
    statistics.by_building = attribution.map(|found| found.buildings);
    talk.say(&summary(&statistics));
    if args.files().next().is_none() && !args.json {
        talk.say("nothing was written: -o keeps the minutes (.tif, .geojson, .parquet), --png shadow.png is a map");
    }
    if args.json {
        print_json(&statistics)?;
    }
    Ok(ExitCode::from(if is_whole && are_written {
        0
    } else {
        interrupt::EXIT_CODE
    }))
}

/// Whether all outputs could be written now.
fn can_write(args: &ShadowsArgs) -> anyhow::Result<()> {
    for path in args.single_files() {
        can_write_whole(path)?;
    }
    args.products.can_write()
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

/// A picture and a GeoTIFF show a grid from above; there is none of façades, roofs and points.
fn refuse_maps_of_no_grid(args: &ShadowsArgs) {
    if args.places.is_grid() {
        return;
    }
    let is_geotiff = |path: &PathBuf| OutputKind::of(path) == OutputKind::GeoTiff;
    if args.places.margin.is_some() {
        wrong_usage("--margin is for the map of the ground");
    }
    if args.png.is_some() || args.output.as_ref().is_some_and(is_geotiff) {
        wrong_usage(
            "a map (--png, .tif) is of the grid over the ground; places on roofs and facades and points are written \
             with -o as .geojson or .parquet",
        );
    }
}

fn refuse_what_is_not_used(args: &ShadowsArgs) {
    if args.tolerance.is_some() && args.method != Method::Fast {
        wrong_usage("--tolerance is for --method fast");
    }
    if args.step.is_some() && args.method != Method::Sampled {
        wrong_usage("--step is for --method sampled");
    }
}

/// By its ending an output is a map or a list.
fn refuse_unknown_output(args: &ShadowsArgs) {
    let wrong = |path: &PathBuf| args::output(&path.to_string_lossy()).err();
    if let Some(error) = args.output.as_ref().and_then(wrong) {
        wrong_usage(&format!("-o: {error}"));
    }
}

/// No output may be one of the files that are read, or another output, by whatever name.
fn refuse_to_write_what_is_read<'a>(
    inputs: impl IntoIterator<Item = &'a Path>,
    outputs: impl IntoIterator<Item = impl AsRef<Path>>,
) {
    let inputs: Vec<PathBuf> = inputs.into_iter().filter_map(whole_path).collect();
    let mut known = Vec::new();
    for output in outputs {
        let output = output.as_ref();
        let wrong = |why: &str| wrong_usage(&format!("{}: {why}", output.display()));
        let Some(whole) = whole_path(output) else {
            continue;
        };
        if inputs.contains(&whole) {
            wrong("is a file that is read; write to another one");
        }
        if known.contains(&whole) {
            wrong("is written twice; give each output a name of its own");
        }
        known.push(whole);
    }
}

/// Where a file is or is to be, without links; none if its folder is not there.
fn whole_path(path: &Path) -> Option<PathBuf> {
    let name = || {
        let folder = path
            .parent()
            .filter(|folder| !folder.as_os_str().is_empty());
        let folder = std::fs::canonicalize(folder.unwrap_or(Path::new("."))).ok()?;
        Some(folder.join(path.file_name()?))
    };
    std::fs::canonicalize(path).ok().or_else(name)
}

fn wrong_usage(message: &str) -> ! {
    super::wrong_usage("shadows", message)
}

fn no_days() -> ! {
    wrong_usage("say which days: --date 2026-12-21, --season winter, or --from DAY --to DAY")
}
