//! Japan: hours of shadow around a site at the winter solstice, by article 56-2 of the Building Standards Act.

mod found;
mod ground;
mod zones;

use std::path::Path;

use anyhow::bail;
use ombra::sun::{Calendar, Season, Window};

use super::super::args::{Said, ShadowsArgs, WhenArgs};
use super::super::clock::{Clock, length};
use super::args::ReportArgs;
use super::frame::{Cell, Column, Fact, Figure, Report, RuleText, Table};
use super::map::Cells;
use super::resources::Area;
use super::study::Study;
use found::Found;
use zones::Zone;

/// Metres above the average ground, unless others are asked for.
const PLANE: f64 = 4.0;

/// Seconds of shadow that are too much beyond 5 m and beyond 10 m of the site: those asked for, else number (2) of table 4.
fn limits(asked: &ReportArgs) -> [f64; 2] {
    let usual = if asked.hokkaido {
        [3.0, 2.0]
    } else {
        [4.0, 2.5]
    };
    asked.limits.unwrap_or(usual.map(|hours| hours * 3600.0))
}

/// The winter solstice, by true solar time.
pub(super) fn when(args: &ShadowsArgs, calendar: &Calendar) -> anyhow::Result<WhenArgs> {
    // Of the north, wherever it is: the day on which the sun stands lowest there.
    let north = Calendar {
        north: true,
        ..calendar.clone()
    };
    let day = Season::Winter.days(calendar.year, &north).0;
    let text = if args.report.hokkaido {
        "09:00-15:00"
    } else {
        "08:00-16:00"
    };
    Ok(WhenArgs {
        date: Some(day.to_string()),
        solar_time: Some(Said {
            text: text.to_owned(),
            value: Window::list(text)?,
        }),
        ..args.when.clone()
    })
}

/// What the file of the site must be.
pub(super) fn check(areas: &[Area], path: &Path) -> anyhow::Result<()> {
    if areas.len() != 1 {
        bail!(
            "{}: {} areas; for --report japan one is wanted, the site (a MultiPolygon if it has several parts)",
            path.display(),
            areas.len()
        );
    }
    Ok(())
}

/// `None` if it was interrupted.
pub(super) fn report(study: &Study<'_>) -> Option<Report> {
    let asked = &study.args.report;
    let (plane, limits) = (asked.plane.unwrap_or(PLANE), limits(asked));
    let clock = Clock::civil(study.when.time_zone.clone());
    let found = Found::measure(study, plane)?;
    let mut rows = Vec::new();
    let mut summary = Vec::new();
    for (zone, limit) in Zone::BOTH.into_iter().zip(limits) {
        let most = found.most(zone);
        // The article forbids so many hours and more.
        let passes = most.is_none_or(|most| most.seconds < limit);
        let time = |seconds: f64| {
            let cell = Cell::number(seconds / 3600.0, 4);
            Cell::shown(cell.value, length(seconds))
        };
        let place = most.map(|most| study.before.origin.to_geographic(most.at));
        rows.push(vec![
            Cell::text(zone.name()),
            time(limit),
            Cell::of(most, |most| time(most.seconds)),
            Cell::text(if passes { "pass" } else { "fail" }),
            Cell::of(place, |place| Cell::number(place[0], 7)),
            Cell::of(place, |place| Cell::number(place[1], 7)),
            Cell::of(most, |most| Cell::number(most.at[0], 2)),
            Cell::of(most, |most| Cell::number(most.at[1], 2)),
            Cell::of(most, |most| Cell::number(most.distance, 2)),
        ]);
        let most = most.map_or("no shadow".to_owned(), |most| {
            format!("{} of shadow at most", length(most.seconds))
        });
        let word = if passes { "pass" } else { "fail" };
        summary.push(format!(
            "{}: {word}: {most}, less than {} is allowed",
            zone.name(),
            length(limit)
        ));
    }
    let mut facts = study.facts(&clock);
    let places = found.hours.iter().filter(|hours| !hours.is_nan()).count();
    facts.extend(study.facts_of_grid(places));
    let number = |key, name, value| Fact {
        key,
        name,
        cell: Cell::number(value, 2),
    };
    facts.push(number(
        "plane_m",
        "Measured so high above the average ground, metres",
        plane,
    ));
    facts.push(number(
        "ground_m",
        "Average ground, local metres",
        found.ground,
    ));
    let mut more = serde_json::Map::new();
    more.insert("contours".to_owned(), found.geojson(study));
    Some(Report {
        rule: rule(study),
        facts,
        table: Table {
            name: "Most hours of shadow beyond the lines",
            columns: columns(),
            rows,
        },
        findings: found.findings(study),
        summary,
        figures: vec![figure(study, &found, limits)],
        more,
    })
}

