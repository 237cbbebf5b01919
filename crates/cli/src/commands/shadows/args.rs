//! What may be asked of `ombra shadows`.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::{Args, ValueEnum};
use ombra::city::Crs;
use ombra::formats::city::CityOptions;
use ombra::sun::{Months, Season, SunError, Weekdays, Window, parse_duration};

use super::places::PlacesArgs;
use super::products::ProductsArgs;
use super::report::ReportArgs;
use super::site::SurroundingsArgs;
use super::spells::SpellsArgs;
use super::what_if::WhatIfArgs;

/// How many minutes each place of a city lies in shadow: of the ground, on roofs, on facades, or points of yours
///
/// Over one day or many, within hours by the clock, by the sun, or all that the sun is up. Minutes are exact:
/// no instants are sampled, it is worked out when each wall begins and ends to cover the sun.
#[derive(Clone, Debug, Args)]
pub(crate) struct ShadowsArgs {
    /// A city: GeoJSON, CityJSON, OpenStreetMap (.osm, .osm.pbf), a surface model (GeoTIFF), or `demo`, which is
    /// built in
    pub(crate) city: String,

    /// Where to write minutes of shadow: a GeoTIFF (.tif), or places as GeoJSON (.geojson) or GeoParquet (.parquet); of
    /// a report the name of its files
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,

    /// Where to write a map as a picture (.png)
    #[arg(long, value_name = "OUT", value_parser = png)]
    pub(crate) png: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) when: WhenArgs,

    #[command(flatten)]
    pub(crate) sun: SunArgs,

    #[command(flatten)]
    pub(crate) places: PlacesArgs,

    /// What the coordinates of the file mean, whatever it says itself: EPSG:25832, a PROJ string, WKT
    #[arg(long, value_name = "CRS", value_parser = crs)]
    pub(crate) crs: Option<Crs>,

    /// The attribute that tells how tall a building is [default: the first one that is known]
    #[arg(long, value_name = "NAME")]
    pub(crate) height_attribute: Option<String>,

    /// How tall a building is that does not say so, in metres [default: it is left out]
    #[arg(long, value_name = "METRES", value_parser = metres)]
    pub(crate) default_height: Option<f64>,

    #[command(flatten)]
    pub(crate) surroundings: SurroundingsArgs,

    #[command(flatten)]
    pub(crate) what_if: WhatIfArgs,

    #[command(flatten)]
    pub(crate) spells: SpellsArgs,

    #[command(flatten)]
    pub(crate) report: ReportArgs,

    #[command(flatten)]
    pub(crate) products: ProductsArgs,

    /// How minutes are found
    #[arg(long, value_enum, default_value_t = Method::Exact)]
    pub(crate) method: Method,

    /// With --method fast: how far off minutes may be, in percent of the time that the sun is up [default: 0.5]
    #[arg(long, value_name = "PERCENT", value_parser = tolerance)]
    pub(crate) tolerance: Option<f64>,

    /// With --method sampled: time between samples, 1min, 30s [default: 1min]
    #[arg(long, value_name = "TIME", value_parser = step)]
    pub(crate) step: Option<f64>,

    /// The title of maps, frames, tiles and reports [default: the name of the city's file]
    #[arg(long, value_name = "TEXT")]
    pub(crate) title: Option<String>,

    /// Go on where a run with the same output was interrupted or ended: what it had done lies in OUT.partial
    #[arg(long)]
    pub(crate) resume: bool,

    /// Threads to use; 0 means all
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=1024))]
    pub(crate) threads: u32,

    /// No progress bar, no talk
    #[arg(long)]
    pub(crate) quiet: bool,

    /// The numbers on standard output as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

impl ShadowsArgs {
    /// How cities are to be read.
    pub(super) fn city_options(&self) -> CityOptions {
        let mut options = CityOptions {
            crs: self.crs.clone(),
            ..CityOptions::default()
        };
        options.heights.attribute.clone_from(&self.height_attribute);
        options.heights.default = self.default_height;
        options
    }

    /// Seconds between samples, if there are any.
    pub(crate) fn samples_step(&self) -> Option<f64> {
        (self.method == Method::Sampled).then(|| self.step())
    }

    /// The same, whether or not there are any.
    pub(crate) fn step(&self) -> f64 {
        self.step.unwrap_or(60.0)
    }

    /// With how much error fast minutes are content, in percent of the time that the sun is up.
    pub(crate) fn tolerance(&self) -> f64 {
        self.tolerance.unwrap_or(0.5)
    }

    /// The files and folders that are written.
    pub(crate) fn files(&self) -> impl Iterator<Item = &Path> {
        self.single_files().chain(self.products.files())
    }

    /// Those of them that are a file each, put in its place when it is whole.
    pub(super) fn single_files(&self) -> impl Iterator<Item = &Path> {
        let SpellsArgs {
            spells,
            by_building,
            ..
        } = &self.spells;
        let all = [&self.output, &self.png, spells, by_building];
        all.into_iter().flatten().map(PathBuf::as_path)
    }

