//! GeoParquet 1.1 (OGC): points as WKB.

use std::io::Write;
use std::path::Path;
use std::sync::Arc;

use parquet::basic::Compression;
use parquet::data_type::{
    BoolType, ByteArray, ByteArrayType, DataType, FloatType, Int32Type, Int64Type,
};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::parser::parse_message_type;

use super::{PlaceRow, PlaceShare, angles};
use crate::columns::{Bounds, Levels, column, point, write_columns, write_fault};
use crate::error::FormatError;

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

/// And where it was asked whose shadow it is.
const BY: &str = "    required group by (LIST) { repeated group list { required group element {
        optional int32 building;
        optional binary building_id (STRING);
        required float minutes;
        required float alone;
    } } }
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
    write_columns(path, |file| {
        let encoded = encode(file, rows.into_iter(), metadata);
        encoded.map_err(|error| write_fault(error).in_file(path))
    })
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
    let is_by = rows.peek().is_some_and(|row| row.by.is_some());
    let change = if is_change { CHANGE } else { "" };
    let by = if is_by { BY } else { "" };
    let schema = Arc::new(parse_message_type(&format!("{SCHEMA}{change}{by}}}"))?);
    let mut writer = SerializedFileWriter::new(file, schema, Arc::new(properties))?;
    let mut bounds = Bounds::default();
    loop {
        let group: Vec<PlaceRow<'_>> = rows.by_ref().take(GROUP).collect();
        if group.is_empty() {
            break;
        }
        bounds.add(group.iter().map(|row| row.position));
        write_group(writer.next_row_group()?, &group, is_change, is_by)?;
    }
    for (name, value) in metadata {
        writer.append_key_value_metadata(KeyValue::new(name.clone(), value.clone()));
    }
    writer.append_key_value_metadata(bounds.geo());
    writer.close()?;
    Ok(())
}

/// The columns in the order of the schema.
fn write_group<W: Write + Send>(
    mut group: SerializedRowGroupWriter<'_, W>,
    rows: &[PlaceRow<'_>],
    is_change: bool,
    is_by: bool,
) -> Result<(), ParquetError> {
    let all = |of: &dyn Fn(&PlaceRow<'_>) -> ByteArray| rows.iter().map(of).collect::<Vec<_>>();
    let text = |text: &str| ByteArray::from(text.as_bytes().to_vec());
    column::<ByteArrayType, _>(&mut group, &all(&|row| point(row.position)), Levels::NONE)?;
    optional::<FloatType, _>(&mut group, rows, |row| row.minutes)?;
    let inside: Vec<bool> = rows.iter().map(|row| row.inside).collect();
    column::<BoolType, _>(&mut group, &inside, Levels::NONE)?;
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
    if is_by {
        write_shares(&mut group, rows)?;
    }
    group.close()?;
    Ok(())
}

/// The four columns of the list of buildings.
fn write_shares<W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    rows: &[PlaceRow<'_>],
) -> Result<(), ParquetError> {
    let lists = || rows.iter().map(|row| row.by.unwrap_or_default());
    // An empty list has no element, and only the first of a list begins a row.
    let (mut repetition, mut is_there) = (Vec::new(), Vec::new());
    for list in lists() {
        repetition.extend((0..list.len().max(1)).map(|k| i16::from(k > 0)));
        is_there.extend((0..list.len().max(1)).map(|_| i16::from(!list.is_empty())));
    }
    let all: Vec<&PlaceShare<'_>> = lists().flatten().collect();
    let of = |is_known: &dyn Fn(&PlaceShare<'_>) -> bool| -> Vec<i16> {
        let mut each = all.iter();
        let level = |&is_there: &i16| match is_there {
            0 => 0,
            _ => 1 + i16::from(each.next().is_some_and(|share| is_known(share))),
        };
        is_there.iter().map(level).collect()
    };
    let levels = |definition| Levels {
        definition: Some(definition),
        repetition: Some(&repetition),
    };
    let numbers = all.iter().filter_map(|share| share.building);
    let numbers: Vec<i32> = numbers.map(|number| number as i32).collect();
    let known = of(&|share| share.building.is_some());
    column::<Int32Type, W>(group, &numbers, levels(&known))?;
    let names = all.iter().filter_map(|share| share.building_id);
    let names: Vec<ByteArray> = names.map(|name| name.as_bytes().to_vec().into()).collect();
    let known = of(&|share| share.building_id.is_some());
    column::<ByteArrayType, W>(group, &names, levels(&known))?;
    let minutes: Vec<f32> = all.iter().map(|share| share.minutes).collect();
    column::<FloatType, W>(group, &minutes, levels(&is_there))?;
    let alone: Vec<f32> = all.iter().map(|share| share.alone).collect();
    column::<FloatType, W>(group, &alone, levels(&is_there))
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
    let levels = Levels {
        definition: Some(&levels),
        repetition: None,
    };
    column::<D, W>(group, &values, levels)
}
