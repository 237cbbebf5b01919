//! The scenes that structures are compared on.

use ombra::scene::Scene;
use ombra::{LoadError, LoadOptions, Loaded};

use crate::scenes::{ALL, SceneFault};
use crate::{Settings, StudyError};

/// What is studied when nobody names a scene: three that are made for it and two with a picture.
pub const DEFAULT_SCENES: [&str; 5] = [
    "study:hills",
    "study:city",
    "study:stadium",
    "teapot",
    "card",
];

/// A scene by name.
#[derive(Clone, Debug)]
pub struct Subject {
    /// As it was asked for.
    pub name: String,
    /// What it is, in one line; empty for files.
    pub line: &'static str,
    /// The scene.
    pub scene: Scene,
    /// What its user should hear of, one line each.
    pub findings: Vec<String>,
}

impl Subject {
    /// A scene of the study (`study:hills`, `study:city`, `study:stadium`), a built-in one, or a file.
    ///
    /// # Errors
    /// When there is none, or the file cannot be read.
    pub fn load(name: &str, settings: &Settings) -> Result<Self, StudyError> {
        if let Some(generated) = ALL.iter().find(|scene| scene.name == name) {
            let made = (generated.make)(settings.detail);
            let scene = made.map_err(|fault: SceneFault| StudyError::Scene(fault.to_string()))?;
            return Ok(Self {
                name: name.to_owned(),
                line: generated.line,
                scene,
                findings: Vec::new(),
            });
        }
        let options = LoadOptions {
            triangle_test: settings.triangle_test,
            ..LoadOptions::default()
        };
        let loaded = ombra::load(name, &options);
        let Loaded {
            scene, findings, ..
        } = loaded.map_err(|error| match error {
            LoadError::NoSuchScene(name) if name.starts_with("study:") => {
                let made: Vec<_> = ALL.iter().map(|scene| scene.name).collect();
                StudyError::Scene(format!(
                    "{name}: the scenes of the study are {}",
                    made.join(", ")
                ))
            }
            other => StudyError::Load(other),
        })?;
        let line = ombra::builtin::find(name).map_or("", |scene| scene.line);
        Ok(Self {
            name: name.to_owned(),
            line,
            scene,
            findings,
        })
    }
}
