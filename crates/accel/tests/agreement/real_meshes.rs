//! Meshes that somebody scanned or modelled, if they are there: see OMBRA_TEST_DATA.

use std::path::PathBuf;

use ombra_geometry::{Point3, TriangleMesh};

use crate::answers::assert_agreement;
use crate::{meshes, rays};

/// Reads the vertices and triangles of an OBJ file; `None`, and a line that says so, if it is not
/// there.
pub(crate) fn read(name: &str) -> Option<TriangleMesh> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data");
    let data = std::env::var_os("OMBRA_TEST_DATA").map_or_else(|| beside.into(), PathBuf::from);
    let path = data.join("render/mesh").join(name);
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!("skipped: {} is not there", path.display());
        return None;
    };
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let mut number = || words.next().unwrap().parse::<f32>().unwrap();
                positions.push(Point3::new(number(), number(), number()));
            }
            Some("f") => {
                let index = |word: &str| word.split('/').next().unwrap().parse::<u32>().unwrap();
                let corners: Vec<_> = words.map(|word| index(word) - 1).collect();
                triangles
                    .extend((2..corners.len()).map(|i| [corners[0], corners[i - 1], corners[i]]));
            }
            _ => {}
        }
    }
    Some(TriangleMesh::new(positions, triangles).unwrap())
}

#[test]
fn every_structure_agrees_with_brute_force_on_the_teapot() {
    if let Some(teapot) = read("teapot.obj") {
        let rays = rays::of_mesh(&teapot, 0.2);
        let hits = assert_agreement("teapot", &meshes::geometry(teapot), &rays);
        assert!(hits > 0);
    }
}

#[test]
fn every_structure_agrees_with_brute_force_on_the_bunny() {
    if let Some(bunny) = read("stanford-bunny.obj") {
        // Brute force has 69 451 triangles to test for every question: a few rays of each kind.
        let rays: Vec<_> = rays::of_mesh(&bunny, 0.03).into_iter().step_by(3).collect();
        let hits = assert_agreement("bunny", &meshes::geometry(bunny), &rays);
        assert!(hits > 0);
    }
}
