//! From what a person names to a scene that can be rendered.

use std::path::Path;

use ombra_accel::{Geometry, Mesh};
use ombra_formats::minray::Contest;
use ombra_formats::scene::{Assets, Picture, SceneFile, parse_scene, read_scene};
use ombra_formats::{
    FormatError, GltfFile, Limits, Model, read_gltf, read_model, sha256, with_normals,
};
use ombra_geometry::triangle::TriangleTest;
use ombra_geometry::{Transform, Vector3};
use ombra_scene::{MaterialId, Rgb, Scene};

use crate::builtin::{self, Builtin};
use crate::defaults;

/// What is behind a model: a sky without sun.
const BACKGROUND: Rgb = Rgb::new(0.62, 0.67, 0.74);

/// How to take a scene or a model.
#[derive(Clone, Debug, Default)]
pub struct LoadOptions {
    /// Which way is up where the camera is made to fit, of any length but 0; by default z for STL
    /// models and y for the rest.
    pub up: Option<Vector3>,
    /// How rays are tested against the triangles of meshes.
    pub triangle_test: TriangleTest,
    /// Bounds on what the files may make the readers do.
    pub limits: Limits,
}

/// A scene, ready to be rendered, and what there is to say about it.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene. It has light; a camera only if its file names one, see [`crate::camera`].
    pub scene: Scene,
    /// What the scene wants to be rendered like.
    pub picture: Picture,
    /// What its user should hear of, one line each.
    pub findings: Vec<String>,
    /// SHA-256, in hexadecimal, over the scene's file and all that it refers to: the same scene gives
    /// the same, and a change to any of the files another.
    pub hash: String,
}

/// Why there is no scene.
#[derive(Debug)]
#[non_exhaustive]
pub enum LoadError {
    /// A file cannot be read.
    Format(FormatError),
    /// Neither a file nor a built-in scene has that name.
    NoSuchScene(String),
}

impl std::fmt::Display for LoadError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Format(error) => error.fmt(f),
            Self::NoSuchScene(name) => {
                let known: Vec<_> = builtin::ALL.iter().map(|scene| scene.name).collect();
                write!(
                    f,
                    "{name}: no such file, and no built-in scene of that name (there are: {})",
                    known.join(", ")
                )
            }
        }
    }
}

impl std::error::Error for LoadError {}

impl From<FormatError> for LoadError {
    fn from(error: FormatError) -> Self {
        Self::Format(error)
    }
}

/// Loads a built-in scene by its name, a scene file, or a model.
///
/// A name that is both a built-in scene and a file in this folder is the built-in scene; `./name`
/// is the file.
///
/// # Errors
/// When there is neither, or the file cannot be read.
pub fn load(name: &str, options: &LoadOptions) -> Result<Loaded, LoadError> {
    if let Some(scene) = builtin::find(name) {
        return Ok(of_builtin(scene, options)?);
    }
    let path = Path::new(name);
    if !path.exists() {
        return Err(LoadError::NoSuchScene(name.to_owned()));
    }
    let mut loaded = if is_named(path, &["toml"]) {
        let file = read_scene(path, options.triangle_test, &options.limits)?;
        of_scene(file)
    } else if is_named(path, &["gltf", "glb"]) {
        let file = read_gltf(path, options.triangle_test, &options.limits)?;
        let hash = sha256::of_files(&file.files)?;
        of_gltf(file, hash)
    } else {
        let model = read_model(path, &options.limits)?;
        let hash = sha256::of_files(&model.files)?;
        of_model(model, options, hash)?
    };
    if let Some(up) = options.up {
        loaded.scene.up = up;
    }
    defaults::light(&mut loaded.scene);
    Ok(loaded)
}

/// Whether a file has one of these endings, that before ".gz" if it has such.
fn is_named(path: &Path, endings: &[&str]) -> bool {
    let packed = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("gz"));
    let path = if packed {
        path.with_extension("")
    } else {
        path.to_owned()
    };
    let ending = path.extension().unwrap_or_default();
    endings
        .iter()
        .any(|known| ending.eq_ignore_ascii_case(known))
}

fn of_builtin(scene: &Builtin, options: &LoadOptions) -> Result<Loaded, FormatError> {
    if let Some(contest) = scene.contest() {
        let hash = sha256::of_bytes(scene.text.as_bytes());
        return Ok(of_contest(&contest?, hash));
    }
    let assets = Assets::Embedded(builtin::ASSETS);
    let file = parse_scene(scene.text, &assets, options.triangle_test, &options.limits)?;
    Ok(of_scene(file))
}

fn of_contest(contest: &Contest, hash: String) -> Loaded {
    Loaded {
        scene: contest.scene(),
        picture: contest.picture(),
        findings: Vec::new(),
        hash,
    }
}

fn of_scene(file: SceneFile) -> Loaded {
    let findings = file.findings.iter().map(ToString::to_string).collect();
    Loaded {
        scene: file.scene,
        picture: file.picture,
        findings,
        hash: file.hash,
    }
}

fn of_gltf(file: GltfFile, hash: String) -> Loaded {
    let findings = file.findings.iter().map(ToString::to_string).collect();
    let mut scene = file.scene;
    scene.background = BACKGROUND.into();
    Loaded {
        scene,
        picture: file.picture,
        findings,
        hash,
    }
}

fn of_model(model: Model, options: &LoadOptions, hash: String) -> Result<Loaded, FormatError> {
    let findings = model.findings.iter().map(ToString::to_string).collect();
    let natural = if model.format.is_stl() {
        Vector3::Z
    } else {
        Vector3::Y
    };
    let mut scene = Scene {
        up: natural,
        ..Scene::default()
    };
    scene.background = BACKGROUND.into();
    scene.materials = model.materials;
    for part in model.parts {
        let mesh = with_normals(part.mesh)?;
        let geometry = Geometry::Mesh(Mesh::with_test(mesh, options.triangle_test));
        scene.place(
            part.name,
            geometry,
            MaterialId(part.material as u32),
            Transform::identity(),
        );
    }
    Ok(Loaded {
        scene,
        picture: Picture::default(),
        findings,
        hash,
    })
}
