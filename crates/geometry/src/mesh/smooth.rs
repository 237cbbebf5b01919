//! Smooth normals for meshes that come without.

use std::collections::HashMap;

use crate::{Angle, MeshError, Normal3, Point3, TriangleMesh, Vector3};

/// The same mesh with normals that are smooth across edges whose two triangles meet at less than
/// `crease`, and sharp across all others; vertices on sharp edges are split.
///
/// A normal is the sum of those of the triangles around it, weighted by their angles there
/// (Thürmer and Wüthrich, "Computing Vertex Normals from Polygonal Facets", Journal of Graphics
/// Tools 3(1), 1998). Vertices in the same place count as one. With a crease of 0 or less every
/// triangle is flat; with 180° or more every edge is smooth. Time is O(n log n) in the triangles,
/// whatever the mesh.
///
/// # Errors
/// When splitting gives more vertices than a mesh can index.
pub fn smooth_normals(mesh: &TriangleMesh, crease: Angle) -> Result<TriangleMesh, MeshError> {
    let count = mesh.triangles().len();
    let face = |i| mesh.geometric_normal(i).map(Normal3::to_vector);
    let faces: Vec<_> = (0..count).map(face).collect();
    let mut groups = Groups::new(count * 3);
    let mut join = |pair: [&HalfEdge; 2]| {
        let [one, other] = pair.map(|h| h.corner as usize / 3);
        let meet = match (faces[one], faces[other]) {
            (Some(a), Some(b)) => a.dot(b).clamp(-1.0, 1.0).acos() < f64::from(crease.radians()),
            _ => false,
        };
        if meet || crease.degrees() >= 180.0 {
            let [a, b] = pair.map(HalfEdge::corners_in_order);
            groups.join(a[0], b[0]);
            groups.join(a[1], b[1]);
        }
    };
    let edges = half_edges(mesh);
    for pair in edges.windows(2) {
        if pair[0].ends == pair[1].ends {
            join([&pair[0], &pair[1]]);
        }
    }
    split(mesh, &faces, &mut groups)
}

/// One side of a triangle.
struct HalfEdge {
    /// The places at its ends, the smaller first.
    ends: [u32; 2],
    /// The corner that it starts from: three times the triangle plus 0, 1 or 2.
    corner: u32,
    /// Whether the smaller place is at its end.
    reversed: bool,
}

impl HalfEdge {
    /// Its two corners, that at the smaller place first.
    fn corners_in_order(&self) -> [usize; 2] {
        let from = self.corner as usize;
        let to = from / 3 * 3 + (from + 1) % 3;
        if self.reversed {
            [to, from]
        } else {
            [from, to]
        }
    }
}

/// All sides, those between the same places next to each other.
fn half_edges(mesh: &TriangleMesh) -> Vec<HalfEdge> {
    let places = places(mesh.positions());
    let mut edges = Vec::with_capacity(mesh.triangles().len() * 3);
    for (triangle, corners) in mesh.triangles().iter().enumerate() {
        for side in 0..3 {
            let [from, to] = [side, (side + 1) % 3].map(|i| places[corners[i] as usize]);
            edges.push(HalfEdge {
                ends: [from.min(to), from.max(to)],
                corner: (triangle * 3 + side) as u32,
                reversed: to < from,
            });
        }
    }
    edges.sort_unstable_by_key(|e| (e.ends, e.corner));
    edges
}

/// For each vertex the first vertex in the same place.
fn places(positions: &[Point3]) -> Vec<u32> {
    let mut first = HashMap::with_capacity(positions.len());
    (0_u32..)
        .zip(positions)
        .map(|(vertex, p)| *first.entry(key(*p)).or_insert(vertex))
        .collect()
}

/// Equal for positions that are equal, −0 and 0 included.
fn key(p: Point3) -> [u32; 3] {
    p.to_array().map(|x| (x + 0.0).to_bits())
}

/// One vertex for each vertex of the mesh and group of corners there.
fn split(
    mesh: &TriangleMesh,
    faces: &[Option<Vector3<f64>>],
    groups: &mut Groups,
) -> Result<TriangleMesh, MeshError> {
    let mut sums = vec![Vector3::<f64>::default(); faces.len() * 3];
    for (triangle, face) in faces.iter().enumerate() {
        let corners = mesh.corners(triangle).map(Point3::wide);
        for side in 0..3 {
            let at = corners[side];
            let [a, b] = [1, 2].map(|i| (corners[(side + i) % 3] - at).normalized());
            if let (Some(face), Some(a), Some(b)) = (face, a, b) {
                let weight = a.dot(b).clamp(-1.0, 1.0).acos();
                sums[groups.root(triangle * 3 + side)] += *face * weight;
            }
        }
    }
    let mut vertices = HashMap::with_capacity(mesh.positions().len());
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    let mut uvs = mesh.uvs().map(|_| Vec::new());
    let mut colours = mesh.colours().map(|_| Vec::new());
    let mut triangles = Vec::with_capacity(faces.len());
    for (triangle, corners) in mesh.triangles().iter().enumerate() {
        let mut split_corners = [0; 3];
        for (side, &vertex) in corners.iter().enumerate() {
            let root = groups.root(triangle * 3 + side);
            split_corners[side] = *vertices.entry((vertex, root)).or_insert_with(|| {
                positions.push(mesh.positions()[vertex as usize]);
                let normal = sums[root].normalized().or(faces[triangle]);
                normals.push(Normal3::from(
                    normal.unwrap_or_default().cast::<f32>().to_array(),
                ));
                if let (Some(uvs), Some(all)) = (&mut uvs, mesh.uvs()) {
                    uvs.push(all[vertex as usize]);
                }
                if let (Some(colours), Some(all)) = (&mut colours, mesh.colours()) {
                    colours.push(all[vertex as usize]);
                }
                positions.len() - 1
            });
        }
        if positions.len() > u32::MAX as usize {
            return Err(MeshError::TooLarge);
        }
        triangles.push(split_corners.map(|i| i as u32));
    }
    let mut mesh = TriangleMesh::new(positions, triangles)?.with_normals(normals)?;
    if let Some(uvs) = uvs {
        mesh = mesh.with_uvs(uvs)?;
    }
    if let Some(colours) = colours {
        mesh = mesh.with_colours(colours)?;
    }
    Ok(mesh)
}

