//! What covers a pixel as a ray would have met it, and whether that is there: surfaces with one side,
//! and with holes.

use ombra_accel::{Candidate, Geometry};
use ombra_geometry::shape::Surface as _;
use ombra_geometry::{InstanceId, PrimitiveId, Ray};
use ombra_scene::World;

use super::bands::Item;
use super::facet::Fragment;
use super::view::View;
use crate::exposure::Exposure;

/// Asks the world, which decides for rays too, about what covers a pixel.
pub(super) struct PresenceTest<'a> {
    pub(super) world: &'a World,
    pub(super) view: &'a View,
    pub(super) exposure: &'a Exposure<'a>,
    /// Which sample of each pixel.
    pub(super) sample: u32,
}

impl PresenceTest<'_> {
    /// Whether all of an item is there, from both sides: its fragments need not be asked about.
    pub(super) fn is_whole(&self, item: &Item) -> bool {
        let scene = self.world.scene();
        let object = &scene.objects[item.object as usize];
        scene.materials[object.material.index()].is_whole()
    }

    /// Whether a fragment is there for the ray of the sample of its pixel.
    pub(super) fn is_there(&self, item: &Item, pixel: [u32; 2], fragment: &Fragment) -> bool {
        let sample = self.exposure.sample(pixel, self.sample);
        let ray = self.exposure.ray(pixel, &sample);
        let candidate = candidate(self.world, self.view, &ray, item, fragment);
        self.world.is_there(&ray.into(), &candidate)
    }
}

/// A fragment of a mesh or of a shape as a ray through its pixel would have met it.
pub(super) fn candidate(
    world: &World,
    view: &View,
    ray: &Ray,
    item: &Item,
    fragment: &Fragment,
) -> Candidate {
    let scene = world.scene();
    let object = &scene.objects[item.object as usize];
    let t = view.along(ray, fragment.depth);
    let [u, v] = match &scene.geometries[object.geometry.index()] {
        Geometry::Mesh(_) => fragment.weights.map(|weight| weight as f32),
        // Triangles that stand for a shape have weights of their own; a plane has none.
        Geometry::Shapes(shapes) => {
            let on_ray = Ray::<f64>::from(*ray).at(t);
            let point = object.world_from_object.inverse().point(on_ray);
            shapes.0[item.primitive as usize].surface_at(point).uv
        }
    };
    Candidate {
        t,
        u,
        v,
        primitive: PrimitiveId(item.primitive),
        geometry: object.geometry,
        instance: InstanceId(item.object),
    }
}
