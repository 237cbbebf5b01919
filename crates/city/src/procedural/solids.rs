//! Houses with pitched roofs, and a spire: closed but for the ground that they stand on.

use ombra_geometry::Point3;

use super::grid::Grid;
use super::lots::Rectangle;
use super::shapes::corners;
use crate::building::{Face, Faces, Part, Surface};

/// A house whose ridge runs along an axis of the grid (0 or 1). Eaves and ridge are in metres above
/// the ground.
pub(super) fn gabled(grid: &Grid, on: &Rectangle, [eaves, ridge]: [f64; 2], along: usize) -> Part {
    let mut ring = corners(on);
    // So that the first edge runs along the ridge.
    ring.rotate_left(along);
    let [a, b, c, d] = ring;
    let between = |p: [f64; 2], q: [f64; 2]| [0, 1].map(|k| 0.5 * (p[k] + q[k]));
    let (west, east) = (between(d, a), between(b, c));
    let at = |place: [f64; 2], z: f64| point(grid, place, z);
    let (low, up) = (
        [a, b, c, d].map(|p| at(p, 0.0)),
        [a, b, c, d].map(|p| at(p, eaves)),
    );
    let (west, east) = (at(west, ridge), at(east, ridge));
    closed(vec![
        (vec![low[0], low[1], up[1], up[0]], Surface::Wall),
        (vec![low[1], low[2], up[2], east, up[1]], Surface::Wall),
        (vec![low[2], low[3], up[3], up[2]], Surface::Wall),
        (vec![low[3], low[0], up[0], west, up[3]], Surface::Wall),
        (vec![up[0], up[1], east, west], Surface::Roof),
        (vec![up[2], up[3], west, east], Surface::Roof),
    ])
}

/// A shaft with a pyramid on it.
pub(super) fn spire(grid: &Grid, on: &Rectangle, [shaft, top]: [f64; 2]) -> Part {
    let tip = point(grid, on.middle(), top);
    let low = corners(on).map(|p| point(grid, p, 0.0));
    let up = corners(on).map(|p| point(grid, p, shaft));
    let sides = (0..4).flat_map(|k| {
        let next = (k + 1) % 4;
        [
            (vec![low[k], low[next], up[next], up[k]], Surface::Wall),
            (vec![up[k], up[next], tip], Surface::Roof),
        ]
    });
    closed(sides.collect())
}

fn point(grid: &Grid, place: [f64; 2], z: f64) -> Point3 {
    let [x, y] = grid.local(place);
    Point3::new(x, y, z as f32)
}

fn closed(faces: Vec<(Vec<Point3>, Surface)>) -> Part {
    let face = |(ring, surface)| Face {
        rings: vec![ring],
        surface,
    };
    Part::Faces(Faces {
        faces: faces.into_iter().map(face).collect(),
        is_closed: true,
    })
}
