//! Files by name, on disk or in memory, and those that a file refers to.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Seek};
use std::path::{Path, PathBuf};

use crate::error::{Fault, FormatError};
use crate::finding::Finding;
use crate::limits::Limits;
use crate::mesh::resolve;
use crate::source::Source;

/// A file to be read. Its name goes into messages, and the ending of it may say what the file is.
#[derive(Clone, Debug)]
pub(crate) struct Input<'a> {
    name: PathBuf,
    /// What it holds, if that is in memory.
    bytes: Option<&'a [u8]>,
}

/// What decoders of pictures read from.
pub(crate) trait Seekable: BufRead + Seek {}

impl<R: BufRead + Seek> Seekable for R {}

impl<'a> Input<'a> {
    pub(crate) fn on_disk(path: impl Into<PathBuf>) -> Self {
        Self {
            name: path.into(),
            bytes: None,
        }
    }

    pub(crate) fn in_memory(name: impl Into<PathBuf>, bytes: &'a [u8]) -> Self {
        Self {
            name: name.into(),
            bytes: Some(bytes),
        }
    }

    pub(crate) fn name(&self) -> &Path {
        &self.name
    }

    pub(crate) const fn is_in_memory(&self) -> bool {
        self.bytes.is_some()
    }

    /// From front to back, unpacked if it is a gzip file.
    pub(crate) fn source(&self, limits: &Limits) -> Result<Source<'a>, FormatError> {
        match self.bytes {
            Some(bytes) => Source::new(bytes, bytes.len() as u64, limits),
            None => Source::open(&self.name, limits),
        }
    }

    /// As it is, for readers that go back and forth.
    pub(crate) fn seekable(&self) -> Result<Box<dyn Seekable + 'a>, FormatError> {
        match self.bytes {
            Some(bytes) => Ok(Box::new(Cursor::new(bytes))),
            None => {
                let action = "be opened";
                let file = File::open(&self.name);
                let file = file
                    .map_err(|e: io::Error| FormatError::file(Fault::Io { action, source: e }))?;
                Ok(Box::new(BufReader::new(file)))
            }
        }
    }
}

/// Where the files are that a scene file or a model refers to.
#[derive(Clone, Debug)]
pub enum Assets<'a> {
    /// In a folder. Nothing outside of it is opened.
    Folder(PathBuf),
    /// In memory: names and contents.
    Embedded(&'a [(&'a str, &'a [u8])]),
}

impl<'a> Assets<'a> {
    /// What may be read beside a file on disk.
    pub(crate) fn beside(path: &Path) -> Self {
        Self::Folder(path.parent().unwrap_or(Path::new("")).to_owned())
    }

    /// The file of this name, or what to tell the user. `what` is it for: a "texture", say.
    pub(crate) fn find(&self, name: &str, what: &'static str) -> Result<Input<'a>, Finding> {
        match self {
            Self::Folder(folder) => resolve(folder, name, what).map(Input::on_disk),
            Self::Embedded(files) => {
                let file = files.iter().find(|(known, _)| *known == name);
                let (_, bytes) = file.ok_or_else(|| Finding::MissingFile {
                    what,
                    name: name.to_owned(),
                })?;
                Ok(Input::in_memory(name, bytes))
            }
        }
    }
}
