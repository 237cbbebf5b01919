//! The city as a model: what is measured on carries its minutes as a texture, the rest is plain.

mod faces;
mod plain;

use std::path::Path;

use ombra::city::{City, Extent, FaceChart, Grid};
use ombra::formats::raster::Shades;
use ombra::formats::{GlbMaterial, GlbMesh, GlbModel, GlbTexture};
use ombra::geometry::Point3;

use super::super::places::{Kind, Places};
use super::atlas::MOST;
use super::{Job, wrong_usage};

/// What has no minutes, and what lies outside of what was measured (sRGB), as on a map.
const NO_MINUTES: [u8; 3] = [186, 179, 170];
const OUTSIDE: [u8; 3] = [240, 237, 232];

/// Whether each face has a place on a texture.
pub(super) fn check(city: &City, places: &Places, cell: f64) {
    let Kind::Faces { kind, found } = &places.kind else {
        return;
    };
    let charts: Vec<FaceChart> = city.face_charts(*kind, cell).collect();
    let sizes = found.places.iter();
    let sizes = sizes.flat_map(|place| charts[place.face as usize].count);
    if let Some(size) = sizes.max().filter(|&size| size > MOST) {
        wrong_usage(&format!(
            "--glb: a face of {size} cells is more than a texture has ({MOST}); take larger cells"
        ));
    }
}

pub(super) fn write(job: &Job<'_>, path: &Path) -> anyhow::Result<()> {
    let shades = Shades::new(job.mapped(), &job.style());
    let mut model = GlbModel {
        up: Some([0.0, 0.0, 1.0]),
        ..GlbModel::default()
    };
    let is_ground = match &job.places.kind {
        Kind::Grid { grid, .. } => {
            ground(job, grid, &shades, &mut model);
            true
        }
        Kind::Faces { kind, found } => {
            let charts: Vec<FaceChart> =
                job.city.face_charts(*kind, job.args.places.cell).collect();
            faces::push(
                job.mapped(),
                &charts,
                &found.places,
                &shades,
                kind.name(),
                &mut model,
            );
            false
        }
        Kind::Points { .. } => unreachable!("refused before anything was measured"),
    };
    plain::push(job.city, is_ground, &mut model);
    model.write(path)?;
    let triangles: usize = model.meshes.iter().map(|mesh| mesh.triangles.len()).sum();
    job.talk
        .say(&format!("{}: {triangles} triangles", path.display()));
    Ok(())
}

/// The ground with the map on it: flat, or the terrain.
fn ground(job: &Job<'_>, grid: &Grid, shades: &Shades, model: &mut GlbModel) {
    let (city, minutes) = (job.city, job.mapped());
    let outside = job.places.outside(city, job.places.tiles.places().len());
    // Every so many cells one is shown.
    let step = grid.width.max(grid.height).div_ceil(MOST);
    let [width, height] = [grid.width, grid.height].map(|count| count.div_ceil(step));
    let shown = |k: u32, count: u32| (k * step + step / 2).min(count - 1) as usize;
    let pixels = (0..height).flat_map(|row| (0..width).map(move |column| [column, row]));
    let pixels = pixels.map(|[column, row]| {
        let cell = shown(row, grid.height) * grid.width as usize + shown(column, grid.width);
        match minutes[cell] {
            minutes if !minutes.is_nan() => shades.colour(minutes),
            _ if outside.get(cell).copied().unwrap_or(false) => OUTSIDE,
            _ => NO_MINUTES,
        }
    });
    let texture = GlbTexture {
        width,
        pixels: pixels.collect(),
    };
    let mut mesh = GlbMesh {
        name: "ground".to_owned(),
        material: model.materials.len(),
        ..GlbMesh::default()
    };
    model
        .materials
        .push(textured("minutes on the ground".to_owned(), texture));
    let [west, north] = grid.north_west();
    let metres = [width, height].map(|count| f64::from(count * step) * grid.cell);
    let on_map = |at: Point3| {
        let away = [f64::from(at.x) - west, north - f64::from(at.y)];
        [0, 1].map(|k| (away[k] / metres[k]).clamp(0.0, 1.0) as f32)
    };
    let sizes = [grid.width, grid.height].map(|count| f64::from(count) * grid.cell);
    let [low, high] = [[west, north - sizes[1]], [west + sizes[0], north]];
    let is_within = |corners: &[Point3; 3]| {
        let around = corners.map(|at| [at.x, at.y].map(f64::from));
        let around = around.into_iter().fold(Extent::NOWHERE, Extent::with);
        (0..2).all(|k| around.low[k] < high[k] && around.high[k] > low[k])
    };
    let triangles = if city.terrain.is_empty() {
        rectangle([low, high], city.ground)
    } else {
        city.terrain.iter().copied().filter(is_within).collect()
    };
    for corners in &triangles {
        push(&mut mesh, corners);
        mesh.texcoords.extend(corners.iter().map(|&at| on_map(at)));
    }
    model.meshes.push(mesh);
}

fn textured(name: String, texture: GlbTexture) -> GlbMaterial {
    GlbMaterial {
        name,
        colour: [1.0; 4],
        texture: Some(texture),
        is_unlit: true,
        ..GlbMaterial::default()
    }
}

/// From its south-western corner to its north-eastern one.
fn rectangle([low, high]: [[f64; 2]; 2], z: f32) -> Vec<[Point3; 3]> {
    let at = |x: f64, y: f64| Point3::new(x as f32, y as f32, z);
    let corners = [
        at(low[0], low[1]),
        at(high[0], low[1]),
        at(high[0], high[1]),
        at(low[0], high[1]),
    ];
    vec![
        [corners[0], corners[1], corners[2]],
        [corners[0], corners[2], corners[3]],
    ]
}

fn push(mesh: &mut GlbMesh, corners: &[Point3; 3]) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(corners.map(|at| at.to_array()));
    mesh.triangles.push([first, first + 1, first + 2]);
}
