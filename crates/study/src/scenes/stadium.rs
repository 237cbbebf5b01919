//! The teapot in a stadium, with a ball for the teapot: what a grid of equal cells cannot take.

use ombra::geometry::mesh::generate::{cuboid, icosphere, torus};
use ombra::geometry::{Aabb, Point3};
use ombra::scene::Scene;

use super::{SceneFault, add, under_the_sun};

/// A ball of about `detail²` triangles, and coarse surroundings.
pub(super) fn scene(detail: u32) -> Result<Scene, SceneFault> {
    let mut scene = under_the_sun(Point3::new(0.0, 1.8, 3.4), Point3::new(0.0, 0.7, 0.0))?;
    let wanted = u64::from(detail).pow(2);
    let cuts = (0..8).find(|&cuts| 20 << (2 * (cuts + 1)) > wanted);
    let centre = Point3::new(0.0, 1.0, 0.0);
    add(
        &mut scene,
        "ball",
        icosphere(cuts.unwrap_or(8), centre, 1.0),
    );
    let lawn = Aabb::around([
        Point3::new(-900.0, -10.0, -900.0),
        Point3::new(900.0, 0.0, 900.0),
    ]);
    add(&mut scene, "lawn", cuboid(&lawn));
    let stands = torus(Point3::ORIGIN, [1000.0, 150.0], [48, 12]);
    add(&mut scene, "stands", upright(stands)?);
    Ok(scene)
}

/// Turned so that its axis, which was z, is y.
fn upright(
    mesh: ombra::geometry::TriangleMesh,
) -> Result<ombra::geometry::TriangleMesh, ombra::geometry::MeshError> {
    let turned = mesh.positions().iter().map(|p| Point3::new(p.y, p.z, p.x));
    ombra::geometry::TriangleMesh::new(turned.collect(), mesh.triangles().to_vec())
}
