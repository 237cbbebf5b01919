//! Blocks of houses in streets: what planes along the axes like.

use ombra::geometry::mesh::generate::cuboid;
use ombra::geometry::{Aabb, Point3, TriangleMesh};
use ombra::scene::Scene;

use super::{SceneFault, add, under_the_sun};

/// Every so many houses a street.
const BLOCK: u32 = 5;

/// With `(detail / 3)²` houses of 12 triangles, one at least.
pub(super) fn scene(detail: u32) -> Result<Scene, SceneFault> {
    let houses = (detail / 3).max(1);
    let width = houses as f32;
    let middle = Point3::new(width / 2.0, 0.0, width / 2.0);
    let from = Point3::new(width * 0.9, 6.0 + width * 0.12, width * 1.05);
    let mut scene = under_the_sun(from, middle)?;
    let ground = Aabb::around([
        Point3::new(-1.0, -0.2, -1.0),
        Point3::new(width + 1.0, 0.0, width + 1.0),
    ]);
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    let mut put = |bounds: &Aabb| {
        let mesh = cuboid(bounds);
        let first = positions.len() as u32;
        positions.extend_from_slice(mesh.positions());
        triangles.extend(mesh.triangles().iter().map(|t| t.map(|i| i + first)));
    };
    put(&ground);
    for (x, z) in (0..houses).flat_map(|x| (0..houses).map(move |z| (x, z))) {
        // Another height for each, from whole numbers alone.
        let tall = (x * 7 + z * 13 + x * z * 3) % 11;
        let high = if tall == 0 {
            9.0
        } else {
            1.0 + tall as f32 * 0.3
        };
        let near = |i: u32| i as f32 + if i.is_multiple_of(BLOCK) { 0.35 } else { 0.05 };
        let corner = Point3::new(near(x), 0.0, near(z));
        let far = Point3::new(x as f32 + 0.95, high, z as f32 + 0.95);
        put(&Aabb::around([corner, far]));
    }
    add(&mut scene, "city", TriangleMesh::new(positions, triangles)?);
    Ok(scene)
}