    /// The files that are read.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = &Path> {
        let PlacesArgs { study, points, .. } = &self.places;
        let SurroundingsArgs {
            terrain, context, ..
        } = &self.surroundings;
        let resources = &self.report.resources;
        let files = [study, points, terrain, resources].into_iter().flatten();
        let files = files.chain(context).chain(&self.what_if.with);
        [Path::new(&self.city)]
            .into_iter()
            .chain(files.map(PathBuf::as_path))
    }

    /// All that the minutes depend on beside city, places and time.
    pub(crate) fn method_text(&self) -> String {
        match self.method {
            Method::Exact => Method::Exact.name().to_owned(),
            Method::Fast => format!("{}, to {} %", Method::Fast.name(), self.tolerance()),
            Method::Sampled => format!("{}, each {} s", Method::Sampled.name(), self.step()),
        }
    }
}

/// What an output is, by its ending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OutputKind {
    GeoTiff,
    GeoJson,
    Parquet,
}

impl OutputKind {
    /// Of a path that [`output`] took.
    pub(crate) fn of(path: &Path) -> Self {
        if has_ending(path, &GEOJSON) {
            Self::GeoJson
        } else if has_ending(path, &PARQUET) {
            Self::Parquet
        } else {
            Self::GeoTiff
        }
    }
}

/// When.
#[derive(Clone, Debug, Args)]
pub(crate) struct WhenArgs {
    /// Which days: 2026-12-21, 2026-06-01..2026-08-31, 2026-03, 2026, winter, "winter 2026", or several with commas
    #[arg(long, value_name = "DAYS", conflicts_with_all = ["from", "season"])]
    pub(crate) date: Option<String>,

    /// The first day of a period
    #[arg(long, value_name = "DAY", requires = "to")]
    pub(crate) from: Option<String>,

    /// The last day of a period
    #[arg(long, value_name = "DAY", requires = "from")]
    pub(crate) to: Option<String>,

    /// A season: winter, spring, summer, fall; of the hemisphere that the city is in
    #[arg(long, value_name = "NAME", conflicts_with = "from", value_parser = said::<Season>)]
    pub(crate) season: Option<Said<Season>>,

    /// The year of what is named without one [default: this year; of a file of spells its first]
    #[arg(long, value_name = "YEAR")]
    pub(crate) year: Option<i16>,

    /// Only some weekdays: mon-fri,sun
    #[arg(long, value_name = "DAYS", value_parser = said::<Weekdays>)]
    pub(crate) weekdays: Option<Said<Weekdays>>,

    /// Only some months: jan,mar-may
    #[arg(long, value_name = "MONTHS", value_parser = said::<Months>)]
    pub(crate) months: Option<Said<Months>>,

    /// Only these hours by the clock: 09:00-15:30, or several with commas
    #[arg(long, value_name = "HOURS", value_parser = hours)]
    pub(crate) hours: Option<Said<Vec<Window>>>,

    /// Only these hours of true solar time: 08:00-16:00, or several with commas; with --hours, what either of them names
    #[arg(long, value_name = "HOURS", value_parser = hours)]
    pub(crate) solar_time: Option<Said<Vec<Window>>>,

    /// Not before so long after sunrise: 90min
    #[arg(long, value_name = "TIME", default_value = "0min", value_parser = duration)]
    pub(crate) after_sunrise: f64,

    /// Not after so long before sunset: 90min
    #[arg(long, value_name = "TIME", default_value = "0min", value_parser = duration)]
    pub(crate) before_sunset: f64,

    /// At which altitude of the sun's middle, in degrees, it rises: a rule may say so
    #[arg(skip)]
    pub(crate) sunrise: f64,

    /// Only while the sun stands at least so high, in degrees [default: 0; with --report bre 10]
    #[arg(long, value_name = "DEGREES")]
    pub(crate) min_altitude: Option<f64>,

    /// The time zone of the clock: Europe/Berlin [default: that of the place]
    #[arg(long, value_name = "ZONE")]
    pub(crate) time_zone: Option<String>,
}

/// What the sun is taken for.
#[derive(Clone, Copy, Debug, Default, Args)]
pub(crate) struct SunArgs {
    /// Lift the sun by refraction, as air at sea level does
    #[arg(long)]
    pub(crate) refraction: bool,

    /// The sun as a disc, not a point: minutes in shadow count by how much of it is covered; takes 7 times as long
    #[arg(long)]
    pub(crate) disc: bool,
}

impl WhenArgs {
    /// Whether it is said which days.
    pub(crate) const fn names_days(&self) -> bool {
        self.date.is_some() || self.from.is_some() || self.season.is_some()
    }

    /// Whether it is said which days or hours.
    pub(crate) fn names_time(&self) -> bool {
        self.names_days()
            || self.weekdays.is_some()
            || self.months.is_some()
            || self.hours.is_some()
            || self.solar_time.is_some()
            || self.after_sunrise > 0.0
            || self.before_sunset > 0.0
            || self.min_altitude.is_some()
    }
}

/// What was typed, and what it means.
#[derive(Clone, Debug)]
pub(crate) struct Said<T> {
    pub(crate) text: String,
    pub(crate) value: T,
}

