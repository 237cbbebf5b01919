//! Whether what a ray meets is there: surfaces with one side, and with holes.

use ombra_accel::{Candidate, Geometry};
use ombra_geometry::shape::Surface as _;
use ombra_geometry::{Normal3, Ray};

use crate::Scene;

/// Whether the material of what was hit says that it is there: not a back face of a surface with one
/// side, and not in a hole.
pub(crate) fn is_there(scene: &Scene, ray: &Ray<f64>, candidate: &Candidate) -> bool {
    let object = &scene.objects[candidate.instance.index()];
    let material = &scene.materials[object.material.index()];
    if material.is_whole() {
        return true;
    }
    let geometry = &scene.geometries[candidate.geometry.index()];
    let primitive = candidate.primitive.index();
    if material.one_sided {
        // In the object's own space: a transform that mirrors turns the order in which corners are
        // met, but not the side that is outside.
        let ray = match &object.world_from_object {
            stays if stays.is_identity() => *ray,
            moved => moved.inverse().ray(ray),
        };
        let direction = ray.direction;
        let is_behind = match geometry {
            Geometry::Mesh(mesh) => {
                let normal = mesh.mesh().geometric_normal(primitive);
                normal.is_some_and(|n: Normal3<f64>| n.dot(direction) > 0.0)
            }
            Geometry::Shapes(shapes) => {
                shapes.0[primitive].leads_out(ray.at(candidate.t), direction)
            }
        };
        if is_behind {
            return false;
        }
    }
    material.cutout.as_ref().is_none_or(|cutout| {
        let uv = match geometry {
            Geometry::Mesh(mesh) => mesh.mesh().uv_at(primitive, candidate.u, candidate.v),
            Geometry::Shapes(_) => None,
        };
        let uv = uv.unwrap_or([candidate.u, candidate.v]);
        cutout.picture.alpha_at(uv) >= cutout.cutoff
    })
}
