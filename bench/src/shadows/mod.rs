//! Shadow time, exact, against one ray a minute: microseconds a place, and how far the minutes are off.
//!
//! All contestants are asked for the same places in one process, in turns, on one thread and its own
//! clock. What does not depend on places is made beforehand, for everybody: structures, the directions
//! to the sun, the arcs of its way.

mod jobs;
mod places;
mod rays;
mod report;
mod samples;
mod tables;
mod timing;
mod what_if;

use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Context as _, bail};
use ombra_accel::Level;
use ombra_accrual::{Exact, Fast, Occluders, Spells, Stretch, Tiles};
use ombra_city::{City, Inside, procedural_city};
use ombra_formats::city::{CityOptions, read_city};
use ombra_geometry::Point3;

use self::jobs::{Period, Skies};
use self::rays::{Rays, Tracer};
use self::timing::{Contestant, by_threads, contest};
use crate::against::processor::HAS_THREAD_CLOCK;
use crate::machine::Machine;

pub use self::report::{CityRecord, Difference, JobRecord, OwnRecord, Ratio, Report, Timed};

pub use self::what_if::{WhatIfRecord, what_if};

pub(crate) use self::samples::Samples;

/// How far the year by some of its days may be off, as a share of the time that the sun is up.
const TOLERANCE: f64 = 0.005;

/// How far minutes and the sum of stretches may be apart, in seconds: each of some dozens begins and ends within milliseconds.
const APART: f64 = 0.5;

/// The name of the generated city among the cities.
pub const PROCEDURAL: &str = "procedural";

/// What to measure, and how much.
#[derive(Clone, Debug)]
pub struct Options {
    /// [`PROCEDURAL`], and files.
    pub cities: Vec<String>,
    /// How many buildings the generated city has.
    pub buildings: usize,
    /// How many windows on the ground.
    pub windows: usize,
    /// How many places a window is wide and high.
    pub side: usize,
    /// The most places on the ground that a day is asked for.
    pub day_places: usize,
    /// How many places on the ground the year is asked for.
    pub year_places: usize,
    /// Every so manieth day makes the year.
    pub every: usize,
    /// How many walls, of sixteen places each.
    pub walls: usize,
    /// How wide the cells are over which one tower is changed, in metres.
    pub what_if_cell: f64,
    /// How many times each contestant runs on the clock. 0 compares answers only.
    pub rounds: usize,
    /// Embree's library or its folder, if it is not where it is looked for.
    pub embree: Option<PathBuf>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            cities: vec![PROCEDURAL.to_owned()],
            buildings: 45_000,
            windows: 30,
            side: 32,
            day_places: 16_384,
            year_places: 256,
            every: 1,
            walls: 64,
            what_if_cell: 4.0,
            rounds: 5,
            embree: None,
        }
    }
}

impl Options {
    /// So small that a test does not wait for it.
    #[must_use]
    pub fn smoke() -> Self {
        Self {
            buildings: 200,
            windows: 2,
            side: 8,
            day_places: 64,
            year_places: 16,
            every: 90,
            walls: 2,
            what_if_cell: 8.0,
            rounds: 1,
            ..Self::default()
        }
    }
}

/// Measures. `talk` hears how far it is, a line at a time.
///
/// # Errors
/// When a city cannot be read, lies in no time zone, or Embree was named and is not there.
pub fn run(options: &Options, talk: &mut dyn FnMut(&str)) -> anyhow::Result<Report> {
    let tracer = Tracer::find(options.embree.as_deref())?;
    if let Some(missing) = &tracer.missing {
        talk(&format!("without Embree: {missing}"));
    }
    let mut report = Report {
        machine: Machine::this(),
        rays: tracer.words(),
        missing: tracer.missing.clone(),
        rounds: options.rounds,
        thread_clock: HAS_THREAD_CLOCK,
        cities: Vec::new(),
        jobs: Vec::new(),
        own: Vec::new(),
        what_if: Vec::new(),
    };
    for name in &options.cities {
        let city = if name == PROCEDURAL {
            procedural_city(1, options.buildings)
        } else {
            read_city(name, &CityOptions::default())?
        };
        measure(name, &city, &tracer, options, &mut report, talk)
            .with_context(|| format!("city {name}"))?;
    }
    Ok(report)
}

