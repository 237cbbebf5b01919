//! The same scene in more triangles, or in fewer.

use std::collections::HashMap;

use ombra_accel::{Geometry, Mesh, Shapes};
use ombra_geometry::{GeometryId, Normal3, Point3, TriangleMesh};
use ombra_scene::{Camera, Scene, World};

use crate::raster::{Drawable, Raster};
use crate::{RenderError, Settings};

/// How to change the number of triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    /// So many times each triangle is cut in four.
    Finer(u32),
    /// Keeps the first of so many.
    Every(usize),
}

impl Cut {
    fn apply(self, mesh: &TriangleMesh) -> TriangleMesh {
        match self {
            Self::Finer(times) => (0..times).fold(mesh.clone(), |mesh, _| cut_in_four(&mesh)),
            Self::Every(step) => {
                let some = mesh.triangles().iter().copied().step_by(step).collect();
                of(
                    mesh.positions().to_vec(),
                    some,
                    mesh.normals().map(<[_]>::to_vec),
                    mesh.uvs().map(<[_]>::to_vec),
                )
            }
        }
    }
}

/// The scene as the rasterizer draws it, in triangles and planes alone, and more or fewer of them.
pub(super) fn recut(
    world: &World,
    camera: &Camera,
    settings: &Settings,
    cut: Cut,
) -> Result<Scene, RenderError> {
    let raster = Raster::new(world, camera, settings)?;
    let old = world.scene();
    let mut scene = Scene {
        materials: old.materials.clone(),
        ..Scene::default()
    };
    // What several objects place is cut once.
    let mut meshes: HashMap<*const TriangleMesh, GeometryId> = HashMap::new();
    for (object, drawables) in old.objects.iter().zip(raster.drawables()) {
        for drawable in drawables {
            let geometry = match drawable {
                Drawable::Mesh(mesh) => {
                    *meshes.entry(std::ptr::from_ref(mesh)).or_insert_with(|| {
                        scene.add_geometry(Geometry::Mesh(Mesh::new(cut.apply(mesh))))
                    })
                }
                Drawable::Plane(plane) => {
                    scene.add_geometry(Geometry::Shapes(Shapes(vec![plane.into()])))
                }
            };
            let (name, material) = (object.name.clone(), object.material);
            scene.place_again(name, geometry, material, object.world_from_object);
        }
    }
    Ok(scene)
}

/// Each triangle in four by the middles of its edges; neighbours share them.
fn cut_in_four(mesh: &TriangleMesh) -> TriangleMesh {
    let mut positions = mesh.positions().to_vec();
    let mut normals = mesh.normals().map(<[Normal3]>::to_vec);
    let mut uvs = mesh.uvs().map(<[[f32; 2]]>::to_vec);
    let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
    let mut triangles = Vec::with_capacity(mesh.triangles().len() * 4);
    for &[a, b, c] in mesh.triangles() {
        let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[i, j]| {
            *middles.entry([i.min(j), i.max(j)]).or_insert_with(|| {
                let [i, j] = [i as usize, j as usize];
                positions.push(positions[i].lerp(positions[j], 0.5));
                if let Some(normals) = &mut normals {
                    normals.push((normals[i] + normals[j]) * 0.5);
                }
                if let Some(uvs) = &mut uvs {
                    uvs.push([0, 1].map(|k| f32::midpoint(uvs[i][k], uvs[j][k])));
                }
                positions.len() as u32 - 1
            })
        });
        triangles.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
    }
    of(positions, triangles, normals, uvs)
}

fn of(
    positions: Vec<Point3>,
    triangles: Vec<[u32; 3]>,
    normals: Option<Vec<Normal3>>,
    uvs: Option<Vec<[f32; 2]>>,
) -> TriangleMesh {
    let whole =
        "each vertex has what those that it comes from have, and each index is one of a vertex";
    let mut mesh = TriangleMesh::new(positions, triangles).expect(whole);
    if let Some(normals) = normals {
        mesh = mesh.with_normals(normals).expect(whole);
    }
    if let Some(uvs) = uvs {
        mesh = mesh.with_uvs(uvs).expect(whole);
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;
    use ombra_geometry::mesh::generate;

    #[test]
    fn a_finer_mesh_is_the_same_surface() {
        let sheet = generate::grid(Point3::ORIGIN, [4.0, 2.0], [3, 2]);
        let finer = Cut::Finer(2).apply(&sheet);
        assert_eq!(finer.triangles().len(), sheet.triangles().len() * 16);
        assert!((finer.area() - sheet.area()).abs() < 1e-5);
        assert_eq!(finer.bounds(), sheet.bounds());
        assert_eq!(finer.uvs().unwrap().len(), finer.positions().len());
        let ball = generate::icosphere(1, Point3::ORIGIN, 1.0);
        assert!(
            Cut::Finer(1).apply(&ball).is_closed(),
            "neighbours share middles"
        );
    }

    #[test]
    fn a_thinner_mesh_keeps_every_nth() {
        let sheet = generate::grid(Point3::ORIGIN, [4.0, 2.0], [3, 2]);
        let thin = Cut::Every(5).apply(&sheet);
        assert_eq!(thin.triangles(), [0, 5, 10].map(|i| sheet.triangles()[i]));
        assert_eq!(thin.uvs(), sheet.uvs());
    }
}
