//! What is wrong with a file, and where.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use ombra_city::CityError;
use ombra_geometry::MeshError;

/// Where in a file a fault lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// The file as a whole.
    File,
    /// A line of a text file, from 1.
    Line(u64),
    /// An offset into a binary file, in bytes from 0 (after unpacking, if it was compressed).
    Byte(u64),
}

/// A file that cannot be read or written: which, where, and what is wrong.
///
/// Shown as one line, such as
/// `model.obj:5: face uses vertex 99, but only 3 are defined (1 to 3)`.
#[derive(Debug)]
pub struct FormatError(Box<Inner>);

#[derive(Debug)]
struct Inner {
    path: Option<PathBuf>,
    place: Place,
    fault: Fault,
}

/// From where an index counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IndexBase {
    /// The first is 0, as in PLY.
    Zero,
    /// The first is 1 and the last is −1, as in OBJ.
    One,
}

/// What can be wrong with a file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// The operating system refuses.
    #[error("cannot {action}: {source}")]
    Io {
        /// What was tried: "be opened", "be read".
        action: &'static str,
        /// Its answer.
        source: io::Error,
    },
    /// Nothing in it.
    #[error("file is empty (0 bytes)")]
    Empty,
    /// Neither the ending nor the content says what it is.
    #[error("unknown kind of file; {known} can be read")]
    UnknownContent {
        /// What can be read.
        known: &'static str,
    },
    /// Nothing is written under this ending.
    #[error("cannot write {}; known endings are {known}", ending_or_none(.ending))]
    UnknownEnding {
        /// The ending without its dot; empty if there is none.
        ending: String,
        /// What would be right.
        known: &'static str,
    },
    /// Something other than what the format asks for.
    #[error("{found} found where {expected} is expected")]
    Unexpected {
        /// What is there, quoted and shortened.
        found: String,
        /// What should be there.
        expected: &'static str,
    },
    /// Not a number.
    #[error("{what} is {found}, which is not a number")]
    NotANumber {
        /// What the number would have been.
        what: &'static str,
        /// What is there, quoted and shortened.
        found: String,
    },
    /// A number that is infinite, NaN, or too large for single precision.
    #[error("{what} is {found}; a finite number is needed (of size up to 3.4e38)")]
    NotFinite {
        /// What the number is.
        what: &'static str,
        /// What is there, quoted and shortened.
        found: String,
    },
    /// Too few numbers.
    #[error("{what} has {found} {}, but needs {needed}", plural("number", *.found))]
    TooFewNumbers {
        /// What the numbers are.
        what: &'static str,
        /// How many there are.
        found: u64,
        /// How many there should be.
        needed: u64,
    },
    /// A reference to something that is not defined.
    #[error("face uses {attribute} {index}, but {}", defined_range(*.defined, *.base, *.index))]
    IndexOutOfRange {
        /// "vertex", "texture coordinate" or "normal".
        attribute: &'static str,
        /// The index as the file gives it.
        index: i64,
        /// How many are defined.
        defined: u64,
        /// From where it counts.
        base: IndexBase,
    },
    /// More vertices or faces than 32-bit indices can name.
    #[error("more than 4294967294 {what}")]
    TooMany {
        /// What there are too many of.
        what: &'static str,
    },
    /// A row of a table that has not the declared numbers.
    #[error(
        "element {element}, row {row} of {rows} has {found} {}, but {expected} {} expected",
        plural("number", *.found), if *.expected == 1 { "is" } else { "are" }
    )]
    RowLength {
        /// The element's name.
        element: String,
        /// Which row, from 1.
        row: u64,
        /// How many rows are declared.
        rows: u64,
        /// How many numbers it has.
        found: u64,
        /// How many it should have.
        expected: u64,
    },
    /// A fault in a row of a table in a binary file.
    #[error("element {element}, row {row}: {fault}")]
    Row {
        /// The element's name.
        element: String,
        /// Which row, from 1.
        row: u64,
        /// What is wrong in it.
        fault: Box<Fault>,
    },
    /// The file ends before the rows that it declares.
    #[error("unexpected end of file in element {element}: row {row} of {rows} is missing or cut")]
    UnexpectedEnd {
        /// The element's name.
        element: String,
        /// The first row that is not whole, from 1.
        row: u64,
        /// How many rows are declared.
        rows: u64,
    },
    /// Declared counts that the file cannot hold. Found before anything is allocated.
    #[error(
        "file too short: {rows} {what} are declared, which need at least {needed} bytes, \
         but {} {available} follow", if *.at_most { "at most" } else { "only" }
    )]
    TooShort {
        /// "vertex rows", "triangles".
        what: String,
        /// How many are declared.
        rows: u64,
        /// How many bytes they would take.
        needed: u64,
        /// How many there are.
        available: u64,
        /// Whether that is a bound (a compressed file) and not exact.
        at_most: bool,
    },
    /// More content than [`Limits`](crate::Limits) allows.
    #[error("{what} exceeds the limit of {limit} bytes")]
    TooLarge {
        /// "unpacked content", "line".
        what: &'static str,
        /// The limit.
        limit: u64,
    },
    /// A picture with more pixels than [`Limits`](crate::Limits) allows.
    #[error("image is {width}x{height} pixels, over the limit of {limit} pixels")]
    ImageTooLarge {
        /// Pixels a row.
        width: u64,
        /// Rows.
        height: u64,
        /// The most pixels allowed.
        limit: u64,
    },
    /// A picture that its library cannot read or write.
    #[error("{format}: {message}")]
    Image {
        /// The format's name.
        format: &'static str,
        /// What the library says, on one line.
        message: String,
    },
    /// Pixels whose number is not width times height.
    #[error("{width}x{height} pixels are declared, but there are {pixels}")]
    PixelCount {
        /// Pixels a row.
        width: u64,
        /// Rows.
        height: u64,
        /// How many there are.
        pixels: u64,
    },
    /// The folder to write into is not there.
    #[error("folder {} does not exist; create it first", one_line(&.folder.display().to_string()))]
    FolderMissing {
        /// The folder.
        folder: PathBuf,
    },
    /// A folder to be written that holds something else.
    #[error(
        "holds {name:?}, and is no folder of {what} that ombra has written; name a new folder or an empty one"
    )]
    FolderTaken {
        /// What was to be written: "tiles".
        what: &'static str,
        /// The first entry that is not ours.
        name: String,
    },
    /// A scene file that does not say what a scene file says.
    #[error("{}", shown(.0))]
    Description(String),
    /// A document (glTF) that does not hold together.
    #[error("{}: {}", shown(.place), shown(.message))]
    InDocument {
        /// Where in it, such as `meshes[0].primitives[0].indices`.
        place: String,
        /// What is wrong there and what would be right.
        message: String,
    },
    /// A mesh that does not hold together.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A city that cannot be placed on the ground.
    #[error("{}", one_line(&.0.to_string()))]
    City(CityError),
    /// Several faults of one file, in its order.
    #[error("{}", several(.faults, *.more))]
    Several {
        /// The first few.
        faults: Vec<(Place, Fault)>,
        /// Whether there are more.
        more: bool,
    },
}

