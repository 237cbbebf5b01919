//! San Francisco: the shadow of a year on parks, by section 295 of the Planning Code.

mod year;

use ombra::accrual::{Exact, Occluders};
use ombra::sun::{ALMANAC_SUNRISE, Calendar};
use serde_json::Map;

use super::super::args::WhenArgs;
use super::super::clock::Clock;
use super::frame::{Column, Figure, Report, RuleText, Table};
use super::map::Cells;
use super::resources::Resource;
use super::study::Study;
use year::{LEAST, Year, peak};

/// Seconds after sunrise and before sunset.
const MARGIN: f64 = 3600.0;

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
    let exact = study.cpu().install(|| Exact::new(&before, &whole_year));
    let places: usize = study.resources.iter().map(Resource::places).sum();
    let mut progress = study.progress(2 * places);
    let (mut found, mut parks) = (Vec::new(), Vec::new());
    for resource in &study.resources {
        let existing = study.seconds(&exact, &resource.tiles, &mut progress)?;
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
        facts: study.facts_of_areas(&clock),
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
            "San Francisco Planning Code, section 295 (1985, after Proposition K of 1984)",
            "Proposition K, the Sunlight Ordinance: memorandum to the Planning and the Recreation and Park Commissions, 3 February \
             1989, adopted by Planning Commission Resolution 11595 of 7 February 1989",
            "Shadow Analysis Procedures and Scope Requirements: memorandum of the San Francisco Planning Department, July 2014",
        ],
        conventions: vec![
            "From an hour after sunrise to an hour before sunset, on every day of the year. Sunrise and sunset are those of almanacs, a \
             convention here: the upper edge of the sun, with 34' of refraction, on a level horizon."
                .to_owned(),
            format!(
                "Theoretical annual available sunlight (TAAS) is the open area of the park times these hours: {:.1} in this year here.",
                study.when.hours()
            ),
            "Load is shadow summed over area and time, in square feet times hours; every day is measured exactly, none stands for others."
                .to_owned(),
            "Net new is the load with the project less the load without it, so what a building that goes has thrown counts against it: a \
             convention here."
                .to_owned(),
            format!("A day has new shadow if some place has more than {LEAST} s more of it than without the project."),
            "Whether new shadow is significant or adverse is for the commissions to judge, by time, size, place and public good as well."
                .to_owned(),
        ],
    }
}
