//! Buffers and the views of them: sections 5.10 and 5.11 of the specification.

use std::borrow::Cow;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::document::{BufferSpec, Document};
use super::{Folder, uri, wrong};
use crate::error::FormatError;
use crate::finding::Finding;

/// The bytes of all buffers.
pub(super) struct Buffers<'a> {
    all: Vec<Bytes<'a>>,
    /// The files that were read.
    pub(super) files: Vec<PathBuf>,
}

#[derive(Clone)]
enum Bytes<'a> {
    InFile(&'a [u8]),
    Read(Rc<[u8]>),
}

impl Bytes<'_> {
    fn get(&self) -> &[u8] {
        match self {
            Self::InFile(bytes) => bytes,
            Self::Read(bytes) => bytes,
        }
    }
}

/// A view: bytes, and how far it is from one element to the next where the view says.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) stride: Option<usize>,
}

impl<'a> Buffers<'a> {
    /// Reads the buffers of a document: the binary chunk, data URIs, and files in its folder. Memory
    /// follows what is there; a file that several buffers name is read once, as far as the longest
    /// of them goes.
    pub(super) fn read(
        document: &Document,
        binary: Option<&'a [u8]>,
        folder: Folder<'_>,
    ) -> Result<Self, FormatError> {
        let mut buffers = Self {
            all: Vec::with_capacity(document.buffers.len()),
            files: Vec::new(),
        };
        let mut paths = Vec::with_capacity(document.buffers.len());
        let mut longest = HashMap::<PathBuf, u64>::new();
        for (index, spec) in document.buffers.iter().enumerate() {
            let uri = spec.uri.as_deref().filter(|uri| !uri::is_data(uri));
            let path = uri.map(|uri| file(folder, uri, &format!("buffers[{index}]")));
            if let Some(Ok(path)) = &path {
                let most = longest.entry(path.clone()).or_default();
                *most = spec.byte_length.max(*most);
            }
            paths.push(path);
        }
        let mut known = HashMap::new();
        for (index, (spec, path)) in document.buffers.iter().zip(paths).enumerate() {
            let place = format!("buffers[{index}]");
            let (bytes, source) = match &spec.uri {
                None => {
                    let binary = binary.filter(|_| index == 0).ok_or_else(|| {
                        let message = "has no uri; only the first buffer of a GLB file, which is \
                                       its BIN chunk, needs none";
                        wrong(&place, message)
                    })?;
                    (Bytes::InFile(binary), Cow::Borrowed("the BIN chunk"))
                }
                Some(uri) => match path {
                    None => {
                        let data = uri::data(uri).unwrap_or_else(|| Ok(Vec::new()));
                        let data = data.map_err(|error| wrong(format!("{place}.uri"), error))?;
                        (Bytes::Read(data.into()), Cow::Borrowed("the data URI"))
                    }
                    Some(path) => {
                        let path = path?;
                        let bytes = match known.get(&path) {
                            Some(bytes) => Rc::clone(bytes),
                            None => {
                                let bytes: Rc<[u8]> = uri::read(&path, longest[&path])?.into();
                                known.insert(path.clone(), Rc::clone(&bytes));
                                buffers.files.push(path);
                                bytes
                            }
                        };
                        (Bytes::Read(bytes), Cow::Owned(uri::file_name(uri)))
                    }
                },
            };
            check_length(spec, bytes.get().len(), &place, &source)?;
            buffers.all.push(bytes);
        }
        Ok(buffers)
    }

    /// How many bytes there are in all.
    pub(super) fn bytes(&self) -> u64 {
        self.all.iter().map(|b| b.get().len() as u64).sum()
    }

    /// A view; `user` is what refers to it, for errors.
    pub(super) fn view(
        &self,
        document: &Document,
        index: usize,
        user: &str,
    ) -> Result<View<'_>, FormatError> {
        let views = &document.buffer_views;
        let spec = views.get(index).ok_or_else(|| {
            let count = views.len();
            wrong(user, no_such("bufferViews", index, count))
        })?;
        let place = || format!("bufferViews[{index}]");
        let buffer = self.all.get(spec.buffer).ok_or_else(|| {
            let message = no_such("buffers", spec.buffer, self.all.len());
            wrong(format!("{}.buffer", place()), message)
        })?;
        // What its document declares, even where more is there.
        let declared = document.buffers[spec.buffer].byte_length as usize;
        let bytes = &buffer.get()[..declared];
        let end = spec.byte_offset.saturating_add(spec.byte_length);
        if end > bytes.len() as u64 {
            let message = format!(
                "bytes {} to {end} of buffers[{}], which has only {}",
                spec.byte_offset,
                spec.buffer,
                bytes.len()
            );
            return Err(wrong(place(), message));
        }
        let stride = match spec.byte_stride {
            None => None,
            Some(stride @ 1..=252) => Some(stride as usize),
            Some(stride) => {
                let message = format!("is {stride}; 4 to 252 is right");
                return Err(wrong(format!("{}.byteStride", place()), message));
            }
        };
        Ok(View {
            bytes: &bytes[spec.byte_offset as usize..end as usize],
            stride,
        })
    }
}

/// What is said of a reference to something that is not there.
pub(super) fn no_such(list: &str, index: usize, count: usize) -> String {
    match count {
        0 => format!("refers to {list}[{index}], but there are none"),
        1 => format!("refers to {list}[{index}], but there is only {list}[0]"),
        n => format!(
            "refers to {list}[{index}], but there are only {n} (0 to {})",
            n - 1
        ),
    }
}

fn check_length(
    spec: &BufferSpec,
    available: usize,
    place: &str,
    source: &str,
) -> Result<(), FormatError> {
    if spec.byte_length <= available as u64 {
        return Ok(());
    }
    let message = format!(
        "is {}, but {source} has only {available} bytes",
        spec.byte_length
    );
    Err(wrong(format!("{place}.byteLength"), message))
}

fn file(folder: Folder<'_>, name: &str, place: &str) -> Result<PathBuf, FormatError> {
    let place = format!("{place}.uri");
    let Folder::Open(folder) = folder else {
        let message = format!("names the file \"{name}\", but only data URIs can be read here");
        return Err(wrong(place, message));
    };
    uri::file(folder, name, "buffer").map_err(|finding| {
        let name = uri::file_name(name);
        let message = match finding {
            Finding::OutsideFolder { .. } => {
                format!("\"{name}\" leads out of the folder of the file: not opened")
            }
            _ => format!("\"{name}\" is not there (looked in {})", shown(folder)),
        };
        wrong(place, message)
    })
}

fn shown(folder: &Path) -> String {
    if folder.as_os_str().is_empty() {
        "this folder".to_owned()
    } else {
        folder.display().to_string()
    }
}
