//! What the surface of a mesh is like: normals, texture coordinates, area.

use std::collections::HashMap;

use super::TriangleMesh;
use crate::{Normal3, Point3, Vector3};

impl TriangleMesh {
    /// The unit normal of the plane of a triangle, to where its corners run counter-clockwise;
    /// `None` for one without area.
    ///
    /// # Panics
    /// When there is no such triangle.
    #[must_use]
    pub fn geometric_normal(&self, triangle: usize) -> Option<Normal3<f64>> {
        Some(self.cross(triangle).normalized()?.to_normal())
    }

    /// The vertex normals interpolated at barycentric weights (u, v) of the second and third corner,
    /// of any length; `None` if the mesh has none or where they cancel.
    ///
    /// # Panics
    /// When there is no such triangle.
    #[must_use]
    #[inline]
    pub fn interpolated_normal(&self, triangle: usize, u: f32, v: f32) -> Option<Normal3> {
        let normals = self.normals()?;
        let [a, b, c] = self.triangles()[triangle].map(|i| normals[i as usize]);
        let blended = a * (1.0 - u - v) + b * u + c * v;
        (blended.wide().length() > 0.0).then_some(blended)
    }

    /// The texture coordinates at barycentric weights (u, v) of the second and third corner; `None`
    /// if the mesh has none.
    ///
    /// # Panics
    /// When there is no such triangle.
    #[must_use]
    #[inline]
    pub fn uv_at(&self, triangle: usize, u: f32, v: f32) -> Option<[f32; 2]> {
        let uvs = self.uvs()?;
        let [a, b, c] = self.triangles()[triangle].map(|i| uvs[i as usize]);
        let w = 1.0 - u - v;
        Some([0, 1].map(|i| a[i] * w + b[i] * u + c[i] * v))
    }

    /// The colour at barycentric weights (u, v) of the second and third corner; `None` if the mesh
    /// has none.
    ///
    /// # Panics
    /// When there is no such triangle.
    #[must_use]
    #[inline]
    pub fn colour_at(&self, triangle: usize, u: f32, v: f32) -> Option<[f32; 3]> {
        let colours = self.colours()?;
        let [a, b, c] = self.triangles()[triangle].map(|i| colours[i as usize]);
        let w = 1.0 - u - v;
        Some([0, 1, 2].map(|i| a[i] * w + b[i] * u + c[i] * v))
    }

    /// The area of a triangle.
    ///
    /// # Panics
    /// When there is no such triangle.
    #[must_use]
    pub fn triangle_area(&self, triangle: usize) -> f64 {
        self.cross(triangle).length() / 2.0
    }

    /// The area of all triangles.
    #[must_use]
    pub fn area(&self) -> f64 {
        (0..self.triangles().len())
            .map(|i| self.triangle_area(i))
            .sum()
    }

    /// How many triangles have no area: their corners lie on one line or are the same, or one is not
    /// finite.
    ///
    /// The arithmetic is exact for corners whose coordinates span less than eight decimal orders of
    /// magnitude, so that a thin triangle is not taken for one without area.
    #[must_use]
    pub fn degenerate_triangles(&self) -> usize {
        (0..self.triangles().len())
            .filter(|&i| !(self.cross(i).max_norm() > 0.0 && self.cross(i).is_finite()))
            .count()
    }

    /// Whether the mesh is closed: each edge of a triangle is, by index, the edge of exactly one
    /// other one that runs through it the opposite way. A mesh of nothing is closed.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let mut edges: HashMap<(u32, u32), usize> = HashMap::new();
        for &[a, b, c] in self.triangles() {
            for edge in [(a, b), (b, c), (c, a)] {
                *edges.entry(edge).or_default() += 1;
            }
        }
        edges.iter().all(|(&(from, to), &count)| {
            count == 1 && from != to && edges.get(&(to, from)) == Some(&1)
        })
    }

    /// Twice the area of a triangle, along its normal.
    fn cross(&self, triangle: usize) -> Vector3<f64> {
        let [a, b, c] = self.corners(triangle).map(Point3::wide);
        (b - a).cross(c - a)
    }
}

#[cfg(test)]
mod tests {
    use crate::Normal3;
    use crate::mesh::generate::cuboid;
    use crate::mesh::smooth_normals;
    use crate::{Aabb, Angle, Point3, TriangleMesh};

    fn unit_cube() -> TriangleMesh {
        cuboid(&Aabb::around([
            Point3::ORIGIN,
            Point3::new(1.0_f32, 1.0, 1.0),
        ]))
    }

    /// One good triangle, a needle, a point, a NaN, and a vertex that none uses.
    fn ragged() -> TriangleMesh {
        let positions = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [2.0, 0.0, 0.0],
            [f32::NAN, 0.0, 0.0],
            [7.0, 7.0, 7.0],
        ];
        let triangles = vec![[0, 1, 2], [0, 1, 3], [0, 0, 0], [0, 1, 4]];
        TriangleMesh::new(positions.map(Point3::from).to_vec(), triangles).unwrap()
    }

    #[test]
    fn triangles_without_area_are_counted_and_have_no_normal() {
        let mesh = ragged();
        assert_eq!(mesh.degenerate_triangles(), 3);
        assert_eq!(mesh.geometric_normal(1), None);
    }

    #[test]
    fn a_thin_triangle_is_no_degenerate_one() {
        let positions = vec![
            Point3::new(1e3_f32, 0.0, 0.0),
            Point3::new(2e3, 0.0, 0.0),
            Point3::new(1.5e3, 1e-4, 0.0),
        ];
        let mesh = TriangleMesh::new(positions, vec![[0, 1, 2]]).unwrap();
        assert_eq!(mesh.degenerate_triangles(), 0);
    }

    #[test]
    fn normals_are_interpolated_unless_they_cancel() {
        let cube = unit_cube();
        assert_eq!(cube.interpolated_normal(0, 0.3, 0.3), None);
        let smooth = smooth_normals(&cube, Angle::from_degrees(180.0)).unwrap();
        let corner = smooth.triangles()[0][1] as usize;
        let expected = smooth.normals().unwrap()[corner];
        assert_eq!(smooth.interpolated_normal(0, 1.0, 0.0), Some(expected));
        let corner = cube.triangles()[0][1] as usize;
        let mut opposite = vec![Normal3::new(0.0, 0.0, 1.0); 8];
        opposite[corner].z = -1.0;
        let cancelling = cube.with_normals(opposite).unwrap();
        assert_eq!(cancelling.interpolated_normal(0, 0.5, 0.0), None);
    }

    #[test]
    fn uvs_are_interpolated() {
        let mesh = ragged();
        assert_eq!(mesh.uv_at(0, 0.5, 0.25), None);
        let uvs = vec![
            [0.0, 0.0],
            [1.0, 0.0],
            [0.0, 2.0],
            [0.0; 2],
            [0.0; 2],
            [0.0; 2],
        ];
        let mesh = mesh.with_uvs(uvs).unwrap();
        assert_eq!(mesh.uv_at(0, 0.5, 0.25), Some([0.5, 0.5]));
    }

    #[test]
    fn a_mesh_with_a_hole_is_not_closed() {
        assert!(TriangleMesh::default().is_closed());
        let cube = unit_cube();
        assert!(cube.is_closed());
        let some = cube.triangles()[1..].to_vec();
        let holed = TriangleMesh::new(cube.positions().to_vec(), some).unwrap();
        assert!(!holed.is_closed());
    }
}
