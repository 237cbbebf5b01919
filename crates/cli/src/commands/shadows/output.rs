//! What is written and said.

use std::path::Path;

use ombra::city::City;
use ombra::formats::places::{write_places_geojson, write_places_parquet};
use ombra::formats::raster::{MapStyle, Raster, Unit, map_picture, write_geotiff};
use ombra::formats::{Metadata, write_image};
use serde::Serialize;

use super::args::{Method, OutputKind, ShadowsArgs};
use super::measure::{Measured, SomeDays};
use super::places::{Kind, Places};
use super::reach::Reach;
use super::rows::with_rows;
use super::when::When;
use crate::commands::command;

/// What `--json` prints.
#[derive(Serialize)]
pub(super) struct Statistics<'a> {
    city: &'a str,
    output: Option<&'a Path>,
    png: Option<&'a Path>,
    method: &'static str,
    when: &'a str,
    /// The first day and the last.
    from: String,
    to: String,
    time_zone: &'a str,
    latitude: f64,
    longitude: f64,
    days: usize,
    /// Hours in which the sun counts.
    sun_hours: f64,
    /// Points that stand for the sun: 1, or those of its disc.
    sun_points: usize,
    buildings: usize,
    findings: usize,
    /// What is measured on: ground, roof, facade, points.
    on: &'static str,
    /// Of a grid.
    width: Option<u32>,
    height: Option<u32>,
    /// None for points.
    cell: Option<f64>,
    /// Outside of buildings.
    places: usize,
    /// Places on faces and points that lie in a building, or against one.
    hidden: usize,
    done: usize,
    /// By an earlier run.
    resumed: usize,
    surroundings: Reach,
    minutes_least: f64,
    minutes_mean: f64,
    minutes_most: f64,
    threads: usize,
    /// Set by whoever measured it.
    pub(super) load_seconds: f64,
    build_seconds: f64,
    seconds: f64,
    places_per_second: f64,
    interrupted: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    some_days: Option<SomeDays>,
}

impl<'a> Statistics<'a> {
    pub(super) fn new(
        args: &'a ShadowsArgs,
        city: &City,
        places: &Places,
        reach: Reach,
        when: &'a When,
        measured: &Measured,
        threads: usize,
    ) -> Self {
        let grid = match &places.kind {
            Kind::Grid { grid, .. } => Some(grid),
            _ => None,
        };
        let minutes = &measured.minutes[..measured.done];
        let sum: f64 = minutes.iter().copied().map(f64::from).sum();
        Self {
            city: &args.city,
            output: args.output.as_deref(),
            png: args.png.as_deref(),
            method: args.method.name(),
            when: &when.text,
            from: when.ends_on[0].to_string(),
            to: when.ends_on[1].to_string(),
            time_zone: &when.zone,
            latitude: city.origin.latitude(),
            longitude: city.origin.longitude(),
            days: when.days,
            sun_hours: when.hours(),
            sun_points: when.suns.len(),
            buildings: city.buildings.len(),
            findings: city.findings.len(),
            on: places.name(),
            width: grid.map(|grid| grid.width),
            height: grid.map(|grid| grid.height),
            cell: args.places.points.is_none().then_some(args.places.cell),
            places: measured.minutes.len(),
            hidden: places.hidden(),
            done: measured.done,
            resumed: measured.resumed,
            surroundings: reach,
            minutes_least: minutes.iter().copied().fold(f32::INFINITY, f32::min).into(),
            minutes_mean: sum / measured.done as f64,
            minutes_most: minutes.iter().copied().fold(0.0, f32::max).into(),
            threads,
            load_seconds: 0.0,
            build_seconds: measured.build_seconds,
            seconds: measured.seconds,
            places_per_second: (measured.done - measured.resumed) as f64
                / measured.seconds.max(1e-9),
            interrupted: measured.done < measured.minutes.len(),
            some_days: measured.some_days,
        }
    }
}

/// Which files were written, for the beginning of a line.
pub(super) fn files(written: [Option<&Path>; 2]) -> String {
    let files: Vec<String> = (written.iter().flatten())
        .map(|file| file.display().to_string())
        .collect();
    if files.is_empty() {
        String::new()
    } else {
        format!("{}: ", files.join(", "))
    }
}

/// One line for people.
pub(super) fn summary(statistics: &Statistics<'_>) -> String {
    let Statistics {
        minutes_mean,
        minutes_most,
        seconds,
        build_seconds,
        places_per_second,
        ..
    } = statistics;
    let kept = if statistics.interrupted && statistics.output.or(statistics.png).is_some() {
        "interrupted, kept what was done (--resume goes on): "
    } else if statistics.interrupted {
        "interrupted: "
    } else {
        ""
    };
    let files = files([statistics.output, statistics.png]);
    let minutes = statistics.sun_hours * 60.0;
    let some = statistics.some_days.filter(|some| some.days > 0);
    let some = some.map_or_else(String::new, |some| {
        format!(
            "; {} of {} days stand for all, {:.2} % off at most at {} places",
            some.days, statistics.days, some.compared.most, some.compared.places
        )
    });
    format!(
        "{kept}{files}{minutes_mean:.1} of {minutes:.1} minutes in shadow on average, {minutes_most:.1} at most{some}; \
         {:.2} s, {places_per_second:.0} places a second",
        build_seconds + seconds,
    )
}

