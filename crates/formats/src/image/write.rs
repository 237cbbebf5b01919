//! Writing a picture so that no half-written file is ever seen.

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::{ImageBuffer, ImageFormat, Metadata, exr, pfm, png, ppm};
use crate::error::{Fault, FormatError};

/// The place of a picture that is still to be made.
///
/// Made before the picture is, so that a wrong ending or a missing folder is known before the work
/// is done. The content goes into a file beside the place, under another name, and is renamed when it
/// is whole; dropped without [`finish`](Self::finish), nothing is left behind.
#[derive(Debug)]
pub struct OutputFile {
    path: PathBuf,
    format: ImageFormat,
    beside: NamedTempFile,
}

impl OutputFile {
    /// A place for a picture; the ending chooses between PNG, EXR, PFM and PPM.
    ///
    /// # Errors
    /// When the ending is unknown, the folder does not exist or cannot be written into, or the path
    /// is a folder.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, FormatError> {
        let path = path.as_ref();
        let format = ImageFormat::of(path)?;
        Ok(Self {
            path: path.to_owned(),
            format,
            beside: file_beside(path).map_err(|e| e.in_file(path))?,
        })
    }

    /// How the picture will be written.
    #[must_use]
    pub const fn format(&self) -> ImageFormat {
        self.format
    }

    /// Writes the picture and puts it in its place. The bytes depend on the arguments alone.
    ///
    /// # Errors
    /// When the file cannot be written; what was there before is still there then.
    pub fn finish(self, image: &ImageBuffer, metadata: &Metadata) -> Result<(), FormatError> {
        let Self {
            path,
            format,
            beside,
        } = self;
        write_and_rename(&path, format, beside, image, metadata).map_err(|e| e.in_file(&path))
    }
}

/// Writes a picture, as [`OutputFile::create`] and [`OutputFile::finish`] do in a row.
///
/// # Errors
/// Those of the two.
pub fn write_image(
    path: impl AsRef<Path>,
    image: &ImageBuffer,
    metadata: &Metadata,
) -> Result<(), FormatError> {
    OutputFile::create(path)?.finish(image, metadata)
}

pub(crate) fn write_error(source: io::Error) -> FormatError {
    let action = "be written";
    FormatError::file(Fault::Io { action, source })
}

pub(crate) fn file_beside(path: &Path) -> Result<NamedTempFile, FormatError> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        let folder = folder.to_owned();
        return Err(FormatError::file(Fault::FolderMissing { folder }));
    }
    if path.is_dir() {
        return Err(write_error(io::ErrorKind::IsADirectory.into()));
    }
    readable_by_others(tempfile::Builder::new().prefix(".ombra-"))
        .tempfile_in(folder)
        .map_err(write_error)
}

fn write_and_rename(
    path: &Path,
    format: ImageFormat,
    mut beside: NamedTempFile,
    image: &ImageBuffer,
    metadata: &Metadata,
) -> Result<(), FormatError> {
    let mut file = BufWriter::with_capacity(1 << 20, beside.as_file_mut());
    match format {
        ImageFormat::Png => png::write(&mut file, image, metadata)?,
        ImageFormat::Exr => exr::write(&mut file, image, metadata)?,
        ImageFormat::Pfm => pfm::write(&mut file, image).map_err(write_error)?,
        ImageFormat::Ppm => ppm::write(&mut file, image, metadata).map_err(write_error)?,
    }
    file.flush().map_err(write_error)?;
    drop(file);
    beside.persist(path).map_err(|e| write_error(e.error))?;
    Ok(())
}

/// Temporary files are private by default; a picture has the permissions of any new file.
#[cfg(unix)]
fn readable_by_others<'a, 'b>(
    builder: &'a mut tempfile::Builder<'b, 'static>,
) -> &'a mut tempfile::Builder<'b, 'static> {
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(std::fs::Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn readable_by_others<'a, 'b>(
    builder: &'a mut tempfile::Builder<'b, 'static>,
) -> &'a mut tempfile::Builder<'b, 'static> {
    builder
}
