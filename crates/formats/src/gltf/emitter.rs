//! Lights at surfaces that shine, for a file that has no other lights.
//!
//! Phong's shading is lit by lights without extent. A flat surface of the area A and the radiance L
//! that shines by Lambert's law has in the direction of its normal the intensity L A, and at an angle
//! to it that times the cosine: a spot light with an opening of 90° comes close. A closed surface
//! shines the same in all directions, L A / 4 (Cauchy: a quarter of the area of a convex body is what
//! of it is seen from anywhere, on average).

use std::f32::consts::FRAC_1_PI;

use ombra_geometry::{Angle, Object, Point3, Transform, TriangleMesh, Vector3, World};
use ombra_scene::light::Falloff;
use ombra_scene::{Light, Rgb};

/// More lights than these are not made: the strongest are.
const MOST: usize = 16;

/// A surface that shines.
pub(super) struct Emitter {
    /// The place of an object in the scene, for those that are chosen.
    pub(super) object: usize,
    light: Light,
    /// Whether its light is one that numbers can hold.
    pub(super) is_finite: bool,
    strength: f32,
}

/// The light of a mesh that shines with some radiance; `None` for one without area.
pub(super) fn emitter(
    object: usize,
    mesh: &TriangleMesh,
    radiance: Rgb,
    world_from_object: &Transform<Object, World>,
) -> Option<Emitter> {
    let mut area = 0.0;
    let mut normal = Vector3::<f64>::default();
    let mut centre = Vector3::<f64>::default();
    for triangle in 0..mesh.triangles().len() {
        let [a, b, c] = mesh
            .corners(triangle)
            .map(|p| world_from_object.point(p.wide()));
        let across = (b - a).cross(c - a) * 0.5;
        let size = across.length();
        area += size;
        normal += outward(across, mesh, triangle, world_from_object);
        centre += (a.to_vector() + b.to_vector() + c.to_vector()) * (size / 3.0);
    }
    if !(area > 0.0 && area.is_finite()) {
        return None;
    }
    let centre = Point3::<f64>::default() + centre * (1.0 / area);
    let flatness = normal.length() / area;
    let full = radiance * (area as f32 * FRAC_1_PI);
    let falloff = Falloff::InverseSquare;
    let light = if flatness > 0.5 {
        let direction = normal.normalized()?;
        // A little in front: the surface itself must not be in the way.
        let position = centre + direction * (1e-3 * area.sqrt());
        Light::Spot {
            position: position.cast(),
            direction: direction.cast(),
            inner: Angle::from_degrees(0.0),
            outer: Angle::from_degrees(90.0),
            intensity: full * flatness as f32,
            falloff,
        }
    } else {
        Light::Point {
            position: centre.cast(),
            intensity: full * 0.25,
            falloff,
        }
    };
    Some(Emitter {
        object,
        light,
        is_finite: full.to_array().iter().all(|c| c.is_finite()),
        strength: full.max_component(),
    })
}

/// The normal of a triangle with the length of its area, on the side that is outside in the space of
/// the object.
fn outward(
    across: Vector3<f64>,
    mesh: &TriangleMesh,
    triangle: usize,
    world_from_object: &Transform<Object, World>,
) -> Vector3<f64> {
    let outside = mesh.geometric_normal(triangle);
    let outside = outside.map(|normal| world_from_object.normal(normal));
    match outside {
        Some(outside) if outside.dot(across) < 0.0 => -across,
        _ => across,
    }
}

/// The strongest of some emitters as lights, with the objects that they are; how many were left out.
pub(super) fn strongest(mut emitters: Vec<Emitter>) -> (Vec<Light>, Vec<usize>, usize) {
    let left_out = emitters.len().saturating_sub(MOST);
    emitters.sort_by(|a, b| {
        b.strength
            .total_cmp(&a.strength)
            .then(a.object.cmp(&b.object))
    });
    emitters.truncate(MOST);
    let objects = emitters.iter().map(|emitter| emitter.object).collect();
    let lights = emitters.into_iter().map(|emitter| emitter.light).collect();
    (lights, objects, left_out)
}
