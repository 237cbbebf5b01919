//! New York: incremental shadow by the CEQR Technical Manual.

use jiff::civil::Date;
use ombra::accrual::{Coverage, Occluders, Spells, Stretches, gained, new_shadow, shadow};
use ombra::city::Change;
use ombra::sun::{ALMANAC_SUNRISE, Calendar, Span};

use super::super::args::WhenArgs;
use super::super::clock::{Clock, length};
use super::frame::{Cell, Column, Figure, Report, RuleText, SQUARE_FEET, Table};
use super::map::Cells;
use super::progress::{Progress, blocks};
use super::resources::Resource;
use super::study::Study;

/// Seconds after sunrise and before sunset.
const MARGIN: f64 = 5400.0;

/// The days that stand for the year: the equinox, midway from it to the summer solstice, that, and the winter solstice.
const DAYS: [&str; 4] = ["03-21", "05-06", "06-21", "12-21"];

/// Shadow that is gone from all places for no longer than this, in seconds, has not left: between two places of the grid a narrow one
/// is on neither.
const GAP: f64 = 60.0;

/// The four days, unless others are asked for.
pub(super) fn when(args: &WhenArgs, calendar: &Calendar) -> WhenArgs {
    let days = || DAYS.map(|day| format!("{}-{day}", calendar.year)).join(",");
    WhenArgs {
        date: args.date.clone().or_else(|| Some(days())),
        after_sunrise: MARGIN,
        before_sunset: MARGIN,
        sunrise: ALMANAC_SUNRISE,
        ..args.clone()
    }
}

/// `None` if it was interrupted.
pub(super) fn report(study: &Study<'_>) -> Option<Report> {
    let clock = Clock::standard(study.when.time_zone.clone());
    let sides = study.cpu().install(|| Sides::new(study));
    let places: usize = study.resources.iter().map(Resource::places).sum();
    let days: Vec<(Date, &[Span])> = study.when.by_day().collect();
    let mut progress = study.progress(places * days.len());
    let (mut rows, mut summary) = (Vec::new(), Vec::new());
    let mut minutes: Vec<Vec<Vec<f64>>> = days.iter().map(|_| Vec::new()).collect();
    for resource in &study.resources {
        let is_reached = sides.reaches(study, resource);
        let mut reached_on = Vec::new();
        for ((day, spans), minutes) in days.iter().zip(&mut minutes) {
            let found = if is_reached {
                Found::measure(study, &sides, resource, spans, &mut progress)?
            } else {
                progress.step(resource.places())?;
                Found::nothing(resource)
            };
            if found.coverage.most().is_some() {
                reached_on.push(day.to_string());
            }
            rows.push(row(resource, *day, spans, &found, &clock));
            minutes.push(found.minutes);
        }
        if resource.nothing().is_none() {
            summary.push(told(resource, &reached_on, days.len()));
        }
    }
    drop(progress);
    let figures = days.iter().zip(&minutes);
    let figures =
        figures.map(|((day, spans), minutes)| figure(study, *day, spans, minutes, &clock));
    Some(Report {
        rule: rule(),
        facts: study.facts_of_areas(&clock),
        table: Table {
            name: "Incremental shadow",
            columns: columns(),
            rows,
        },
        findings: study
            .resources
            .iter()
            .filter_map(Resource::finding)
            .collect(),
        summary,
        figures: figures.collect(),
        more: serde_json::Map::new(),
    })
}

/// The city before and after.
struct Sides {
    change: Change,
    before: Occluders,
    after: Occluders,
}

impl Sides {
    fn new(study: &Study<'_>) -> Self {
        Self {
            change: study.change(),
            before: Occluders::new(&study.before.facets()),
            after: Occluders::new(&study.after().facets()),
        }
    }

    /// Whether the change makes any difference to a resource, on any of the days.
    fn reaches(&self, study: &Study<'_>, resource: &Resource) -> bool {
        let sheets = study.sheets(&study.when.spans);
        let again = study.again(resource, &self.before, &self.change, &sheets);
        !again.tiles().is_empty()
    }
}

