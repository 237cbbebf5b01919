//! From when to when places lie in shadow, as GeoParquet: out ([`write_spells`]) and in ([`SpellsFile`]).
//!
//! One row a place that was measured, in longitude and latitude (WGS 84). Its stretches of shadow are four lists of one length,
//! in order of time; a stretch ends where another building takes over, or where others begin or end to stand behind it.
//!
//! | column | type | what |
//! |---|---|---|
//! | `geometry` | point | longitude, latitude, and the height in metres of the city's own heights |
//! | `place` | whole number | which place: of a grid the cell, row by row from the north-west; else the row of the list of places |
//! | `begin`, `end` | lists of timestamps | when each stretch begins and ends, in milliseconds, UTC |
//! | `building` | list of whole numbers | the building that the ray toward the sun meets first: its place in the list `buildings` of the footer, −1 for other things that stand there, −2 for terrain |
//! | `alone` | list of booleans | whether nothing else stands behind it: without this one, the sun would shine |
//!
//! The footer holds, as JSON under `ombra_spells`, what a reader needs besides: see [`SpellsAbout`].

mod about;
mod chunks;
mod quietly;
mod read;
mod write;

#[cfg(test)]
mod tests;

use ombra_accrual::Stretches;

pub use about::SpellsAbout;
pub use read::SpellsFile;
pub use write::{SpellsWriter, write_spells};

/// The key of the footer.
const KEY: &str = "ombra_spells";

/// Names of the columns.
const COLUMNS: [&str; 6] = ["geometry", "place", "begin", "end", "building", "alone"];

const SCHEMA: &str = "message spells {
    required binary geometry;
    required int32 place;
    required group begin (LIST) { repeated group list { required int64 element (TIMESTAMP(MILLIS,true)); } }
    required group end (LIST) { repeated group list { required int64 element (TIMESTAMP(MILLIS,true)); } }
    required group building (LIST) { repeated group list { required int32 element; } }
    required group alone (LIST) { repeated group list { required boolean element; } }
}";

/// Some places and their stretches of shadow.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpellsGroup {
    /// Which places, see the column `place`.
    pub places: Vec<u32>,
    /// Where each is: longitude, latitude (WGS 84, degrees), metres of height.
    pub positions: Vec<[f64; 3]>,
    /// The stretches of each. In files their ends are rounded to milliseconds.
    pub stretches: Stretches,
}
