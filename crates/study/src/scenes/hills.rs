//! A height field: what a grid likes.

use ombra::geometry::{MeshError, Point3, TriangleMesh};
use ombra::scene::Scene;

use super::{SceneFault, add, under_the_sun};

/// With `2 · detail²` triangles.
pub(super) fn scene(detail: u32) -> Result<Scene, SceneFault> {
    let mut scene = under_the_sun(Point3::new(0.0, 4.0, 9.5), Point3::new(0.0, 0.0, 0.0))?;
    add(&mut scene, "hills", hills(detail.max(1))?);
    Ok(scene)
}

fn hills(detail: u32) -> Result<TriangleMesh, MeshError> {
    let row = detail + 1;
    let place = |i| 20.0 * (i as f32 / detail as f32 - 0.5);
    // Sums and products only, no library function: the same everywhere.
    let bump = |x: f32| {
        let wave = x.rem_euclid(2.0) - 1.0;
        wave * wave * (2.0 - wave * wave)
    };
    let corner = |i| {
        let (x, z) = (place(i % row), place(i / row));
        let height = 1.6 * bump(0.31 * x) * bump(0.37 * z) + 0.25 * bump(1.1 * x + 0.7 * z);
        Point3::new(x, height, z)
    };
    let cells = (0..detail * detail).map(|i| i / detail * row + i % detail);
    let triangles = cells.flat_map(|i| [[i, i + row, i + 1], [i + 1, i + row, i + row + 1]]);
    TriangleMesh::new((0..row * row).map(corner).collect(), triangles.collect())
}
