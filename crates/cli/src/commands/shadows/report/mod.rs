//! Reports: the tables that rules about shadow ask for.

mod args;
mod bre;
mod ceqr;
mod facts;
mod frame;
mod japan;
mod map;
mod page;
mod progress;
mod prop_k;
mod resources;
mod study;
mod written;

use std::process::ExitCode;

pub(crate) use args::{ReportArgs, Rule};
use frame::Report;
use study::Study;
use written::Outputs;

use super::args::{Method, ShadowsArgs};
use super::{Session, refuse_to_write_what_is_read, refuse_what_is_not_used, wrong_usage};
use crate::commands::{Talk, command, print_json};
use crate::interrupt;

pub(super) fn run(args: &ShadowsArgs, rule: Rule) -> anyhow::Result<ExitCode> {
    refuse(args, rule);
    refuse_what_is_not_used(args);
    let outputs = Outputs::of(args.output.as_deref());
    refuse_to_write_what_is_read(args.inputs(), outputs.paths());
    let session = Session::new(args)?;
    outputs.check()?;
    let talk = Talk { quiet: args.quiet };
    let study = Study::read(args, rule, &session, &talk)?;
    let found = match rule {
        Rule::Ceqr => ceqr::report(&study),
        Rule::PropK => prop_k::report(&study),
        Rule::Bre => bre::report(&study),
        Rule::Japan => japan::report(&study),
    };
    let Some(mut report) = found else {
        talk.say("interrupted; nothing written");
        return Ok(ExitCode::from(interrupt::EXIT_CODE));
    };
    report.more.extend(study.resources_json());
    outputs.write(&report)?;
    say(args, &report, &outputs, &talk);
    if args.json {
        print_json(&written::json(&report, &command()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// What came out, in lines.
fn say(args: &ShadowsArgs, report: &Report, outputs: &Outputs, talk: &Talk) {
    for line in report.findings.iter().chain(&report.summary) {
        talk.say(line);
    }
    let files: Vec<String> = (outputs.paths())
        .map(|path| path.display().to_string())
        .collect();
    match files.is_empty() {
        false => talk.say(&format!("{}: written", files.join(", "))),
        true if args.json => {}
        true => {
            talk.say("nothing was written: -o OUT keeps the report (OUT.csv, OUT.json, OUT.html)")
        }
    }
}

/// What a rule does not go with.
fn refuse(args: &ShadowsArgs, rule: Rule) {
    let name = rule.name();
    let wrong = |message: &str| wrong_usage(&format!("--report {name}: {message}"));
    let (when, report) = (&args.when, &args.report);
    if args.method != Method::Exact {
        wrong("every day is measured exactly; leave --method out");
    }
    let says_hours = when.hours.is_some()
        || when.solar_time.is_some()
        || when.after_sunrise != 0.0
        || when.before_sunset != 0.0;
    if says_hours {
        wrong(
            "the rule says which hours count; leave out --hours, --solar-time, --after-sunrise and --before-sunset",
        );
    }
    if when.from.is_some()
        || when.season.is_some()
        || when.weekdays.is_some()
        || when.months.is_some()
    {
        wrong(
            "the rule says which days count; leave out --from, --to, --season, --weekdays and --months",
        );
    }
    if args.sun.disc {
        wrong("the sun is a point; leave --disc out");
    }
    if matches!(rule, Rule::PropK | Rule::Japan) && when.date.is_some() {
        wrong("the rule says which days count; leave --date out, --year says of which year");
    }
    if rule != Rule::Bre && when.min_altitude.is_some() {
        wrong(
            "the sun counts however low it stands within the hours of the rule; leave --min-altitude out",
        );
    }
    if rule != Rule::Bre && args.places.points.is_some() {
        wrong("it is of areas: name their file with --resources, not --points");
    }
    if report.resources.is_none() && args.places.points.is_none() {
        wrong(match rule {
            Rule::Bre => {
                "name the gardens with --resources gardens.geojson, or windows with --points windows.csv"
            }
            Rule::Japan => "name the site with --resources site.geojson",
            Rule::Ceqr | Rule::PropK => "name the open spaces with --resources parks.geojson",
        });
    }
    if rule != Rule::Bre && !args.what_if.is_asked() {
        wrong(
            "say what is to be built: --with tower.geojson (and --without ID, --height ID=120m for what changes)",
        );
    }
    if rule == Rule::Japan {
        if !args.what_if.without.is_empty() || !args.what_if.height.is_empty() {
            wrong(
                "the shadow is that of the buildings of --with alone; leave --without and --height out",
            );
        }
    } else if report.plane.is_some() || report.limits.is_some() || report.hokkaido {
        wrong("--plane, --limits and --hokkaido are for --report japan");
    }
}