/// All of one city.
fn measure(
    name: &str,
    city: &City,
    tracer: &Tracer,
    options: &Options,
    report: &mut Report,
    talk: &mut dyn FnMut(&str),
) -> anyhow::Result<()> {
    let facets = city.facets();
    talk(&format!("{name}: {} polygons", facets.len()));
    let begin = Instant::now();
    let occluders = Occluders::new(&facets);
    report.cities.push(CityRecord {
        city: name.to_owned(),
        buildings: city.buildings.len(),
        polygons: facets.len(),
        build_seconds: begin.elapsed().as_secs_f64(),
    });
    let inside = Inside::new(city);
    let ground = places::on_ground(city, &inside, options.windows, options.side);
    let ground = places::some(&ground, options.day_places);
    let walls = places::on_facades(&facets, &inside, options.walls);
    let skies = Skies::of(city)?;
    let rays = tracer.over(&facets)?;
    let [short, whole] = skies.days()?;
    let mut bench = Bench {
        name,
        skies: &skies,
        occluders: &occluders,
        rays: &rays,
        rounds: options.rounds,
        report,
    };
    for period in short.iter().chain(&whole) {
        talk(&format!("  ground, {}", period.name));
        bench.against_rays("ground", period, &ground)?;
    }
    for period in &whole {
        talk(&format!("  façades, {}", period.name));
        bench.against_rays("façades", period, &walls)?;
    }
    talk("  ground, year");
    let year = skies.year(options.every)?;
    let few = places::some(&ground, options.year_places);
    // How many days it takes is found at all places of the ground, as in a run over all of them.
    let tiles = Tiles::near(&ground);
    let fast = Fast::new(&occluders, &year.by_day, &tiles, TOLERANCE, || true);
    let fast = fast.context("nobody stops it")?;
    let within = format!("within {} % by {} days", 100.0 * TOLERANCE, fast.days());
    bench.against_rays_with("ground", &year, &few, &[(within, &fast)])?;
    for period in [&short[2], &whole[0]] {
        talk(&format!("  instruction sets and threads, {}", period.name));
        bench.by_level(period, &ground)?;
        bench.by_threads(period, &ground)?;
    }
    for period in short.iter().chain(&whole) {
        talk(&format!("  who shades whom, {}", period.name));
        bench.by_owner(period, &ground)?;
    }
    if !city.buildings.is_empty() {
        let found = what_if(name, city, options.what_if_cell, talk)?;
        report.what_if.extend(found);
    }
    Ok(())
}

/// What all jobs of a city share.
struct Bench<'a> {
    name: &'a str,
    skies: &'a Skies,
    occluders: &'a Occluders,
    rays: &'a Rays,
    rounds: usize,
    report: &'a mut Report,
}

