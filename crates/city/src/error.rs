//! Why there is no city.

use crate::finding::Finding;

/// What keeps a city from being placed on the ground.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CityError {
    /// A reference system that cannot be understood.
    #[error(
        "coordinate reference system {name:?} is not known ({reason}); an EPSG code such as \
         EPSG:25832, OGC:CRS84, a PROJ string or WKT is expected"
    )]
    UnknownCrs {
        /// As it was given, shortened.
        name: String,
        /// Why not.
        reason: String,
    },
    /// Coordinates that do not belong to the reference system.
    #[error(
        "coordinates {x}, {y} lie outside of {crs}; name the right coordinate reference system"
    )]
    OutsideCrs {
        /// First coordinate.
        x: f64,
        /// Second coordinate.
        y: f64,
        /// The system's name.
        crs: String,
    },
    /// No building and no terrain.
    #[error("no building that could be placed{}", reasons(.findings))]
    NothingThere {
        /// Why not.
        findings: Vec<Finding>,
    },
    /// Heights that are no surface.
    #[error("{what}")]
    HeightField {
        /// What is wrong, and what would be right.
        what: String,
    },
    /// More pixels of heights within reach of the places than can be made into a surface.
    #[error(
        "{width} x {height} pixels lie within reach of the places, over the limit of {} \
         (4096 x 4096): cut the file, make its pixels larger, or ask for a smaller area and a higher \
         sun, which needs less around it",
        crate::height_field::MOST_PIXELS
    )]
    ManyPixels {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// Heights that do not lie where they are asked for.
    #[error(
        "no height lies within reach of the places; the pixels lie {distance_km:.0} km away, if their \
         coordinates are those of {crs}"
    )]
    HeightsElsewhere {
        /// From the middle of the city to that of the heights, kilometres; NaN if that is nowhere.
        distance_km: f64,
        /// The reference system of the heights.
        crs: String,
    },
    /// An added model that stands nowhere near the city.
    #[error(
        "the origin of the model, {x}, {y}, does not lie within 60 km of the city; its coordinates are \
         those of {crs}"
    )]
    ModelElsewhere {
        /// First coordinate.
        x: f64,
        /// Second coordinate.
        y: f64,
        /// The reference system of the city.
        crs: String,
    },
    /// An added model that is to stand on the ground where there is none.
    #[error(
        "there is no ground at the origin of the model, {x}, {y}, beside the heights or in a hole of them: give its \
         height as well (--context-origin E,N,H)"
    )]
    ModelWithoutGround {
        /// First coordinate.
        x: f64,
        /// Second coordinate.
        y: f64,
    },
    /// More than can be numbered.
    #[error("more than {limit} {what}")]
    TooMany {
        /// "buildings".
        what: &'static str,
        /// The most there can be.
        limit: u64,
    },
}

/// The first few findings on one line.
fn reasons(findings: &[Finding]) -> String {
    const SHOWN: usize = 4;
    let mut text = String::new();
    for (i, finding) in findings.iter().take(SHOWN).enumerate() {
        text += if i == 0 { ": " } else { "; " };
        text += &finding.to_string();
    }
    if findings.len() > SHOWN {
        text += "; and more";
    }
    text
}
