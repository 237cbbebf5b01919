//! Points of a table (RFC 4180, with the separators that spreadsheets write).

use csv::{ErrorKind, Position, Reader, ReaderBuilder, StringRecord};
use ombra_city::Crs;
use serde_json::{Map, Number, Value};

use super::{Point, PointFile, height_fault};
use crate::error::{Fault, FormatError, Place, quoted, shown};

/// Counts lines: the library's own count is one too low where a line ends in two characters.
struct Lines<'a> {
    text: &'a [u8],
    at: usize,
    line: u64,
}

impl<'a> Lines<'a> {
    fn of(text: &'a [u8]) -> Self {
        Self {
            text,
            at: 0,
            line: 1,
        }
    }

    /// The line of what comes at a place or, if that is the end of a line, after it: from 1. Places come in order.
    fn at(&mut self, place: Option<&Position>) -> u64 {
        let byte = place.map_or(0, |place| place.byte() as usize);
        while let Some(&b) = self.text.get(self.at) {
            if self.at >= byte && b != b'\r' && b != b'\n' {
                break;
            }
            self.line += u64::from(b == b'\n');
            self.at += 1;
        }
        self.line
    }
}

/// Where in a line things are.
struct Columns {
    names: Vec<String>,
    at: [usize; 2],
    is_geographic: bool,
    height: Option<usize>,
    id: Option<usize>,
}

pub(super) fn read(text: &[u8]) -> Result<PointFile, FormatError> {
    let first = text.split(|&b| b == b'\n').next().unwrap_or_default();
    let separator = [b'\t', b';', b',']
        .into_iter()
        .max_by_key(|separator| first.iter().filter(|b| *b == separator).count())
        .unwrap_or(b',');
    let mut reader = ReaderBuilder::new().delimiter(separator).from_reader(text);
    let columns = Columns::of(&mut reader)?;
    let mut points = Vec::new();
    let mut lines = Lines::of(text);
    for record in reader.records() {
        let record = record.map_err(|error| fault(&error, &mut lines))?;
        let line = lines.at(record.position());
        points.push(columns.point(&record, line)?);
    }
    Ok(PointFile {
        crs: columns.is_geographic.then(Crs::wgs84),
        points,
        findings: Vec::new(),
        counts: "line",
    })
}

impl Columns {
    fn of(reader: &mut Reader<&[u8]>) -> Result<Self, FormatError> {
        let names = reader
            .headers()
            .map_err(|error| fault(&error, &mut Lines::of(&[])))?;
        let names: Vec<String> = names.iter().map(|name| name.trim().to_owned()).collect();
        let find = |known: &[&str]| {
            let is_known = |name: &String| known.iter().any(|k| name.eq_ignore_ascii_case(k));
            names.iter().position(is_known)
        };
        for (index, name) in names.iter().enumerate() {
            if names[..index].contains(name) {
                let message = format!("column {:?} is there twice", shown(name));
                return Err(in_line(1, message));
            }
        }
        let geographic = find(&["lon", "lng", "longitude"]).zip(find(&["lat", "latitude"]));
        let projected = find(&["x"]).zip(find(&["y"]));
        let Some((x, y)) = geographic.or(projected) else {
            let message = format!(
                "its columns are {}; lon and lat, or x and y, are wanted",
                shown(&names.join(", "))
            );
            return Err(in_line(1, message));
        };
        Ok(Self {
            at: [x, y],
            is_geographic: geographic.is_some(),
            height: find(&["z"]),
            id: find(&["id"]),
            names,
        })
    }

    fn point(&self, record: &StringRecord, line: u64) -> Result<Point, FormatError> {
        let field = |index: usize| record.get(index).unwrap_or_default().trim();
        let number = |index: usize| {
            let text = field(index);
            let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
            number.ok_or_else(|| {
                let (name, text) = (shown(&self.names[index]), quoted(text.as_bytes()));
                in_line(line, format!("column {name}: {text} is no number"))
            })
        };
        let height = match self.height {
            Some(index) if !field(index).is_empty() => number(index)?,
            _ => 0.0,
        };
        if let Some(fault) = height_fault(height) {
            return Err(in_line(line, fault));
        }
        let mut properties = Map::new();
        for (index, name) in self.names.iter().enumerate() {
            let is_read = self.at.contains(&index) || [self.height, self.id].contains(&Some(index));
            if !is_read {
                properties.insert(name.clone(), value(field(index)));
            }
        }
        let id = self.id.map(|index| field(index).to_owned());
        Ok(Point {
            number: line,
            at: [number(self.at[0])?, number(self.at[1])?],
            height,
            id: id.filter(|id| !id.is_empty()),
            properties,
        })
    }
}

/// What looks like a number to JSON is one (007 does not), an empty field is nothing.
fn value(text: &str) -> Value {
    match serde_json::from_str::<Number>(text) {
        _ if text.is_empty() => Value::Null,
        Ok(number) => Value::Number(number),
        Err(_) => Value::String(text.to_owned()),
    }
}

fn in_line(line: u64, message: String) -> FormatError {
    let place = "table".to_owned();
    FormatError::new(Place::Line(line), Fault::InDocument { place, message })
}

fn fault(error: &csv::Error, lines: &mut Lines<'_>) -> FormatError {
    let line = lines.at(error.position());
    let message = match error.kind() {
        ErrorKind::UnequalLengths {
            expected_len, len, ..
        } => format!("{len} columns, where the first line names {expected_len}"),
        ErrorKind::Utf8 { .. } => "no text in UTF-8".to_owned(),
        _ => error.to_string(),
    };
    in_line(line, message)
}
