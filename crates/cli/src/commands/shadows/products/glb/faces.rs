//! Roofs and façades, each with its cells on a part of a texture.

use std::collections::VecDeque;

use ombra::city::{FaceChart, FacePlace};
use ombra::formats::raster::Shades;
use ombra::formats::{GlbMesh, GlbModel};

use super::super::atlas::Atlas;
use super::{NO_MINUTES, textured};

/// The faces that have places, a pixel a cell.
pub(super) fn push(
    minutes: &[f32],
    charts: &[FaceChart],
    places: &[FacePlace],
    shades: &Shades,
    name: &str,
    model: &mut GlbModel,
) {
    let groups: Vec<&[FacePlace]> = places.chunk_by(|a, b| a.face == b.face).collect();
    let chart = |group: &[FacePlace]| &charts[group[0].face as usize];
    let sizes: Vec<[u32; 2]> = groups.iter().map(|group| chart(group).count).collect();
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
            super::push(mesh, corners);
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

#[cfg(test)]
mod tests {
    use ombra::accrual::OnFaces;
    use ombra::city::{FaceKind, demo_city};
    use ombra::formats::raster::MapStyle;
    use ombra::geometry::Point3;

    use super::*;

    /// The colour of the model where a triangle has a place, if it has it.
    fn seen(model: &GlbModel, mesh: &GlbMesh, triangle: [u32; 3], at: Point3) -> Option<[u8; 3]> {
        let corner = |k: usize| Point3::from(mesh.positions[triangle[k] as usize]);
        let (a, b, c) = (corner(0), corner(1), corner(2));
        let normal = (b - a).cross(c - a);
        let area = normal.length();
        if !((at - a).dot(normal).abs() <= 1e-3 * area) {
            return None;
        }
        let share = |p: Point3, q: Point3| (q - p).cross(at - p).dot(normal) / (area * area);
        let weights = [share(b, c), share(c, a), share(a, b)];
        if weights.iter().any(|&weight| weight < -1e-4) {
            return None;
        }
        let coordinate = |axis: usize| -> f32 {
            let of = |k: usize| weights[k] * mesh.texcoords[triangle[k] as usize][axis];
            of(0) + of(1) + of(2)
        };
        let texture = model.materials[mesh.material].texture.as_ref().unwrap();
        let height = texture.pixels.len() / texture.width as usize;
        let column = (coordinate(0) * texture.width as f32) as usize;
        let row = (coordinate(1) * height as f32) as usize;
        Some(texture.pixels[row * texture.width as usize + column])
    }

    #[test]
    fn every_place_has_the_colour_of_its_minutes() {
        let city = demo_city();
        for kind in [FaceKind::Facade, FaceKind::Roof] {
            let within = |[x, y]: [f64; 2]| x.abs() < 130.0 && y.abs() < 130.0;
            let found = OnFaces::of(&city, kind, 3.0, within).unwrap();
            let minutes: Vec<f32> = (0..found.places.len())
                .map(|k| (k * 37 % 601) as f32)
                .collect();
            let shades = Shades::new(&minutes, &MapStyle::default());
            let charts: Vec<FaceChart> = city.face_charts(kind, 3.0).collect();
            let mut model = GlbModel::default();
            push(&minutes, &charts, &found.places, &shades, "", &mut model);
            assert!(found.places.len() > 500);
            for (place, &minutes) in found.places.iter().zip(&minutes) {
                let all = model
                    .meshes
                    .iter()
                    .flat_map(|mesh| mesh.triangles.iter().map(move |&triangle| (mesh, triangle)));
                let mut colours =
                    all.filter_map(|(mesh, triangle)| seen(&model, mesh, triangle, place.at));
                // Faces in one plane may lie on one another: one of them is its own.
                assert!(
                    colours.any(|colour| colour == shades.colour(minutes)),
                    "{place:?}"
                );
            }
        }
    }
}
