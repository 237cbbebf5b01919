//! The last step of every model reader: a clean mesh out of what a file holds.

use ombra_geometry::{Normal3, Point3, TriangleMesh, Vector3};

use crate::error::FormatError;
use crate::finding::Finding;

/// Vertices with their attributes, and triangles between them.
#[derive(Default)]
pub(crate) struct Raw {
    pub(crate) positions: Vec<Point3>,
    pub(crate) normals: Option<Vec<Normal3>>,
    pub(crate) uvs: Option<Vec<[f32; 2]>>,
    pub(crate) colours: Option<Vec<[f32; 3]>>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// How much of a mesh had to be mended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Mended {
    pub(crate) degenerate: u64,
    pub(crate) zero_normals: u64,
    pub(crate) unused_vertices: u64,
}

impl Mended {
    pub(crate) fn add(&mut self, other: Self) {
        self.degenerate += other.degenerate;
        self.zero_normals += other.zero_normals;
        self.unused_vertices += other.unused_vertices;
    }

    pub(crate) fn report(self, findings: &mut Vec<Finding>) {
        if self.degenerate > 0 {
            let count = self.degenerate;
            findings.push(Finding::DegenerateTriangles { count });
        }
        if self.zero_normals > 0 {
            let count = self.zero_normals;
            findings.push(Finding::ZeroNormals { count });
        }
        if self.unused_vertices > 0 {
            let count = self.unused_vertices;
            findings.push(Finding::UnusedVertices { count });
        }
    }
}

/// The mesh without its triangles of area zero and the vertices that no other triangle uses, and
/// with normals of length 1.
pub(crate) fn finish(mut raw: Raw) -> Result<(TriangleMesh, Mended), FormatError> {
    let whole = raw.triangles.len();
    let unused = if whole > 0 { drop_unused(&mut raw) } else { 0 };
    let positions = &raw.positions;
    raw.triangles
        .retain(|t| area_normal(positions, *t).is_some());
    let mut mended = Mended {
        degenerate: (whole - raw.triangles.len()) as u64,
        zero_normals: 0,
        unused_vertices: unused,
    };
    if mended.degenerate > 0 {
        // What only these used is part of the same fault.
        drop_unused(&mut raw);
    }
    if let Some(normals) = &mut raw.normals {
        mended.zero_normals = unit_normals(normals, &raw.positions, &raw.triangles);
    }
    let mut mesh = TriangleMesh::new(raw.positions, raw.triangles).map_err(FormatError::file)?;
    if let Some(normals) = raw.normals {
        mesh = mesh.with_normals(normals).map_err(FormatError::file)?;
    }
    if let Some(uvs) = raw.uvs {
        mesh = mesh.with_uvs(uvs).map_err(FormatError::file)?;
    }
    if let Some(colours) = raw.colours {
        mesh = mesh.with_colours(colours).map_err(FormatError::file)?;
    }
    Ok((mesh, mended))
}

/// Leaves out the vertices that no triangle uses, the others keeping their order. Returns how many
/// there were.
fn drop_unused(raw: &mut Raw) -> u64 {
    let mut used = vec![false; raw.positions.len()];
    for &corner in raw.triangles.iter().flatten() {
        used[corner as usize] = true;
    }
    let unused = used.iter().filter(|used| !**used).count();
    if unused == 0 {
        return 0;
    }
    let mut next = 0;
    let places: Vec<u32> = (used.iter())
        .map(|&used| {
            let place = next;
            next += u32::from(used);
            place
        })
        .collect();
    for corner in raw.triangles.iter_mut().flatten() {
        *corner = places[*corner as usize];
    }
    keep(&mut raw.positions, &used);
    raw.normals.iter_mut().for_each(|n| keep(n, &used));
    raw.uvs.iter_mut().for_each(|uvs| keep(uvs, &used));
    raw.colours.iter_mut().for_each(|c| keep(c, &used));
    unused as u64
}

fn keep<T>(values: &mut Vec<T>, used: &[bool]) {
    let mut used = used.iter();
    values.retain(|_| used.next() == Some(&true));
}

/// The normal of a triangle with the length of twice its area; `None` if that is zero.
///
/// In double precision, differences of single-precision coordinates of like size are exact and so
/// are their products: triangles with collinear corners give zero, all others do not.
pub(super) fn area_normal(positions: &[Point3], triangle: [u32; 3]) -> Option<Vector3<f64>> {
    let [a, b, c] = triangle.map(|i| positions[i as usize].wide());
    let normal = (b - a).cross(c - a);
    (normal != Vector3::default()).then_some(normal)
}

/// Makes normals as long as 1, and those that have no direction equal to the normal of a triangle
/// that uses them. Returns how many of the latter there are.
fn unit_normals(normals: &mut [Normal3], positions: &[Point3], triangles: &[[u32; 3]]) -> u64 {
    let mut missing = false;
    for normal in normals.iter_mut() {
        // Normals of a length close to 1 keep their bits, so that writing and reading is exact.
        if (normal.length() - 1.0).abs() > 1e-6 {
            *normal = normal.normalized().unwrap_or_default();
            missing |= *normal == Normal3::default();
        }
    }
    let mut count = 0;
    if missing {
        for &triangle in triangles {
            let face = area_normal(positions, triangle).and_then(Vector3::normalized);
            for corner in triangle {
                let normal = &mut normals[corner as usize];
                if *normal == Normal3::default() {
                    count += 1;
                    *normal = face.unwrap_or_default().cast::<f32>().to_array().into();
                }
            }
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_of_area_zero_go_and_thin_ones_stay() {
        let raw = Raw {
            positions: vec![
                Point3::new(1e7, 0.0, 0.0),
                Point3::new(1e7 + 1.0, 0.0, 0.0),
                Point3::new(1e7 + 2.0, 0.0, 0.0),
                Point3::new(1e7 + 2.0, 1e-30, 0.0),
            ],
            triangles: vec![[0, 1, 2], [0, 0, 1], [3, 3, 3], [0, 1, 3]],
            ..Raw::default()
        };
        let (mesh, mended) = finish(raw).unwrap();
        assert_eq!(mesh.triangles(), [[0, 1, 2]]);
        assert_eq!(mesh.positions()[2].y, 1e-30);
        assert_eq!((mended.degenerate, mended.unused_vertices), (3, 0));
    }

    #[test]
    fn normals_become_unit_ones_and_none_is_left_without_direction() {
        let raw = Raw {
            positions: vec![
                Point3::ORIGIN,
                Point3::new(1.0, 0.0, 0.0),
                Point3::new(0.0, 1.0, 0.0),
                Point3::ORIGIN,
            ],
            normals: Some(vec![
                Normal3::new(0.0, 3.0, 0.0),
                Normal3::default(),
                Normal3::new(1e-30, 0.0, 0.0),
                Normal3::new(0.0, 1.0, 0.0),
            ]),
            triangles: vec![[0, 1, 2]],
            ..Raw::default()
        };
        let (mesh, mended) = finish(raw).unwrap();
        let normals = mesh.normals().unwrap();
        assert_eq!(normals[0], Normal3::new(0.0, 1.0, 0.0));
        assert_eq!(normals[1], Normal3::new(0.0, 0.0, 1.0));
        assert_eq!(normals[2], Normal3::new(1.0, 0.0, 0.0));
        assert_eq!(normals.len(), 3);
        assert_eq!((mended.zero_normals, mended.unused_vertices), (1, 1));
    }
}
