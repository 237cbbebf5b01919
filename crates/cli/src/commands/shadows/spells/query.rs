//! `ombra shadows query`: answers from a file of spells, without looking at the city again.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use anyhow::{Context as _, bail};
use clap::Args;
use jiff::civil::Date;
use jiff::tz::TimeZone;
use ombra::accrual::{Counted, Share, Stretch, Summary};
use ombra::formats::can_write_whole;
use ombra::formats::spells::{SpellsAbout, SpellsFile};
use ombra::pipeline::Cpu;
use ombra::sun::{Place, Span};
use rayon::prelude::*;
use serde::Serialize;

use super::super::args::{SunArgs, WhenArgs, csv, ends_in};
use super::super::refuse_to_write_what_is_read;
use super::super::when::{When, calendar};
use super::answer::{self, Answer, Answered};
use super::buildings::{self, BuildingRow, Buildings};
use super::counted::{Weight, weighed};
use crate::commands::Talk;

/// Answers from a file of spells, in no time: minutes of shadow and sun, the first and the last sun, the longest, how often
///
/// Of all that the file holds, or of some of its days and hours. --weight makes hours or days count more or less.
#[derive(Clone, Debug, Args)]
pub(crate) struct QueryArgs {
    /// What `ombra shadows CITY --spells` wrote (.parquet)
    spells: PathBuf,

    /// Where to write a row for each place: a table (.csv), GeoJSON (.geojson), or of a grid a map (.tif)
    #[arg(short, long, value_name = "OUT", value_parser = output)]
    output: Option<PathBuf>,

    #[command(flatten)]
    when: WhenArgs,

    /// How much some hours by the clock or some days count: 12:00-14:00=2, 2026-12-21=0.5, winter=2; those of several are
    /// multiplied
    #[arg(long, value_name = "WHAT=NUMBER", value_parser = Weight::parse)]
    weight: Vec<Weight>,

    /// Only the shadow of this building counts, and all else is sun: its name, or #0, #1, … by its number
    #[arg(long, value_name = "ID", conflicts_with = "by_building")]
    building: Option<String>,

    /// A table (.csv) of buildings: how many places each shades, for how long, and what it takes alone
    #[arg(long, value_name = "OUT", value_parser = csv)]
    by_building: Option<PathBuf>,

    /// Threads to use; 0 means all
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=1024))]
    threads: u32,

    /// No talk
    #[arg(long)]
    quiet: bool,

    /// The numbers on standard output as JSON
    #[arg(long)]
    json: bool,
}

fn output(text: &str) -> Result<PathBuf, String> {
    ends_in(text, &["csv", "geojson", "tif", "tiff"])
}

fn wrong_usage(message: &str) -> ! {
    crate::commands::wrong_usage("shadows query", message)
}

/// What `--json` prints.
#[derive(Serialize)]
struct Statistics<'a> {
    spells: &'a PathBuf,
    output: Option<&'a PathBuf>,
    places: usize,
    when: &'a str,
    weights: Vec<String>,
    /// Whose shadow counts, if not that of all.
    building: Option<&'a str>,
    time_zone: &'a str,
    /// Hours that are asked about, by their weights.
    sun_hours: f64,
    minutes_least: f64,
    minutes_mean: f64,
    minutes_most: f64,
    /// Of sun without a break.
    longest_sun_mean: f64,
    spells_mean: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    by_building: Option<&'a [BuildingRow]>,
    threads: usize,
    read_seconds: f64,
    /// What the answers themselves took.
    seconds: f64,
}

