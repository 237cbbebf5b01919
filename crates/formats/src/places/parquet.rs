//! GeoParquet 1.1 (OGC): points as WKB.

use std::io::Write;
use std::path::Path;
use std::sync::Arc;

use parquet::basic::Compression;
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, FloatType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::parser::parse_message_type;
use serde_json::{Value, json};

use super::{PlaceRow, angles, rounded};
use crate::error::{Fault, FormatError, one_line};
use crate::whole::write_whole_with;

/// Rows that are written together; they are in memory at once.
const GROUP: usize = 1 << 16;

const SCHEMA: &str = "message places {
    required binary geometry;
    optional float minutes;
    required boolean inside;
    optional int64 building;
    optional binary building_id (STRING);
    optional binary surface (STRING);
    optional float azimuth;
    optional float tilt;
    optional binary id (STRING);
    optional binary properties (JSON);
";

/// And of a city that is changed.
const CHANGE: &str = "    optional float before;
    optional float after;
    optional float net;
";

/// Writes places as GeoParquet 1.1 in OGC:CRS84, packed with Snappy.
///
/// `metadata` are names and values that say how the numbers came about; they stand beside `geo` in the footer. The
/// file is put in its place when it is whole, and its bytes depend on the arguments alone.
///
/// # Errors
/// When the folder does not exist or cannot be written into.
pub fn write_places_parquet<'a>(
    path: impl AsRef<Path>,
    rows: impl IntoIterator<Item = PlaceRow<'a>>,
    metadata: &[(String, String)],
) -> Result<(), FormatError> {
    let path = path.as_ref();
    let mut fault = None;
    let written = write_whole_with(path, |file| {
        encode(file, rows.into_iter(), metadata).map_err(|error| match error {
            ParquetError::External(source) => match source.downcast::<std::io::Error>() {
                Ok(source) => *source,
                Err(source) => std::io::Error::other(source),
            },
            error => {
                fault = Some(error.to_string());
                std::io::Error::other(error)
            }
        })
    });
    match fault {
        Some(message) => {
            let (format, message) = ("GeoParquet", one_line(&message));
            Err(FormatError::file(Fault::Image { format, message }).in_file(path))
        }
        None => written,
    }
}

fn encode<'a>(
    file: &mut (dyn Write + Send),
    rows: impl Iterator<Item = PlaceRow<'a>>,
    metadata: &[(String, String)],
) -> Result<(), ParquetError> {
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by(concat!("ombra ", env!("CARGO_PKG_VERSION")).to_owned())
        .build();
    let mut rows = rows.peekable();
    let is_change = rows.peek().is_some_and(|row| row.change.is_some());
    let more = if is_change { CHANGE } else { "" };
    let schema = Arc::new(parse_message_type(&format!("{SCHEMA}{more}}}"))?);
    let mut writer = SerializedFileWriter::new(file, schema, Arc::new(properties))?;
    let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    loop {
        let group: Vec<PlaceRow<'_>> = rows.by_ref().take(GROUP).collect();
        if group.is_empty() {
            break;
        }
        for position in group.iter().map(|row| rounded(row.position)) {
            for axis in 0..3 {
                bounds[0][axis] = bounds[0][axis].min(position[axis]);
                bounds[1][axis] = bounds[1][axis].max(position[axis]);
            }
        }
        write_group(writer.next_row_group()?, &group, is_change)?;
    }
    for (name, value) in metadata {
        writer.append_key_value_metadata(KeyValue::new(name.clone(), value.clone()));
    }
    writer.append_key_value_metadata(KeyValue::new("geo".to_owned(), geo(bounds).to_string()));
    writer.close()?;
    Ok(())
}

/// What GeoParquet asks for. No `crs` says OGC:CRS84.
fn geo(bounds: [[f64; 3]; 2]) -> Value {
    let mut geometry = json!({"encoding": "WKB", "geometry_types": ["Point Z"]});
    if bounds[0][0] <= bounds[1][0] {
        geometry["bbox"] = json!(bounds.concat());
    }
    json!({"version": "1.1.0", "primary_column": "geometry", "columns": {"geometry": geometry}})
}

/// The columns in the order of the schema.
fn write_group<W: Write + Send>(
    mut group: SerializedRowGroupWriter<'_, W>,
    rows: &[PlaceRow<'_>],
    is_change: bool,
) -> Result<(), ParquetError> {
    let all = |of: &dyn Fn(&PlaceRow<'_>) -> ByteArray| rows.iter().map(of).collect::<Vec<_>>();
    let text = |text: &str| ByteArray::from(text.as_bytes().to_vec());
    column::<ByteArrayType, _>(&mut group, &all(&|row| point(row.position)), None)?;
    optional::<FloatType, _>(&mut group, rows, |row| row.minutes)?;
    let inside: Vec<bool> = rows.iter().map(|row| row.inside).collect();
    column::<BoolType, _>(&mut group, &inside, None)?;
    optional::<Int64Type, _>(&mut group, rows, |row| {
        row.building.map(|(number, _)| number.into())
    })?;
    optional::<ByteArrayType, _>(&mut group, rows, |row| row.building?.1.map(text))?;
    optional::<ByteArrayType, _>(&mut group, rows, |row| Some(text(row.surface?.0)))?;
    optional::<FloatType, _>(&mut group, rows, |row| {
        angles(row.surface?.1).0.map(|azimuth| azimuth as f32)
    })?;
    optional::<FloatType, _>(&mut group, rows, |row| {
        Some(angles(row.surface?.1).1 as f32)
    })?;
    optional::<ByteArrayType, _>(&mut group, rows, |row| row.id.map(text))?;
    optional::<ByteArrayType, _>(&mut group, rows, |row| {
        let properties = row.properties?;
        Some(text(&serde_json::to_string(properties).ok()?))
    })?;
    if is_change {
        optional::<FloatType, _>(&mut group, rows, |row| row.change?.before)?;
        optional::<FloatType, _>(&mut group, rows, |row| row.change?.after)?;
        optional::<FloatType, _>(&mut group, rows, |row| row.change?.net)?;
    }
    group.close()?;
    Ok(())
}

/// A column whose values may be absent.
fn optional<D: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    rows: &[PlaceRow<'_>],
    value: impl Fn(&PlaceRow<'_>) -> Option<D::T>,
) -> Result<(), ParquetError> {
    let values: Vec<Option<D::T>> = rows.iter().map(value).collect();
    let levels: Vec<i16> = values.iter().map(|value| value.is_some().into()).collect();
    let values: Vec<D::T> = values.into_iter().flatten().collect();
    column::<D, W>(group, &values, Some(&levels))
}

fn column<D: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &[D::T],
    levels: Option<&[i16]>,
) -> Result<(), ParquetError> {
    let missing = || ParquetError::General("fewer columns than the schema names".to_owned());
    let mut column = group.next_column()?.ok_or_else(missing)?;
    column.typed::<D>().write_batch(values, levels, None)?;
    column.close()
}

/// A point as well-known binary (OGC 06-103r4, ISO 13249-3): 1001 is a point with a z.
fn point(position: [f64; 3]) -> ByteArray {
    let mut bytes = Vec::with_capacity(29);
    bytes.push(1);
    bytes.extend_from_slice(&1001_u32.to_le_bytes());
    for x in rounded(position) {
        bytes.extend_from_slice(&x.to_le_bytes());
    }
    bytes.into()
}
