//! The year of a park.

use jiff::civil::Date;
use ombra::accrual::{Again, Coverage, Exact, Occluders, Peak, Spells, new_shadow};
use ombra::sun::{Sheet, Span};
use serde_json::{Value, json};

use super::super::super::clock::Clock;
use super::super::frame::{Cell, SQUARE_FEET, rounded};
use super::super::progress::Progress;
use super::super::resources::Resource;
use super::super::study::Study;

/// A day has new shadow if some place has more of it by so many seconds: by half of what a day is good to.
pub(super) const LEAST: f64 = 0.5;

/// The year of a park.
pub(super) struct Year {
    /// Seconds of all places together, without the change.
    existing: f64,
    /// What the change adds, day by day: seconds of all places together, less what it takes away.
    net: Vec<f64>,
    /// Whether some place has more shadow.
    has_new: Vec<bool>,
    /// Seconds that each place has more, over the year.
    pub(super) by_place: Vec<f64>,
    /// When most of the park lies in new shadow, on the day of which there is most.
    pub(super) peak: Option<Peak>,
}

impl Year {
    /// `before` is how many seconds each place lies in shadow over the year; only those places are measured day by day for which
    /// the change makes a difference.
    pub(super) fn measure(
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

    pub(super) fn largest_day(&self) -> Option<usize> {
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

    pub(super) fn row(&self, study: &Study<'_>, resource: &Resource, clock: &Clock) -> Vec<Cell> {
        let mut cells = vec![
            Cell::text(&resource.area.name),
            Cell::number(resource.open() * SQUARE_FEET, 0),
            Cell::number(resource.open(), 1),
        ];
        if resource.nothing().is_some() {
            cells.push(Cell::text("not measured"));
            cells.resize(super::columns().len(), Cell::nothing());
            return cells;
        }
        let available = Self::available(study, resource);
        let [existing, net] =
            [self.existing, self.net.iter().sum()].map(|own| Self::load(resource, own));
        let count = self.has_new.iter().filter(|&&is_new| is_new).count();
        let dates: Vec<Date> = study.when.by_day().map(|day| day.0).collect();
        let largest = self.largest_day();
        let mut new_days = (0..dates.len()).filter(|&day| self.has_new[day]);
        let [first, last] = [new_days.clone().next(), new_days.next_back()];
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

    pub(super) fn told(&self, study: &Study<'_>, resource: &Resource) -> String {
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
    pub(super) fn json(&self, study: &Study<'_>, resource: &Resource, clock: &Clock) -> Value {
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
pub(super) fn peak(
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