/// The incremental shadow of a day on a resource.
struct Found {
    coverage: Coverage,
    /// For how many seconds no place has sun that would have it somewhere without the change.
    dark: f64,
    /// Of each place.
    minutes: Vec<f64>,
}

impl Found {
    fn nothing(resource: &Resource) -> Self {
        Self {
            coverage: Coverage::default(),
            dark: 0.0,
            minutes: vec![0.0; resource.places()],
        }
    }

    fn measure(
        study: &Study<'_>,
        sides: &Sides,
        resource: &Resource,
        spans: &[Span],
        progress: &mut Progress<'_>,
    ) -> Option<Self> {
        let sheets = study.sheets(spans);
        let both = study.cpu().install(|| {
            [&sides.before, &sides.after].map(|occluders| Spells::new(occluders, &sheets))
        });
        let (mut new, mut before, mut after) = (Vec::new(), Vec::new(), Vec::new());
        let tiles = &resource.tiles;
        for block in blocks(tiles) {
            let stretches = |spells: &Spells<'_>| spells.stretches_of(tiles, block.clone());
            let [was, is]: [Stretches; 2] = study
                .cpu()
                .install(|| [stretches(&both[0]), stretches(&both[1])]);
            new.extend(new_shadow(&was, &is));
            before.extend(was.iter().map(shadow));
            after.extend(is.iter().map(shadow));
            progress.step(was.len())?;
        }
        let all_dark = |spans: &[Vec<Span>]| {
            let coverage = Coverage::of(spans.iter().map(Vec::as_slice));
            coverage.periods(spans.len().max(1), 0.0)
        };
        let dark = gained(&all_dark(&before), &all_dark(&after));
        Some(Self {
            coverage: Coverage::of(new.iter().map(Vec::as_slice)),
            dark: dark.iter().map(Span::seconds).sum(),
            minutes: (new.iter())
                .map(|spans| spans.iter().map(Span::seconds).sum::<f64>() / 60.0)
                .collect(),
        })
    }
}

fn columns() -> Vec<Column> {
    [
        ("resource", "Resource"),
        ("day", "Day"),
        ("from", "Analysis from"),
        ("to", "to"),
        ("result", "Incremental shadow"),
        ("enters", "Enters"),
        ("exits", "Exits"),
        ("duration_minutes", "Duration"),
        ("is_contiguous", "Contiguous"),
        ("periods", "Periods"),
        ("largest_percent", "Largest, % of its area"),
        ("largest_m2", "Largest, m²"),
        ("largest_ft2", "Largest, ft²"),
        ("largest_at", "Largest at"),
        ("integrated_m2_h", "Over time, m²·h"),
        ("integrated_ft2_h", "Over time, ft²·h"),
        ("sun_eliminated_minutes", "All sun gone because of it"),
    ]
    .map(|(key, head)| Column { key, head })
    .into()
}

fn row(resource: &Resource, day: Date, spans: &[Span], found: &Found, clock: &Clock) -> Vec<Cell> {
    let time = |instant| Cell::shown(clock.iso(instant), clock.time(instant));
    let ends = spans.first().zip(spans.last());
    let [from, to] = ends.map_or([Cell::nothing(), Cell::nothing()], |(first, last)| {
        [time(first.start), time(last.end)]
    });
    let periods = found.coverage.periods(1, GAP);
    let (first, last) = (periods.first(), periods.last());
    let result = match (resource.nothing(), ends, first) {
        (Some(_), ..) => "not measured",
        (_, None, _) => "no sun within the hours",
        (.., None) => "none",
        (.., Some(_)) => "yes",
    };
    let is_there = first.is_some();
    let when_there = |cell: Cell| if is_there { cell } else { Cell::nothing() };
    let minutes = |seconds: f64| {
        let cell = Cell::number(seconds / 60.0, 1);
        Cell::shown(cell.value, length(seconds))
    };
    let duration: f64 = periods.iter().map(Span::seconds).sum();
    let most = found.coverage.most();
    let largest = most.map_or(0.0, |most| resource.each() * most.places as f64);
    let integrated = found.coverage.place_seconds() * resource.each() / 3600.0;
    let all: Vec<String> = periods.iter().map(|&span| clock.span(span)).collect();
    vec![
        Cell::text(&resource.area.name),
        Cell::text(day.to_string()),
        from,
        to,
        Cell::text(result),
        Cell::of(first, |span| time(span.start)),
        Cell::of(last, |span| time(span.end)),
        when_there(minutes(duration)),
        when_there(Cell::yes(periods.len() == 1)),
        when_there(Cell::text(all.join(", "))),
        when_there(Cell::percent(
            largest / resource.open().max(f64::MIN_POSITIVE),
            2,
        )),
        when_there(Cell::number(largest, 1)),
        when_there(Cell::number(largest * SQUARE_FEET, 0)),
        Cell::of(most, |most| time(most.when.start)),
        when_there(Cell::number(integrated, 1)),
        when_there(Cell::number(integrated * SQUARE_FEET, 0)),
        when_there(minutes(found.dark)),
    ]
}

