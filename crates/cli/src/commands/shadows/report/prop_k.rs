//! San Francisco: the shadow of a year on parks, by section 295 of the Planning Code.

use jiff::civil::Date;
use ombra::accrual::{Again, Coverage, Exact, Occluders, Peak, Spells, new_shadow};
use ombra::sun::{ALMANAC_SUNRISE, Calendar, Sheet, Span};
use serde_json::{Map, Value, json};

use super::super::args::WhenArgs;
use super::clock::Clock;
use super::frame::{Cell, Column, Figure, Report, RuleText, SQUARE_FEET, Table, rounded};
use super::map::Cells;
use super::resources::Resource;
use super::study::{Progress, Study};

/// Seconds after sunrise and before sunset.
const MARGIN: f64 = 3600.0;

/// A day has new shadow if some place has more of it by so many seconds: by half of what a day is good to.
const LEAST: f64 = 0.5;

/// Blocks of tiles are measured at once: so many.
const BLOCK: usize = 256;

/// A whole year.
pub(super) fn when(args: &WhenArgs, calendar: &Calendar) -> WhenArgs {
    WhenArgs {
        date: Some(calendar.year.to_string()),
        after_sunrise: MARGIN,
        before_sunset: MARGIN,
        sunrise: ALMANAC_SUNRISE,
        ..args.clone()
    }
}

/// `None` if it was interrupted.
pub(super) fn report(study: &Study<'_>) -> Option<Report> {
    let clock = Clock::civil(study.when.time_zone.clone());
    let change = study.change();
    let [before, after] = study
        .cpu()
        .install(|| [&study.before, study.after()].map(|city| Occluders::new(&city.facets())));
    let days = study.when.sheets();
    let whole_year = days.concat();
    let places: usize = study.resources.iter().map(Resource::places).sum();
    let mut progress = study.progress(2 * places);
    let (mut found, mut parks) = (Vec::new(), Vec::new());
    for resource in &study.resources {
        let existing = seconds(
            study,
            &Exact::new(&before, &whole_year),
            resource,
            &mut progress,
        )?;
        let again = study.again(resource, &before, &change, &whole_year);
        let mut year = Year::measure(
            study,
            resource,
            &before,
            &again,
            &days,
            existing,
            &mut progress,
        )?;
        year.peak = year
            .largest_day()
            .and_then(|day| peak(study, [&before, &after], &again, &days[day]));
        parks.push(year.json(study, resource, &clock));
        found.push(year);
    }
    drop(progress);
    let rows = study.resources.iter().zip(&found);
    let told = rows
        .clone()
        .filter(|(resource, _)| resource.nothing().is_none());
    let mut more = Map::new();
    more.insert("parks".to_owned(), parks.into());
    Some(Report {
        rule: rule(study),
        facts: study.facts(&clock),
        table: Table {
            name: "Shadow of the year",
            columns: columns(),
            rows: rows
                .map(|(resource, year)| year.row(study, resource, &clock))
                .collect(),
        },
        findings: study
            .resources
            .iter()
            .filter_map(Resource::finding)
            .collect(),
        summary: told
            .map(|(resource, year)| year.told(study, resource))
            .collect(),
        figures: vec![figure(study, &found)],
        more,
    })
}

/// How many seconds each place lies in shadow.
fn seconds(
    study: &Study<'_>,
    exact: &Exact<'_>,
    resource: &Resource,
    progress: &mut Progress<'_>,
) -> Option<Vec<f64>> {
    let tiles = &resource.tiles;
    let mut seconds = Vec::with_capacity(resource.places());
    for first in (0..tiles.len()).step_by(BLOCK) {
        let block = first..tiles.len().min(first + BLOCK);
        let own = study.cpu().install(|| exact.seconds_of(tiles, block));
        progress.step(own.len())?;
        seconds.extend(own);
    }
    Some(seconds)
}

/// The year of a park.
struct Year {
    /// Seconds of all places together, without the change.
    existing: f64,
    /// What the change adds, day by day: seconds of all places together, less what it takes away.
    net: Vec<f64>,
    /// Whether some place has more shadow.
    has_new: Vec<bool>,
    /// Seconds that each place has more, over the year.
    by_place: Vec<f64>,
    /// When most of the park lies in new shadow, on the day of which there is most.
    peak: Option<Peak>,
}