impl Bench<'_> {
    fn against_rays(&mut self, at: &str, period: &Period, places: &[Point3]) -> anyhow::Result<()> {
        self.against_rays_with(at, period, places, &[])
    }

    /// Others of ours, by name, are asked in the same rounds.
    fn against_rays_with(
        &mut self,
        at: &str,
        period: &Period,
        places: &[Point3],
        others: &[(String, &Fast<'_>)],
    ) -> anyhow::Result<()> {
        if places.is_empty() {
            return Ok(());
        }
        let exact = Exact::new(self.occluders, &period.sheets);
        let mut contestants = vec![Contestant::new("exact", |places| exact.seconds(places))];
        contestants.extend(others.iter().map(|&(ref name, fast)| {
            Contestant::new(name.clone(), move |places| fast.seconds(places))
        }));
        let own = contestants.len();
        contestants.extend(self.rays.contestants(&self.skies.sky, period));
        let outcomes = contest(&contestants, places, self.rounds)?;
        let (ours, rays) = outcomes.split_at(own);
        let (single, packets) = (&rays[0], &rays[1..]);
        let best =
            (packets.iter().filter_map(|o| o.micros)).min_by(|a, b| a.median.total_cmp(&b.median));
        for (who, outcome) in contestants.iter().zip(ours) {
            let timed = |who: &str, outcome: &timing::Outcome| Timed {
                contestant: who.to_owned(),
                micros: outcome.micros,
            };
            let theirs = contestants[own..].iter().zip(rays);
            let off = (packets.iter()).map(|o| Difference::of(&o.seconds, &single.seconds));
            let name = match who.name.as_str() {
                "exact" => String::new(),
                name => format!(", {name}"),
            };
            self.report.jobs.push(JobRecord {
                bench: "shadows",
                city: self.name.to_owned(),
                job: format!("{at}, {}{name}", period.name),
                places: places.len(),
                rays: period.samples.count(),
                times: [timed("exact", outcome)]
                    .into_iter()
                    .chain(theirs.map(|(who, outcome)| timed(&who.name, outcome)))
                    .collect(),
                over_single: Ratio::of(single.micros, outcome.micros),
                over_packets: Ratio::of(best, outcome.micros),
                mean_seconds: outcome.seconds.iter().sum::<f64>() / places.len() as f64,
                sampling: Difference::of(&outcome.seconds, &single.seconds),
                packets: off.max_by(|a, b| a.most.total_cmp(&b.most)),
            });
        }
        Ok(())
    }

    /// The plainest first.
    fn by_level(&mut self, period: &Period, places: &[Point3]) -> anyhow::Result<()> {
        if places.is_empty() {
            return Ok(());
        }
        let levels: Vec<Exact<'_>> = (Level::available().into_iter())
            .map(|level| Exact::new(self.occluders, &period.sheets).at_level(level))
            .collect();
        let contestants: Vec<_> = (levels.iter().zip(Level::available()))
            .map(|(exact, level)| {
                let name = format!("{level:?}").to_lowercase();
                Contestant::new(name, |places| exact.seconds(places))
            })
            .collect();
        let outcomes = contest(&contestants, places, self.rounds)?;
        for (who, outcome) in contestants.iter().zip(&outcomes) {
            self.own(period, &who.name, outcome.micros, outcomes[0].micros);
        }
        Ok(())
    }

    fn by_threads(&mut self, period: &Period, places: &[Point3]) -> anyhow::Result<()> {
        let machine = std::thread::available_parallelism().map_or(1, usize::from);
        if places.is_empty() || machine < 2 {
            return Ok(());
        }
        let exact = Exact::new(self.occluders, &period.sheets);
        let exact = Contestant::new("exact", |places| exact.seconds(places));
        let times = by_threads(&exact, places, &[1, 2], self.rounds)?;
        for (&micros, way) in times.iter().zip(["1 thread", "2 threads"]) {
            self.own(period, way, micros, times[0]);
        }
        Ok(())
    }

    /// Minutes, and whose shadow it is besides.
    fn by_owner(&mut self, period: &Period, places: &[Point3]) -> anyhow::Result<()> {
        if places.is_empty() {
            return Ok(());
        }
        let exact = Exact::new(self.occluders, &period.sheets);
        let spells = Spells::new(self.occluders, &period.sheets);
        let sum = |stretches: &[Stretch]| stretches.iter().map(Stretch::seconds).sum();
        let contestants = [
            Contestant::new("minutes", |places| exact.seconds(places)),
            Contestant::new("stretches, by building", |places| {
                spells.stretches(places).iter().map(sum).collect()
            }),
        ];
        let outcomes = contest(&contestants, places, self.rounds)?;
        let off = Difference::of(&outcomes[1].seconds, &outcomes[0].seconds);
        if off.most > APART {
            bail!(
                "{}: stretches and minutes are {:.2} s apart",
                period.name,
                off.most
            );
        }
        for (who, outcome) in contestants.iter().zip(&outcomes) {
            self.own(period, &who.name, outcome.micros, outcomes[0].micros);
        }
        Ok(())
    }

    fn own(
        &mut self,
        period: &Period,
        way: &str,
        micros: Option<crate::contest::Spread>,
        first: Option<crate::contest::Spread>,
    ) {
        self.report.own.push(OwnRecord {
            city: self.name.to_owned(),
            job: format!("ground, {}", period.name),
            way: way.to_owned(),
            micros,
            speed: Ratio::of(first, micros),
        });
    }
}
