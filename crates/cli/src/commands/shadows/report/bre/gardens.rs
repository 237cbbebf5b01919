//! How much of a garden has two hours of sun, by BRE 209.

use ombra::accrual::{Exact, Occluders};
use ombra::city::City;
use ombra::formats::contour::contour_lines;

use super::super::clock::Clock;
use super::super::frame::{Cell, Column, Figure, Report, RuleText, Table};
use super::super::map::Cells;
use super::super::resources::Resource;
use super::super::study::{Progress, Study};

/// Seconds of sun that a place should have.
const ENOUGH: f64 = 7200.0;

/// The share of an area that should have them.
const HALF: f64 = 0.5;

/// The share of what it was before from which on a loss is not noticed.
const FORMER: f64 = 0.8;

/// Blocks of tiles are measured at once: so many.
const BLOCK: usize = 256;

pub(super) fn report(study: &Study<'_>) -> Option<Report> {
    let clock = Clock::civil(study.when.time_zone.clone());
    let is_changed = study.edited.is_some();
    let sides: Vec<&City> = match is_changed {
        true => vec![&study.before, study.after()],
        false => vec![&study.before],
    };
    let places: usize = study.resources.iter().map(Resource::places).sum();
    let mut progress = study.progress(sides.len() * places);
    let mut found: Vec<Garden> = study.resources.iter().map(|_| Garden::default()).collect();
    for city in sides {
        let occluders = study.cpu().install(|| Occluders::new(&city.facets()));
        let sheets = study.sheets(&study.when.spans);
        let exact = study.cpu().install(|| Exact::new(&occluders, &sheets));
        for (resource, garden) in study.resources.iter().zip(&mut found) {
            let sun = sun(study, &exact, resource, &mut progress)?;
            let enough = sun.iter().filter(|&&seconds| seconds >= ENOUGH).count();
            let share = enough as f64 / sun.len().max(1) as f64;
            garden.before = garden.now.replace(share).or(garden.before);
            garden.sun = sun;
        }
    }
    drop(progress);
    let pairs = study.resources.iter().zip(&found);
    let told = pairs
        .clone()
        .filter(|(resource, _)| resource.nothing().is_none());
    Some(Report {
        rule: rule(study),
        facts: study.facts_of_areas(&clock),
        table: Table {
            name: "Sun in gardens and amenity areas",
            columns: columns(),
            rows: pairs
                .map(|(resource, garden)| garden.row(resource))
                .collect(),
        },
        findings: study
            .resources
            .iter()
            .filter_map(Resource::finding)
            .collect(),
        summary: told
            .map(|(resource, garden)| garden.told(resource))
            .collect(),
        figures: vec![figure(study, &found)],
        more: serde_json::Map::new(),
    })
}

/// How many seconds each place has sun.
fn sun(
    study: &Study<'_>,
    exact: &Exact<'_>,
    resource: &Resource,
    progress: &mut Progress<'_>,
) -> Option<Vec<f64>> {
    let (tiles, whole) = (&resource.tiles, study.when.hours() * 3600.0);
    let mut seconds = Vec::with_capacity(resource.places());
    for first in (0..tiles.len()).step_by(BLOCK) {
        let block = first..tiles.len().min(first + BLOCK);
        let own = study.cpu().install(|| exact.seconds_of(tiles, block));
        progress.step(own.len())?;
        seconds.extend(own.into_iter().map(|shadow| (whole - shadow).max(0.0)));
    }
    Some(seconds)
}

#[derive(Default)]
struct Garden {
    /// Shares of the area with enough sun: without the change, if there is one, and as it is asked about.
    before: Option<f64>,
    now: Option<f64>,
    /// Seconds of each place as it is asked about.
    sun: Vec<f64>,
}

impl Garden {
    fn row(&self, resource: &Resource) -> Vec<Cell> {
        let mut cells = vec![
            Cell::text(&resource.area.name),
            Cell::number(resource.open(), 1),
            Cell::count(resource.places()),
        ];
        let Some(now) = self.now.filter(|_| resource.nothing().is_none()) else {
            cells.resize(columns().len() - 2, Cell::nothing());
            cells.extend([Cell::text("not measured"), Cell::nothing()]);
            return cells;
        };
        let share = |share: f64| Cell::percent(share, 1);
        let (verdict, why) = verdict(self.before, now);
        cells.extend([
            Cell::of(self.before, share),
            share(now),
            Cell::of(self.before, |before| Cell::yes(before >= HALF)),
            Cell::yes(now >= HALF),
            Cell::of(ratio(self.before, now), |ratio| Cell::number(ratio, 3)),
            Cell::text(if verdict { "pass" } else { "fail" }),
            Cell::text(why),
        ]);
        cells
    }

