//! Cities: buildings with heights, out of the files that planners have.
//!
//! - **GeoJSON** (RFC 7946): a `FeatureCollection`, a `Feature` or a bare geometry. `Polygon`s and
//!   `MultiPolygon`s, in collections, too, are outlines of buildings; heights are attributes
//!   ([`ombra_city::heights`]). The third number of a position is the z of the ground. Coordinates
//!   are longitude and latitude, unless the `crs` member of older files names another system.
//! - **A list of polygons**, as the examples of deck.gl have it:
//!   `[{"height": 30, "polygon": [[lon, lat], …]}, …]`.
//! - **CityJSON** 1.0, 1.1 and 2.0: buildings and their parts in the highest level of detail up to
//!   3, and terrain (`TINRelief`). Other objects cast no shadow and are counted. The same as a
//!   sequence (CityJSONSeq), a feature a line.
//! - **OpenStreetMap** XML (`.osm`) and PBF (`.osm.pbf`): closed ways and multipolygons tagged
//!   `building` or `building:part`. Parts stand in place of the outline that they lie in.
//! - **GeoTIFF**: a surface model ([`crate::elevation`]), of which all is ground, roofs as
//!   well; with terrain below it see [`City::of_surface`].
//!
//! Which of them a file is, its content says and not its name; each may be packed with gzip.
//!
//! ```no_run
//! use ombra_formats::city::{CityOptions, read_city};
//!
//! let city = read_city("city.geojson", &CityOptions::default())?;
//! for finding in &city.findings {
//!     eprintln!("note: {finding}");
//! }
//! println!("{} buildings", city.buildings.len());
//! # Ok::<(), ombra_formats::FormatError>(())
//! ```

mod area;
mod cityjson;
mod footprint;
mod geojson;
mod info;
mod json;
mod model;
mod osm;
mod points;
mod polygon_list;
#[cfg(test)]
pub(crate) mod tests;

use std::path::Path;

use ombra_city::heights::Heights;
use ombra_city::{City, CityError, Crs, Draft, Extent, Origin};

use crate::elevation;
use crate::error::{Fault, FormatError};
use crate::input::Input;
use crate::limits::Limits;
pub use area::{AreaFile, NamedArea, read_area, read_area_bytes};
pub use info::{CityInfo, HeightsInfo};
pub(crate) use info::{city_info, is_city};
use json::Kind;
pub use model::{CityModel, Up, read_city_model};
pub use points::{Point, PointFile, read_points, read_points_bytes};

/// What can be read, as messages have it.
const KNOWN: &str =
    "GeoJSON, CityJSON, OpenStreetMap (XML and PBF), lists of polygons and heights as GeoTIFF";

/// How a city is to be read.
#[derive(Clone, Debug, Default)]
pub struct CityOptions {
    /// What the coordinates mean, whatever the file says. Needed where it says nothing and is no
    /// GeoJSON.
    pub crs: Option<Crs>,
    /// How heights of outlines are told.
    pub heights: Heights,
    /// How much the reader may take on.
    pub limits: Limits,
}

/// Reads a city; what its file is, its content says.
///
/// What is wrong with single buildings is in [`City::findings`].
///
/// # Errors
/// When the file cannot be opened, is of no known kind or not well-formed, when its coordinates do
/// not belong to their reference system, and when there is neither a building nor terrain in it.
pub fn read_city(path: impl AsRef<Path>, options: &CityOptions) -> Result<City, FormatError> {
    read(&Input::on_disk(path.as_ref()), options)
}

/// The same for a file in memory. Its name is for messages only.
///
/// # Errors
/// As those of [`read_city`].
pub fn read_city_bytes(
    name: impl AsRef<Path>,
    bytes: &[u8],
    options: &CityOptions,
) -> Result<City, FormatError> {
    read(&Input::in_memory(name.as_ref(), bytes), options)
}