impl Year {
    /// `before` is how many seconds each place lies in shadow over the year; only those places are measured day by day for which
    /// the change makes a difference.
    fn measure(
        study: &Study<'_>,
        resource: &Resource,
        occluders: &Occluders,
        again: &Again,
        days: &[Vec<Sheet>],
        before: Vec<f64>,
        progress: &mut Progress<'_>,
    ) -> Option<Self> {
        let tiles = again.tiles();
        let mut gains = vec![0.0; tiles.places().len()];
        let (mut net, mut has_new) = (vec![0.0; days.len()], vec![false; days.len()]);
        let all = resource.places();
        for (day, sheets) in days.iter().enumerate() {
            if !gains.is_empty() {
                let of_day = study.cpu().install(|| {
                    let own = |exact: &Exact<'_>| exact.seconds_of(tiles, 0..tiles.len());
                    [
                        own(&Exact::new(occluders, sheets)),
                        own(&again.exact(sheets)),
                    ]
                });
                for (sum, (was, is)) in gains.iter_mut().zip(of_day[0].iter().zip(&of_day[1])) {
                    let gain = is - was;
                    *sum += gain;
                    net[day] += gain;
                    has_new[day] |= gain > LEAST;
                }
            }
            // In equal parts, so that the bar goes on evenly.
            progress.step(all * (day + 1) / days.len() - all * day / days.len())?;
        }
        let none = vec![0.0; resource.grid.count()];
        let by_cell = again.after(&none, &gains, 0.0);
        let indices = resource.tiles.indices().iter();
        Some(Self {
            existing: before.iter().sum(),
            net,
            has_new,
            by_place: indices.map(|&index| by_cell[index as usize]).collect(),
            peak: None,
        })
    }

    fn largest_day(&self) -> Option<usize> {
        let new = (0..self.net.len()).filter(|&day| self.has_new[day]);
        new.reduce(|a, b| if self.net[b] > self.net[a] { b } else { a })
    }

    /// Theoretical annual available sunlight, ft²·h.
    fn available(study: &Study<'_>, resource: &Resource) -> f64 {
        study.when.hours() * resource.open() * SQUARE_FEET
    }

    /// Seconds of all places together in ft²·h.
    fn load(resource: &Resource, seconds: f64) -> f64 {
        seconds / 3600.0 * resource.each() * SQUARE_FEET
    }

    fn row(&self, study: &Study<'_>, resource: &Resource, clock: &Clock) -> Vec<Cell> {
        let mut cells = vec![
            Cell::text(&resource.area.name),
            Cell::number(resource.open() * SQUARE_FEET, 0),
            Cell::number(resource.open(), 1),
        ];
        if resource.nothing().is_some() {
            cells.push(Cell::text("not measured"));
            cells.resize(columns().len(), Cell::nothing());
            return cells;
        }
        let available = Self::available(study, resource);
        let [existing, net] =
            [self.existing, self.net.iter().sum()].map(|own| Self::load(resource, own));
        let count = self.has_new.iter().filter(|&&is_new| is_new).count();
        let dates: Vec<Date> = study.when.by_day().map(|day| day.0).collect();
        let largest = self.largest_day();
        let new_days = (0..dates.len()).filter(|&day| self.has_new[day]);
        let [first, last] = [new_days.clone().next(), new_days.last()];
        let date = |day: usize| Cell::text(dates[day].to_string());
        let share = |load: f64| Cell::number(100.0 * load / available, 3);
        let peak_share = |peak: Peak| 100.0 * peak.places as f64 / resource.places() as f64;
        cells.extend([
            Cell::text(if count > 0 { "yes" } else { "none" }),
            Cell::number(available, 0),
            Cell::number(existing, 0),
            share(existing),
            Cell::number(net, 1),
            share(net),
            Cell::number(existing + net, 0),
            share(existing + net),
            Cell::count(count),
            Cell::of(first, date),
            Cell::of(last, date),
            Cell::of(largest, date),
            Cell::of(largest, |day| {
                Cell::number(Self::load(resource, self.net[day]), 1)
            }),
            Cell::of(self.peak, |peak| Cell::number(peak_share(peak), 2)),
            Cell::of(self.peak, |peak| {
                let start = peak.when.start;
                Cell::shown(clock.iso(start), clock.time(start))
            }),
        ]);
        cells
    }

    fn told(&self, study: &Study<'_>, resource: &Resource) -> String {
        let name = &resource.area.name;
        let count = self.has_new.iter().filter(|&&is_new| is_new).count();
        let net = self.net.iter().sum();
        if count == 0 && net == 0.0 {
            return format!("{name}: no net new shadow on any day of the year.");
        }
        let net = Self::load(resource, net);
        format!(
            "{name}: {:+.1} ft²·h of net new shadow, {:+.3} % of what sunlight there could be; on {count} days.",
            net,
            100.0 * net / Self::available(study, resource)
        )
    }

