//! Models that stand in a city: their triangles alone.

use std::path::Path;

use ombra_accel::Geometry;
use ombra_geometry::triangle::TriangleTest;
use ombra_geometry::{Point3, TriangleMesh};

use crate::error::FormatError;
use crate::finding::Finding;
use crate::gltf::{is_named, read_gltf};
use crate::limits::Limits;
use crate::mesh::read_model;

/// Which axis of a model points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Up {
    /// x is east, y up, z south, as glTF has it.
    Y,
    /// x is east, y north, z up.
    Z,
}

/// A model as [`City::add_model`](ombra_city::City::add_model) takes it.
#[derive(Clone, Debug)]
pub struct CityModel {
    /// Its triangles, x east, y north, z up, in the unit of the file.
    pub triangles: Vec<[Point3; 3]>,
    /// What its user should hear of.
    pub findings: Vec<Finding>,
}

/// Reads the triangles of an OBJ, PLY, STL, glTF or GLB file. Without `up`, y is up in glTF and z in all
/// others.
///
/// # Errors
/// As those of [`read_model`] and [`read_gltf`].
pub fn read_city_model(
    path: impl AsRef<Path>,
    up: Option<Up>,
    limits: &Limits,
) -> Result<CityModel, FormatError> {
    let path = path.as_ref();
    let mut triangles = Vec::new();
    let (findings, usual) = if is_named(path) {
        let file = read_gltf(path, TriangleTest::default(), limits)?;
        for object in &file.scene.objects {
            if let Geometry::Mesh(mesh) = &file.scene.geometries[object.geometry.index()] {
                let place = |p| object.world_from_object.point(p);
                triangles.extend(of_mesh(mesh.mesh()).map(|corners| corners.map(place)));
            }
        }
        (file.findings, Up::Y)
    } else {
        let model = read_model(path, limits)?;
        for part in &model.parts {
            triangles.extend(of_mesh(&part.mesh));
        }
        (model.findings, Up::Z)
    };
    if up.unwrap_or(usual) == Up::Y {
        for p in triangles.iter_mut().flatten() {
            *p = Point3::new(p.x, -p.z, p.y);
        }
    }
    Ok(CityModel {
        triangles,
        findings,
    })
}

fn of_mesh(mesh: &TriangleMesh) -> impl Iterator<Item = [Point3; 3]> {
    let corner = |index: u32| mesh.positions()[index as usize];
    (mesh.triangles().iter()).map(move |corners| corners.map(corner))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(name: &str, text: &str, up: Option<Up>) -> Result<CityModel, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        read_city_model(path, up, &Limits::default()).map_err(|error| error.to_string())
    }

    #[test]
    fn axes_are_those_of_the_format_or_those_asked_for() {
        let wall = "v 0 0 0\nv 4 0 0\nv 4 0 3\nf 1 2 3\n";
        let top = |up| written("a.obj", wall, up).unwrap().triangles[0][2].to_array();
        assert_eq!(top(None), [4.0, 0.0, 3.0]);
        assert_eq!(top(Some(Up::Z)), [4.0, 0.0, 3.0]);
        assert_eq!(top(Some(Up::Y)), [4.0, -3.0, 0.0]);
        let gltf = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
            "nodes":[{"mesh":0,"translation":[10,0,0]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,2,0]}],
            "bufferViews":[{"buffer":0,"byteLength":36}],
            "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAEAAAAAA"}]}"#;
        let model = written("a.gltf", gltf, None).unwrap();
        assert_eq!(
            model.triangles[0][2].to_array(),
            [11.0, 0.0, 2.0],
            "{:?}",
            model.findings
        );
    }

    #[test]
    fn what_is_no_model_is_told() {
        assert!(
            written("a.txt", "v 0 0 0", None)
                .unwrap_err()
                .contains("obj, ply, stl")
        );
        assert!(
            written("a.obj", "f 1 2 3\n", None)
                .unwrap_err()
                .contains("vertex")
        );
        assert!(
            written("a.obj", "v 0 0 0\n", None)
                .unwrap()
                .triangles
                .is_empty()
        );
    }
}