/// Reads a city into the local metres of another one, so that its buildings can be [added](ombra_city::Edits) to that.
///
/// # Errors
/// As those of [`read_city`]; and for a surface model, which has no buildings.
pub fn read_city_about(
    path: impl AsRef<Path>,
    options: &CityOptions,
    origin: &Origin,
) -> Result<City, FormatError> {
    let input = Input::on_disk(path.as_ref());
    let read = || {
        let bytes = input.source(&options.limits)?.rest()?;
        if bytes.is_empty() {
            return Err(FormatError::file(Fault::Empty));
        }
        if elevation::is_tiff(&bytes) {
            let message =
                "a surface model has no buildings to be added; outlines with heights are wanted";
            return Err(wrong("GeoTIFF", message));
        }
        let draft = Format::of(&bytes)?.read(options)?;
        draft.finish_about(origin).map_err(unplaceable)
    };
    read().map_err(|error| error.in_file(input.name()))
}

fn read(input: &Input<'_>, options: &CityOptions) -> Result<City, FormatError> {
    read_named(input, options).map(|(_, city)| city)
}

/// A city and the name of its format.
fn read_named(
    input: &Input<'_>,
    options: &CityOptions,
) -> Result<(&'static str, City), FormatError> {
    let read = || {
        let bytes = input.source(&options.limits)?.rest()?;
        if bytes.is_empty() {
            return Err(FormatError::file(Fault::Empty));
        }
        if elevation::is_tiff(&bytes) {
            return of_surface(&bytes, options).map(|city| ("GeoTIFF", city));
        }
        let format = Format::of(&bytes)?;
        let city = format.read(options)?.finish().map_err(unplaceable)?;
        Ok((format.name(), city))
    };
    read().map_err(|error| error.in_file(input.name()))
}

fn of_surface(bytes: &[u8], options: &CityOptions) -> Result<City, FormatError> {
    let surface = elevation::parse(bytes, options.crs.as_ref(), &options.limits)?;
    let city = City::of_surface(&surface.field, None, Extent::EVERYWHERE).map_err(unplaceable)?;
    let findings = surface.findings.into_iter().chain(city.findings).collect();
    Ok(City { findings, ..city })
}

/// What a file is, by its content.
enum Format<'a> {
    Json(Kind, &'a [u8]),
    Osm(osm::File<'a>),
}

impl<'a> Format<'a> {
    fn of(bytes: &'a [u8]) -> Result<Self, FormatError> {
        if let Some(file) = osm::File::recognised(bytes) {
            return Ok(Self::Osm(file));
        }
        // Some editors put a byte order mark before the text.
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        match json::kind(text)? {
            Kind::Unknown => Err(FormatError::file(Fault::UnknownContent { known: KNOWN })),
            kind => Ok(Self::Json(kind, text)),
        }
    }

    fn name(&self) -> &'static str {
        match self {
            Self::Json(Kind::List, _) => "list of polygons",
            Self::Json(Kind::GeoJson(_), _) => "GeoJSON",
            Self::Json(Kind::CityJsonSeq, _) => "CityJSONSeq",
            Self::Json(Kind::CityJson | Kind::Unknown, _) => "CityJSON",
            Self::Osm(osm::File::Xml(_)) => "OpenStreetMap XML",
            Self::Osm(osm::File::Pbf(_)) => "OpenStreetMap PBF",
        }
    }

    fn read(&self, options: &CityOptions) -> Result<Draft, FormatError> {
        match self {
            Self::Json(Kind::List, text) => polygon_list::read(text, options),
            Self::Json(Kind::GeoJson(kind), text) => geojson::read(text, kind, options),
            Self::Json(Kind::CityJson | Kind::CityJsonSeq | Kind::Unknown, text) => {
                cityjson::read(text, options)
            }
            Self::Osm(file) => osm::read(*file, options),
        }
    }
}

fn unplaceable(error: CityError) -> FormatError {
    FormatError::file(Fault::City(error))
}

fn wrong(place: impl Into<String>, message: impl Into<String>) -> FormatError {
    FormatError::file(Fault::InDocument {
        place: place.into(),
        message: message.into(),
    })
}