fn columns() -> Vec<Column> {
    [
        ("zone", "Beyond the boundary of the site"),
        ("limit_h", "Less than"),
        ("most_h", "Most shadow"),
        ("result", "Result"),
        ("longitude", "There: longitude"),
        ("latitude", "latitude"),
        ("east_m", "east, m"),
        ("north_m", "north, m"),
        ("distance_m", "from the site, m"),
    ]
    .map(|(key, head)| Column { key, head })
    .into()
}

fn figure(study: &Study<'_>, found: &Found, limits: [f64; 2]) -> Figure {
    let hours = study.when.hours() as f32;
    let mut map = study.map_of(found.extent(), |map| {
        map.cells(&Cells {
            grid: &found.grid,
            values: &found.hours,
            most: hours,
        });
    });
    for contour in &found.contours {
        let is_limit = limits
            .iter()
            .any(|limit| (limit / 3600.0 - f64::from(contour.level)).abs() < 1e-6);
        let class = if is_limit {
            "class=\"limit\""
        } else {
            "class=\"line\""
        };
        map.path([contour.points.as_slice()], false, class);
    }
    for lines in &found.lines {
        map.path(lines.iter().map(Vec::as_slice), true, "class=\"ring\"");
    }
    for zone in Zone::BOTH {
        if let Some(most) = found.most(zone) {
            map.mark(most.at, &length(most.seconds));
        }
    }
    let levels = found
        .contours
        .iter()
        .map(|contour| format!("{}", contour.level));
    let mut levels: Vec<String> = levels.collect();
    levels.dedup();
    let caption = format!(
        "{}: hours of shadow of the proposed buildings alone. Lines of equal time at {} h, those of the limits in red; dashed the lines \
         5 m and 10 m from the site; dots where there is most.",
        study.when.text,
        levels.join(", ")
    );
    Figure {
        svg: map.finish(&caption, Some(&format!("{hours:.0} h of shadow"))),
        caption,
    }
}

fn rule(study: &Study<'_>) -> RuleText {
    let hours = if study.args.report.hokkaido {
        "9 to 15 (Hokkaido)"
    } else {
        "8 to 16"
    };
    RuleText {
        title: "Hours of shadow around a site (Japan, 日影規制)",
        sources: &[
            "建築基準法 (Building Standards Act, Act 201 of 1950), article 56-2 and appended table 4",
            "建築基準法施行令 (its Enforcement Order, Cabinet Order 338 of 1950), articles 135-12 and 135-13",
        ],
        conventions: vec![
            format!("At the winter solstice, from {hours} by true solar time: the sun is due south at 12."),
            "Of the proposed buildings alone (--with): existing ones, terrain and trees throw no shadow. All buildings of a site count as one: \
             those that stay on it belong in --with, too."
                .to_owned(),
            "On a level plane above the average ground around the proposed buildings. What plane (1.5, 4 or 6.5 m), which limits and whether there \
             are any, table 4 and an ordinance say for each zone: --plane and --limits. The limits of the table are 3 and 2 h, 4 and 2.5 h, 5 and \
             3 h; in Hokkaido 2 and 1.5 h, 3 and 2 h, 4 and 2.5 h."
                .to_owned(),
            "Fail is shadow for as long as the limit or longer, at any place farther than 5 m and up to 10 m from the boundary of the site, and at any \
             place farther than 10 m; also on these lines themselves, every half of a cell."
                .to_owned(),
            "Distances are level ones, with round corners. A road, water or railway beside the site moves its boundary outward: draw the site so \
             that it does. Not looked at are ground of neighbours that is 1 m higher or more, zones with other limits or none, and whether the building \
             is one of those that the article holds for."
                .to_owned(),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_those_asked_for_or_of_the_table() {
        let asked = |limits, hokkaido| ReportArgs {
            report: None,
            resources: None,
            plane: None,
            limits,
            hokkaido,
        };
        assert_eq!(limits(&asked(None, false)), [14_400.0, 9000.0]);
        assert_eq!(limits(&asked(None, true)), [10_800.0, 7200.0]);
        let other = [18_000.0, 10_800.0];
        assert_eq!(limits(&asked(Some(other), true)), other);
    }
}
