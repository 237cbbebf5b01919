//! Hills as a height field of triangles, and mirror balls above them.

use ombra_accel::{Geometry, Mesh, Shapes};
use ombra_geometry::shape::Sphere;
use ombra_geometry::{MeshError, Point3, Transform, TriangleMesh};
use ombra_scene::{Material, Rgb, Scene};

use super::balls::mirror;

/// With `2 · detail²` triangles.
pub(super) fn scene(detail: u32) -> Result<Scene, MeshError> {
    let mut scene = Scene::default();
    let hills = Geometry::Mesh(Mesh::new(hills(detail.max(1))?));
    let ground = Material::matt("ground", Rgb::new(0.4, 0.6, 0.3));
    scene.add("hills", hills, ground, Transform::identity());
    let ball = |x, y, z, r| Sphere::new(Point3::new(x, y, z), r).into();
    let balls = Shapes(vec![
        ball(-2.0, 1.0, 0.0, 1.0),
        ball(1.5, 0.8, 2.0, 0.8),
        ball(2.5, 1.5, -2.0, 1.2),
    ]);
    scene.add(
        "balls",
        Geometry::Shapes(balls),
        mirror(),
        Transform::identity(),
    );
    Ok(scene)
}

fn hills(detail: u32) -> Result<TriangleMesh, MeshError> {
    let row = detail + 1;
    let place = |i| 20.0 * (i as f32 / detail as f32 - 0.5);
    // Sums of products of small whole numbers only, no library function: the same everywhere.
    let bump = |x: f32| {
        let wave = (x * 0.7).rem_euclid(2.0) - 1.0;
        wave * wave * (2.0 - wave * wave)
    };
    let corner = |i| {
        let (x, z) = (place(i % row), place(i / row));
        let height = bump(x) * bump(z) + 0.2 * bump(3.0 * x + z) - 1.2;
        Point3::new(x, height, z)
    };
    let cells = (0..detail * detail).map(|i| i / detail * row + i % detail);
    let triangles = cells.flat_map(|i| [[i, i + row, i + 1], [i + 1, i + row, i + row + 1]]);
    TriangleMesh::new((0..row * row).map(corner).collect(), triangles.collect())
}
