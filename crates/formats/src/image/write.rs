//! Writing a picture so that no half-written file is ever seen.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use super::{ImageBuffer, ImageFormat, Metadata, exr, pfm, png, ppm};
use crate::error::{Fault, FormatError};

/// Writes a picture; the ending chooses between PNG, EXR, PFM and PPM.
///
/// The file is written beside its place under another name and renamed when it is whole. The bytes
/// depend on the arguments alone.
///
/// # Errors
/// When the ending is unknown, the folder does not exist, or the file cannot be written.
pub fn write_image(
    path: impl AsRef<Path>,
    image: &ImageBuffer,
    metadata: &Metadata,
) -> Result<(), FormatError> {
    let path = path.as_ref();
    let format = ImageFormat::of(path)?;
    replace(path, |file| match format {
        ImageFormat::Png => png::write(file, image, metadata),
        ImageFormat::Exr => exr::write(file, image, metadata),
        ImageFormat::Pfm => pfm::write(file, image).map_err(write_error),
        ImageFormat::Ppm => ppm::write(file, image, metadata).map_err(write_error),
    })
    .map_err(|e| e.in_file(path))
}

pub(super) fn write_error(source: io::Error) -> FormatError {
    let action = "be written";
    FormatError::file(Fault::Io { action, source })
}

fn replace(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&mut File>) -> Result<(), FormatError>,
) -> Result<(), FormatError> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        let folder = folder.to_owned();
        return Err(FormatError::file(Fault::FolderMissing { folder }));
    }
    let mut beside = readable_by_others(tempfile::Builder::new().prefix(".ombra-"))
        .tempfile_in(folder)
        .map_err(write_error)?;
    let mut file = BufWriter::with_capacity(1 << 20, beside.as_file_mut());
    write(&mut file)?;
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
