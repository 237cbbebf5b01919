//! How long the sun shines on windows, by EN 17037.

use jiff::civil::Date;
use ombra::accrual::{Exact, Occluders};
use ombra::city::{City, Inside};

use super::super::super::clock::{Clock, length};
use super::super::super::places::{Kind, Places};
use super::super::frame::{Cell, Column, Report, RuleText, Table};
use super::super::progress::Progress;
use super::super::study::Study;

/// Seconds of sun for each level, the highest first.
const LEVELS: [(&str, f64); 3] = [
    ("high", 4.0 * 3600.0),
    ("medium", 3.0 * 3600.0),
    ("minimum", 1.5 * 3600.0),
];

pub(super) fn report(study: &Study<'_>, points: &Places) -> Option<Report> {
    let Kind::Points {
        file, at, inside, ..
    } = &points.kind
    else {
        return None;
    };
    let clock = Clock::civil(study.when.time_zone.clone());
    let sides = 1 + usize::from(study.edited.is_some());
    let mut progress = study.progress(sides * points.tiles.places().len());
    let before = match &study.edited {
        Some(_) => Some(sun(study, points, &study.before, &mut progress)?),
        None => None,
    };
    let now = sun(study, points, study.after(), &mut progress)?;
    drop(progress);
    let was_inside = study.edited.as_ref().map(|_| Inside::new(&study.before));
    let was_free = |index: usize| {
        was_inside
            .as_ref()
            .is_none_or(|inside| !inside.contains(at[index]))
    };
    let mut rows = Vec::with_capacity(at.len());
    let (mut passed, mut hidden) = (0, 0);
    for (index, point) in file.points.iter().enumerate() {
        let before = before.as_ref().map(|before| before[index]);
        let before = before.filter(|before| !before.is_nan() && was_free(index));
        let name = point.id.clone().unwrap_or_else(|| format!("#{index}"));
        let now = now[index];
        let level = LEVELS
            .iter()
            .find(|level| now >= level.1)
            .map(|level| level.0);
        passed += usize::from(level.is_some());
        let time = |seconds: f64| {
            let cell = Cell::number(seconds / 3600.0, 3);
            Cell::shown(cell.value, length(seconds))
        };
        let [x, y] = point.at;
        let mut cells = vec![
            Cell::text(name),
            Cell::number(x, 6),
            Cell::number(y, 6),
            Cell::number(point.height, 2),
        ];
        if inside[index].is_some() {
            hidden += 1;
            cells.extend([Cell::nothing(), Cell::nothing(), Cell::nothing()]);
            cells.push(Cell::text("not measured: lies inside of a building"));
        } else {
            cells.extend([
                Cell::of(before, time),
                time(now),
                Cell::text(level.unwrap_or("below the minimum")),
                Cell::text(if level.is_some() { "pass" } else { "fail" }),
            ]);
        }
        rows.push(cells);
    }
    let measured = at.len() - hidden;
    let days: Vec<Date> = study.when.by_day().map(|day| day.0).collect();
    let mut findings = Vec::new();
    if hidden > 0 {
        findings.push(format!(
            "{hidden} of the points lie inside of buildings and are not measured"
        ));
    }
    let is_in_season =
        |day: &Date| (2..=3).contains(&day.month()) && (day.month(), day.day()) <= (3, 21);
    if !days.iter().all(is_in_season) {
        findings.push(
            "EN 17037 asks for a day from 1 February to 21 March; this is another one".to_owned(),
        );
    }
    if study.args.when.min_altitude.is_none() {
        findings.push(format!(
            "EN 17037 counts the sun from an altitude that depends on the place (11° in Germany, 13° in the Czech Republic); none was named, and {}° is taken (--min-altitude)",
            super::ALTITUDE
        ));
    }
    Some(Report {
        rule: rule(study),
        facts: study.facts(&clock),
        table: Table {
            name: "Sun at windows",
            columns: columns(),
            rows,
        },
        findings,
        summary: vec![format!(
            "{passed} of {measured} points have 1.5 h of sun or more."
        )],
        figures: Vec::new(),
        more: serde_json::Map::new(),
    })
}

/// How many seconds each point has sun; NaN for those that lie in a building. `None` if it was interrupted.
fn sun(
    study: &Study<'_>,
    points: &Places,
    city: &City,
    progress: &mut Progress<'_>,
) -> Option<Vec<f64>> {
    let sheets = study.sheets(&study.when.spans);
    let tiles = &points.tiles;
    let occluders = study.cpu().install(|| Occluders::new(&city.facets()));
    let exact = study.cpu().install(|| Exact::new(&occluders, &sheets));
    let shadow = study.seconds(&exact, tiles, progress)?;
    let whole = study.when.hours() * 3600.0;
    let Kind::Points { outside, .. } = &points.kind else {
        return None;
    };
    let mut seconds = vec![f64::NAN; points.count()];
    for (&index, shadow) in tiles.indices().iter().zip(shadow) {
        seconds[outside[index as usize] as usize] = (whole - shadow).max(0.0);
    }
    Some(seconds)
}

fn columns() -> Vec<Column> {
    [
        ("point", "Point"),
        ("x", "x"),
        ("y", "y"),
        ("height_m", "Above the ground, m"),
        ("sun_before_h", "Sun before"),
        ("sun_h", "Sun now"),
        ("level", "Level"),
        ("result", "Result"),
    ]
    .map(|(key, head)| Column { key, head })
    .into()
}

fn rule(study: &Study<'_>) -> RuleText {
    RuleText {
        title: "Sun at windows (EN 17037, BRE 209)",
        sources: &[
            "EN 17037:2018+A1:2021, Daylight in buildings: exposure to sunlight",
            "BRE report BR 209, third edition, 2022, which has the minimum for new dwellings, on 21 March",
        ],
        conventions: vec![
            "On a day from 1 February to 21 March: 1.5 h of sun is the minimum, 3 h medium, 4 h high. In a dwelling one habitable room \
             should have it; which point is of which room the file says."
                .to_owned(),
            super::altitude(study),
            "Each point is where the file has it. What the standard asks for is the plane of the wall's inner face, the middle of the window's \
             width, at least 1.2 m above the floor and at least 0.3 m above the sill. Its own wall throws shadow if it stands in the city."
                .to_owned(),
        ],
    }
}
