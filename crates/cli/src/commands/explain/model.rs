//! The scene with the rays of a pixel as a model, to be walked around in any viewer.

use ombra::formats::{GlbMaterial, GlbMesh, GlbModel};
use ombra::geometry::{Aabb, Point3};
use ombra::render::explain::{RayKind, SampleTree};
use ombra::scene::{Material, Rgb, Scene, Texture};

use super::path::{Path, paths};
use super::solid::Solids;

/// Sides of the tube that stands for a ray.
const SIDES: u32 = 6;

/// The thickness of a ray, and the tolerance of curved shapes, as shares of the size of what is shown.
const THICKNESS: f64 = 1.5e-3;
const TOLERANCE: f64 = 5e-4;

/// Kinds of rays with the colours that they have in the drawing, too.
const KINDS: [(&str, [f32; 3]); 5] = [
    ("camera", [0.02, 0.02, 0.02]),
    ("reflected", [0.54, 0.01, 0.10]),
    ("transmitted", [0.01, 0.13, 0.53]),
    ("shadow", [0.63, 0.24, 0.0]),
    ("occlusion", [0.03, 0.20, 0.03]),
];

/// The model of a scene and of the rays of some samples.
pub(crate) fn model(scene: &Scene, samples: &[SampleTree]) -> GlbModel {
    let (paths, _) = paths(samples);
    let shown = shown(scene, &paths);
    let size = shown.extent().length();
    let mut materials: Vec<_> = scene.materials.iter().map(material).collect();
    let first_kind = materials.len();
    materials.extend(KINDS.map(|(name, colour)| GlbMaterial {
        name: format!("{name} rays"),
        colour: [0.0, 0.0, 0.0, 1.0],
        emission: colour,
        ..GlbMaterial::default()
    }));
    let solids = Solids {
        scene,
        tolerance: TOLERANCE * size,
        reach: shown,
    };
    let mut meshes: Vec<_> = (0..scene.objects.len())
        .map(|index| {
            let solid = solids.of(index);
            let object = &scene.objects[index];
            let mut mesh = GlbMesh {
                name: object.name.clone(),
                material: object.material.index(),
                ..GlbMesh::default()
            };
            let single = |point: &Point3<f64>| point.cast::<f32>().to_array();
            mesh.positions = solid.points.iter().map(single).collect();
            let finite =
                |&&index: &&u32| mesh.positions[index as usize].iter().all(|x| x.is_finite());
            let whole = |triangle: &&[u32; 3]| triangle.iter().filter(finite).count() == 3;
            mesh.triangles = solid.triangles.iter().filter(whole).copied().collect();
            // A vertex that no triangle uses must be finite all the same.
            for x in mesh
                .positions
                .iter_mut()
                .flatten()
                .filter(|x| !x.is_finite())
            {
                *x = 0.0;
            }
            mesh
        })
        .collect();
    for path in &paths {
        let kind = KINDS.iter().position(|(name, _)| *name == path.kind.name());
        let mut mesh = tube(path, size);
        mesh.material = first_kind + kind.unwrap_or(0);
        meshes.push(mesh);
    }
    GlbModel {
        materials,
        meshes,
        up: Some(scene.up.to_array()),
    }
}

/// What the model is to show: the ends of the rays, and objects that have an end.
fn shown(scene: &Scene, paths: &[Path]) -> Aabb<f64> {
    let ends = paths.iter().flat_map(|path| {
        let end = path.to.filter(|_| path.met);
        std::iter::once(path.from).chain(end)
    });
    let mut shown = Aabb::around(ends.filter(|end| end.is_finite()));
    let around_rays = shown.extent().length().max(1e-6);
    for index in 0..scene.objects.len() {
        if let Some(bounds) = super::drawing::object_bounds(scene, index)
            && bounds.extent().length() < 100.0 * around_rays
        {
            shown = shown.union(bounds);
        }
    }
    if shown.is_empty() {
        shown = Aabb::around([Point3::new(0.0, 0.0, 0.0)]);
    }
    shown.padded(1e-3 * around_rays)
}

fn material(material: &Material) -> GlbMaterial {
    let Rgb { r, g, b } = match &material.diffuse {
        Texture::Constant(colour) => *colour,
        Texture::Checker {
            colours: [one, other],
            ..
        } => (*one + *other) * 0.5,
        _ => Rgb::grey(0.6),
    };
    // Mirrors and glass have little colour of their own; here they are to be seen.
    let mirror = material.reflection * 0.6;
    let transparent = !material.transmission.is_black();
    let opacity = if transparent { 0.25 } else { 1.0 };
    let glass = if transparent { 0.7 } else { 0.0 };
    GlbMaterial {
        name: material.name.clone(),
        colour: [
            r + mirror.r + glass,
            g + mirror.g + glass,
            b + mirror.b + glass,
            opacity,
        ],
        emission: material.emission.to_array(),
        ..GlbMaterial::default()
    }
}

/// A ray as a tube with a pointed end; one that goes on for ever is as long as what is shown.
fn tube(path: &Path, size: f64) -> GlbMesh {
    let blocked = if path.blocked { ", blocked" } else { "" };
    let name = match path.kind {
        RayKind::Shadow { light } => format!("ray {} shadow, light {light}{blocked}", path.name),
        kind => format!("ray {} {}{blocked}", path.name, kind.name()),
    };
    let end = path.to.filter(|end| end.is_finite());
    let end = end.unwrap_or(path.from + path.along * size);
    let thickness = match path.kind {
        kind if kind.is_question() => 0.5,
        _ => 0.6 + 0.8 * f64::from(path.weight.clamp(0.0, 1.0)).sqrt(),
    };
    let radius = thickness * THICKNESS * size;
    let length = (end - path.from).length();
    let neck = end + path.along * -(6.0 * radius).min(0.5 * length);
    let (s, t) = path.along.orthonormal_basis();
    let mut mesh = GlbMesh {
        name,
        ..GlbMesh::default()
    };
    let mut add = |point: Point3<f64>| mesh.positions.push(point.cast::<f32>().to_array());
    for (centre, radius) in [(path.from, radius), (neck, radius), (neck, 2.5 * radius)] {
        for i in 0..SIDES {
            let turn = std::f64::consts::TAU * f64::from(i) / f64::from(SIDES);
            let (sin, cos) = turn.sin_cos();
            add(centre + s * (cos * radius) + t * (sin * radius));
        }
    }
    add(path.from);
    add(end);
    let (start, tip) = (3 * SIDES, 3 * SIDES + 1);
    for i in 0..SIDES {
        let j = (i + 1) % SIDES;
        mesh.triangles.push([start, j, i]);
        for ring in [0, SIDES] {
            let (below, above) = (ring, ring + SIDES);
            mesh.triangles.push([below + i, below + j, above + j]);
            mesh.triangles.push([below + i, above + j, above + i]);
        }
        mesh.triangles.push([2 * SIDES + i, 2 * SIDES + j, tip]);
    }
    if mesh.positions.iter().flatten().any(|x| !x.is_finite()) {
        mesh.triangles.clear();
    }
    mesh
}
