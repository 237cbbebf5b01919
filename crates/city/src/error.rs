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
