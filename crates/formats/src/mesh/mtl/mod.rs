//! MTL, the materials of OBJ files ("Advanced Visualizer Manual", appendix B, Wavefront
//! Technologies, 1992), as Whitted's materials.

mod definition;

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::Arc;

use ombra_scene::{Image, Material, Rgb};

use super::obj::Unused;
use crate::error::{Fault, FormatError, quoted};
use crate::finding::Finding;
use crate::image::texture;
use crate::input::{Assets, Input};
use crate::limits::{Limits, take_pixels};
use crate::number::Words;
use crate::source::Source;

use definition::Definition;

const TEXTURE: &str = "texture";

/// The materials that the materials files of a model define, and the textures loaded so far.
pub(super) struct Library<'a> {
    assets: &'a Assets<'a>,
    definitions: HashMap<String, Definition>,
    images: HashMap<PathBuf, Arc<Image>>,
    /// What was read.
    files: Vec<PathBuf>,
    /// What is left of it for textures.
    limits: Limits,
}

impl<'a> Library<'a> {
    /// Reads the materials files that a model names. A name that is not there as a whole may be
    /// several with blanks between.
    pub(super) fn load(
        assets: &'a Assets<'a>,
        names: &[String],
        limits: &Limits,
        findings: &mut Vec<Finding>,
    ) -> Result<Self, FormatError> {
        const WHAT: &str = "materials file";
        let mut library = Self {
            assets,
            definitions: HashMap::new(),
            images: HashMap::new(),
            files: Vec::new(),
            limits: limits.clone(),
        };
        let mut seen = HashSet::new();
        for name in names.iter().filter(|name| seen.insert(name.as_str())) {
            let several = name.split_whitespace().count() > 1;
            match assets.find(name, WHAT) {
                Ok(input) => library.read_file(&input, name, findings)?,
                Err(_) if several => {
                    for name in name.split_whitespace() {
                        match assets.find(name, WHAT) {
                            Ok(input) => library.read_file(&input, name, findings)?,
                            Err(finding) => findings.push(finding),
                        }
                    }
                }
                Err(finding) => findings.push(finding),
            }
        }
        Ok(library)
    }

    fn read_file(
        &mut self,
        input: &Input<'_>,
        name: &str,
        findings: &mut Vec<Finding>,
    ) -> Result<(), FormatError> {
        self.files.push(input.name().to_owned());
        input
            .source(&self.limits)
            .and_then(|mut source| self.read(&mut source, name, findings))
            .map_err(|e| e.in_file(input.name()))
    }

    fn read(
        &mut self,
        source: &mut Source<'_>,
        file: &str,
        findings: &mut Vec<Finding>,
    ) -> Result<(), FormatError> {
        let mut unused = Unused::default();
        let mut current: Option<(String, Definition)> = None;
        while let Some(line) = source.joined_line()? {
            let mut words = Words(line.bytes);
            match words.next() {
                None | Some([b'#', ..]) => {}
                Some(b"newmtl") => {
                    let name = String::from_utf8_lossy(words.0.trim_ascii()).into_owned();
                    self.define(current.replace((name, Definition::default())));
                }
                Some(keyword) => {
                    let at_line = |fault| FormatError::line(line.number, fault);
                    let (_, definition) = current.as_mut().ok_or_else(|| {
                        let (found, expected) = (quoted(keyword), "newmtl NAME");
                        at_line(Fault::Unexpected { found, expected })
                    })?;
                    if !definition.set(keyword, words).map_err(at_line)? {
                        unused.count(keyword, line.number);
                    }
                }
            }
        }
        self.define(current);
        unused.report(Some(file), findings);
        Ok(())
    }

    /// The first definition of a name holds.
    fn define(&mut self, definition: Option<(String, Definition)>) {
        if let Some((name, definition)) = definition {
            self.definitions.entry(name).or_insert(definition);
        }
    }

    /// The material that a model calls `name`, with its texture; default grey if it is not defined.
    pub(super) fn take(
        &mut self,
        name: &str,
        line: u64,
        findings: &mut Vec<Finding>,
    ) -> Result<Material, FormatError> {
        let Some(definition) = self.definitions.remove(name) else {
            let name = name.to_owned();
            findings.push(Finding::UndefinedMaterial {
                name: name.clone(),
                line,
            });
            return Ok(Material {
                name,
                ..Material::default()
            });
        };
        let mut material = definition.material(name);
        for option in definition.unused_map_options() {
            findings.push(Finding::Unused {
                what: "map option",
                name: option.clone(),
                count: 1,
                file: None,
                line: None,
            });
        }
        if let Some(texture) = definition.texture() {
            match self.assets.find(texture, TEXTURE) {
                Ok(input) => {
                    let image = self.image(&input)?;
                    let factor = material.diffuse.average();
                    material.diffuse = self.tinted(image, factor)?.into();
                }
                Err(finding) => findings.push(finding),
            }
        }
        Ok(material)
    }

    /// The materials files and textures that were read, in order.
    pub(super) fn into_files(self) -> Vec<PathBuf> {
        self.files
    }

    fn image(&mut self, input: &Input<'_>) -> Result<Arc<Image>, FormatError> {
        let path = input.name();
        if let Some(image) = self.images.get(path) {
            return Ok(Arc::clone(image));
        }
        let image = texture(input, &self.limits)?;
        self.account(&image).map_err(|e| e.in_file(path))?;
        let image = Arc::new(image);
        self.files.push(path.to_owned());
        self.images.insert(path.to_owned(), Arc::clone(&image));
        Ok(image)
    }

    /// The picture times Kd. Black counts as white: exporters write it where the picture alone is
    /// meant.
    fn tinted(&mut self, image: Arc<Image>, factor: Rgb) -> Result<Arc<Image>, FormatError> {
        if factor == Rgb::WHITE || factor.is_black() {
            return Ok(image);
        }
        self.account(&image)?;
        let pixels = image.pixels().iter().map(|&p| p * factor).collect();
        let tinted = Image::new(image.width(), image.height(), pixels);
        Ok(tinted.map_or(image, Arc::new))
    }

    /// Takes the pixels of an image from what may still be loaded.
    fn account(&mut self, image: &Image) -> Result<(), FormatError> {
        take_pixels(&mut self.limits, image.width(), image.height())
    }
}
