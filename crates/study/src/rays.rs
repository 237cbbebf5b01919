//! The rays of a study: four kinds that are hard in different ways.

use std::fmt;

use ombra::accel::Traversable as _;
use ombra::geometry::sampling::{cosine_hemisphere, uniform_sphere};
use ombra::geometry::{Aabb, Point3, Ray, Vector3};
use ombra::render::SamplerKind;
use ombra::render::sampler::{Dimension, Numbers};
use ombra::scene::camera::CameraSample;
use ombra::scene::{Interaction, World};
use serde::Serialize;

/// What rays are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Workload {
    /// From the camera through the middle of each pixel: neighbours go the same way.
    Primary,
    /// From where those end into a random direction over the surface, as light is scattered.
    Diffuse,
    /// From where those end to the lights: is anything in between?
    Shadow,
    /// From anywhere in the scene's box to anywhere: no ray has anything in common with the next.
    Random,
}

impl Workload {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Primary, Self::Diffuse, Self::Shadow, Self::Random];

    /// For people.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Primary => "primary",
            Self::Diffuse => "diffuse",
            Self::Shadow => "shadow",
            Self::Random => "random",
        }
    }

    /// Whether any hit answers the question; else it is the closest.
    #[must_use]
    pub const fn asks_any(self) -> bool {
        matches!(self, Self::Shadow)
    }
}

impl fmt::Display for Workload {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The rays of each kind, in the order of [`Workload::ALL`]. As many of each as the picture has
/// pixels; none where there is nowhere to start from.
pub(crate) fn all(world: &World, [width, height]: [u32; 2], seed: u64) -> [Vec<Ray>; 4] {
    let primary = primary(world, [width, height]);
    let count = primary.len();
    let mut hits = vec![None; count];
    world.intersect_many(&primary, &mut hits);
    let places: Vec<Interaction> = primary
        .iter()
        .zip(&hits)
        .filter_map(|(ray, hit)| Some(world.interaction(ray, hit.as_ref()?)))
        .collect();
    let numbers = |ray: usize| {
        let ray = ray as u64;
        Numbers::new(
            SamplerKind::Independent,
            seed,
            [ray as u32, (ray >> 32) as u32],
        )
    };
    let diffuse = diffuse(&places, count, numbers);
    let shadow = shadow(world, &places, count, numbers);
    let random = random(&world.finite_bounds(), count, numbers);
    [primary, diffuse, shadow, random]
}

fn primary(world: &World, [width, height]: [u32; 2]) -> Vec<Ray> {
    let aspect = width as f32 / height as f32;
    let camera = ombra::camera(world, aspect);
    let rays = camera.rays(aspect);
    let middle = |pixel: u32, of: u32| (pixel as f32 + 0.5) / of as f32;
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    pixels
        .map(|[x, y]| rays.ray(CameraSample::pinhole([middle(x, width), middle(y, height)])))
        .collect()
}

/// Places are used in their order, several times each where they are fewer than rays.
fn diffuse(places: &[Interaction], count: usize, numbers: impl Fn(usize) -> Numbers) -> Vec<Ray> {
    if places.is_empty() {
        return Vec::new();
    }
    let ray = |index: usize| {
        let place = &places[index * places.len() / count];
        let xi = numbers(index).sample(0).pair(Dimension::Hemisphere);
        let normal = place.normal.facing(-place.wo).to_vector();
        let (s, t) = normal.orthonormal_basis();
        let local: Vector3 = cosine_hemisphere(xi).cast();
        place.spawn(s * local.x + t * local.y + normal * local.z)
    };
    let rays = (0..count).map(ray);
    rays.filter(Ray::is_valid).collect()
}

/// The lights take turns. A renderer does not ask for one behind the surface, and neither do we.
fn shadow(
    world: &World,
    places: &[Interaction],
    count: usize,
    numbers: impl Fn(usize) -> Numbers,
) -> Vec<Ray> {
    /// How many places may be tried for a ray: most lights may be on the wrong side.
    const TRIES: usize = 8;
    let lights = &world.scene().lights;
    if places.is_empty() || lights.is_empty() {
        return Vec::new();
    }
    let ray = |index: usize| {
        let place = &places[index * places.len() / (count * TRIES)];
        let light = &lights[index % lights.len()];
        let xi = || numbers(index).sample(1).pair(Dimension::Light);
        let sample = light.sample_li(place.point, xi)?;
        let normal = place.normal.facing(-place.wo);
        let ray = place.spawn_within(sample.wi, sample.distance);
        (normal.dot(sample.wi) > 0.0 && ray.is_valid()).then_some(ray)
    };
    let found: Vec<Ray> = (0..count * TRIES).filter_map(ray).collect();
    let kept = found.len().min(count);
    (0..kept).map(|i| found[i * found.len() / kept]).collect()
}

fn random(bounds: &Aabb, count: usize, numbers: impl Fn(usize) -> Numbers) -> Vec<Ray> {
    if bounds.is_empty() {
        return Vec::new();
    }
    let (corner, extent) = (bounds.min, bounds.extent());
    let ray = |index: usize| {
        let sample = numbers(index).sample(2);
        let [x, y] = sample.pair(Dimension::Pixel);
        let [z, _] = sample.pair(Dimension::Lens);
        let along = Vector3::new(extent.x * x, extent.y * y, extent.z * z);
        let origin: Point3 = corner + along;
        Ray::new(
            origin,
            uniform_sphere(sample.pair(Dimension::Hemisphere)).cast(),
        )
    };
    (0..count).map(ray).collect()
}