    fn told(&self, resource: &Resource) -> String {
        let now = self.now.unwrap_or(0.0);
        let (passes, why) = verdict(self.before, now);
        let word = if passes { "pass" } else { "fail" };
        format!("{}: {word}: {why}", resource.area.name)
    }
}

/// What is left of what had enough sun.
fn ratio(before: Option<f64>, now: f64) -> Option<f64> {
    before
        .filter(|&before| before > 0.0)
        .map(|before| now / before)
}

fn verdict(before: Option<f64>, now: f64) -> (bool, String) {
    let percent = 100.0 * now;
    if now >= HALF {
        return (
            true,
            format!("{percent:.1} % of it has 2 h of sun, half of it should"),
        );
    }
    let short = format!("{percent:.1} % of it has 2 h of sun, less than half");
    match before {
        None => (false, short),
        Some(before) if now < FORMER * before => {
            let ratio = now / before;
            (
                false,
                format!(
                    "{short}, and {ratio:.2} times the former {:.1} %: a loss that is likely to be noticed",
                    100.0 * before
                ),
            )
        }
        Some(before) => (
            true,
            format!(
                "{short}, but no less than {FORMER} times the former {:.1} %: no loss that is likely to be noticed",
                100.0 * before
            ),
        ),
    }
}

fn columns() -> Vec<Column> {
    [
        ("garden", "Garden"),
        ("area_m2", "Open area, m²"),
        ("places", "Places"),
        ("two_hours_before_percent", "2 h of sun before, % of it"),
        ("two_hours_after_percent", "2 h of sun now, % of it"),
        ("half_before", "Half of it before"),
        ("half_after", "Half of it now"),
        ("ratio", "Now / before"),
        ("result", "Result"),
        ("reason", "Why"),
    ]
    .map(|(key, head)| Column { key, head })
    .into()
}

fn figure(study: &Study<'_>, found: &[Garden]) -> Figure {
    let most = study.when.hours();
    let shadow = |garden: &Garden| -> Vec<f64> {
        let hours = garden.sun.iter().map(|sun| (most - sun / 3600.0).max(0.0));
        hours.collect()
    };
    let map = study.map(|map| {
        for (resource, garden) in study.resources.iter().zip(found) {
            let values = Study::spread(resource, shadow(garden));
            map.cells(&Cells {
                grid: &resource.grid,
                values: &values,
                most: most as f32,
            });
            let line = (most - ENOUGH / 3600.0) as f32;
            for contour in contour_lines(&resource.grid, &values, &[line]) {
                map.path([contour.points.as_slice()], false, "class=\"limit\"");
            }
        }
    });
    let caption = format!(
        "{}: shadow of the {most:.1} h of sun that count, on each place; in red where there are just 2 h of sun.",
        study.when.text
    );
    Figure {
        svg: map.finish(&caption, Some(&format!("{most:.1} h of shadow"))),
        caption,
    }
}

fn rule(study: &Study<'_>) -> RuleText {
    let mut conventions = vec![
        "At least half of a garden or amenity area should have at least 2 h of sun on 21 March. Where it has not, and less than 0.8 \
         times what had them before has them now, the loss is likely to be noticed."
            .to_owned(),
        super::altitude(study),
        "Each place is a point on the ground; fences, trees and what the file of the city does not hold throw no shadow here.".to_owned(),
    ];
    if study.edited.is_none() {
        conventions.push("Nothing is changed (--with), so that there is no former value; only the half is looked at.".to_owned());
    }
    RuleText {
        title: "Sun in gardens and amenity areas (BRE 209)",
        sources: &[
            "Littlefair, King, Howlett, Ticleanu, Longfield: Site layout planning for daylight and sunlight, a guide to good practice, BRE \
             report BR 209, third edition, 2022, section 3.3",
        ],
        conventions,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_garden_passes_by_its_half_or_by_what_it_was() {
        let passes = |before, now| verdict(before, now).0;
        assert!(passes(None, 0.5) && !passes(None, 0.499));
        // Above the half a loss does not matter.
        assert!(passes(Some(1.0), 0.5));
        assert!(!passes(Some(0.6), 0.47) && passes(Some(0.6), 0.49));
        // What had no sun loses none.
        assert!(passes(Some(0.0), 0.0) && passes(Some(0.2), 0.3));
        assert_eq!(ratio(Some(0.0), 0.0), None);
        assert_eq!(ratio(Some(0.5), 0.25), Some(0.5));
    }
}