    /// Day by day.
    fn json(&self, study: &Study<'_>, resource: &Resource, clock: &Clock) -> Value {
        let days = study.when.by_day().enumerate();
        let days = days.filter(|(day, _)| self.net[*day] != 0.0);
        let days: Vec<Value> = days
            .map(|(day, (date, _))| {
                json!({
                    "day": date.to_string(),
                    "net_ft2_h": rounded(Self::load(resource, self.net[day]), 2),
                    "is_new": self.has_new[day],
                })
            })
            .collect();
        json!({
            "name": resource.area.name,
            "places": resource.places(),
            "days_that_change": days,
            "peak": self.peak.map(|peak| json!({
                "from": clock.iso(peak.when.start),
                "to": clock.iso(peak.when.end),
                "ft2": rounded(resource.each() * peak.places as f64 * SQUARE_FEET, 0),
            })),
        })
    }
}

/// The most new shadow at one moment of a day, among the places for which the change makes a difference.
fn peak(
    study: &Study<'_>,
    sides: [&Occluders; 2],
    again: &Again,
    sheets: &[Sheet],
) -> Option<Peak> {
    let tiles = again.tiles();
    let [was, is] = study.cpu().install(|| {
        sides.map(|occluders| Spells::new(occluders, sheets).stretches_of(tiles, 0..tiles.len()))
    });
    let new: Vec<Vec<Span>> = new_shadow(&was, &is);
    Coverage::of(new.iter().map(Vec::as_slice)).most()
}

fn columns() -> Vec<Column> {
    [
        ("park", "Park"),
        ("area_ft2", "Area, ft²"),
        ("area_m2", ""),
        ("result", "Net new shadow"),
        ("available_ft2_h", "Available sunlight (TAAS), ft²·h"),
        ("existing_ft2_h", "Existing shadow, ft²·h"),
        ("existing_percent", "% of TAAS"),
        ("net_new_ft2_h", "Net new, ft²·h"),
        ("net_new_percent", "% of TAAS"),
        ("with_project_ft2_h", "With the project, ft²·h"),
        ("with_project_percent", "% of TAAS"),
        ("days_with_new", "Days with new shadow"),
        ("first_day", "First day"),
        ("last_day", "Last day"),
        ("largest_day", "Day of the most"),
        ("largest_ft2_h", "Then, ft²·h"),
        ("largest_percent", "Largest at once that day, % of the park"),
        ("largest_at", "Largest at"),
    ]
    .map(|(key, head)| Column { key, head })
    .into()
}

fn figure(study: &Study<'_>, found: &[Year]) -> Figure {
    let hours = |year: &Year| -> Vec<f64> {
        let hours = year.by_place.iter().map(|seconds| seconds / 3600.0);
        hours.collect()
    };
    let all: Vec<Vec<f64>> = found.iter().map(hours).collect();
    let most = all.iter().flatten().copied().fold(0.0, f64::max);
    let map = study.map(|map| {
        for (resource, hours) in study.resources.iter().zip(&all) {
            if hours.iter().any(|&hours| hours > 0.0) {
                let values = Study::spread(resource, hours.iter().copied());
                map.cells(&Cells {
                    grid: &resource.grid,
                    values: &values,
                    most: most as f32,
                });
            }
        }
    });
    let legend = format!("{most:.1} h of net new shadow in the year");
    let caption = match most > 0.0 {
        true => format!("Net new shadow of the year on each place, up to {most:.1} h."),
        false => "No net new shadow in the year.".to_owned(),
    };
    Figure {
        svg: map.finish(&caption, (most > 0.0).then_some(&legend)),
        caption,
    }
}

fn rule(study: &Study<'_>) -> RuleText {
    RuleText {
        title: "Shadow of a year on parks (San Francisco, Planning Code section 295)",
        sources: &[
            "San Francisco Planning Code, section 295 (Proposition K, 1984)",
            "Proposition K, the Sunlight Ordinance: memorandum to the Planning and the Recreation and Park Commissions, 3 February \
             1989, adopted by Planning Commission Resolution 11595",
            "Shadow Analysis Procedures and Scope Requirements: memorandum of the San Francisco Planning Department, July 2014",
        ],
        conventions: vec![
            "From an hour after sunrise to an hour before sunset, on every day of the year. Sunrise and sunset are those of almanacs: the \
             upper edge of the sun, with 34' of refraction, on a level horizon."
                .to_owned(),
            format!(
                "Theoretical annual available sunlight (TAAS) is the open area of the park times these hours: {:.1} in this year here.",
                study.when.hours()
            ),
            "Load is shadow summed over area and time, in square feet times hours; every day is measured exactly, none stands for others."
                .to_owned(),
            "Net new is the load with the project less the load without it, so what a building that goes has thrown counts against it."
                .to_owned(),
            format!("A day has new shadow if some place has more than {LEAST} s more of it than without the project."),
            "Whether new shadow is significant or adverse is for the commissions to judge, by time, size, place and public good as well."
                .to_owned(),
        ],
    }
}