/// Corners that share a normal: disjoint sets with path halving.
struct Groups {
    parent: Vec<u32>,
}

impl Groups {
    fn new(count: usize) -> Self {
        let parent = (0..count as u32).collect();
        Self { parent }
    }

    fn root(&mut self, corner: usize) -> usize {
        let mut at = corner;
        while self.parent[at] as usize != at {
            self.parent[at] = self.parent[self.parent[at] as usize];
            at = self.parent[at] as usize;
        }
        at
    }

    /// The smaller root stays, so that the outcome does not hang on the order of joining.
    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b)] = a.min(b) as u32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Aabb;
    use crate::mesh::generate::{cuboid, icosphere};

    fn box_mesh() -> TriangleMesh {
        let corners = [[0.0_f32; 3], [1.0; 3]].map(Point3::from);
        cuboid(&Aabb::around(corners))
    }

    #[test]
    fn normals_of_a_ball_point_outward() {
        let centre = Point3::new(3.0, -1.0, 2.0);
        let ball = icosphere(2, centre, 2.0);
        let round = smooth_normals(&ball, Angle::from_degrees(60.0)).unwrap();
        assert_eq!(round.positions().len(), ball.positions().len());
        for (p, n) in round.positions().iter().zip(round.normals().unwrap()) {
            let outward = (*p - centre).normalized().unwrap();
            assert!(n.dot(outward) > 0.9999, "{n:?} at {p:?}");
        }
    }

    #[test]
    fn triangles_without_area_change_no_normal() {
        let positions = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [f32::NAN; 3],
        ];
        let triangles = vec![[0, 1, 2], [0, 1, 1], [0, 0, 0], [0, 1, 3]];
        let mesh = TriangleMesh::new(positions.map(Point3::from).to_vec(), triangles).unwrap();
        let smooth = smooth_normals(&mesh, Angle::from_degrees(180.0)).unwrap();
        let first = smooth.triangles()[0];
        for corner in first {
            let normal = smooth.normals().unwrap()[corner as usize];
            assert_eq!(normal, Normal3::new(0.0, 0.0, 1.0));
        }
    }

    #[test]
    fn a_box_has_sharp_edges_below_ninety_degrees_and_round_ones_above() {
        let sharp = smooth_normals(&box_mesh(), Angle::from_degrees(60.0)).unwrap();
        assert_eq!(sharp.positions().len(), 24);
        for (triangle, corners) in sharp.triangles().iter().enumerate() {
            let face = sharp.geometric_normal(triangle).unwrap();
            for &corner in corners {
                let normal = sharp.normals().unwrap()[corner as usize].wide();
                assert_eq!(normal, face);
            }
        }
        let round = smooth_normals(&box_mesh(), Angle::from_degrees(120.0)).unwrap();
        assert_eq!(round.positions().len(), 8);
        for (p, n) in round.positions().iter().zip(round.normals().unwrap()) {
            let outward = (*p - Point3::new(0.5, 0.5, 0.5)).normalized().unwrap();
            assert!(n.dot(outward) > 0.999_999, "{n:?} at {p:?}");
        }
    }

    #[test]
    fn a_crease_of_zero_leaves_every_triangle_flat() {
        let flat = smooth_normals(&box_mesh(), Angle::from_degrees(0.0)).unwrap();
        assert_eq!(flat.positions().len(), 36);
    }

    #[test]
    fn vertices_in_the_same_place_are_smoothed_together() {
        let whole = box_mesh();
        let apart: Vec<_> = (0..12).flat_map(|i| whole.corners(i)).collect();
        let triangles = (0..12).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let apart = TriangleMesh::new(apart, triangles).unwrap();
        let round = smooth_normals(&apart, Angle::from_degrees(120.0)).unwrap();
        for (p, n) in round.positions().iter().zip(round.normals().unwrap()) {
            let outward = (*p - Point3::new(0.5, 0.5, 0.5)).normalized().unwrap();
            assert!(n.dot(outward) > 0.999_999, "{n:?} at {p:?}");
        }
    }

    #[test]
    fn nothing_has_no_normals_and_a_degenerate_mesh_does_not_panic() {
        let nothing = smooth_normals(&TriangleMesh::default(), Angle::from_degrees(30.0));
        assert_eq!(nothing.unwrap().triangles().len(), 0);
        let points = vec![Point3::ORIGIN; 3];
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [0, 0, 0]]).unwrap();
        assert!(smooth_normals(&mesh, Angle::from_degrees(180.0)).is_ok());
    }
}
