//! How much of a garden has two hours of sun, by BRE 209.

use ombra::accrual::{Exact, Occluders};
use ombra::city::City;
use ombra::formats::contour::contour_lines;

use super::super::super::clock::Clock;
use super::super::frame::{Cell, Column, Figure, Report, RuleText, Table};
use super::super::map::Cells;
use super::super::resources::Resource;
use super::super::study::Study;

/// Seconds of sun that a place should have.
const ENOUGH: f64 = 7200.0;

pub(super) fn report(study: &Study<'_>) -> Option<Report> {
    let clock = Clock::civil(study.when.time_zone.clone());
    let is_changed = study.edited.is_some();
    let sides: Vec<&City> = match is_changed {
        true => vec![&study.before, study.after()],
        false => vec![&study.before],
    };
    let places: usize = study.resources.iter().map(Resource::places).sum();
    let mut progress = study.progress(sides.len() * places);
    let whole = study.when.hours() * 3600.0;
    let mut found: Vec<Garden> = study.resources.iter().map(|_| Garden::default()).collect();
    for city in sides {
        let occluders = study.cpu().install(|| Occluders::new(&city.facets()));
        let sheets = study.sheets(&study.when.spans);
        let exact = study.cpu().install(|| Exact::new(&occluders, &sheets));
        for (resource, garden) in study.resources.iter().zip(&mut found) {
            let shadow = study.seconds(&exact, &resource.tiles, &mut progress)?;
            let sun = shadow.into_iter().map(|shadow| (whole - shadow).max(0.0));
            let sun: Vec<f64> = sun.collect();
            let enough = sun.iter().filter(|&&seconds| seconds >= ENOUGH).count();
            garden.before = garden.now.replace(enough).or(garden.before);
            garden.sun = sun;
        }
    }
    drop(progress);
    let pairs = study.resources.iter().zip(&found);
    let told = (pairs.clone()).filter_map(|(resource, garden)| garden.told(resource));
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
        summary: told.collect(),
        figures: vec![figure(study, &found)],
        more: serde_json::Map::new(),
    })
}

#[derive(Default)]
struct Garden {
    /// Places with enough sun: without the change, if there is one, and as it is asked about.
    before: Option<usize>,
    now: Option<usize>,
    /// Seconds of each place as it is asked about.
    sun: Vec<f64>,
}

impl Garden {
    /// `None` where nothing was measured.
    fn counts(&self) -> Option<Counts> {
        let places = self.sun.len();
        let counts = |now| Counts {
            before: self.before,
            now,
            places,
        };
        self.now.filter(|_| places > 0).map(counts)
    }

    fn row(&self, resource: &Resource) -> Vec<Cell> {
        let mut cells = vec![
            Cell::text(&resource.area.name),
            Cell::number(resource.open(), 1),
            Cell::count(resource.places()),
        ];
        let Some(counts) = self.counts() else {
            cells.resize(columns().len() - 2, Cell::nothing());
            cells.extend([Cell::text("not measured"), Cell::nothing()]);
            return cells;
        };
        let share = |count| Cell::percent(counts.share(count), 1);
        let half = |count| Cell::yes(counts.is_half(count));
        let (passes, why) = counts.verdict();
        cells.extend([
            Cell::of(counts.before, share),
            share(counts.now),
            Cell::of(counts.before, half),
            half(counts.now),
            Cell::of(counts.ratio(), |ratio| Cell::number(ratio, 3)),
            Cell::text(if passes { "pass" } else { "fail" }),
            Cell::text(why),
        ]);
        cells
    }

    fn told(&self, resource: &Resource) -> Option<String> {
        let (passes, why) = self.counts()?.verdict();
        let word = if passes { "pass" } else { "fail" };
        Some(format!("{}: {word}: {why}", resource.area.name))
    }
}

/// How many places of a garden have enough sun.
#[derive(Clone, Copy, Debug)]
struct Counts {
    /// Without the change, if there is one.
    before: Option<usize>,
    now: usize,
    /// All of them.
    places: usize,
}

impl Counts {
    fn share(self, count: usize) -> f64 {
        count as f64 / self.places as f64
    }

    /// Whether at least half of the places are so many.
    const fn is_half(self, count: usize) -> bool {
        2 * count >= self.places
    }

    /// What is left of what had enough sun.
    fn ratio(self) -> Option<f64> {
        let before = self.before.filter(|&before| before > 0)?;
        Some(self.now as f64 / before as f64)
    }

    /// Whether less than 0.8 times what it was is left. In whole numbers, so that what is just 0.8 times is not rounded to less.
    fn is_less(self) -> bool {
        self.before.is_some_and(|before| 5 * self.now < 4 * before)
    }

    fn verdict(self) -> (bool, String) {
        let percent = |count| format!("{:.1} %", 100.0 * self.share(count));
        let now = percent(self.now);
        if self.is_half(self.now) {
            return (
                true,
                format!("{now} of it has 2 h of sun, half of it should"),
            );
        }
        let short = format!("{now} of it has 2 h of sun, less than half");
        let Some(before) = self.before.map(percent) else {
            return (false, short);
        };
        let loss = match self.ratio() {
            Some(ratio) if self.is_less() => {
                format!(
                    "and {ratio:.3} times the former {before}: a loss that is likely to be noticed"
                )
            }
            _ => format!(
                "but no less than 0.8 times the former {before}: no loss that is likely to be noticed"
            ),
        };
        (!self.is_less(), format!("{short}, {loss}"))
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
        let counts = |before, now| Counts {
            before,
            now,
            places: 1000,
        };
        let passes = |before, now| counts(before, now).verdict().0;
        assert!(passes(None, 500) && !passes(None, 499));
        // Above the half a loss does not matter.
        assert!(passes(Some(1000), 500));
        assert!(!passes(Some(600), 479) && passes(Some(600), 481));
        // What had no sun loses none.
        assert!(passes(Some(0), 0) && passes(Some(200), 300));
        assert_eq!(counts(Some(0), 0).ratio(), None);
        assert_eq!(counts(Some(500), 250).ratio(), Some(0.5));
    }

    /// Of 100 places, 45 and 36: as shares 0.36 is less than 0.8 times 0.45 by rounding.
    #[test]
    fn just_four_fifths_of_what_it_was_pass() {
        for places in 1..=120 {
            for before in (0..=places).step_by(5) {
                let verdict = |now| {
                    let before = Some(before);
                    let counts = Counts {
                        before,
                        now,
                        places,
                    };
                    counts.verdict().0
                };
                let now = before / 5 * 4;
                assert!(verdict(now), "{now} of {before}, {places}");
                let is_half = |now| 2 * now >= places;
                if now > 0 {
                    assert_eq!(
                        verdict(now - 1),
                        is_half(now - 1),
                        "{now} of {before}, {places}"
                    );
                }
            }
        }
    }
}
