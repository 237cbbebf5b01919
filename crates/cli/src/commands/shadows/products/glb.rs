//! The city as a model: what is measured on carries its minutes as a texture, the rest is plain.

use std::collections::VecDeque;
use std::path::Path;

use ombra::city::{City, Extent, FaceChart, FacePlace, Facet, Grid};
use ombra::formats::raster::Shades;
use ombra::formats::{GlbMaterial, GlbMesh, GlbModel, GlbTexture};
use ombra::geometry::Point3;

use super::super::places::Kind;
use super::atlas::{Atlas, MOST};
use super::{Job, wrong_usage};

/// What has no minutes (sRGB), and the colours of what is not measured on (linear).
const NO_MINUTES: [u8; 3] = [186, 179, 170];
const BUILDING: [f32; 4] = [0.49, 0.45, 0.4, 1.0];
const GROUND: [f32; 4] = [0.87, 0.84, 0.79, 1.0];

/// How far the ground goes beyond what stands on it, metres.
const MARGIN: f64 = 20.0;

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
            faces(
                job,
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
    plain(job.city, is_ground, &mut model);
    model.write(path)?;
    let triangles: usize = model.meshes.iter().map(|mesh| mesh.triangles.len()).sum();
    job.talk
        .say(&format!("{}: {triangles} triangles", path.display()));
    Ok(())
}

/// The faces that have places, a pixel a cell.
fn faces(
    job: &Job<'_>,
    charts: &[FaceChart],
    places: &[FacePlace],
    shades: &Shades,
    name: &str,
    model: &mut GlbModel,
) {
    let minutes = job.mapped();
    let groups: Vec<&[FacePlace]> = places.chunk_by(|a, b| a.face == b.face).collect();
    let chart = |group: &[FacePlace]| &charts[group[0].face as usize];
    let sizes: Vec<[u32; 2]> = groups.iter().map(|group| chart(group).count).collect();
    if let Some(size) = sizes.iter().flatten().find(|&&size| size > MOST) {
        wrong_usage(&format!(
            "--glb: a face of {size} cells is more than a texture has ({MOST}); take larger cells"
        ));
    }
    let mut atlas = Atlas::new(&sizes, NO_MINUTES);
    let first = model.materials.len();
    let mut meshes: Vec<GlbMesh> = (0..atlas.pages.len())
        .map(|page| GlbMesh {
            name: format!("{name}s {page}"),
            material: first + page,
            ..GlbMesh::default()
        })
        .collect();
    let mut index = 0;
    for (picture, group) in groups.iter().enumerate() {
        let (chart, size) = (chart(group), sizes[picture]);
        let values = &minutes[index..index + group.len()];
        index += group.len();
        for (cell, colour) in colours(chart, group, values, shades) {
            // Rows of pictures come from the top.
            atlas.set(picture, [cell[0], size[1] - 1 - cell[1]], colour);
        }
        let mesh = &mut meshes[atlas.slots[picture].page];
        for (corners, cells) in chart.triangles.iter().zip(&chart.in_cells) {
            push(mesh, corners);
            let rows = f64::from(size[1]);
            let on_page = |&[u, v]: &[f64; 2]| atlas.texcoord(picture, size, [u, rows - v]);
            mesh.texcoords.extend(cells.iter().map(on_page));
        }
    }
    for (page, texture) in atlas.pages.into_iter().enumerate() {
        model
            .materials
            .push(textured(format!("minutes on {name}s {page}"), texture));
    }
    model.meshes.extend(meshes);
}

/// The colours of all cells of a face. A cell whose middle lies beside the face has that of the nearest one that has any, since a
/// part of it may be seen; one whose place is hidden has none.
fn colours(
    chart: &FaceChart,
    places: &[FacePlace],
    minutes: &[f32],
    shades: &Shades,
) -> Vec<([u32; 2], [u8; 3])> {
    let [columns, rows] = chart.count;
    let index = |cell: [u32; 2]| (cell[1] * columns + cell[0]) as usize;
    let mut all = vec![None; columns as usize * rows as usize];
    for &cell in &chart.cells {
        all[index(cell)] = Some(NO_MINUTES);
    }
    for (place, &minutes) in places
        .iter()
        .zip(minutes)
        .filter(|(_, minutes)| !minutes.is_nan())
    {
        all[index(place.cell)] = Some(shades.colour(minutes));
    }
    let cells = |k: usize| [k as u32 % columns, k as u32 / columns];
    let known = (0..all.len()).filter(|&k| all[k].is_some());
    let mut front: VecDeque<usize> = known.collect();
    while let Some(k) = front.pop_front() {
        let [column, row] = cells(k);
        let around = [
            [column.wrapping_sub(1), row],
            [column + 1, row],
            [column, row.wrapping_sub(1)],
            [column, row + 1],
        ];
        for next in around
            .into_iter()
            .filter(|next| next[0] < columns && next[1] < rows)
        {
            if all[index(next)].is_none() {
                all[index(next)] = all[k];
                front.push_back(index(next));
            }
        }
    }
    let colours = all.into_iter().enumerate();
    colours
        .map(|(k, colour)| (cells(k), colour.unwrap_or(NO_MINUTES)))
        .collect()
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

/// What lies outside of what was measured, as on a map.
const OUTSIDE: [u8; 3] = [240, 237, 232];

/// All buildings and models, and the ground if it has no minutes.
fn plain(city: &City, is_ground: bool, model: &mut GlbModel) {
    let material = model.materials.len();
    for (name, colour) in [("buildings", BUILDING), ("terrain", GROUND)] {
        model.materials.push(GlbMaterial {
            name: name.to_owned(),
            colour,
            ..GlbMaterial::default()
        });
    }
    let facets = city.facets();
    let mut buildings = GlbMesh {
        name: "buildings".to_owned(),
        material,
        ..GlbMesh::default()
    };
    let mut ground = GlbMesh {
        name: "terrain".to_owned(),
        material: material + 1,
        ..GlbMesh::default()
    };
    for facet in &facets {
        let mesh = match facet.owner {
            Facet::TERRAIN if is_ground => continue,
            Facet::TERRAIN => &mut ground,
            _ => &mut buildings,
        };
        let [a, b, c, d] = facet.corners;
        push(mesh, &[a, b, c]);
        if !facet.is_triangle() {
            push(mesh, &[a, c, d]);
        }
    }
    if !is_ground && city.terrain.is_empty() {
        let corners = facets.iter().flat_map(|facet| facet.corners);
        let around = corners.map(|at| [at.x, at.y].map(f64::from));
        let Extent { low, high } = around.fold(Extent::NOWHERE, Extent::with);
        let corners = [low.map(|x| x - MARGIN), high.map(|x| x + MARGIN)];
        for corners in rectangle(corners, city.ground) {
            push(&mut ground, &corners);
        }
    }
    model.meshes.extend([buildings, ground]);
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
