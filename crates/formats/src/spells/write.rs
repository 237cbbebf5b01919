//! Out.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ombra_accrual::Stretch;
use ombra_city::Facet;
use parquet::basic::{Compression, Encoding};
use parquet::data_type::{BoolType, ByteArrayType, Int32Type, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use parquet::schema::types::ColumnPath;

use super::about::milliseconds;
use super::{KEY, SCHEMA, SpellsAbout, SpellsGroup};
use crate::columns::{Bounds, Levels, column, point, write_columns, write_fault};
use crate::error::FormatError;

/// Writes groups of places, a few thousand or more each: each is packed by itself.
pub struct SpellsWriter<'a> {
    path: PathBuf,
    file: SerializedFileWriter<&'a mut (dyn Write + Send)>,
    bounds: Bounds,
}

/// Writes a file of spells: `groups` hands its groups to the writer, one after another, so that they need not be in memory at once.
/// `metadata` are names and values that say how it came about.
///
/// The file is put in its place when it is whole, and its bytes depend on what is written alone.
///
/// # Errors
/// When the folder does not exist or cannot be written into, and what `groups` fails with: then nothing is written.
pub fn write_spells<E: From<FormatError>>(
    path: impl AsRef<Path>,
    about: &SpellsAbout,
    metadata: &[(String, String)],
    groups: impl FnOnce(&mut SpellsWriter<'_>) -> Result<(), E>,
) -> Result<(), E> {
    let path = path.as_ref();
    let fault = |error| write_fault(error).in_file(path);
    write_columns(path, |file| {
        let mut writer = SpellsWriter::new(path, file).map_err(fault)?;
        groups(&mut writer)?;
        Ok(writer.close(about, metadata).map_err(fault)?)
    })
}

impl<'a> SpellsWriter<'a> {
    fn new(path: &Path, file: &'a mut (dyn Write + Send)) -> Result<Self, ParquetError> {
        let list =
            |name: &str| ColumnPath::from(vec![name.into(), "list".into(), "element".into()]);
        let mut properties = WriterProperties::builder()
            .set_compression(Compression::SNAPPY)
            .set_created_by(concat!("ombra ", env!("CARGO_PKG_VERSION")).to_owned());
        // Hardly any time is there twice, and what comes one after another is alike.
        for path in [list("begin"), list("end"), ColumnPath::from("place")] {
            properties = properties
                .set_column_dictionary_enabled(path.clone(), false)
                .set_column_encoding(path, Encoding::DELTA_BINARY_PACKED);
        }
        let geometry = ColumnPath::from("geometry");
        let properties = properties
            .set_column_dictionary_enabled(geometry.clone(), false)
            .set_column_encoding(geometry, Encoding::DELTA_BYTE_ARRAY);
        let schema = Arc::new(parse_message_type(SCHEMA)?);
        Ok(Self {
            path: path.to_owned(),
            file: SerializedFileWriter::new(file, schema, Arc::new(properties.build()))?,
            bounds: Bounds::default(),
        })
    }

    /// Writes a group.
    ///
    /// # Errors
    /// When the disk is full.
    ///
    /// # Panics
    /// If there are not as many positions and lists of stretches as places.
    pub fn write(&mut self, group: &SpellsGroup) -> Result<(), FormatError> {
        assert_eq!(
            group.positions.len(),
            group.places.len(),
            "as many positions"
        );
        assert_eq!(group.stretches.len(), group.places.len(), "as many lists");
        self.bounds.add(group.positions.iter().copied());
        let written = self.columns(group);
        written.map_err(|error| write_fault(error).in_file(&self.path))
    }

    fn columns(&mut self, group: &SpellsGroup) -> Result<(), ParquetError> {
        let mut columns = self.file.next_row_group()?;
        let points: Vec<_> = group.positions.iter().copied().map(point).collect();
        column::<ByteArrayType, _>(&mut columns, &points, Levels::NONE)?;
        let places: Vec<i32> = group.places.iter().map(|&place| place as i32).collect();
        column::<Int32Type, _>(&mut columns, &places, Levels::NONE)?;

        let (mut definition, mut repetition) = (Vec::new(), Vec::new());
        let mut all: Vec<Row> = Vec::new();
        for list in group.stretches.iter() {
            let before = all.len();
            all.extend(list.iter().map(Row::new).filter(|row| row.begin < row.end));
            let count = all.len() - before;
            // An empty list has no element, and only the first of a list begins a row.
            definition.extend((0..count.max(1)).map(|_| i16::from(count > 0)));
            repetition.extend((0..count.max(1)).map(|k| i16::from(k > 0)));
        }
        let levels = Levels {
            definition: Some(&definition),
            repetition: Some(&repetition),
        };
        let begins: Vec<i64> = all.iter().map(|row| row.begin).collect();
        column::<Int64Type, _>(&mut columns, &begins, levels)?;
        let ends: Vec<i64> = all.iter().map(|row| row.end).collect();
        column::<Int64Type, _>(&mut columns, &ends, levels)?;
        let buildings: Vec<i32> = all.iter().map(|row| row.building).collect();
        column::<Int32Type, _>(&mut columns, &buildings, levels)?;
        let alone: Vec<bool> = all.iter().map(|row| row.is_alone).collect();
        column::<BoolType, _>(&mut columns, &alone, levels)?;
        columns.close()?;
        Ok(())
    }

    fn close(
        mut self,
        about: &SpellsAbout,
        metadata: &[(String, String)],
    ) -> Result<(), ParquetError> {
        for (name, value) in metadata {
            let pair = KeyValue::new(name.clone(), value.clone());
            self.file.append_key_value_metadata(pair);
        }
        let about = serde_json::to_string(about)
            .map_err(|error| ParquetError::General(error.to_string()))?;
        self.file
            .append_key_value_metadata(KeyValue::new(KEY.to_owned(), about));
        self.file.append_key_value_metadata(self.bounds.geo());
        self.file.close()?;
        Ok(())
    }
}

/// A stretch as it is written. One shorter than half a millisecond may have no length.
struct Row {
    begin: i64,
    end: i64,
    building: i32,
    is_alone: bool,
}

impl Row {
    fn new(stretch: &Stretch) -> Self {
        Self {
            begin: milliseconds(stretch.from),
            end: milliseconds(stretch.to),
            building: number(stretch.owner),
            is_alone: stretch.is_alone,
        }
    }
}

/// A building by its number, and what is none below 0.
fn number(owner: u32) -> i32 {
    match owner {
        Facet::CONTEXT => -1,
        Facet::TERRAIN => -2,
        // No city has as many buildings.
        number => number as i32,
    }
}
