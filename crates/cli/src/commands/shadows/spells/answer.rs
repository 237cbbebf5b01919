//! Answers as files: a row a place.

use std::path::Path;

use jiff::tz::TimeZone;
use ombra::accrual::Summary;
use ombra::city::{Crs, Origin};
use ombra::formats::places::{PlaceRow, write_places_geojson};
use ombra::formats::raster::{Band, Raster, Unit, write_geotiff_bands};
use ombra::formats::spells::SpellsAbout;
use ombra::formats::write_whole;
use ombra::sun::Instant;
use serde_json::{Map, Value};

use super::super::args::{GEOTIFF, has_ending};
use super::super::clock::Clock;
use super::buildings::Buildings;

/// What was found for the places of a group.
pub(super) struct Answered {
    pub(super) places: Vec<u32>,
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) summaries: Vec<Summary>,
    pub(super) buildings: Buildings,
    /// Seconds to read it, and to answer.
    pub(super) took: [f64; 2],
}

/// What was found for each place, one group after another.
pub(super) struct Answer<'a> {
    pub(super) about: &'a SpellsAbout,
    pub(super) groups: &'a [Answered],
    pub(super) metadata: Vec<(String, String)>,
    pub(super) zone: &'a str,
}

/// Whether it is a file of a map.
pub(super) fn is_map(path: &Path) -> bool {
    has_ending(path, &GEOTIFF)
}

/// The columns beside where a place is.
const COLUMNS: [&str; 6] = [
    "shadow_minutes",
    "sun_minutes",
    "first_sun",
    "last_sun",
    "longest_sun_minutes",
    "spells",
];

impl Answer<'_> {
    pub(super) fn write(&self, path: &Path) -> anyhow::Result<()> {
        if is_map(path) {
            self.map(path)
        } else if has_ending(path, &["csv"]) {
            self.table(path)
        } else {
            self.features(path)
        }
    }

    /// Each place with what was found for it.
    fn rows(&self) -> impl Iterator<Item = (u32, [f64; 3], &Summary)> {
        self.groups.iter().flat_map(|group| {
            let places = group.places.iter().zip(&group.positions);
            let all = places.zip(&group.summaries);
            all.map(|((&place, &position), summary)| (place, position, summary))
        })
    }

    fn table(&self, path: &Path) -> anyhow::Result<()> {
        let clock = Clock::civil(TimeZone::get(self.zone)?);
        let mut table = csv::Writer::from_writer(Vec::new());
        table.write_record(
            ["place", "longitude", "latitude", "height"]
                .iter()
                .chain(&COLUMNS),
        )?;
        for (place, [longitude, latitude, height], summary) in self.rows() {
            let time = |at: Option<Instant>| at.map_or_else(String::new, |at| clock.iso(at));
            table.write_record([
                place.to_string(),
                format!("{longitude:.9}"),
                format!("{latitude:.9}"),
                format!("{height:.3}"),
                format!("{:.3}", summary.shadow / 60.0),
                format!("{:.3}", summary.sun / 60.0),
                time(summary.first_sun),
                time(summary.last_sun),
                format!("{:.3}", summary.longest_sun / 60.0),
                summary.spells.to_string(),
            ])?;
        }
        Ok(write_whole(path, &table.into_inner()?)?)
    }

    fn features(&self, path: &Path) -> anyhow::Result<()> {
        let clock = Clock::civil(TimeZone::get(self.zone)?);
        let minutes = |seconds: f64| Value::from((seconds / 60.0 * 1e3).round() / 1e3);
        let properties = |(place, _, summary): (u32, [f64; 3], &Summary)| -> Map<String, Value> {
            let time = |at: Option<Instant>| at.map(|at| clock.iso(at)).into();
            let values = [
                minutes(summary.shadow),
                minutes(summary.sun),
                time(summary.first_sun),
                time(summary.last_sun),
                minutes(summary.longest_sun),
                summary.spells.into(),
            ];
            // The row itself has the minutes in shadow.
            let pairs = COLUMNS.into_iter().zip(values).skip(1);
            let place = [("place", Value::from(place))];
            place
                .into_iter()
                .chain(pairs)
                .map(|(name, value)| (name.to_owned(), value))
                .collect()
        };
        let all: Vec<Map<String, Value>> = self.rows().map(properties).collect();
        let rows = self
            .rows()
            .zip(&all)
            .map(|((_, position, summary), properties)| PlaceRow {
                position,
                minutes: Some((summary.shadow / 60.0) as f32),
                properties: Some(properties),
                ..PlaceRow::default()
            });
        Ok(write_places_geojson(path, rows, &self.metadata)?)
    }

    /// Bands of a GeoTIFF.
    fn map(&self, path: &Path) -> anyhow::Result<()> {
        let Some(grid) = self.about.grid() else {
            unreachable!("refused before anything was read");
        };
        let centre = [self.about.longitude, self.about.latitude];
        let origin = Origin::new(Crs::wgs84(), centre)?;
        let values = |of: fn(&Summary) -> f64| -> anyhow::Result<Vec<f32>> {
            let mut values = vec![f32::NAN; grid.count()];
            for (place, _, summary) in self.rows() {
                let value = values.get_mut(place as usize);
                *value.ok_or_else(|| anyhow::anyhow!("place {place} is not in the grid"))? =
                    of(summary) as f32;
            }
            Ok(values)
        };
        let all = [
            ("minutes in shadow", values(|own| own.shadow / 60.0)?),
            ("minutes of sun", values(|own| own.sun / 60.0)?),
            (
                "longest sun, minutes",
                values(|own| own.longest_sun / 60.0)?,
            ),
        ];
        let mut bands = Vec::new();
        for (name, values) in &all {
            let raster = Raster::new(&origin, grid, Unit::Minutes, values)?;
            bands.push(Band { name, raster });
        }
        Ok(write_geotiff_bands(path, &bands, &self.metadata)?)
    }
}
