//! What each building shades, in all.

use std::collections::BTreeMap;
use std::path::Path;

use ombra::accrual::Share;
use ombra::city::Facet;
use ombra::formats::write_whole;
use serde::Serialize;

/// What one building shades.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct BuildingRow {
    /// Its number; none for what is no building.
    pub(super) building: Option<u32>,
    /// Its name, `terrain`, or `other` for other things that stand there.
    pub(super) building_id: Option<String>,
    /// How many places it shades, and how much ground that is, if they are of a grid.
    pub(super) places: usize,
    pub(super) square_metres: Option<f64>,
    /// Minutes, summed over places: in all, alone, and with another building behind it.
    pub(super) place_minutes: f64,
    pub(super) alone: f64,
    pub(super) shared: f64,
    /// The most minutes at one place.
    pub(super) most: f64,
}

/// The sums as they grow.
#[derive(Debug, Default)]
pub(super) struct Buildings(BTreeMap<u32, Sum>);

#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    places: usize,
    seconds: f64,
    alone: f64,
    most: f64,
}

impl Buildings {
    /// One more place.
    pub(super) fn add(&mut self, shares: &[Share]) {
        for share in shares {
            let sum = self.0.entry(share.owner).or_default();
            sum.places += 1;
            sum.seconds += share.seconds;
            sum.alone += share.alone;
            sum.most = sum.most.max(share.seconds);
        }
    }

    /// The places of others.
    pub(super) fn add_all(&mut self, others: &Self) {
        for (&owner, other) in &others.0 {
            let sum = self.0.entry(owner).or_default();
            sum.places += other.places;
            sum.seconds += other.seconds;
            sum.alone += other.alone;
            sum.most = sum.most.max(other.most);
        }
    }

    /// Those that take most first; places stand for cells so many metres wide.
    pub(super) fn rows(
        self,
        cell: Option<f64>,
        id: impl Fn(usize) -> Option<String>,
    ) -> Vec<BuildingRow> {
        let row = |(owner, sum): (u32, Sum)| BuildingRow {
            building: (owner < Facet::CONTEXT).then_some(owner),
            building_id: match owner {
                Facet::CONTEXT => Some("other".to_owned()),
                Facet::TERRAIN => Some("terrain".to_owned()),
                number => id(number as usize),
            },
            places: sum.places,
            square_metres: cell.map(|cell| cell * cell * sum.places as f64),
            place_minutes: sum.seconds / 60.0,
            alone: sum.alone / 60.0,
            shared: (sum.seconds - sum.alone) / 60.0,
            most: sum.most / 60.0,
        };
        let mut rows: Vec<BuildingRow> = self.0.into_iter().map(row).collect();
        rows.sort_by(|a, b| b.place_minutes.total_cmp(&a.place_minutes));
        rows
    }
}

/// Writes the rows as a table.
pub(super) fn write(path: &Path, rows: &[BuildingRow]) -> anyhow::Result<()> {
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record([
        "building",
        "building_id",
        "places",
        "square_metres",
        "place_minutes",
        "alone",
        "shared",
        "most",
    ])?;
    let number = |x: f64| format!("{x:.3}");
    for row in rows {
        table.write_record([
            row.building.map_or_else(String::new, |own| own.to_string()),
            row.building_id.clone().unwrap_or_default(),
            row.places.to_string(),
            row.square_metres.map_or_else(String::new, number),
            number(row.place_minutes),
            number(row.alone),
            number(row.shared),
            number(row.most),
        ])?;
    }
    Ok(write_whole(path, &table.into_inner()?)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_by_building_and_the_most_come_first() {
        let share = |owner, seconds, alone| Share {
            owner,
            seconds,
            alone,
        };
        let mut all = Buildings::default();
        all.add(&[share(0, 600.0, 600.0), share(Facet::TERRAIN, 60.0, 0.0)]);
        all.add(&[]);
        all.add(&[share(1, 1200.0, 0.0), share(0, 300.0, 60.0)]);
        let rows = all.rows(Some(2.0), |number| (number == 0).then(|| "a".to_owned()));
        let names: Vec<_> = rows
            .iter()
            .map(|row| (row.building, row.building_id.as_deref()))
            .collect();
        assert_eq!(
            names,
            [
                (Some(1), None),
                (Some(0), Some("a")),
                (None, Some("terrain"))
            ]
        );
        let a = &rows[1];
        assert_eq!((a.places, a.square_metres, a.most), (2, Some(8.0), 10.0));
        assert_eq!((a.place_minutes, a.alone, a.shared), (15.0, 11.0, 4.0));
        assert!(Buildings::default().rows(None, |_| None).is_empty());
    }
}
