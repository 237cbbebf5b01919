//! The files that a scene file refers to.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use ombra_scene::Image;

use crate::error::{Fault, FormatError};
use crate::image::read_texture;
use crate::limits::Limits;
use crate::mesh::{Model, read_model, read_model_bytes, resolve};

/// Where the files are that a scene file refers to.
#[derive(Clone, Debug)]
pub enum Assets<'a> {
    /// In a folder. Nothing outside of it is opened.
    Folder(PathBuf),
    /// In memory: names and contents.
    Embedded(&'a [(&'a str, &'a [u8])]),
}

impl Assets<'_> {
    pub(super) fn model(&self, name: &str, limits: &Limits) -> Result<Model, FormatError> {
        match self {
            Self::Folder(folder) => read_model(Self::path(folder, name, "model")?, limits),
            Self::Embedded(files) => {
                let file = files.iter().find(|(known, _)| *known == name);
                let (_, bytes) = file.ok_or_else(|| missing(name, "model"))?;
                read_model_bytes(Path::new(name), bytes, limits)
            }
        }
    }

    pub(super) fn image(&self, name: &str, limits: &Limits) -> Result<Arc<Image>, FormatError> {
        match self {
            Self::Folder(folder) => {
                let path = Self::path(folder, name, "texture")?;
                Ok(Arc::new(read_texture(&path, limits)?))
            }
            // No built-in scene has a texture.
            Self::Embedded(_) => Err(missing(name, "texture")),
        }
    }

    fn path(folder: &Path, name: &str, what: &'static str) -> Result<PathBuf, FormatError> {
        resolve(folder, name, what)
            .map_err(|finding| FormatError::file(Fault::Description(finding.to_string())))
    }
}

fn missing(name: &str, what: &'static str) -> FormatError {
    FormatError::file(Fault::Description(format!("{what} {name} not found")))
}
