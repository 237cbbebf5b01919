//! Models from files.

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use anyhow::{Context, ensure};
use ombra::LoadOptions;
use ombra_accel::Geometry;
use ombra_geometry::{Point3, TriangleMesh};

use super::builder::without_area;

/// Bytes of a triangle in a soup: nine numbers of four bytes.
const SOUP_TRIANGLE: usize = 36;

/// A soup (`.bin`), or whatever `ombra render` takes: the triangles of all its meshes, where they
/// are placed.
pub(super) fn mesh(path: &Path) -> anyhow::Result<TriangleMesh> {
    let ending = path.extension().unwrap_or_default();
    let mesh = if ending.eq_ignore_ascii_case("bin") {
        soup(path)?
    } else {
        model(path)?
    };
    ensure!(
        !mesh.triangles().is_empty(),
        "{}: there is no triangle in it",
        path.display()
    );
    Ok(mesh)
}

fn model(path: &Path) -> anyhow::Result<TriangleMesh> {
    let name = path.to_str().context("the path is not Unicode")?;
    // A file may have the name of a built-in scene.
    let name = if path.components().count() == 1 {
        format!("./{name}")
    } else {
        name.to_owned()
    };
    let scene = ombra::load(&name, &LoadOptions::default())?.scene;
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for object in &scene.objects {
        let Geometry::Mesh(mesh) = &scene.geometries[object.geometry.index()] else {
            continue;
        };
        let first = u32::try_from(positions.len()).context("more vertices than an index names")?;
        let place = |p: &Point3| object.world_from_object.point(*p);
        positions.extend(mesh.mesh().positions().iter().map(place));
        let shifted = |corners: &[u32; 3]| corners.map(|i| i.saturating_add(first));
        triangles.extend(mesh.mesh().triangles().iter().map(shifted));
    }
    Ok(without_area(positions, triangles)?)
}

/// Nine little-endian numbers a triangle and nothing else. Corners that are equal become one vertex.
fn soup(path: &Path) -> anyhow::Result<TriangleMesh> {
    let shown = path.display();
    let bytes = fs::read(path).with_context(|| format!("cannot read {shown}"))?;
    ensure!(
        bytes.len() % SOUP_TRIANGLE == 0,
        "{shown}: {} bytes are not a whole number of triangles of {SOUP_TRIANGLE} bytes",
        bytes.len()
    );
    let mut numbers = HashMap::new();
    let (mut positions, mut corners) = (Vec::new(), Vec::new());
    for (index, place) in bytes.chunks_exact(12).enumerate() {
        let number = |at: usize| {
            let four = [place[at], place[at + 1], place[at + 2], place[at + 3]];
            f32::from_le_bytes(four)
        };
        let place = Point3::new(number(0), number(4), number(8));
        ensure!(
            place.is_finite(),
            "{shown}: byte {}: a corner that is not finite: {place:?}",
            index * 12
        );
        let bits = [place.x, place.y, place.z].map(f32::to_bits);
        let vertex = *numbers.entry(bits).or_insert_with(|| {
            positions.push(place);
            (positions.len() - 1) as u32
        });
        corners.push(vertex);
    }
    let triangles = corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]);
    Ok(without_area(positions, triangles.collect())?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(name: &str, content: &[u8]) -> (tempfile::TempDir, std::path::PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        fs::write(&path, content).unwrap();
        (folder, path)
    }

    fn soup_of(numbers: &[f32]) -> Vec<u8> {
        numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
    }

    #[test]
    fn a_soup_shares_its_corners() {
        let square = [
            [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0],
        ];
        let (_folder, path) = written("some.bin", &soup_of(square.as_flattened()));
        let mesh = mesh(&path).unwrap();
        assert_eq!((mesh.positions().len(), mesh.triangles().len()), (4, 2));
    }

    #[test]
    fn a_soup_that_is_none_is_an_error_that_says_why() {
        for (content, reason) in [
            (vec![0; 35], "35 bytes are not a whole number"),
            (Vec::new(), "no triangle"),
            (
                soup_of(&[f32::NAN; 9]),
                "byte 0: a corner that is not finite",
            ),
            (soup_of(&[1.0; 9]), "no triangle"),
        ] {
            let (_folder, path) = written("some.bin", &content);
            let error = mesh(&path).unwrap_err().to_string();
            assert!(error.contains(reason), "{error}");
        }
    }

    #[test]
    fn a_model_is_its_triangles() {
        let obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\n";
        let (_folder, path) = written("some.obj", obj);
        assert_eq!(mesh(&path).unwrap().triangles().len(), 2);
        assert!(mesh(Path::new("no-such.obj")).is_err());
    }
}
