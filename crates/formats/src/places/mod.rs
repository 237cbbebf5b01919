//! Shadow time at single places, out as GeoJSON ([`write_places_geojson`]) and GeoParquet
//! ([`write_places_parquet`]).
//!
//! Both have the same rows, in longitude and latitude (WGS 84), whatever the map of the city was:
//!
//! | column | type | what |
//! |---|---|---|
//! | `geometry` | point | longitude, latitude, and the height in metres of the city's own heights |
//! | `minutes` | number or null | in shadow; null inside of buildings and where nothing was measured |
//! | `inside` | boolean | whether the place lies in a building |
//! | `building` | whole number or null | the building that it lies in or on, counted from 0 as they are read |
//! | `building_id` | text or null | that building's name in its file |
//! | `surface` | `roof`, `facade` or null | what of the building it lies on |
//! | `azimuth` | degrees or null | which way that looks, clockwise from north; null where it is level |
//! | `tilt` | degrees or null | 0 faces up, 90 is upright |
//! | `id` | text or null | the place's own name |
//! | `before`, `after`, `net` | number or null | only of a city that is changed: minutes before and after, and what is new; `minutes` and `inside` are after |
//! | `properties` | JSON or null | what else the list of places said of it; in GeoJSON they are properties themselves |

mod geojson;
mod parquet;

#[cfg(test)]
mod tests;

use ombra_geometry::Vector3;
use serde_json::{Map, Value};

pub use geojson::write_places_geojson;
pub use parquet::write_places_parquet;

/// One place and what was found there.
#[derive(Clone, Copy, Debug, Default)]
pub struct PlaceRow<'a> {
    /// Longitude and latitude (WGS 84, degrees), and metres of height.
    pub position: [f64; 3],
    /// Minutes in shadow, if they are known.
    pub minutes: Option<f32>,
    /// Whether the place lies in a building.
    pub inside: bool,
    /// The building that it lies in or on: its number, and its name.
    pub building: Option<(u32, Option<&'a str>)>,
    /// What of the building it lies on, and which way that looks: of length 1, x east, y north, z up.
    pub surface: Option<(&'static str, Vector3)>,
    /// The place's own name.
    pub id: Option<&'a str>,
    /// Of a city that is changed; all rows of a file have it, or none.
    pub change: Option<PlaceChange>,
    /// What else is known of it.
    pub properties: Option<&'a Map<String, Value>>,
}

/// Minutes in shadow before and after a change of the city.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlaceChange {
    /// Before it, if they are known.
    pub before: Option<f32>,
    /// After it.
    pub after: Option<f32>,
    /// How many there are more; fewer are negative.
    pub net: Option<f32>,
}

/// Names that a property cannot have beside a [`PlaceChange`].
pub const CHANGE_COLUMNS: [&str; 3] = ["before", "after", "net"];

/// Names that a property cannot have in GeoJSON, where it would stand beside what was measured.
pub const PLACE_COLUMNS: [&str; 7] = [
    "minutes",
    "inside",
    "building",
    "building_id",
    "surface",
    "azimuth",
    "tilt",
];

/// A normal closer to upright than this, as the sine of the angle, looks no way: the face is level.
const LEVEL: f32 = 1e-3;

/// Azimuth, unless the face is level, and tilt: degrees, to a hundredth.
fn angles(normal: Vector3) -> (Option<f64>, f64) {
    let Vector3 { x, y, z } = normal;
    let level = x.hypot(y);
    let hundredths = |degrees: f32| (f64::from(degrees) * 100.0).round() / 100.0;
    let azimuth = hundredths(x.atan2(y).to_degrees()).rem_euclid(360.0);
    // A full turn is none, and so is the turn by minus nothing.
    (
        (level > LEVEL).then_some(azimuth + 0.0),
        hundredths(level.atan2(z).to_degrees()),
    )
}

/// Degrees to a tenth of a millimetre on the ground, metres to a millimetre.
pub(crate) fn rounded([longitude, latitude, height]: [f64; 3]) -> [f64; 3] {
    let degrees = |x: f64| (x * 1e9).round() / 1e9;
    [
        degrees(longitude),
        degrees(latitude),
        (height * 1e3).round() / 1e3 + 0.0,
    ]
}
