//! `ombra bench`: what things cost.

use std::io::{self, Write as _};
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Context as _;
use clap::Args;
use ombra::accel::StructureKind;
use ombra::render::MAX_SIDE;
use ombra_bench::against::{self, Options, Peer};
use ombra_bench::machine::Machine;
use ombra_bench::{BENCHES, Settings, records, shadows};

use super::{Talk, wrong_usage};
use crate::args::{Accel, accel, named};

/// Without --against: parts of ombra that do the same job, their answers compared first, then their
/// times.
///
/// With it: rays, builds, bytes and answers of ombra and of other ray tracers, in one process. With
/// --shadows: exact shadow time against one ray a minute.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("large"))]
pub(crate) struct BenchArgs {
    /// Benches of ombra's own parts; --list names them [default: all of them]
    #[arg(conflicts_with = "large")]
    pub(crate) benches: Vec<String>,

    /// List the benches of ombra's own parts
    #[arg(long, conflicts_with = "large")]
    pub(crate) list: bool,

    /// Other ray tracers, separated by commas
    #[arg(long, group = "large", value_name = "PEER", value_delimiter = ',', value_parser = named(&Peer::ALL, Peer::name, Peer::line))]
    pub(crate) against: Vec<Peer>,

    /// Exact shadow time in a city of 45,000 buildings, against Embree with one ray a minute; against
    /// ombra's own rays where there is no Embree
    #[arg(long, group = "large")]
    pub(crate) shadows: bool,

    /// The structures that take part, separated by commas; of ombra's own parts the first is used
    #[arg(long, value_name = "NAME", value_delimiter = ',', default_value = StructureKind::default().name(), value_parser = accel)]
    pub(crate) accel: Vec<Accel>,

    /// How many pixels wide and high pictures are [default: 1024 with --against, else 256]
    #[arg(long, visible_alias = "rays", conflicts_with = "shadows", value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SIDE)))]
    pub(crate) size: Option<u32>,

    /// How many times each contestant runs on the clock; 0 compares answers only [default: 9, with --shadows 5]
    #[arg(long, value_name = "N")]
    pub(crate) rounds: Option<usize>,

    /// With how many threads, separated by commas; 0 is all of them
    #[arg(long, value_name = "N", value_delimiter = ',', default_values_t = [1, 0])]
    pub(crate) threads: Vec<usize>,

    /// How fine what is generated is: hills of twice the square of this many triangles, a city with
    /// twice as many houses a side
    #[arg(
        long,
        value_name = "N",
        default_value_t = 200,
        conflicts_with = "large"
    )]
    pub(crate) detail: u32,

    /// Scenes, separated by commas: interior, dragon, city; models; soups of triangles (.bin);
    /// FILE@inside starts rays within it [default: interior,dragon,city]. With --shadows: procedural, and
    /// files of cities [default: procedural]
    #[arg(long, value_name = "SCENE", value_delimiter = ',', requires = "large")]
    pub(crate) scenes: Vec<String>,

    /// Embree's library or its folder [default: OMBRA_EMBREE, else where `cargo xtask bench --setup` puts it]
    #[arg(
        long,
        value_name = "PATH",
        requires = "large",
        conflicts_with = "benches"
    )]
    pub(crate) embree: Option<PathBuf>,

    /// Tiny scenes, few rays, one round: whether it works
    #[arg(long, requires = "large", conflicts_with = "benches")]
    pub(crate) smoke: bool,

    /// Keep what is found in FOLDER/MACHINE/DATE-against.json and .md, with --shadows DATE-shadows
    #[arg(
        long,
        value_name = "FOLDER",
        requires = "large",
        conflicts_with = "benches"
    )]
    pub(crate) record: Option<PathBuf>,

    /// No talk
    #[arg(long)]
    pub(crate) quiet: bool,

    /// As JSON
    #[arg(long)]
    pub(crate) json: bool,
}

