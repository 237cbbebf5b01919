//! Local shading: Phong's model without a ray to be traced.

use ombra_geometry::{Point3, Ray, TriangleMesh};
use ombra_scene::{Interaction, Material, Rgb, Scene};

use super::Raster;
use super::band::Nearest;
use super::bands::Item;
use super::facet::Fragment;
use super::presence::candidate;
use super::source::{Body, Form};
use crate::sampler::{Dimension, Sample};
use crate::shading::{self, Side};

impl Raster<'_> {
    /// The light that comes from what is seen in a pixel; `ray` is the one of the sample.
    pub(super) fn shade(&self, ray: &Ray, sample: &Sample, nearest: &Nearest) -> Rgb {
        let item = self.bands.item(nearest.item);
        let place = self.place(ray, item, &nearest.fragment);
        local(self.world.scene(), &place, self.material(item), sample)
    }

    fn material(&self, item: &Item) -> &Material {
        let scene = self.world.scene();
        &scene.materials[scene.objects[item.object as usize].material.index()]
    }

    /// What was drawn made into a place. The triangle of a mesh and a plane give the one that a ray
    /// gives; on a shape that was made into triangles the place and what it is like are interpolated
    /// between their corners.
    fn place(&self, ray: &Ray, item: &Item, fragment: &Fragment) -> Interaction {
        let object = &self.world.scene().objects[item.object as usize];
        let [u, v] = fragment.weights;
        if let Body::Shapes(forms) = &self.sources[item.object as usize].body
            && let Form::Triangles(mesh) = &forms[item.primitive as usize]
        {
            let [point, normal, uv] = interpolated(mesh, item.triangle as usize, [u, v]);
            let point = Point3::from(point);
            let uv = [uv[0] as f32, uv[1] as f32];
            return Interaction::of_surface(
                ray,
                point,
                normal.into(),
                uv,
                &object.world_from_object,
            );
        }
        let met = candidate(self.world, &self.view, ray, item, fragment);
        self.world.interaction(ray, &met.hit())
    }
}

/// What a place sends toward the viewer if nothing casts a shadow and nothing is mirrored: the local
/// term of `whitted` with every light in sight, which is all that can be known without rays. A light
/// source shows its emission and nothing else; what is transparent is as if it were not.
pub(crate) fn local(
    scene: &Scene,
    place: &Interaction,
    material: &Material,
    sample: &Sample,
) -> Rgb {
    let emission = material.emission_at(place.uv);
    if material.is_light_source() {
        return emission;
    }
    let diffuse = material.diffuse_at(place.object_point, place.uv) * place.tint;
    let mut radiance = scene.ambient * diffuse;
    if diffuse.is_black() && material.specular.is_black() {
        return emission + radiance;
    }
    let side = Side::of(place);
    for (index, light) in scene.lights.iter().enumerate() {
        // The numbers that the camera's ray has for the light: it is the first of its sample.
        let xi = || sample.nth_pair(Dimension::Light, 1, index as u32);
        if let Some(light) = light.sample_li(place.point, xi) {
            radiance += shading::scattered(material, diffuse, &side, place.wo, &light);
        }
    }
    emission + radiance
}

/// Position, normal and surface parameters (with a third of 0) at weights of the second and the third
/// corner, in double precision.
fn interpolated(mesh: &TriangleMesh, triangle: usize, [u, v]: [f64; 2]) -> [[f64; 3]; 3] {
    let corners = mesh.triangles()[triangle].map(|i| i as usize);
    let blend = |of: &dyn Fn(usize) -> [f32; 3]| {
        let [a, b, c] = corners.map(|i| of(i).map(f64::from));
        [0, 1, 2].map(|k| a[k] * (1.0 - u - v) + b[k] * u + c[k] * v)
    };
    let normal = |i: usize| mesh.normals().map_or([0.0; 3], |all| all[i].to_array());
    let uv = |i: usize| {
        mesh.uvs()
            .map_or([0.0; 3], |all| [all[i][0], all[i][1], 0.0])
    };
    [
        blend(&|i| mesh.positions()[i].to_array()),
        blend(&normal),
        blend(&uv),
    ]
}
