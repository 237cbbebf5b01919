//! The files that a scene file refers to.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ombra_geometry::triangle::TriangleTest;
use ombra_scene::{Image, Material, Texture};

use super::build::wrong;
use crate::error::FormatError;
use crate::finding::Finding;
use crate::gltf::{self, GltfFile};
use crate::image::texture;
use crate::input::{Assets, Input};
use crate::limits::{Limits, take_pixels};
use crate::mesh::{self, Model};
use crate::sha256::Content;

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
        let input = find(self.assets, name, "model")?;
        // What a model on disk names is looked for beside it.
        let beside = match self.assets {
            Assets::Folder(_) => Assets::beside(input.name()),
            Assets::Embedded(files) => Assets::Embedded(files),
        };
        let model = mesh::read(&input, &beside, &self.limits)?;
        self.take(&model.files)?;
        self.account(&model.materials)?;
        Ok(model)
    }

    /// The scene of a glTF file.
    pub(super) fn gltf(&mut self, name: &str, test: TriangleTest) -> Result<GltfFile, FormatError> {
        let input = find(self.assets, name, "model")?;
        let file = gltf::read_input(&input, test, &self.limits)?;
        self.take(&file.files)?;
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
        let input = find(self.assets, name, "texture")?;
        let path = input.name().to_owned();
        if let Some(image) = self.images.get(&path) {
            return Ok(Arc::clone(image));
        }
        let image = Arc::new(texture(&input, &self.limits)?);
        take_pixels(&mut self.limits, image.width(), image.height())
            .map_err(|e| e.in_file(&path))?;
        self.take(std::slice::from_ref(&path))?;
        self.images.insert(path, Arc::clone(&image));
        Ok(image)
    }

    /// Takes what has been read into the hash.
    fn take(&mut self, files: &[PathBuf]) -> Result<(), FormatError> {
        match self.assets {
            Assets::Folder(_) => self.content.take_files(files),
            Assets::Embedded(known) => {
                for file in files {
                    let named = known.iter().filter(|(name, _)| Path::new(name) == file);
                    named
                        .take(1)
                        .for_each(|(_, bytes)| self.content.take(bytes));
                }
                Ok(())
            }
        }
    }
}

fn find<'a>(assets: &Assets<'a>, name: &str, what: &'static str) -> Result<Input<'a>, FormatError> {
    assets.find(name, what).map_err(|finding| match finding {
        Finding::OutsideFolder { .. } => wrong(format!(
            "{what} {name} lies outside the scene file's folder: not opened"
        )),
        _ => wrong(format!("{what} {name} not found")),
    })
}
