//! What is known of all places of a file.

use ombra_city::{Grid, MAX_CELLS};
use ombra_sun::{Instant, Span};
use serde::{Deserialize, Serialize};

/// What all places of a file of spells share: JSON in its footer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpellsAbout {
    /// Of the layout: 1.
    pub version: u32,
    /// Degrees north of the place for which the sun was reckoned, and where local metres begin.
    pub latitude: f64,
    /// Degrees east of it.
    pub longitude: f64,
    /// The time zone of the clock: Europe/Berlin.
    pub time_zone: String,
    /// Whether the sun was lifted by refraction.
    pub refraction: bool,
    /// The stretches of time that were looked at, in order: milliseconds since 1970, UTC.
    pub windows: Vec<[i64; 2]>,
    /// What the places are on: `ground`, `roof`, `facade` or `points`.
    pub on: String,
    /// Metres between places; none for points.
    pub cell: Option<f64>,
    /// The grid over the ground, if they are of one.
    pub grid: Option<GridAbout>,
    /// How many places were to be measured: more than there are rows if it was interrupted.
    pub places: u64,
    /// The names of all buildings, by their number; null for those that have none.
    pub buildings: Vec<Option<String>>,
}

/// See [`Grid`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GridAbout {
    /// The south-west corner: metres east and north of the place.
    corner: [f64; 2],
    width: u32,
    height: u32,
}

impl SpellsAbout {
    /// Sets the grid.
    pub fn set_grid(&mut self, grid: Grid) {
        self.cell = Some(grid.cell);
        self.grid = Some(GridAbout {
            corner: grid.corner,
            width: grid.width,
            height: grid.height,
        });
    }

    /// The grid, if they are of one.
    #[must_use]
    pub fn grid(&self) -> Option<Grid> {
        let GridAbout {
            corner,
            width,
            height,
        } = self.grid?;
        Some(Grid {
            corner,
            cell: self.cell?,
            width,
            height,
        })
    }

    /// The stretches of time that were looked at.
    #[must_use]
    pub fn spans(&self) -> Vec<Span> {
        let span = |&[from, to]: &[i64; 2]| Span::new(instant(from), instant(to));
        self.windows.iter().map(span).collect()
    }

    /// Rounded to milliseconds, as in the file.
    pub fn set_spans(&mut self, spans: &[Span]) {
        let window = |span: &Span| [milliseconds(span.start), milliseconds(span.end)];
        self.windows = spans.iter().map(window).collect();
    }

    /// What is wrong, if anything is.
    pub(super) fn fault(&self) -> Option<String> {
        let is_on_globe = self.latitude.abs() <= 90.0 && self.longitude.abs() <= 180.0;
        let is_in_order = self.windows.iter().all(|[from, to]| from < to)
            && self.windows.windows(2).all(|pair| pair[0][1] <= pair[1][0]);
        let is_small = |grid: Grid| {
            let (width, height) = (u64::from(grid.width), u64::from(grid.height));
            width > 0 && height > 0 && width * height <= MAX_CELLS
        };
        // Within some thousands of years, so that sums of milliseconds are exact.
        let is_near = |time: &i64| time.unsigned_abs() < 1 << 48;
        if self.version != 1 {
            Some(format!("has layout {}; 1 can be read", self.version))
        } else if !is_on_globe {
            let (latitude, longitude) = (self.latitude, self.longitude);
            Some(format!(
                "lies at latitude {latitude}, longitude {longitude}"
            ))
        } else if !(is_in_order && self.windows.iter().flatten().all(is_near)) {
            Some("has windows that are not in order".to_owned())
        } else if !self.grid().is_none_or(is_small) {
            Some("has a grid of no cells, or of too many".to_owned())
        } else if self
            .cell
            .is_some_and(|cell| !(0.01..=10_000.0).contains(&cell))
        {
            Some("has a cell of no size".to_owned())
        } else {
            None
        }
    }
}

pub(super) fn instant(milliseconds: i64) -> Instant {
    Instant::from_seconds(milliseconds as f64 / 1000.0)
}

pub(super) fn milliseconds(instant: Instant) -> i64 {
    (instant.seconds() * 1000.0).round() as i64
}
