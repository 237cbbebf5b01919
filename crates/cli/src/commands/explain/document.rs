//! The tree with its names filled in: what `--json` writes, and reads again for `--diff`.
//!
//! The names of fields are documented in `docs/explain.md`; they change only with [`FORMAT`].

use ombra::accel::Geometry;
use ombra::geometry::Hit;
use ombra::geometry::shape::Shape;
use ombra::render::explain::{LightWay, Part, Place, RayKind, SampleTree, TracedRay};
use ombra::scene::{Light, Rgb, Scene};
use serde::{Deserialize, Serialize};

use super::number::{Number, numbers};

/// The version of the field names.
pub(crate) const FORMAT: u32 = 1;

/// What a tree belongs to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Heading {
    pub(crate) format: u32,
    /// The version of ombra.
    pub(crate) ombra: String,
    pub(crate) scene: String,
    pub(crate) scene_hash: String,
    pub(crate) integrator: String,
    pub(crate) accel: String,
    pub(crate) triangle_test: String,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) spp: u32,
    pub(crate) max_depth: u32,
    pub(crate) seed: u64,
    pub(crate) pixel: [u32; 2],
}

/// A whole file.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Document {
    #[serde(flatten)]
    pub(crate) heading: Heading,
    pub(crate) samples: Vec<Sample>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Sample {
    pub(crate) sample: u32,
    pub(crate) radiance: [Number; 3],
    pub(crate) rays: Vec<Ray>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Ray {
    pub(crate) ray: usize,
    pub(crate) parent: Option<usize>,
    pub(crate) kind: String,
    /// Of shadow rays.
    pub(crate) light: Option<usize>,
    pub(crate) step: u32,
    pub(crate) origin: [Number; 3],
    pub(crate) direction: [Number; 3],
    pub(crate) t_min: Number,
    pub(crate) t_max: Number,
    pub(crate) weight: [Number; 3],
    pub(crate) weight_in_pixel: [Number; 3],
    pub(crate) met: Option<Met>,
    pub(crate) crossed: Vec<Crossed>,
    pub(crate) emission: Option<[Number; 3]>,
    pub(crate) ambient: Option<[Number; 3]>,
    pub(crate) lights: Vec<Lit>,
    pub(crate) measured: Option<[Number; 3]>,
    pub(crate) absorbed: Option<Absorbed>,
    pub(crate) split: Option<Split>,
    pub(crate) end: String,
    pub(crate) radiance: [Number; 3],
    pub(crate) nodes_visited: u64,
    pub(crate) tests_made: u64,
}

/// Which surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct SurfaceName {
    pub(crate) object: usize,
    pub(crate) name: String,
    pub(crate) geometry: usize,
    pub(crate) shape: String,
    pub(crate) primitive: usize,
    pub(crate) material: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Met {
    #[serde(flatten)]
    pub(crate) surface: SurfaceName,
    pub(crate) side: String,
    pub(crate) t: Number,
    pub(crate) point: [Number; 3],
    pub(crate) normal: [Number; 3],
    pub(crate) shading_normal: [Number; 3],
    pub(crate) uv: [Number; 2],
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Crossed {
    #[serde(flatten)]
    pub(crate) surface: SurfaceName,
    pub(crate) t: Number,
    /// None of what is opaque.
    pub(crate) transmission: Option<[Number; 3]>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Lit {
    pub(crate) light: usize,
    pub(crate) kind: String,
    pub(crate) diffuse: [Number; 3],
    pub(crate) specular: [Number; 3],
    pub(crate) way: String,
    /// The shadow ray, if there is one.
    pub(crate) ray: Option<usize>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Absorbed {
    pub(crate) way: Number,
    pub(crate) left: [Number; 3],
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Split {
    pub(crate) eta: Number,
    pub(crate) mirrored: Number,
    pub(crate) total_internal_reflection: bool,
}

impl Sample {
    pub(crate) fn of(tree: &SampleTree, scene: &Scene) -> Self {
        let rays = tree.rays.iter().enumerate();
        Self {
            sample: tree.index,
            radiance: colour(tree.radiance),
            rays: rays
                .map(|(index, ray)| Ray::of(index, ray, scene))
                .collect(),
        }
    }
}

impl Ray {
    fn of(index: usize, ray: &TracedRay, scene: &Scene) -> Self {
        let mut emission = None;
        let mut ambient = None;
        let mut measured = None;
        let mut lights = Vec::new();
        for part in &ray.parts {
            match part {
                Part::Emission(light) => emission = Some(colour(*light)),
                Part::Ambient(light) => ambient = Some(colour(*light)),
                Part::Measured(what) => measured = Some(colour(*what)),
                Part::Light(part) => lights.push(Lit {
                    light: part.light,
                    kind: light_kind(scene, part.light).to_owned(),
                    diffuse: colour(part.diffuse),
                    specular: colour(part.specular),
                    way: light_way(part.way).to_owned(),
                    ray: match part.way {
                        LightWay::Ray(ray) => Some(ray),
                        _ => None,
                    },
                }),
                _ => {}
            }
        }
        Self {
            ray: index,
            parent: ray.parent,
            kind: ray.kind.name().to_owned(),
            light: match ray.kind {
                RayKind::Shadow { light } => Some(light),
                _ => None,
            },
            step: ray.step,
            origin: numbers(ray.ray.origin.to_array()),
            direction: numbers(ray.ray.direction.to_array()),
            t_min: Number(ray.ray.t_min),
            t_max: Number(ray.ray.t_max),
            weight: colour(ray.weight),
            weight_in_pixel: colour(ray.weight_in_pixel),
            met: ray.met.as_ref().map(|place| Met::of(place, scene)),
            crossed: ray
                .crossed
                .iter()
                .map(|crossing| Crossed {
                    surface: SurfaceName::of(&crossing.hit, scene),
                    t: Number(crossing.hit.t),
                    transmission: crossing.transmission.map(colour),
                })
                .collect(),
            emission,
            ambient,
            lights,
            measured,
            absorbed: ray.absorbed.map(|absorbed| Absorbed {
                way: Number(absorbed.way),
                left: colour(absorbed.left),
            }),
            split: ray.split.map(|split| Split {
                eta: Number(split.eta),
                mirrored: Number(split.mirrored),
                total_internal_reflection: split.total,
            }),
            end: ray.end.name().to_owned(),
            radiance: colour(ray.radiance),
            nodes_visited: ray.cost.nodes_visited,
            tests_made: ray.cost.tests_made,
        }
    }
}

impl Met {
    fn of(place: &Place, scene: &Scene) -> Self {
        Self {
            surface: SurfaceName::of(&place.hit, scene),
            side: if place.front { "front" } else { "back" }.to_owned(),
            t: Number(place.hit.t),
            point: numbers(place.point.to_array()),
            normal: numbers(place.normal.to_array()),
            shading_normal: numbers(place.shading_normal.to_array()),
            uv: numbers(place.uv),
        }
    }
}

impl SurfaceName {
    pub(crate) fn of(hit: &Hit, scene: &Scene) -> Self {
        let object = &scene.objects[hit.instance.index()];
        Self {
            object: hit.instance.index(),
            name: object.name.clone(),
            geometry: hit.geometry.index(),
            shape: shape(&scene.geometries[hit.geometry.index()], hit).to_owned(),
            primitive: hit.primitive.index(),
            material: scene.materials[object.material.index()].name.clone(),
        }
    }
}

fn colour(rgb: Rgb) -> [Number; 3] {
    numbers(rgb.to_array())
}

fn shape(geometry: &Geometry, hit: &Hit) -> &'static str {
    match geometry {
        Geometry::Mesh(_) => "mesh triangle",
        Geometry::Shapes(shapes) => match &shapes.0[hit.primitive.index()] {
            Shape::Sphere(_) => "sphere",
            Shape::Triangle(_) => "triangle",
            Shape::Plane(_) => "plane",
            Shape::Disk(_) => "disk",
            Shape::Rectangle(_) => "rectangle",
            Shape::Cylinder(_) => "cylinder",
            Shape::Cone(_) => "cone",
            Shape::Cuboid(_) => "box",
            Shape::OrientedBox(_) => "oriented box",
            Shape::Frustum(_) => "frustum",
            Shape::ConvexPolyhedron(_) => "polyhedron",
            Shape::Torus(_) => "torus",
            _ => "shape",
        },
    }
}

/// What kind of light it is.
pub(crate) fn light_kind(scene: &Scene, index: usize) -> &'static str {
    match scene.lights.get(index) {
        Some(Light::Point { .. }) => "point",
        Some(Light::Directional { .. }) => "directional",
        Some(Light::Spot { .. }) => "spot",
        Some(Light::Area { .. }) => "area",
        Some(Light::Luminous { .. }) => "luminous object",
        _ => "light",
    }
}

fn light_way(way: LightWay) -> &'static str {
    match way {
        LightWay::Ray(_) => "asked",
        LightWay::OutOfReach => "out of reach",
        LightWay::Behind => "behind the surface",
        LightWay::NothingScattered => "nothing scattered",
        LightWay::Unimportant => "unimportant",
    }
}
