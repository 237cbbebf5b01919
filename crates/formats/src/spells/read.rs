//! In.

use std::fs::File;
use std::path::{Path, PathBuf};

use ombra_accrual::Stretch;
use ombra_city::Facet;
use parquet::basic::Type;
use parquet::column::reader::get_typed_column_reader;
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, Int32Type, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};

use super::about::instant;
use super::chunks::Chunks;
use super::quietly::quietly;
use super::{COLUMNS, KEY, SpellsAbout, SpellsGroup};
use crate::columns::wrong;
use crate::error::{Fault, FormatError};

/// Values are read so many at a time, whatever a file says how many there are.
const BATCH: usize = 1 << 16;

/// A file of spells that is open.
pub struct SpellsFile {
    path: PathBuf,
    file: SerializedFileReader<Chunks>,
    about: SpellsAbout,
}

impl SpellsFile {
    /// Opens a file and reads its footer.
    ///
    /// # Errors
    /// When there is no such file, when it is not GeoParquet, or holds no spells.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, FormatError> {
        let path = path.as_ref();
        let open = || {
            let action = "be opened";
            let file = File::open(path)
                .map_err(|source| FormatError::file(Fault::Io { action, source }))?;
            let chunks = Chunks::new(file)
                .map_err(|source| FormatError::file(Fault::Io { action, source }))?;
            let file = SerializedFileReader::new(chunks)
                .map_err(|error| wrong(&format!("{error}; {WRITES}")))?;
            let about = about(&file)?;
            Ok((file, about))
        };
        let opened = quietly(open).map_err(|error: FormatError| error.in_file(path));
        let (file, about) = opened?;
        Ok(Self {
            path: path.to_owned(),
            file,
            about,
        })
    }

    /// What all places share.
    #[must_use]
    pub const fn about(&self) -> &SpellsAbout {
        &self.about
    }

    /// The names and values that say how it came about.
    #[must_use]
    pub fn metadata(&self) -> Vec<(String, String)> {
        let all = self.file.metadata().file_metadata().key_value_metadata();
        (all.into_iter().flatten())
            .filter(|pair| pair.key != KEY && pair.key != "geo" && pair.key != "ARROW:schema")
            .filter_map(|pair| Some((pair.key.clone(), pair.value.clone()?)))
            .collect()
    }

    /// How many groups of places there are.
    #[must_use]
    pub fn groups(&self) -> usize {
        self.file.num_row_groups()
    }

    /// Reads one of the groups; several threads may.
    ///
    /// # Errors
    /// When it is broken, or what it holds is no list of stretches.
    ///
    /// # Panics
    /// If there are not as many.
    pub fn read(&self, group: usize) -> Result<SpellsGroup, FormatError> {
        let read = || {
            let columns = self.file.get_row_group(group).map_err(broken)?;
            read_group(&*columns, &self.about)
        };
        quietly(read).map_err(|error: FormatError| error.in_file(&self.path))
    }
}

fn broken(error: ParquetError) -> FormatError {
    wrong(&error.to_string())
}

const WRITES: &str = "a file that `ombra shadows CITY --spells OUT.parquet` wrote is wanted";

fn about(file: &SerializedFileReader<Chunks>) -> Result<SpellsAbout, FormatError> {
    let metadata = file.metadata().file_metadata();
    let columns = metadata.schema_descr().columns();
    let types = [
        Type::BYTE_ARRAY,
        Type::INT32,
        Type::INT64,
        Type::INT64,
        Type::INT32,
        Type::BOOLEAN,
    ];
    let is_there = |(index, name): (usize, &&str)| {
        columns.get(index).is_some_and(|column| {
            let levels = i16::from(index > 1);
            column.path().parts()[0] == **name
                && column.physical_type() == types[index]
                && column.max_def_level() == levels
                && column.max_rep_level() == levels
        })
    };
    if let Some((_, name)) = COLUMNS.iter().enumerate().find(|&own| !is_there(own)) {
        return Err(wrong(&format!(
            "there is no column {name:?} as spells have it; {WRITES}"
        )));
    }
    let pairs = metadata.key_value_metadata().into_iter().flatten();
    let own = pairs
        .filter(|pair| pair.key == KEY)
        .find_map(|pair| pair.value.as_ref());
    let Some(own) = own else {
        return Err(wrong(&format!("its footer has no {KEY:?}; {WRITES}")));
    };
    let about: SpellsAbout =
        serde_json::from_str(own).map_err(|error| wrong(&format!("{KEY}: {error}; {WRITES}")))?;
    match about.fault() {
        Some(fault) => Err(wrong(&format!("{KEY}: it {fault}; {WRITES}"))),
        None => Ok(about),
    }
}