pub(crate) fn run(args: &QueryArgs) -> anyhow::Result<ExitCode> {
    let talk = Talk { quiet: args.quiet };
    let outputs = || [&args.output, &args.by_building].into_iter().flatten();
    refuse_to_write_what_is_read([&*args.spells], outputs());
    for path in outputs() {
        can_write_whole(path)?;
    }
    if args.when.year.is_some() && !args.when.names_days() && args.weight.is_empty() {
        wrong_usage(
            "--year is of days that are named without one, as winter; --date 2026 is a year",
        );
    }
    let cpu = Cpu::with_threads(args.threads as usize).context("cannot start the threads")?;
    let file = SpellsFile::open(&args.spells)?;
    let about = file.about();
    if args
        .output
        .as_ref()
        .is_some_and(|path| answer::is_map(path))
        && about.grid().is_none()
    {
        wrong_usage(
            "a map (.tif) is of a grid over the ground; places on roofs and facades and points are written as .csv or \
             .geojson",
        );
    }
    let building = (args.building.as_ref())
        .map(|name| find(name, about))
        .transpose()?;
    let (when, counted) = cpu.install(|| asked(args, about, &talk))?;

    let asked = Asked {
        counted,
        building,
        is_by_building: args.by_building.is_some(),
    };
    let begun = Instant::now();
    let groups = cpu.install(|| {
        let each = (0..file.groups()).into_par_iter();
        each.map(|group| asked.answer(&file, group))
            .collect::<Result<Vec<_>, _>>()
    })?;
    let took = begun.elapsed().as_secs_f64();
    let places: usize = groups.iter().map(|group| group.places.len()).sum();
    if places == 0 {
        bail!("{}: holds no place", args.spells.display());
    }
    // Threads do both at once: by what each of them took.
    let [read, answered] = groups.iter().fold([1e-9, 0.0], |[read, answered], group| {
        [read + group.took[0], answered + group.took[1]]
    });
    let read_seconds = took * read / (read + answered);
    let by_building = args.by_building.as_ref().map(|_| {
        let mut all = Buildings::default();
        groups
            .iter()
            .for_each(|group| all.add_all(&group.buildings));
        all.rows(about.grid().map(|grid| grid.cell), |number| {
            about.buildings[number].clone()
        })
    });

    if let Some(path) = &args.output {
        let answer = Answer {
            about,
            groups: &groups,
            metadata: metadata(&file, &when, args),
            zone: &when.zone,
        };
        answer.write(path)?;
    }
    if let (Some(path), Some(rows)) = (&args.by_building, &by_building) {
        buildings::write(path, rows)?;
    }
    let summaries = || groups.iter().flat_map(|group| &group.summaries);
    let minutes = || summaries().map(|own| own.shadow / 60.0);
    let mean = |sum: f64| sum / places as f64;
    let weight = |own: &Counted| own.span.seconds() * own.weight / 3600.0;
    let statistics = Statistics {
        spells: &args.spells,
        output: args.output.as_ref(),
        places,
        when: &when.text,
        weights: args.weight.iter().map(Weight::text).collect(),
        building: args.building.as_deref(),
        time_zone: &when.zone,
        sun_hours: asked.counted.iter().map(weight).sum(),
        minutes_least: minutes().fold(f64::INFINITY, f64::min),
        minutes_mean: mean(minutes().sum()),
        minutes_most: minutes().fold(0.0, f64::max),
        longest_sun_mean: mean(summaries().map(|own| own.longest_sun / 60.0).sum()),
        spells_mean: mean(summaries().map(|own| own.spells as f64).sum()),
        by_building: by_building.as_deref(),
        threads: cpu.threads(),
        read_seconds,
        seconds: took - read_seconds,
    };
    talk.say(&line(&statistics));
    if args.json {
        crate::commands::print_json(&statistics)?;
    }
    Ok(ExitCode::SUCCESS)
}

/// What is wanted of each place.
struct Asked {
    counted: Vec<Counted>,
    /// Only the shadow of this one, if any.
    building: Option<u32>,
    is_by_building: bool,
}

impl Asked {
    /// Reads a group of places and answers: its stretches are in memory only meanwhile.
    fn answer(&self, file: &SpellsFile, group: usize) -> anyhow::Result<Answered> {
        let begun = Instant::now();
        let group = file.read(group)?;
        let read = begun.elapsed().as_secs_f64();
        let begun = Instant::now();
        let own = |stretches: &[Stretch]| match self.building {
            None => Summary::new(stretches, &self.counted),
            Some(owner) => {
                let own = stretches.iter().filter(|own| own.owner == owner);
                Summary::new(&own.copied().collect::<Vec<_>>(), &self.counted)
            }
        };
        let summaries = group.stretches.iter().map(own).collect();
        let mut buildings = Buildings::default();
        if self.is_by_building {
            for stretches in group.stretches.iter() {
                buildings.add(&Share::all(stretches, &self.counted));
            }
        }
        Ok(Answered {
            places: group.places,
            positions: group.positions,
            summaries,
            buildings,
            took: [read, begun.elapsed().as_secs_f64()],
        })
    }
}

/// One line for people.
fn line(statistics: &Statistics<'_>) -> String {
    let Statistics {
        places,
        when,
        sun_hours,
        minutes_mean,
        minutes_most,
        longest_sun_mean,
        spells_mean,
        ..
    } = statistics;
    let file = statistics
        .output
        .map_or_else(String::new, |path| format!("{}: ", path.display()));
    let whose = (statistics.building).map_or_else(String::new, |id| format!(", of {id} alone"));
    let weights = if statistics.weights.is_empty() {
        String::new()
    } else {
        format!(", weighed by {}", statistics.weights.join(" and "))
    };
    format!(
        "{file}{when}{whose}{weights}: {minutes_mean:.1} of {:.1} minutes in shadow on average at {places} places, {minutes_most:.1} at most; \
         the longest sun {longest_sun_mean:.1} minutes, {spells_mean:.1} spells of shadow; read in {:.0} ms, answered in {:.1} ms",
        sun_hours * 60.0,
        1e3 * statistics.read_seconds,
        1e3 * statistics.seconds,
    )
}

