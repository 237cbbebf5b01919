//! What has no minutes.

use ombra::city::{City, Extent, Facet};
use ombra::formats::{GlbMaterial, GlbMesh, GlbModel};

use super::rectangle;

/// The colour of buildings where it is not measured (linear), and how light it is: what looks up first, then walls from those that
/// look south-east to those that look north-west. Nothing is lit, lest minutes change their colours; so edges are seen all the same.
const BUILDING: [f32; 3] = [0.49, 0.45, 0.4];
const TONES: [f32; 5] = [1.0, 0.38, 0.5, 0.64, 0.8];
const GROUND: [f32; 3] = [0.87, 0.84, 0.79];

/// How far the ground goes beyond what stands on it, metres.
const MARGIN: f64 = 20.0;

/// All buildings and models, and the ground if it has no minutes.
pub(super) fn push(city: &City, is_ground: bool, model: &mut GlbModel) {
    let facets = city.facets();
    let first = model.materials.len();
    let mut meshes: Vec<GlbMesh> = (0..=TONES.len())
        .map(|tone| GlbMesh {
            name: match tone {
                0 => "roofs".to_owned(),
                _ if tone == TONES.len() => "terrain".to_owned(),
                _ => format!("walls {tone}"),
            },
            material: first + tone,
            ..GlbMesh::default()
        })
        .collect();
    let colours = TONES.map(|tone| BUILDING.map(|x| x * tone));
    let colours = colours.into_iter().chain([GROUND]);
    let materials = meshes
        .iter()
        .zip(colours)
        .map(|(mesh, [r, g, b])| GlbMaterial {
            name: mesh.name.clone(),
            colour: [r, g, b, 1.0],
            is_unlit: true,
            ..GlbMaterial::default()
        });
    model.materials.extend(materials);
    for facet in facets
        .iter()
        .filter(|facet| !(is_ground && facet.owner == Facet::TERRAIN))
    {
        let mesh = match facet.owner {
            Facet::TERRAIN => &mut meshes[TONES.len()],
            _ => &mut meshes[tone(facet)],
        };
        let [a, b, c, d] = facet.corners;
        super::push(mesh, &[a, b, c]);
        if !facet.is_triangle() {
            super::push(mesh, &[a, c, d]);
        }
    }
    if !is_ground && city.terrain.is_empty() {
        let corners = facets.iter().flat_map(|facet| facet.corners);
        let around = corners.map(|at| [at.x, at.y].map(f64::from));
        let Extent { low, high } = around.fold(Extent::NOWHERE, Extent::with);
        let corners = [low.map(|x| x - MARGIN), high.map(|x| x + MARGIN)];
        for corners in rectangle(corners, city.ground) {
            super::push(&mut meshes[TONES.len()], &corners);
        }
    }
    model.meshes.extend(meshes);
}

/// Which of [`TONES`] a polygon has.
fn tone(facet: &Facet) -> usize {
    let [a, b, c, _] = facet.corners;
    let normal = (b - a).cross(c - a);
    let level = normal.x.hypot(normal.y);
    if level <= normal.z.abs() {
        return 0;
    }
    // From -1 for what looks south-east to 1 for what looks north-west.
    let north_west = (normal.y - normal.x) / (level * std::f32::consts::SQRT_2);
    1 + ((2.0 * (north_west + 1.0)) as usize).min(3)
}