/// The values of one column, and how long each list is.
fn column<D: DataType>(
    columns: &dyn RowGroupReader,
    index: usize,
) -> Result<(Vec<D::T>, Vec<usize>), FormatError> {
    let reader = columns.get_column_reader(index).map_err(broken)?;
    let mut reader = get_typed_column_reader::<D>(reader);
    let (mut values, mut definition, mut repetition) = (Vec::new(), Vec::new(), Vec::new());
    let is_list = index > 1;
    loop {
        let definition = is_list.then_some(&mut definition);
        let repetition = is_list.then_some(&mut repetition);
        let read = reader.read_records(BATCH, definition, repetition, &mut values);
        let (records, ..) = read.map_err(broken)?;
        if records == 0 {
            break;
        }
    }
    let mut lengths: Vec<usize> = Vec::new();
    for (is_there, is_more) in definition.into_iter().zip(repetition) {
        if is_more == 0 {
            lengths.push(0);
        }
        match lengths.last_mut() {
            Some(last) => *last += usize::from(is_there == 1),
            None => return Err(wrong("a list goes on that has not begun")),
        }
    }
    Ok((values, lengths))
}

fn read_group(
    columns: &dyn RowGroupReader,
    about: &SpellsAbout,
) -> Result<SpellsGroup, FormatError> {
    let (points, _) = column::<ByteArrayType>(columns, 0)?;
    let (places, _) = column::<Int32Type>(columns, 1)?;
    let (begins, lengths) = column::<Int64Type>(columns, 2)?;
    let (ends, other) = column::<Int64Type>(columns, 3)?;
    let (buildings, third) = column::<Int32Type>(columns, 4)?;
    let (alone, fourth) = column::<BoolType>(columns, 5)?;
    let is_even = points.len() == places.len() && lengths.len() == places.len();
    if !is_even || [other, third, fourth].iter().any(|own| *own != lengths) {
        return Err(wrong("its columns are not of one length"));
    }
    let cells = about.grid().map(|grid| grid.count());
    let mut group = SpellsGroup {
        positions: points.iter().map(position).collect::<Result<_, _>>()?,
        ..SpellsGroup::default()
    };
    let times = begins.iter().zip(&ends);
    let mut all = times.zip(buildings.iter().zip(&alone));
    for (&place, &length) in places.iter().zip(&lengths) {
        let number = u32::try_from(place).ok();
        let number = number.filter(|&own| cells.is_none_or(|cells| (own as usize) < cells));
        let number = number.ok_or_else(|| wrong(&format!("place {place} is not in its grid")))?;
        let mut stretches: Vec<Stretch> = Vec::with_capacity(length);
        for ((&begin, &end), (&building, &is_alone)) in all.by_ref().take(length) {
            let before = stretches.last().map(|last| last.to);
            let stretch = Stretch {
                from: instant(begin),
                to: instant(end),
                owner: owner(building, about.buildings.len()).ok_or_else(|| {
                    wrong(&format!(
                        "place {place}: building {building}, of which there is none"
                    ))
                })?,
                is_alone,
            };
            if begin >= end || before.is_some_and(|before| stretch.from < before) {
                return Err(wrong(&format!(
                    "place {place}: a stretch from {begin} to {end} ms, which is not in order"
                )));
            }
            stretches.push(stretch);
        }
        group.places.push(number);
        group.stretches.push(stretches);
    }
    Ok(group)
}

/// The opposite of what is written.
fn owner(building: i32, buildings: usize) -> Option<u32> {
    match building {
        -1 => Some(Facet::CONTEXT),
        -2 => Some(Facet::TERRAIN),
        _ => u32::try_from(building)
            .ok()
            .filter(|&own| (own as usize) < buildings),
    }
}

/// Out of a point with a z as well-known binary.
fn position(bytes: &ByteArray) -> Result<[f64; 3], FormatError> {
    let wanted = || wrong("a geometry is no point with a height (WKB, type 1001)");
    let bytes: &[u8; 29] = bytes.data().try_into().map_err(|_| wanted())?;
    let (head, rest) = bytes.split_at(5);
    if head != [1, 233, 3, 0, 0] {
        return Err(wanted());
    }
    let number = |k: usize| {
        let mut own = [0; 8];
        own.copy_from_slice(&rest[8 * k..][..8]);
        f64::from_le_bytes(own)
    };
    let position @ [longitude, latitude, height] = [number(0), number(1), number(2)];
    if longitude.abs() <= 360.0 && latitude.abs() <= 90.0 && height.is_finite() {
        Ok(position)
    } else {
        Err(wrong(&format!("a place lies at {position:?}")))
    }
}
