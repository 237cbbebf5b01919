//! Triangles that share their vertices.

pub mod generate;
mod smooth;
mod surface;

use crate::{Aabb, Normal3, Point3};

pub use smooth::smooth_normals;

/// An indexed triangle mesh.
///
/// Vertex attributes, where present, have one entry a position. Triangles wind counter-clockwise
/// seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    positions: Vec<Point3>,
    triangles: Vec<[u32; 3]>,
    normals: Option<Vec<Normal3>>,
    uvs: Option<Vec<[f32; 2]>>,
    colours: Option<Vec<[f32; 3]>>,
}

/// What does not make a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshError {
    /// A triangle names a vertex that is not there.
    IndexOutOfRange {
        /// Which triangle, from 0.
        triangle: usize,
        /// The index it names.
        index: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// An attribute has not as many entries as there are positions.
    AttributeLength {
        /// "normals", "uvs" or "colours".
        attribute: &'static str,
        /// How many entries it has.
        entries: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// More triangles or vertices than an index can name.
    TooLarge,
}

impl std::fmt::Display for MeshError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::IndexOutOfRange {
                triangle,
                index,
                vertices,
            } => write!(
                f,
                "triangle {triangle} uses vertex {index}, but there are {vertices} (0 to {})",
                vertices.saturating_sub(1)
            ),
            Self::AttributeLength {
                attribute,
                entries,
                vertices,
            } => {
                write!(
                    f,
                    "{entries} {attribute} for {vertices} vertices; one each is needed"
                )
            }
            Self::TooLarge => write!(f, "more than {} triangles or vertices", u32::MAX),
        }
    }
}

impl std::error::Error for MeshError {}

impl TriangleMesh {
    /// From positions and triangles.
    ///
    /// # Errors
    /// When a triangle names a vertex that is not there, or there are more than 2³² − 1 of either.
    pub fn new(positions: Vec<Point3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        let limit = u32::MAX as usize;
        if positions.len() > limit || triangles.len() > limit {
            return Err(MeshError::TooLarge);
        }
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|&&i| i as usize >= positions.len()) {
                let vertices = positions.len();
                return Err(MeshError::IndexOutOfRange {
                    triangle,
                    index,
                    vertices,
                });
            }
        }
        Ok(Self {
            positions,
            triangles,
            normals: None,
            uvs: None,
            colours: None,
        })
    }

    /// The same mesh with shading normals, one a vertex.
    ///
    /// # Errors
    /// When there are not as many as vertices.
    pub fn with_normals(self, normals: Vec<Normal3>) -> Result<Self, MeshError> {
        self.check_length("normals", normals.len())?;
        Ok(Self {
            normals: Some(normals),
            ..self
        })
    }

    /// The same mesh with texture coordinates, one a vertex.
    ///
    /// # Errors
    /// When there are not as many as vertices.
    pub fn with_uvs(self, uvs: Vec<[f32; 2]>) -> Result<Self, MeshError> {
        self.check_length("uvs", uvs.len())?;
        Ok(Self {
            uvs: Some(uvs),
            ..self
        })
    }

    /// The same mesh with colours, one a vertex: red, green and blue in linear light, by which what
    /// the surface is made of is tinted.
    ///
    /// # Errors
    /// When there are not as many as vertices.
    pub fn with_colours(self, colours: Vec<[f32; 3]>) -> Result<Self, MeshError> {
        self.check_length("colours", colours.len())?;
        Ok(Self {
            colours: Some(colours),
            ..self
        })
    }

    /// The vertices.
    #[must_use]
    pub fn positions(&self) -> &[Point3] {
        &self.positions
    }

    /// The triangles, as indices of vertices.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The shading normals, one a vertex, if there are any.
    #[must_use]
    pub fn normals(&self) -> Option<&[Normal3]> {
        self.normals.as_deref()
    }

    /// The texture coordinates, one a vertex, if there are any.
    #[must_use]
    pub fn uvs(&self) -> Option<&[[f32; 2]]> {
        self.uvs.as_deref()
    }

    /// The colours, one a vertex, if there are any.
    #[must_use]
    pub fn colours(&self) -> Option<&[[f32; 3]]> {
        self.colours.as_deref()
    }

    /// The corners of one triangle.
    ///
    /// # Panics
    /// When there is no such triangle.
    #[must_use]
    #[inline]
    pub fn corners(&self, triangle: usize) -> [Point3; 3] {
        self.triangles[triangle].map(|i| self.positions[i as usize])
    }

    /// The box around one triangle; empty if a corner is NaN or infinite, since such a triangle is
    /// never hit.
    ///
    /// # Panics
    /// When there is no such triangle.
    #[must_use]
    #[inline]
    pub fn triangle_bounds(&self, triangle: usize) -> Aabb {
        let corners = self.corners(triangle);
        if corners.iter().all(|corner| corner.is_finite()) {
            Aabb::around(corners)
        } else {
            Aabb::EMPTY
        }
    }

    /// The box around all triangles that can be hit. Vertices that no triangle uses do not count.
    #[must_use]
    pub fn bounds(&self) -> Aabb {
        (0..self.triangles.len()).fold(Aabb::EMPTY, |bounds, i| {
            bounds.union(self.triangle_bounds(i))
        })
    }

    /// Bytes held on the heap.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(self.positions())
            + size_of_val(self.triangles())
            + self.normals().map_or(0, size_of_val)
            + self.uvs().map_or(0, size_of_val)
            + self.colours().map_or(0, size_of_val)
    }

    fn check_length(&self, attribute: &'static str, entries: usize) -> Result<(), MeshError> {
        let vertices = self.positions.len();
        if entries == vertices {
            Ok(())
        } else {
            Err(MeshError::AttributeLength {
                attribute,
                entries,
                vertices,
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_a_mesh_with_empty_bounds() {
        assert!(TriangleMesh::default().bounds().is_empty());
    }

    #[test]
    fn what_cannot_be_hit_has_no_box() {
        for bad in [f32::NAN, f32::INFINITY] {
            let mut positions = [0.0, 1.0, 2.0].map(|x| Point3::new(x, x * x, 0.0)).to_vec();
            let good = Aabb::around(positions.iter().copied());
            positions.push(Point3::new(7.0, bad, 0.0));
            let mesh = TriangleMesh::new(positions, vec![[0, 1, 2], [0, 1, 3]]).unwrap();
            assert!(mesh.triangle_bounds(1).is_empty());
            assert_eq!(mesh.bounds(), good);
        }
    }

    #[test]
    fn an_index_past_the_vertices_is_named() {
        let error = TriangleMesh::new(vec![Point3::ORIGIN; 3], vec![[0, 1, 2], [0, 7, 1]]);
        assert_eq!(
            error.unwrap_err().to_string(),
            "triangle 1 uses vertex 7, but there are 3 (0 to 2)"
        );
    }

    #[test]
    fn attributes_come_one_a_vertex() {
        let mesh = TriangleMesh::new(vec![Point3::ORIGIN; 3], vec![[0, 1, 2]]).unwrap();
        assert!(mesh.clone().with_uvs(vec![[0.0; 2]; 2]).is_err());
        assert!(mesh.with_normals(vec![Normal3::default(); 3]).is_ok());
    }
}
