//! What stands in a city: buildings in local metres, and where they are on the map.
//!
//! A reader of files fills a [`Draft`] with outlines and faces in the coordinates of a map
//! ([`Crs`]); [`Draft::finish`] repairs what is broken, finds an [`Origin`] and gives a [`City`] in
//! local metres. [`City::facets`] are what casts shadow, and [`Inside`] tells which places lie in a
//! building.
//!
//! ```
//! use ombra_city::{Crs, Draft, DraftBuilding, DraftPart, Inside};
//! use ombra_geometry::Point3;
//!
//! let mut draft = Draft::new(Crs::from_epsg(32633)?);
//! let ring = vec![[390000.0, 5820000.0], [390010.0, 5820000.0], [390010.0, 5820010.0]];
//! draft.buildings.push(DraftBuilding {
//!     place: "feature 0".to_owned(),
//!     parts: vec![DraftPart::Footprint { rings: vec![ring], base: 0.0, top: 12.0 }],
//!     ..DraftBuilding::default()
//! });
//! let city = draft.finish()?;
//! assert_eq!(city.facets().len(), 4, "three walls and a roof");
//! let [x, y] = city.origin.to_local([390007.0, 5820003.0]);
//! let inside = Inside::new(&city);
//! assert!(inside.contains(Point3::new(x as f32, y as f32, 11.9)));
//! assert!(!inside.contains(Point3::new(x as f32, y as f32, 12.0)));
//! # Ok::<(), ombra_city::CityError>(())
//! ```
//!
//! # Units
//! Local coordinates are metres on the ground, in single precision: x east, y north, z up, about
//! the city's [`Origin`]. What is still in the coordinates of a map is in double precision.

pub mod heights;

mod around;
mod building;
mod city;
mod context;
mod crs;
mod draft;
mod edit;
mod error;
mod extent;
mod facet;
mod finding;
mod height_field;
mod inside;
mod join;
mod origin;
mod parts;
mod polygon;
mod procedural;
mod receiver;
mod repair;
mod stand;
mod surface_model;
mod triangulate;
mod united;

pub use around::line_around;
pub use building::{Building, Face, Faces, Part, Prism, Surface};
pub use city::City;
pub use context::Base;
pub use crs::Crs;
pub use draft::{Draft, DraftBuilding, DraftFace, DraftPart};
pub use edit::{Change, EditError, Edited, Edits};
pub use error::CityError;
pub use extent::Extent;
pub use facet::Facet;
pub use finding::{Finding, Notes};
pub use height_field::{HeightField, MOST_PIXELS};
pub use inside::Inside;
pub use origin::Origin;
pub use polygon::Polygon;
pub use procedural::{demo_city, procedural_city};
pub use receiver::{
    FaceChart, FaceKind, FacePlace, Grid, GridError, MAX_CELLS, MAX_PLACES, STAND_OFF, StudyArea,
    StudyError,
};
pub use united::{area_of, united};