/// What wrote a file.
pub(super) const VERSION: &str = concat!("ombra ", env!("CARGO_PKG_VERSION"));

/// How good exact times are, for people.
pub(super) const EXACT: &str = "exact in time: within 1 s a day, 0.05 s on average";

/// What a map calls what lies around the polygons of `--study`.
pub(super) const OUTSIDE: &str = "Outside of the study area";

/// What is known of the times, for people.
fn bound(args: &ShadowsArgs, when: &When, measured: &Measured) -> String {
    let sun = when.sun();
    match (args.method, measured.some_days) {
        (Method::Fast, Some(some)) if some.days > 0 => format!(
            "{} of {} days stand for all, within {} % of the time that the sun is up (at {} places compared with every \
             day, {:.2} % at most); the sun is {sun}",
            some.days,
            when.days,
            args.tolerance(),
            some.compared.places,
            some.compared.most
        ),
        (Method::Exact | Method::Fast, _) => format!("{EXACT}; the sun is {sun}"),
        (Method::Sampled, _) => {
            format!("one sample every {} s; the sun is {sun}", args.step())
        }
    }
}

/// How much of the places was measured, if not all.
fn share(measured: &Measured) -> Option<String> {
    let (done, all) = (measured.done, measured.minutes.len());
    (done < all).then(|| {
        let percent = 100.0 * done as f64 / all as f64;
        format!("interrupted, {percent:.1} % of the places are measured")
    })
}

pub(super) fn write(
    args: &ShadowsArgs,
    city: &City,
    places: &Places,
    when: &When,
    measured: &Measured,
) -> anyhow::Result<()> {
    let values = places.spread(&measured.minutes);
    if let Some(path) = &args.output {
        let metadata = of_run(args, when, measured);
        match (OutputKind::of(path), &places.kind) {
            (OutputKind::GeoJson, _) => with_rows(places, city, &values, None, |rows| {
                write_places_geojson(path, rows, &metadata)
            })?,
            (OutputKind::Parquet, _) => with_rows(places, city, &values, None, |rows| {
                write_places_parquet(path, rows, &metadata)
            })?,
            (OutputKind::GeoTiff, Kind::Grid { grid, .. }) => {
                let raster = Raster::new(&city.origin, *grid, Unit::Minutes, &values)?;
                write_geotiff(path, &raster, &metadata)?;
            }
            (OutputKind::GeoTiff, _) => unreachable!("refused before anything was measured"),
        }
    }
    if let (Some(path), Kind::Grid { grid, .. }) = (&args.png, &places.kind) {
        let raster = Raster::new(&city.origin, *grid, Unit::Minutes, &values)?;
        let title = || format!("Shadow: {}", stem(&args.city));
        let share = share(measured).map_or_else(String::new, |share| format!("{share}; "));
        let style = MapStyle {
            title: args.title.clone().unwrap_or_else(title),
            subtitle: format!("{} ({})", when.text, when.zone),
            footer: format!("{share}{VERSION}; {}", bound(args, when, measured)),
            outside: places.outside(city, measured.done),
            outside_name: if share.is_empty() {
                OUTSIDE.to_owned()
            } else {
                "Not measured".to_owned()
            },
            // Of a season nobody counts minutes.
            unit: if when.days > 2 {
                Unit::Hours
            } else {
                Unit::Minutes
            },
            blank: if city.buildings.is_empty() {
                "Not ground".to_owned()
            } else {
                String::new()
            },
            ..MapStyle::default()
        };
        write_map(path, &raster, &style)?;
    }
    Ok(())
}

pub(super) fn write_map(path: &Path, raster: &Raster<'_>, style: &MapStyle) -> anyhow::Result<()> {
    let metadata = Metadata {
        version: Some(VERSION.to_owned()),
        ..Metadata::default()
    };
    Ok(write_image(path, &map_picture(raster, style), &metadata)?)
}

/// The name of a city's file.
pub(super) fn stem(city: &str) -> String {
    let stem = Path::new(city).file_stem();
    stem.map_or_else(
        || city.to_owned(),
        |stem| stem.to_string_lossy().into_owned(),
    )
}

/// What says how the numbers of a run came about.
pub(super) fn of_run(
    args: &ShadowsArgs,
    when: &When,
    measured: &Measured,
) -> Vec<(String, String)> {
    let bound = bound(args, when, measured);
    let mut metadata = metadata(when, args.method, bound, "minutes in shadow");
    metadata.extend(share(measured).map(|share| ("measured".to_owned(), share)));
    metadata
}

/// What says how the numbers came about: those of a method, with its bound, of what `unit` says.
pub(super) fn metadata(
    when: &When,
    method: Method,
    bound: String,
    unit: &str,
) -> Vec<(String, String)> {
    let all = [
        ("command", command()),
        ("version", VERSION.to_owned()),
        ("when", when.text.clone()),
        ("time_zone", when.zone.clone()),
        ("days", when.days.to_string()),
        ("sun", when.sun()),
        ("sun_hours", format!("{:.6}", when.hours())),
        ("method", method.name().to_owned()),
        ("bound", bound),
        ("unit", unit.to_owned()),
    ];
    all.map(|(key, value)| (key.to_owned(), value)).into()
}
