//! What is written and said.

use std::path::Path;

use ombra::accrual::Tiles;
use ombra::city::{City, Grid};
use ombra::formats::raster::{MapStyle, Raster, Unit, map_picture, write_geotiff};
use ombra::formats::{Metadata, write_image};
use serde::Serialize;

use super::args::{Method, ShadowsArgs};
use super::measure::Measured;
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
    width: u32,
    height: u32,
    cell: f64,
    /// Outside of buildings.
    places: usize,
    done: usize,
    minutes_least: f64,
    minutes_mean: f64,
    minutes_most: f64,
    threads: usize,
    load_seconds: f64,
    build_seconds: f64,
    seconds: f64,
    places_per_second: f64,
    interrupted: bool,
}

impl<'a> Statistics<'a> {
    pub(super) fn new(
        args: &'a ShadowsArgs,
        city: &City,
        grid: &Grid,
        when: &'a When,
        measured: &Measured,
        load_seconds: f64,
        threads: usize,
    ) -> Self {
        let minutes = &measured.minutes[..measured.done];
        let sum: f64 = minutes.iter().copied().map(f64::from).sum();
        Self {
            city: &args.city,
            output: args.output.as_deref(),
            png: args.png.as_deref(),
            method: args.method.name(),
            when: &when.text,
            time_zone: &when.zone,
            latitude: city.origin.latitude(),
            longitude: city.origin.longitude(),
            days: when.days,
            sun_hours: when.hours(),
            sun_points: when.suns.len(),
            buildings: city.buildings.len(),
            findings: city.findings.len(),
            width: grid.width,
            height: grid.height,
            cell: grid.cell,
            places: measured.minutes.len(),
            done: measured.done,
            minutes_least: minutes.iter().copied().fold(f32::INFINITY, f32::min).into(),
            minutes_mean: sum / measured.done as f64,
            minutes_most: minutes.iter().copied().fold(0.0, f32::max).into(),
            threads,
            load_seconds,
            build_seconds: measured.build_seconds,
            seconds: measured.seconds,
            places_per_second: measured.done as f64 / measured.seconds.max(1e-9),
            interrupted: measured.done < measured.minutes.len(),
        }
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
    let files = [statistics.output, statistics.png];
    let files: Vec<String> = files
        .iter()
        .flatten()
        .map(|file| file.display().to_string())
        .collect();
    let kept = if statistics.interrupted {
        "interrupted, kept what was done: "
    } else {
        ""
    };
    let files = if files.is_empty() {
        String::new()
    } else {
        format!("{}: ", files.join(", "))
    };
    let hours = statistics.sun_hours * 60.0;
    format!(
        "{kept}{files}{minutes_mean:.1} of {hours:.1} minutes in shadow on average, {minutes_most:.1} at most; \
         {:.2} s, {:.2} million places a second",
        build_seconds + seconds,
        places_per_second / 1e6,
    )
}

/// What is known of the times, for people.
fn bound(args: &ShadowsArgs, when: &When) -> String {
    let sun = when.sun();
    match args.method {
        Method::Exact => {
            format!(
                "exact in time, a day to 1 s and to 0.05 s in the mean, for a sun that is {sun}"
            )
        }
        Method::Sampled => {
            format!("one sample every {} s, for a sun that is {sun}", args.step)
        }
    }
}

pub(super) fn write(
    args: &ShadowsArgs,
    city: &City,
    grid: &Grid,
    when: &When,
    tiles: &Tiles,
    minutes: &[f32],
) -> anyhow::Result<()> {
    let mut values = vec![f32::NAN; grid.count()];
    for (&cell, &minutes) in tiles.cells().iter().zip(minutes) {
        values[cell as usize] = minutes;
    }
    let raster = Raster::new(&city.origin, *grid, Unit::Minutes, &values)?;
    if let Some(path) = &args.output {
        let entry = |key: &str, value: String| (key.to_owned(), value);
        let metadata = [
            entry("command", command()),
            entry(
                "version",
                concat!("ombra ", env!("CARGO_PKG_VERSION")).to_owned(),
            ),
            entry("when", when.text.clone()),
            entry("time_zone", when.zone.clone()),
            entry("days", when.days.to_string()),
            entry("sun", when.sun()),
            entry("sun_hours", format!("{:.6}", when.hours())),
            entry("method", args.method.name().to_owned()),
            entry("bound", bound(args, when)),
            entry("unit", "minutes in shadow".to_owned()),
        ];
        write_geotiff(path, &raster, &metadata)?;
    }
    if let Some(path) = &args.png {
        let name = Path::new(&args.city).file_stem().map_or_else(
            || args.city.clone(),
            |stem| stem.to_string_lossy().into_owned(),
        );
        let style = MapStyle {
            title: format!("Shadow: {name}"),
            subtitle: format!("{} ({})", when.text, when.zone),
            footer: format!("ombra {}; {}", env!("CARGO_PKG_VERSION"), bound(args, when)),
            max: None,
            ..MapStyle::default()
        };
        let metadata = Metadata {
            version: Some(concat!("ombra ", env!("CARGO_PKG_VERSION")).to_owned()),
            ..Metadata::default()
        };
        write_image(path, &map_picture(&raster, &style), &metadata)?;
    }
    Ok(())
}
