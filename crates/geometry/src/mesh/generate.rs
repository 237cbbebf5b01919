//! Meshes by formula, for tests and examples. All wind counter-clockwise seen from outside, share
//! their vertices and, but for the grid, are closed.

use std::collections::HashMap;
use std::f64::consts::PI;

use crate::{Aabb, Point3, TriangleMesh, Vector3};

/// A ball: an icosahedron whose triangles are cut in four, `subdivisions` times, each new vertex
/// lifted to the sphere. 20 · 4ⁿ triangles.
///
/// # Panics
/// When `subdivisions` is above 12, which would be more triangles than an index can name.
#[must_use]
pub fn icosphere(subdivisions: u32, centre: Point3, radius: f32) -> TriangleMesh {
    assert!(subdivisions <= 12, "an icosphere is cut 12 times at most");
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    // The corners of three golden rectangles, one across each axis.
    let mut points: Vec<Vector3<f64>> = Vec::new();
    for (short, long) in [
        (1.0, golden),
        (-1.0, golden),
        (1.0, -golden),
        (-1.0, -golden),
    ] {
        points.push(Vector3::new(short, long, 0.0));
        points.push(Vector3::new(0.0, short, long));
        points.push(Vector3::new(long, 0.0, short));
    }
    let mut triangles = hull_of_near(&points, 2.1);
    points = points.into_iter().map(unit).collect();
    for _ in 0..subdivisions {
        let mut middles = HashMap::new();
        let mut finer = Vec::with_capacity(triangles.len() * 4);
        for [a, b, c] in triangles {
            let mut middle = |i: u32, j: u32| {
                *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
                    points.push(unit(points[i as usize] + points[j as usize]));
                    points.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    let place = |p: Vector3<f64>| centre.wide() + p * f64::from(radius);
    of(points.into_iter().map(place), triangles)
}

/// A box of 12 triangles and 8 vertices.
#[must_use]
pub fn cuboid(bounds: &Aabb) -> TriangleMesh {
    // Bit k of an index chooses the far side on axis k.
    let sides = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let triangles = sides
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    of(bounds.corners().map(Point3::wide), triangles.collect())
}

/// A flat sheet in the plane z = `corner.z`, facing +z: from `corner` along +x and +y, `cells` cells
/// of two triangles each way, with texture coordinates from 0 to 1.
#[must_use]
pub fn grid(corner: Point3, size: [f32; 2], cells: [u32; 2]) -> TriangleMesh {
    let [columns, rows] = cells.map(|n| n.max(1));
    let vertices = (0..=rows).flat_map(|j| (0..=columns).map(move |i| (i, j)));
    let part = |(i, j)| [i as f32 / columns as f32, j as f32 / rows as f32];
    let uvs: Vec<_> = vertices.map(part).collect();
    let place = |&[u, v]: &[f32; 2]| {
        Point3::new(corner.x + u * size[0], corner.y + v * size[1], corner.z).wide()
    };
    let at = |i, j| j * (columns + 1) + i;
    let cell = |(i, j)| {
        let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        let [a, b, c, d] = corners;
        [[a, b, c], [a, c, d]]
    };
    let triangles = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    let mesh = of(uvs.iter().map(place), triangles.flat_map(cell).collect());
    TriangleMesh {
        uvs: Some(uvs),
        ..mesh
    }
}

/// A ring around the z axis: a tube of radius `minor` whose middle is `major` from the centre, cut
/// into `around` pieces around the axis and `along` around the tube (3 at least).
#[must_use]
pub fn torus(centre: Point3, [major, minor]: [f32; 2], [around, along]: [u32; 2]) -> TriangleMesh {
    let (around, along) = (around.max(3), along.max(3));
    let angle = |i: u32, n: u32| 2.0 * PI * f64::from(i) / f64::from(n);
    let place = |(i, j)| {
        let ((sin_a, cos_a), (sin_t, cos_t)) =
            (angle(i, around).sin_cos(), angle(j, along).sin_cos());
        let out = f64::from(major) + f64::from(minor) * cos_t;
        centre.wide() + Vector3::new(out * cos_a, out * sin_a, f64::from(minor) * sin_t)
    };
    let at = |i, j| (i % around) * along + j % along;
    let piece = |(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let pieces = (0..around).flat_map(|i| (0..along).map(move |j| (i, j)));
    of(pieces.clone().map(place), pieces.flat_map(piece).collect())
}

/// The triangles of three points each nearer than `near` to both others, seen from outside.
fn hull_of_near(points: &[Vector3<f64>], near: f64) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    let close = |i: usize, j: usize| (points[i] - points[j]).length() < near;
    for i in 0..points.len() {
        for j in i + 1..points.len() {
            for k in j + 1..points.len() {
                if close(i, j) && close(j, k) && close(k, i) {
                    let outward = points[i].dot(points[j].cross(points[k])) > 0.0;
                    let (j, k) = if outward { (j, k) } else { (k, j) };
                    triangles.push([i, j, k].map(|index| index as u32));
                }
            }
        }
    }
    triangles
}

fn unit(v: Vector3<f64>) -> Vector3<f64> {
    v / v.length()
}

/// The mesh of points, rounded to single precision. The indices are those that were just made.
fn of(points: impl IntoIterator<Item = Point3<f64>>, triangles: Vec<[u32; 3]>) -> TriangleMesh {
    TriangleMesh {
        positions: points.into_iter().map(Point3::cast).collect(),
        triangles,
        normals: None,
        uvs: None,
        colours: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six times the volume inside, positive if triangles wind counter-clockwise.
    fn volume(mesh: &TriangleMesh) -> f64 {
        let cone = |i| {
            let [a, b, c] = mesh.corners(i).map(|p| p.wide().to_vector());
            a.dot(b.cross(c)) / 6.0
        };
        (0..mesh.triangles().len()).map(cone).sum()
    }

    #[test]
    fn balls_are_closed_and_approach_the_sphere() {
        for (subdivisions, triangles, off) in [(0, 20, 0.4), (1, 80, 0.13), (3, 1280, 0.01)] {
            let ball = icosphere(subdivisions, Point3::ORIGIN, 2.0);
            assert_eq!(ball.triangles().len(), triangles);
            assert!(ball.is_closed());
            let full = 32.0 * PI / 3.0;
            assert!((1.0 - volume(&ball) / full) < off && volume(&ball) < full);
        }
    }

    #[test]
    fn boxes_and_rings_are_closed_and_face_outward() {
        let bounds = Aabb::around([Point3::new(-1.0_f32, 0.0, 2.0), Point3::new(1.0, 3.0, 4.0)]);
        let solid = cuboid(&bounds);
        assert!(solid.is_closed());
        assert!((volume(&solid) - 12.0).abs() < 1e-12);
        assert!((solid.area() - 32.0).abs() < 1e-12);

        let ring = torus(Point3::ORIGIN, [2.0, 0.5], [64, 32]);
        assert!(ring.is_closed());
        let full = 2.0 * PI * PI * 2.0 * 0.25;
        assert!((volume(&ring) / full - 1.0).abs() < 0.02);
        assert!(torus(Point3::ORIGIN, [2.0, 0.5], [0, 0]).is_closed());
    }

    #[test]
    fn a_grid_is_flat_and_faces_up() {
        let sheet = grid(Point3::new(1.0, 2.0, 3.0), [4.0, 2.0], [8, 2]);
        assert_eq!(sheet.triangles().len(), 32);
        assert!((sheet.area() - 8.0).abs() < 1e-6);
        for i in 0..32 {
            assert_eq!(
                sheet.geometric_normal(i).unwrap().to_array(),
                [0.0, 0.0, 1.0]
            );
        }
        assert_eq!(grid(Point3::ORIGIN, [1.0; 2], [0, 0]).triangles().len(), 2);
        assert_eq!(sheet.uvs().unwrap().last(), Some(&[1.0, 1.0]));
    }
}