impl FormatError {
    pub(crate) fn new(place: Place, fault: impl Into<Fault>) -> Self {
        Self(Box::new(Inner {
            path: None,
            place,
            fault: fault.into(),
        }))
    }

    pub(crate) fn line(line: u64, fault: Fault) -> Self {
        Self::new(Place::Line(line), fault)
    }

    pub(crate) fn file(fault: impl Into<Fault>) -> Self {
        Self::new(Place::File, fault)
    }

    /// One error out of the faults that were collected on the way; the first gives the place.
    pub(crate) fn collected(mut faults: Vec<(Place, Fault)>, more: bool) -> Self {
        if faults.len() == 1 && !more {
            let (place, fault) = faults.remove(0);
            return Self::new(place, fault);
        }
        let place = faults.first().map_or(Place::File, |f| f.0);
        Self::new(place, Fault::Several { faults, more })
    }

    /// The same error of this file, unless it already names one.
    pub(crate) fn in_file(mut self, path: &Path) -> Self {
        self.0.path.get_or_insert_with(|| path.to_path_buf());
        self
    }

    /// The same error at this place, unless it already names one or is about another file.
    pub(crate) fn at(mut self, place: Place) -> Self {
        if self.0.path.is_none() && self.0.place == Place::File {
            self.0.place = place;
        }
        self
    }