impl<T> Said<T> {
    fn new(text: &str, value: Result<T, SunError>) -> Result<Self, String> {
        let value = value.map_err(|error| error.to_string())?;
        let text = text.to_owned();
        Ok(Self { text, value })
    }
}

fn said<T: FromStr<Err = SunError>>(text: &str) -> Result<Said<T>, String> {
    Said::new(text, text.parse())
}

fn hours(text: &str) -> Result<Said<Vec<Window>>, String> {
    Said::new(text, Window::list(text))
}

/// How minutes are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Method {
    /// When each wall begins and ends to cover the sun
    Exact,
    /// The same on some of the days, and on every day where these do not tell: as --tolerance asks
    Fast,
    /// One ray toward the sun every --step
    Sampled,
}

impl Method {
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Fast => "fast",
            Self::Sampled => "sampled",
        }
    }
}

/// Whether a file has one of these endings, in whatever case.
pub(super) fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let own = path
        .extension()
        .map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    own.is_some_and(|own| endings.contains(&own.as_str()))
}

pub(super) fn ends_in(text: &str, endings: &[&str]) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if has_ending(&path, endings) {
        Ok(path)
    } else {
        Err(format!(
            "a file that ends in .{} is wanted",
            endings.join(" or .")
        ))
    }
}

/// The endings of maps as numbers.
pub(super) const GEOTIFF: [&str; 2] = ["tif", "tiff"];

/// The endings of files of places.
pub(super) const GEOJSON: [&str; 2] = ["geojson", "json"];
const PARQUET: [&str; 2] = ["parquet", "geoparquet"];

/// What minutes of shadow are written to; a report has names of its own.
pub(crate) fn output(text: &str) -> Result<PathBuf, String> {
    ends_in(text, &[&GEOTIFF[..], &GEOJSON, &PARQUET].concat())
}

pub(super) fn parquet(text: &str) -> Result<PathBuf, String> {
    ends_in(text, &PARQUET)
}

pub(super) fn csv(text: &str) -> Result<PathBuf, String> {
    ends_in(text, &["csv"])
}

fn png(text: &str) -> Result<PathBuf, String> {
    ends_in(text, &["png"])
}

pub(super) fn cell(text: &str) -> Result<f64, String> {
    match metres(text)? {
        metres if (0.01..=10_000.0).contains(&metres) => Ok(metres),
        _ => Err("0.01 to 10000 metres are wanted".to_owned()),
    }
}

pub(super) fn metres(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches('m').trim_end();
    match number.parse::<f64>() {
        Ok(metres) if metres > 0.0 && metres.is_finite() => Ok(metres),
        _ => Err("metres above 0 are wanted, as 1, 0.5m or \"2 m\"".to_owned()),
    }
}

fn duration(text: &str) -> Result<f64, String> {
    parse_duration(text).map_err(|error| error.to_string())
}

fn tolerance(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches('%').trim_end();
    match number.parse::<f64>() {
        Ok(percent) if (0.0..=10.0).contains(&percent) => Ok(percent),
        _ => Err("0 to 10 percent are wanted, as 0.5 or 0.5%".to_owned()),
    }
}

fn step(text: &str) -> Result<f64, String> {
    match duration(text)? {
        seconds if seconds >= 1.0 => Ok(seconds),
        _ => Err("a second or more is wanted, as 1min or 30s".to_owned()),
    }
}

pub(super) fn crs(text: &str) -> Result<Crs, String> {
    Crs::parse(text).map_err(|error| error.to_string())
}

pub(super) fn area(text: &str) -> Result<[f64; 4], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[west, south, east, north]) if west < east && south < north => Ok([west, south, east, north]),
        _ => Err("four numbers are wanted: west,south,east,north, with west below east and south below north".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_units_and_ranges() {
        assert_eq!(metres("1"), Ok(1.0));
        assert_eq!(metres("0.5m"), Ok(0.5));
        assert_eq!(metres("2 m"), Ok(2.0));
        for wrong in ["", "0", "-1", "nan", "inf", "1km"] {
            assert!(metres(wrong).is_err(), "{wrong}");
        }
        assert_eq!(tolerance("0.5%"), Ok(0.5));
        assert_eq!(tolerance("0"), Ok(0.0));
        for wrong in ["", "-1", "11", "nan", "half"] {
            assert!(tolerance(wrong).is_err(), "{wrong}");
        }
        assert_eq!(area("-1,2,3.5,4"), Ok([-1.0, 2.0, 3.5, 4.0]));
        for wrong in ["", "1,2,3", "3,2,1,4", "1,2,3,nan", "a,b,c,d"] {
            assert!(area(wrong).is_err(), "{wrong}");
        }
        assert!(output("a.png").is_err() && png("a").is_err());
        for (name, kind) in [
            ("a.TIF", OutputKind::GeoTiff),
            ("a.b.geojson", OutputKind::GeoJson),
            ("a.Parquet", OutputKind::Parquet),
        ] {
            assert_eq!(OutputKind::of(&output(name).unwrap()), kind);
        }
    }
}
