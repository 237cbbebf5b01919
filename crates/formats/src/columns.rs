//! What all GeoParquet files (OGC, 1.1) share: how columns are written, and points as WKB.

use std::io::Write;
use std::path::Path;

use parquet::data_type::{ByteArray, DataType};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::writer::SerializedRowGroupWriter;
use serde_json::json;

use crate::error::{Fault, FormatError, one_line};
use crate::image::write_error;
use crate::places::rounded;
use crate::whole::write_whole_with;

/// Writes a file beside its place and renames it when it is whole; what `encode` fails with is the error then.
pub(crate) fn write_columns<E: From<FormatError>>(
    path: &Path,
    encode: impl FnOnce(&mut (dyn Write + Send)) -> Result<(), E>,
) -> Result<(), E> {
    let mut failed = None;
    let written = write_whole_with(path, |file| {
        encode(file).map_err(|error| {
            failed = Some(error);
            std::io::Error::other("not encoded")
        })
    });
    match failed {
        Some(error) => Err(error),
        None => Ok(written?),
    }
}

/// What went wrong while a file was written.
pub(crate) fn write_fault(error: ParquetError) -> FormatError {
    match error {
        ParquetError::External(source) => match source.downcast::<std::io::Error>() {
            Ok(source) => write_error(*source),
            Err(source) => wrong(&source.to_string()),
        },
        error => wrong(&error.to_string()),
    }
}

/// What the library says is wrong with a file.
pub(crate) fn wrong(message: &str) -> FormatError {
    let (format, message) = ("GeoParquet", one_line(message));
    FormatError::file(Fault::Image { format, message })
}

/// Which values there are, and which belong together.
#[derive(Clone, Copy)]
pub(crate) struct Levels<'a> {
    pub(crate) definition: Option<&'a [i16]>,
    pub(crate) repetition: Option<&'a [i16]>,
}

impl Levels<'_> {
    /// One value a row.
    pub(crate) const NONE: Self = Levels {
        definition: None,
        repetition: None,
    };
}

/// The next column.
pub(crate) fn column<D: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &[D::T],
    levels: Levels<'_>,
) -> Result<(), ParquetError> {
    let missing = || ParquetError::General("fewer columns than the schema names".to_owned());
    let mut column = group.next_column()?.ok_or_else(missing)?;
    let writer = column.typed::<D>();
    writer.write_batch(values, levels.definition, levels.repetition)?;
    column.close()
}

/// The box around points: lowest and highest longitude, latitude and height.
pub(crate) struct Bounds([[f64; 3]; 2]);

impl Default for Bounds {
    fn default() -> Self {
        Self([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]])
    }
}

impl Bounds {
    pub(crate) fn add(&mut self, positions: impl IntoIterator<Item = [f64; 3]>) {
        let [low, high] = &mut self.0;
        for position in positions.into_iter().map(rounded) {
            for axis in 0..3 {
                low[axis] = low[axis].min(position[axis]);
                high[axis] = high[axis].max(position[axis]);
            }
        }
    }

    /// What GeoParquet asks for beside points in `geometry`. No `crs` says OGC:CRS84.
    pub(crate) fn geo(&self) -> KeyValue {
        let mut geometry = json!({"encoding": "WKB", "geometry_types": ["Point Z"]});
        if self.0[0][0] <= self.0[1][0] {
            geometry["bbox"] = json!(self.0.concat());
        }
        let geo = json!({
            "version": "1.1.0",
            "primary_column": "geometry",
            "columns": {"geometry": geometry}
        });
        KeyValue::new("geo".to_owned(), geo.to_string())
    }
}

/// A point as well-known binary (OGC 06-103r4, ISO 13249-3): 1001 is a point with a z.
pub(crate) fn point(position: [f64; 3]) -> ByteArray {
    let mut bytes = Vec::with_capacity(29);
    bytes.push(1);
    bytes.extend_from_slice(&1001_u32.to_le_bytes());
    for x in rounded(position) {
        bytes.extend_from_slice(&x.to_le_bytes());
    }
    bytes.into()
}