pub(crate) fn run(args: &BenchArgs) -> anyhow::Result<ExitCode> {
    let text = if args.list {
        let line = |bench: &ombra_bench::Bench| format!("{:<10} {}\n", bench.name, bench.line);
        BENCHES.iter().map(line).collect()
    } else if args.shadows {
        shadow_time(args)?
    } else if args.against.is_empty() {
        own_parts(args)?
    } else {
        peers(args)?
    };
    io::stdout().write_all(text.as_bytes())?;
    Ok(ExitCode::SUCCESS)
}

/// ombra against others.
fn peers(args: &BenchArgs) -> anyhow::Result<String> {
    let base = if args.smoke {
        Options::smoke()
    } else {
        Options::default()
    };
    let scenes = if args.scenes.is_empty() {
        base.scenes.clone()
    } else {
        args.scenes.clone()
    };
    let options = Options {
        peers: args.against.clone(),
        accels: args.accel.iter().map(|accel| accel.kind).collect(),
        scenes,
        side: args.size.unwrap_or(base.side),
        rounds: args.rounds.unwrap_or(base.rounds),
        threads: args.threads.clone(),
        embree: args.embree.clone(),
        ..base
    };
    let report = against::run(&options, &mut |line| talk(args).say(line))?;
    let (json, tables) = (serde_json::to_string_pretty(&report)?, report.tables());
    let title = ("against", "Against other tracers");
    shown(args, &report.machine, title, json, tables)
}

/// Exact shadow time against rays.
fn shadow_time(args: &BenchArgs) -> anyhow::Result<String> {
    let base = if args.smoke {
        shadows::Options::smoke()
    } else {
        shadows::Options::default()
    };
    let cities = if args.scenes.is_empty() {
        base.cities.clone()
    } else {
        args.scenes.clone()
    };
    let options = shadows::Options {
        cities,
        rounds: args.rounds.unwrap_or(base.rounds),
        embree: args.embree.clone(),
        ..base
    };
    let report = shadows::run(&options, &mut |line| talk(args).say(line))?;
    let (json, tables) = (serde_json::to_string_pretty(&report)?, report.tables());
    let title = ("shadows", "Exact shadow time against rays");
    shown(args, &report.machine, title, json, tables)
}

const fn talk(args: &BenchArgs) -> Talk {
    Talk { quiet: args.quiet }
}

/// What goes to the output; kept as a record first, if it is to be.
fn shown(
    args: &BenchArgs,
    machine: &Machine,
    (name, title): (&str, &str),
    json: String,
    tables: String,
) -> anyhow::Result<String> {
    if let Some(folder) = &args.record {
        let paths = records::keep(folder, machine, name, title, &json, &tables)
            .with_context(|| format!("cannot write to {}", folder.display()))?;
        for path in paths {
            talk(args).say(&format!("wrote {}", path.display()));
        }
    }
    Ok(if args.json { json + "\n" } else { tables })
}

/// Parts of ombra against one another.
fn own_parts(args: &BenchArgs) -> anyhow::Result<String> {
    for name in &args.benches {
        if BENCHES.iter().all(|bench| bench.name != name) {
            wrong_usage(
                "bench",
                &format!("there is no bench \"{name}\"; --list names them"),
            );
        }
    }
    let base = Settings::default();
    let settings = Settings {
        rounds: args.rounds.unwrap_or(base.rounds),
        threads: args.threads.clone(),
        pixels: args.size.unwrap_or(base.pixels),
        detail: args.detail,
        accel: args.accel.first().map_or(base.accel, |accel| accel.kind),
    };
    let mut records = Vec::new();
    for bench in BENCHES {
        if args.benches.is_empty() || args.benches.iter().any(|name| name == bench.name) {
            records.extend((bench.run)(&settings)?);
        }
    }
    let machine = Machine::this();
    if args.json {
        let all = serde_json::json!({ "machine": machine, "records": records });
        return Ok(serde_json::to_string_pretty(&all)? + "\n");
    }
    let (cpu, threads, commit) = (&machine.cpu, machine.threads, &machine.commit);
    let head = format!("{cpu} ({threads} threads), {commit}\n");
    let lines = records.iter().map(|record| format!("{record}\n"));
    Ok(head + &lines.collect::<String>())
}