    /// Which file.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        self.0.path.as_deref()
    }

    /// Where in the file.
    #[must_use]
    pub fn place(&self) -> Place {
        self.0.place
    }

    /// What is wrong.
    #[must_use]
    pub fn fault(&self) -> &Fault {
        &self.0.fault
    }
}

impl fmt::Display for FormatError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Inner { path, place, fault } = &*self.0;
        if let Some(path) = path {
            write!(f, "{}", one_line(&path.display().to_string()))?;
        }
        match (place, path.is_some()) {
            (Place::File, true) => f.write_str(": ")?,
            (Place::File, false) => {}
            (Place::Line(line), true) => write!(f, ":{line}: ")?,
            (Place::Byte(byte), true) => write!(f, ": byte {byte}: ")?,
            (place, false) => write!(f, "{place}: ")?,
        }
        write!(f, "{fault}")
    }
}

impl std::error::Error for FormatError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        // The text of what lies behind is part of this one's: a chain would say it twice.
        None
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File => f.write_str("file"),
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// A piece of a file as it may be shown: quoted, without control characters, shortened.
pub(crate) fn quoted(bytes: &[u8]) -> String {
    const SHOWN: usize = 40;
    let cut = &bytes[..bytes.len().min(SHOWN)];
    let dots = if bytes.len() > SHOWN { "..." } else { "" };
    format!("\"{}{dots}\"", one_line(&String::from_utf8_lossy(cut)))
}

/// The same text with its control characters escaped, so that it stays on one line.
pub(crate) fn one_line(text: &str) -> String {
    let mut line = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() {
            line.extend(c.escape_default());
        } else {
            line.push(c);
        }
    }
    line
}

/// A text out of a file in a message: on one line, and cut where it is longer than any that a person
/// would give.
pub(crate) fn shown(text: &str) -> String {
    const MOST: usize = 400;
    let mut line = one_line(text);
    if let Some((end, _)) = line.char_indices().nth(MOST) {
        line.truncate(end);
        line.push_str("...");
    }
    line
}

pub(crate) fn plural(word: &str, count: u64) -> String {
    if count == 1 {
        word.to_owned()
    } else {
        format!("{word}s")
    }
}

fn ending_or_none(ending: &str) -> String {
    if ending.is_empty() {
        "a file without an ending".to_owned()
    } else {
        format!("a .{} file", shown(ending))
    }
}

fn defined_range(defined: u64, base: IndexBase, index: i64) -> String {
    let verb = if defined == 1 { "is" } else { "are" };
    match (defined, base) {
        (0, _) => "none is defined".to_owned(),
        (n, IndexBase::Zero) => format!("only {n} {verb} defined (0 to {})", n - 1),
        (n, IndexBase::One) if index < 0 => {
            format!("only {n} {verb} defined up to here (-{n} to -1)")
        }
        (n, IndexBase::One) => format!("only {n} {verb} defined (1 to {n})"),
    }
}

fn several(faults: &[(Place, Fault)], more: bool) -> String {
    let mut text = String::new();
    for (i, (place, fault)) in faults.iter().enumerate() {
        if i > 0 {
            text += &format!("; {place}: ");
        }
        text += &fault.to_string();
    }
    if more {
        text += "; and more";
    }
    text
}
