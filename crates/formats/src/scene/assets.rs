//! The files that a scene file refers to.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ombra_geometry::triangle::TriangleTest;
use ombra_scene::{Image, Material, Texture};

use super::build::wrong;
use crate::error::FormatError;
use crate::finding::Finding;
use crate::gltf::{GltfFile, read_gltf};
use crate::image::read_texture;
use crate::limits::{Limits, take_pixels};
use crate::mesh::{Model, read_model, read_model_bytes, resolve};
use crate::sha256::Content;

/// Where the files are that a scene file refers to.
#[derive(Clone, Debug)]
pub enum Assets<'a> {
    /// In a folder. Nothing outside of it is opened.
    Folder(PathBuf),
    /// In memory: names and contents.
    Embedded(&'a [(&'a str, &'a [u8])]),
}

/// Reads assets within limits that hold for all of them together.
pub(super) struct Loader<'a> {
    assets: &'a Assets<'a>,
    /// What is left of it for textures.
    limits: Limits,
    images: HashMap<PathBuf, Arc<Image>>,
    content: Content,
}

impl<'a> Loader<'a> {
    /// A loader for what a scene file of this text refers to.
    pub(super) fn new(text: &str, assets: &'a Assets<'a>, limits: &Limits) -> Self {
        let mut content = Content::default();
        content.take(text.as_bytes());
        Self {
            assets,
            limits: limits.clone(),
            images: HashMap::new(),
            content,
        }
    }

    pub(super) fn model(&mut self, name: &str) -> Result<Model, FormatError> {
        let model = match self.assets {
            Assets::Folder(folder) => read_model(path(folder, name, "model")?, &self.limits)?,
            Assets::Embedded(files) => {
                let file = files.iter().find(|(known, _)| *known == name);
                let (_, bytes) = file.ok_or_else(|| missing(name, "model"))?;
                self.content.take(bytes);
                read_model_bytes(Path::new(name), bytes, &self.limits)?
            }
        };
        self.content.take_files(&model.files)?;
        self.account(&model.materials)?;
        Ok(model)
    }

    /// The scene of a glTF file.
    pub(super) fn gltf(&mut self, name: &str, test: TriangleTest) -> Result<GltfFile, FormatError> {
        let file = match self.assets {
            Assets::Folder(folder) => read_gltf(path(folder, name, "model")?, test, &self.limits)?,
            // No built-in scene has one.
            Assets::Embedded(_) => return Err(missing(name, "model")),
        };
        self.content.take_files(&file.files)?;
        self.account(&file.scene.materials)?;
        Ok(file)
    }

    /// Takes the textures of some materials, each picture once, from what may still be loaded.
    fn account(&mut self, materials: &[Material]) -> Result<(), FormatError> {
        let mut counted = Vec::new();
        for material in materials {
            if let Texture::Picture(picture) = &material.diffuse {
                let image = &picture.image;
                let address = Arc::as_ptr(image);
                if !counted.contains(&address) {
                    counted.push(address);
                    take_pixels(&mut self.limits, image.width(), image.height())?;
                }
            }
        }
        Ok(())
    }

    /// The SHA-256 of the scene file and all that was read after it.
    pub(super) fn hash(self) -> String {
        self.content.hexadecimal()
    }

    /// A texture; each file is read once.
    pub(super) fn image(&mut self, name: &str) -> Result<Arc<Image>, FormatError> {
        let path = match self.assets {
            Assets::Folder(folder) => path(folder, name, "texture")?,
            // No built-in scene has a texture.
            Assets::Embedded(_) => return Err(missing(name, "texture")),
        };
        if let Some(image) = self.images.get(&path) {
            return Ok(Arc::clone(image));
        }
        let image = Arc::new(read_texture(&path, &self.limits)?);
        take_pixels(&mut self.limits, image.width(), image.height())
            .map_err(|e| e.in_file(&path))?;
        self.content.take_files(std::slice::from_ref(&path))?;
        self.images.insert(path, Arc::clone(&image));
        Ok(image)
    }
}

fn path(folder: &Path, name: &str, what: &'static str) -> Result<PathBuf, FormatError> {
    resolve(folder, name, what).map_err(|finding| match finding {
        Finding::OutsideFolder { .. } => wrong(format!(
            "{what} {name} lies outside the scene file's folder: not opened"
        )),
        _ => missing(name, what),
    })
}

fn missing(name: &str, what: &'static str) -> FormatError {
    wrong(format!("{what} {name} not found"))
}