/// The building of a name or a number.
fn find(name: &str, about: &SpellsAbout) -> anyhow::Result<u32> {
    let all = about.buildings.iter().enumerate();
    let named: Vec<usize> = all
        .filter_map(|(number, id)| (id.as_deref() == Some(name)).then_some(number))
        .collect();
    let count = about.buildings.len();
    let numbered = || {
        let number = name.strip_prefix('#')?.parse().ok();
        number.filter(|&number: &usize| number < count)
    };
    match (&named[..], numbered()) {
        (&[number], _) | (&[], Some(number)) => Ok(number as u32),
        (&[], None) => bail!(
            "--building {name}: the file has no such building; it has {count}, by their names or as #0 to #{}",
            count.saturating_sub(1)
        ),
        (several, _) => {
            let few = several.iter().take(8).map(|number| format!("#{number}"));
            let few: Vec<String> = few.collect();
            bail!(
                "--building {name}: {} buildings are called so; name one by its number: {}",
                several.len(),
                few.join(", ")
            )
        }
    }
}

/// Days as they are asked for: 2026-06-20..2026-06-22,2026-12-21.
fn listed(dates: &BTreeSet<Date>) -> String {
    let mut parts: Vec<[Date; 2]> = Vec::new();
    for &date in dates {
        match parts.last_mut() {
            Some([_, last]) if last.tomorrow().ok() == Some(date) => *last = date,
            _ => parts.push([date, date]),
        }
    }
    let word = |[first, last]: &[Date; 2]| {
        if first == last {
            first.to_string()
        } else {
            format!("{first}..{last}")
        }
    };
    parts.iter().map(word).collect::<Vec<_>>().join(",")
}

/// The time that is asked about, as far as the file holds it.
fn asked(
    args: &QueryArgs,
    about: &SpellsAbout,
    talk: &Talk,
) -> anyhow::Result<(When, Vec<Counted>)> {
    let held = about.spans();
    let (Some(first), Some(last)) = (held.first(), held.last()) else {
        bail!("{}: holds no time", args.spells.display());
    };
    let mut asked = args.when.clone();
    if asked.time_zone.is_none() {
        TimeZone::get(&about.time_zone)
            .with_context(|| format!("{}: its time zone", args.spells.display()))?;
        asked.time_zone = Some(about.time_zone.clone());
    }
    let place = Place::new(about.latitude, about.longitude, 0.0)?;
    let zone = calendar(&asked, &place)?.zone;
    let ends = held.iter().flat_map(|span| [span.start, span.end]);
    let dates: BTreeSet<Date> = ends.map(|end| end.zoned(&zone).date()).collect();
    let [first, last] = [first.start, last.end].map(|instant| instant.zoned(&zone).date());
    if !asked.names_days() {
        asked.date = Some(listed(&dates));
    }
    asked.year = asked.year.or(Some(first.year()));
    let sun = SunArgs {
        refraction: about.refraction,
        disc: false,
    };
    let when = When::new(&asked, sun, place, None)?;
    let spans = Span::intersection(&when.spans, &held);
    if spans.is_empty() {
        bail!(
            "{}: holds nothing of {}: it goes from {first} to {last}",
            args.spells.display(),
            when.text
        );
    }
    let seconds = |spans: &[Span]| spans.iter().map(Span::seconds).sum::<f64>();
    let missing = seconds(&when.spans) - seconds(&spans);
    // Without a word on hours, those that the file holds are meant.
    if args.when.names_time() && missing > 1.0 {
        talk.say(&format!(
            "{}: {:.1} of the {:.1} hours that are asked about are not in the file, and do not count",
            args.spells.display(),
            missing / 3600.0,
            seconds(&when.spans) / 3600.0
        ));
    }
    let calendar = calendar(&asked, &place)?;
    let weighed = weighed(
        &spans,
        &args.weight,
        &when.dates,
        (&when.suns[0], &zone, &calendar),
    );
    let (counted, idle) = weighed.unwrap_or_else(|error| wrong_usage(&error));
    for weight in idle {
        talk.say(&format!(
            "--weight {weight}: none of what is asked about lies in it"
        ));
    }
    Ok((when, counted))
}

/// What says how the numbers came about: what the file said of its own, and what was asked.
fn metadata(file: &SpellsFile, when: &When, args: &QueryArgs) -> Vec<(String, String)> {
    let kept = ["sun", "method", "bound"];
    let mut all: Vec<(String, String)> = (file.metadata().into_iter())
        .filter(|(name, _)| kept.contains(&name.as_str()))
        .collect();
    let own = [
        ("command", crate::commands::command()),
        ("version", super::super::output::VERSION.to_owned()),
        ("spells", args.spells.display().to_string()),
        ("when", when.text.clone()),
        ("time_zone", when.zone.clone()),
        ("unit", "minutes".to_owned()),
        ("building", args.building.clone().unwrap_or_default()),
        (
            "weights",
            args.weight
                .iter()
                .map(Weight::text)
                .collect::<Vec<_>>()
                .join(", "),
        ),
    ];
    let own = own.into_iter().filter(|(_, value)| !value.is_empty());
    all.extend(own.map(|(name, value)| (name.to_owned(), value)));
    all
}
