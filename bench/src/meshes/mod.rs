//! Scenes as bare triangles, for tracers that know nothing else.

mod builder;
mod city;
mod file;
mod interior;
mod view;

use std::path::Path;
use std::sync::Arc;

use anyhow::{bail, ensure};
use ombra_geometry::{MeshError, Point3, TriangleMesh, Vector3};

pub use view::{Light, View};

/// The names of those that need no file of the user's, in the order of the tables.
pub const BUILT_IN: [&str; 3] = ["interior", "dragon", "city"];

/// A file name that ends so is seen from its inside.
const INSIDE: &str = "@inside";

/// Where the dragon lies in the outside data.
const DRAGON: &str = "render/mesh/dragon_vrip.ply.gz";

/// Triangles, and from where rays start.
#[derive(Clone, Debug)]
pub struct MeshScene {
    /// As the user named it; of a file, the name without folder and ending.
    pub name: String,
    /// The triangles, none of them without area.
    pub mesh: Arc<TriangleMesh>,
    /// From where rays start.
    pub view: View,
}

/// How much of a generated scene is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// All of it.
    Full,
    /// So little that a test does not wait for it.
    Tiny,
}

/// What came of a name.
#[derive(Clone, Debug)]
pub enum Found {
    /// The scene.
    Scene(MeshScene),
    /// Its data are not here; the line says which.
    Skipped(String),
}

/// A built-in scene or a file: a model, or a soup of triangles (`.bin`). With `@inside` after a file's
/// name rays start within it, as in a hall.
///
/// # Errors
/// When it is neither, or the file cannot be read.
pub fn load(name: &str, size: Size) -> anyhow::Result<Found> {
    let tiny = size == Size::Tiny;
    let (mesh, view): (_, fn(&_) -> _) = match name {
        "interior" => (interior::mesh(if tiny { 2 } else { 8 })?, view::inside),
        "city" => (city::mesh(if tiny { 20 } else { 400 })?, view::over_roofs),
        "dragon" => match dragon()? {
            Some(mesh) => (mesh, view::on_a_floor),
            None => {
                let line = format!("dragon: skipped, no {DRAGON} in the outside data");
                return Ok(Found::Skipped(line + " (OMBRA_TEST_DATA)"));
            }
        },
        file => match file.strip_suffix(INSIDE) {
            Some(file) => (of_file(file)?, view::inside),
            None => (of_file(file)?, view::outside),
        },
    };
    let bounds = mesh.bounds();
    ensure!(bounds.is_finite(), "{name}: its box is not finite");
    let stem = Path::new(name.trim_end_matches(INSIDE)).file_stem();
    Ok(Found::Scene(MeshScene {
        name: stem.map_or_else(|| name.to_owned(), |s| s.to_string_lossy().into_owned()),
        mesh: Arc::new(mesh),
        view: view(&bounds),
    }))
}

/// The city with so many houses a side; that of the tables has 400.
///
/// # Errors
/// When a mesh cannot have so many triangles.
pub fn city(houses: u32) -> Result<TriangleMesh, MeshError> {
    city::mesh(houses)
}

fn of_file(name: &str) -> anyhow::Result<TriangleMesh> {
    let path = Path::new(name);
    if !path.is_file() {
        bail!(
            "{name}: no such file, and no scene of this bench (there are: {})",
            BUILT_IN.join(", ")
        );
    }
    file::mesh(path)
}

/// The dragon, a hundred times as large as in its file, on a floor of two triangles; nothing if the
/// file is not there.
///
/// In its file it is 0.2 units wide, and one of the peers loses hits on triangles so small.
fn dragon() -> anyhow::Result<Option<TriangleMesh>> {
    let path = crate::place::outside_data().map(|data| data.join(DRAGON));
    let Some(path) = path.filter(|path| path.is_file()) else {
        return Ok(None);
    };
    let dragon = file::mesh(&path)?;
    let larger = |p: &Point3| Point3::ORIGIN + (*p - Point3::ORIGIN) * 100.0;
    let mut positions: Vec<_> = dragon.positions().iter().map(larger).collect();
    let mut triangles = dragon.triangles().to_vec();
    let bounds = ombra_geometry::Aabb::around(positions.iter().copied());
    let reach = 3.0 * bounds.extent().x;
    let first = positions.len() as u32;
    let middle = Point3 {
        y: bounds.min.y,
        ..bounds.centre()
    };
    for [x, z] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
        positions.push(middle + Vector3::new(x * reach, 0.0, z * reach));
    }
    triangles.extend([[0, 2, 1], [0, 3, 2]].map(|corners| corners.map(|i| first + i)));
    Ok(Some(builder::without_area(positions, triangles)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn built_in_scenes_load_or_say_what_is_missing() {
        for name in ["interior", "city"] {
            let Found::Scene(scene) = load(name, Size::Tiny).unwrap() else {
                panic!("{name} needs no data");
            };
            assert_eq!(scene.name, name);
        }
        if crate::place::outside_data().is_none()
            && let Found::Scene(_) = load("dragon", Size::Tiny).unwrap()
        {
            panic!("where is the dragon from?");
        }
    }

    #[test]
    fn a_name_that_is_nothing_lists_those_that_there_are() {
        let error = load("no-such", Size::Tiny).unwrap_err().to_string();
        assert!(error.contains("interior, dragon, city"), "{error}");
    }
}
