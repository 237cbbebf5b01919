//! What a city holds.

use std::path::Path;

use ombra_city::{City, Finding};
use serde::Serialize;

use super::{CityOptions, osm, read_named};
use crate::error::FormatError;
use crate::input::Input;

/// What a city holds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CityInfo {
    /// "GeoJSON", "CityJSON", "OpenStreetMap PBF" and so on.
    pub format: &'static str,
    /// How many buildings there are, those that were left out not counted.
    pub buildings: u64,
    /// Of how many parts they are made.
    pub parts: u64,
    /// How many triangles of terrain there are.
    pub terrain: u64,
    /// How many walls, roofs and other faces cast shadow, terrain included.
    pub facets: u64,
    /// Metres from west to east and from south to north.
    pub extent: [f32; 2],
    /// The name of the coordinate reference system.
    pub crs: String,
    /// Longitude and latitude, in degrees, of the place where local metres begin.
    pub origin: [f64; 2],
    /// Heights of buildings above their ground, metres, if there are any.
    pub heights: Option<HeightsInfo>,
    /// What its user should hear of.
    pub findings: Vec<Finding>,
}

/// Heights of buildings above their ground, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct HeightsInfo {
    /// Of the lowest.
    pub min: f32,
    /// Of the middle one.
    pub median: f32,
    /// Of the tallest.
    pub max: f32,
}

/// Whether a file begins as cities do: as JSON, as XML of OpenStreetMap or as its PBF. Other files
/// that are JSON (glTF) are to be told by their names before.
pub(crate) fn is_city(head: &[u8]) -> bool {
    let text = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head);
    let is_json = matches!(text.trim_ascii_start().first(), Some(b'{' | b'['));
    is_json || osm::File::recognised(head).is_some()
}

/// Reads what a city holds, with the options that stand for nothing said.
pub(crate) fn city_info(path: &Path) -> Result<CityInfo, FormatError> {
    let (format, city) = read_named(&Input::on_disk(path), &CityOptions::default())?;
    Ok(CityInfo::of(format, city))
}

impl CityInfo {
    fn of(format: &'static str, city: City) -> Self {
        let facets = city.facets();
        let nothing = [[f32::INFINITY; 2], [f32::NEG_INFINITY; 2]];
        let corners = facets.iter().flat_map(|facet| facet.corners);
        let [low, high] = corners.fold(nothing, |[low, high], p| {
            [
                [low[0].min(p.x), low[1].min(p.y)],
                [high[0].max(p.x), high[1].max(p.y)],
            ]
        });
        let height = |building: &ombra_city::Building| {
            let tops = building.parts.iter().map(|part| part.range()[1]);
            tops.fold(f32::NEG_INFINITY, f32::max) - building.ground
        };
        let mut heights: Vec<f32> = city.buildings.iter().map(height).collect();
        heights.sort_unstable_by(f32::total_cmp);
        Self {
            format,
            buildings: city.buildings.len() as u64,
            parts: city.buildings.iter().map(|b| b.parts.len() as u64).sum(),
            terrain: city.terrain.len() as u64,
            facets: facets.len() as u64,
            extent: [0, 1].map(|i| (high[i] - low[i]).max(0.0)),
            crs: city.origin.crs().name().to_owned(),
            origin: [city.origin.longitude(), city.origin.latitude()],
            heights: (heights.first().zip(heights.last())).map(|(&min, &max)| HeightsInfo {
                min,
                median: heights[heights.len() / 2],
                max,
            }),
            findings: city.findings,
        }
    }
}