/// One sentence.
fn told(resource: &Resource, reached_on: &[String], days: usize) -> String {
    let name = &resource.area.name;
    match reached_on.len() {
        0 if days == 1 => format!("{name}: no incremental shadow on the day of the analysis."),
        0 => format!("{name}: no incremental shadow on any of the {days} days of the analysis."),
        _ => format!("{name}: incremental shadow on {}.", reached_on.join(", ")),
    }
}

fn figure(
    study: &Study<'_>,
    day: Date,
    spans: &[Span],
    minutes: &[Vec<f64>],
    clock: &Clock,
) -> Figure {
    let most = minutes.iter().flatten().copied().fold(0.0, f64::max);
    let map = study.map(|map| {
        for (resource, minutes) in study.resources.iter().zip(minutes) {
            if minutes.iter().any(|&minutes| minutes > 0.0) {
                let values = Study::spread(resource, minutes.iter().copied());
                map.cells(&Cells {
                    grid: &resource.grid,
                    values: &values,
                    most: most as f32,
                });
            }
        }
    });
    let hours = spans.iter().map(|&span| clock.span(span));
    let hours = hours.collect::<Vec<_>>().join(", ");
    let legend = format!("{} of incremental shadow", length(60.0 * most));
    let caption = match most > 0.0 {
        true => format!(
            "{day}, {hours}: how long incremental shadow lies on each place, up to {}.",
            length(60.0 * most)
        ),
        false => format!("{day}, {hours}: no incremental shadow."),
    };
    Figure {
        svg: map.finish(&caption, (most > 0.0).then_some(&legend)),
        caption,
    }
}

fn rule() -> RuleText {
    RuleText {
        title: "Incremental shadow (New York, CEQR)",
        sources: &[
            "City Environmental Quality Review (CEQR) Technical Manual, Mayor's Office of Environmental Coordination, City of New York, \
             chapter 8, Shadows: days, hours and standard time as in studies by its editions since 2010 (the latest known here: December 2025)",
        ],
        conventions: vec![
            "Incremental shadow is shadow that lies on a place with the change and does not without it.".to_owned(),
            "From an hour and a half after sunrise to an hour and a half before sunset. Sunrise and sunset are those of almanacs for this place and day, \
             a convention here: the upper edge of the sun, with 34' of refraction, on a level horizon. Studies with fixed hours for a day may \
             begin and end some minutes earlier or later."
                .to_owned(),
            "Standard time all year: the manual does not use daylight saving time.".to_owned(),
            "The sun goes nearly the same way on September 21 as on March 21, and on August 6 as on May 6: these days stand for those, too."
                .to_owned(),
            format!(
                "Times and durations are of any incremental shadow on the resource, however small; gaps of up to {GAP:.0} s are bridged."
            ),
            "Shares are of the area of the resource without what buildings stand on.".to_owned(),
            "\"All sun gone because of it\" is how long no place of the resource has sun, where without the change one would. The edition of \
             2010 takes more than 10 minutes of that for significant in general; how the resource is used, the time of year and what is \
             sunlit near by count as well. Whether an impact is significant is for people to judge."
                .to_owned(),
        ],
    }
}
