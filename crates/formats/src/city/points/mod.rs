//! Points at which something is measured.

mod json;
mod table;

use std::path::Path;

use ombra_city::{Crs, Finding, MAX_PLACES};
use serde_json::{Map, Value};

use super::wrong;
use crate::error::{Fault, FormatError};
use crate::input::Input;
use crate::limits::Limits;

/// What can be read, as messages have it.
const KNOWN: &str = "GeoJSON with points or CSV with a line of names";

/// Points as a file has them, in its order.
#[derive(Clone, Debug)]
pub struct PointFile {
    /// What the coordinates mean; `None` where they are those of the city (a table with x and y).
    pub crs: Option<Crs>,
    /// At least one.
    pub points: Vec<Point>,
    /// What in the file is no point, and was left out.
    pub findings: Vec<Finding>,
    /// What [`Point::number`] counts: "feature" or "line".
    pub counts: &'static str,
}

/// A point, and what its file says of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Which feature of the file, from 0, or which line, from 1.
    pub number: u64,
    /// In the coordinates of the map: finite.
    pub at: [f64; 2],
    /// Metres above the ground, 0 to 10 000.
    pub height: f64,
    /// Its name in the file, if it has one.
    pub id: Option<String>,
    /// What else the file says of it.
    pub properties: Map<String, Value>,
}

impl PointFile {
    /// Where in the file a point is, for messages: "feature 3", "line 7".
    #[must_use]
    pub fn place(&self, point: &Point) -> String {
        format!("{} {}", self.counts, point.number)
    }
}

/// Reads points, from GeoJSON or a table; which it is, the content says.
///
/// - GeoJSON: `Point`s and `MultiPoint`s, longitude and latitude, unless the `crs` member names another system. A
///   third number is the height above the ground in metres.
/// - A table (CSV) with commas, semicolons or tabs between its columns, whose first line names them: `lon` and
///   `lat` (or `longitude`, `latitude`, `lng`), or `x` and `y` in the coordinates of the city's file, and
///   `z`, the height above the ground, if there is one. A column `id` names the points. Capitals do not matter.
///
/// # Errors
/// When the file cannot be opened or is neither, when a coordinate is no number or a height is not 0 to 10 km, when
/// there is no point at all, or more than [`MAX_PLACES`].
pub fn read_points(path: impl AsRef<Path>, limits: &Limits) -> Result<PointFile, FormatError> {
    read(&Input::on_disk(path.as_ref()), limits)
}

/// The same for a file in memory. Its name is for messages only.
///
/// # Errors
/// As those of [`read_points`].
pub fn read_points_bytes(
    name: impl AsRef<Path>,
    bytes: &[u8],
    limits: &Limits,
) -> Result<PointFile, FormatError> {
    read(&Input::in_memory(name.as_ref(), bytes), limits)
}

fn read(input: &Input<'_>, limits: &Limits) -> Result<PointFile, FormatError> {
    let read = || of_bytes(&input.source(limits)?.rest()?);
    read().map_err(|error: FormatError| error.in_file(input.name()))
}

fn of_bytes(bytes: &[u8]) -> Result<PointFile, FormatError> {
    if bytes.is_empty() {
        return Err(FormatError::file(Fault::Empty));
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if is_binary(text) {
        return Err(FormatError::file(Fault::UnknownContent { known: KNOWN }));
    }
    let file = match text.trim_ascii_start().first() {
        Some(b'{' | b'[') => json::read(text)?,
        _ => table::read(text)?,
    };
    if file.points.is_empty() {
        let first = file
            .findings
            .first()
            .map_or(String::new(), |finding| format!(": {finding}"));
        return Err(wrong("points", format!("there is none{first}")));
    }
    if file.points.len() as u64 > MAX_PLACES {
        return Err(wrong("points", format!("more than {MAX_PLACES}")));
    }
    Ok(file)
}

/// Whether the first of it is no text, so that a table would have columns whose names nobody can read.
fn is_binary(bytes: &[u8]) -> bool {
    const LOOKED_AT: usize = 1024;
    let control = |b: &u8| b.is_ascii_control() && !b"\t\r\n".contains(b);
    bytes.iter().take(LOOKED_AT).any(control)
}

/// What is wrong with a height above the ground, if anything.
fn height_fault(height: f64) -> Option<String> {
    let is_right = (0.0..=10_000.0).contains(&height);
    (!is_right).then(|| format!("z is {height}; 0 to 10000 metres above the ground are wanted"))
}

#[cfg(test)]
mod tests;
