//! Shapes as triangles, for whoever can only draw those.
//!
//! Every vertex lies on the shape. Between vertices the mesh is off by a sagitta, the height of an
//! arc over its chord: r (1 − cos(π / n)) where a circle of radius r is cut into n parts. So the
//! number of parts follows from the tolerance, and nothing is cut finer than that.

mod flat;
mod turned;

use std::f64::consts::PI;

use super::{Shape, Surface as _};
use crate::{Normal3, Point3, TriangleMesh};

/// The most triangles that one shape is made of.
pub const MAX_TRIANGLES: usize = 1 << 22;

/// Why a shape cannot be made into triangles.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TessellationError {
    /// A plane has no end.
    #[error("a plane has no end, so no number of triangles covers it")]
    Endless,
    /// The tolerance is no distance.
    #[error("the tolerance is {tolerance}; it must be finite and above 0")]
    Tolerance {
        /// What was asked for.
        tolerance: f64,
    },
    /// The tolerance is below what single precision can express at the place of the shape, or takes
    /// more than [`MAX_TRIANGLES`].
    #[error(
        "a tolerance of {tolerance} takes more than {MAX_TRIANGLES} triangles, or vertices in more \
         than single precision"
    )]
    TooFine {
        /// What was asked for.
        tolerance: f64,
    },
}

/// A shape as triangles with normals and surface parameters at their vertices.
///
/// No point of the mesh is farther than `tolerance` from the shape, and no point of the shape
/// farther from the mesh. `tolerance` is in the unit of the shape, finite and above 0. Triangles wind
/// counter-clockwise seen from where the normal of the shape points to. Where normals or parameters
/// jump, as at an edge or where u starts over, there are several vertices in the same place, equal to
/// the last bit.
///
/// Parameters are exact on flat shapes but for the disk; on curved ones they are interpolated between
/// vertices where they are exact. A degenerate shape, which is never hit, has no triangles.
///
/// # Errors
/// For a plane, and for a tolerance that is no distance or cannot be kept.
pub fn tessellate(shape: &Shape, tolerance: f64) -> Result<TriangleMesh, TessellationError> {
    let plan = Plan::of(shape, tolerance)?;
    if plan.triangles() > MAX_TRIANGLES as u64 {
        return Err(TessellationError::TooFine { tolerance });
    }
    let mut soup = Soup::default();
    match plan {
        Plan::Nothing => {}
        Plan::Flat(faces) => faces.iter().for_each(|face| face.add_to(&mut soup)),
        Plan::Turned(turned) => turned.add_to(&mut soup),
    }
    Ok(soup.into_mesh())
}

/// How many triangles [`tessellate`] makes, without making them; also more than it would make.
///
/// # Errors
/// As for [`tessellate`], but for the number of triangles.
pub fn triangle_count(shape: &Shape, tolerance: f64) -> Result<u64, TessellationError> {
    Ok(Plan::of(shape, tolerance)?.triangles())
}

/// What a shape is cut into.
enum Plan {
    Nothing,
    Flat(Vec<flat::Face>),
    Turned(turned::Turned),
}

impl Plan {
    fn of(shape: &Shape, tolerance: f64) -> Result<Self, TessellationError> {
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(TessellationError::Tolerance { tolerance });
        }
        if shape.validate().is_err() {
            return Ok(Self::Nothing);
        }
        // Vertices are rounded to single precision, by half a unit of the last place in each
        // coordinate and so by √3 / 2 of one in space. What is left is for the sagitta.
        let bounds = shape.bounds().wide();
        let [low, high] = [bounds.min, bounds.max].map(|corner| corner.to_vector().max_norm());
        let rounding = f64::from(f32::EPSILON) * low.max(high);
        let left = tolerance - rounding;
        Ok(match shape {
            Shape::Plane(_) => return Err(TessellationError::Endless),
            _ if !(left > 0.0) => return Err(TessellationError::TooFine { tolerance }),
            Shape::Triangle(triangle) => Self::Flat(vec![flat::of_triangle(triangle)]),
            Shape::Rectangle(rectangle) => Self::Flat(vec![flat::of_rectangle(rectangle)]),
            Shape::Cuboid(cuboid) => Self::Flat(flat::of_cuboid(cuboid)),
            Shape::OrientedBox(oriented) => Self::Flat(flat::of_oriented_box(oriented)),
            Shape::ConvexPolyhedron(solid) => Self::Flat(flat::of_polyhedron(solid)),
            Shape::Frustum(frustum) => Self::Flat(flat::of_polyhedron(frustum.polyhedron())),
            Shape::Sphere(sphere) => Self::Turned(turned::of_sphere(sphere, left)),
            Shape::Disk(disk) => Self::Turned(turned::of_disk(disk, left)),
            Shape::Cylinder(cylinder) => Self::Turned(turned::of_revolved(&cylinder.0, left)),
            Shape::Cone(cone) => Self::Turned(turned::of_revolved(&cone.0, left)),
            Shape::Torus(torus) => Self::Turned(turned::of_torus(torus, left)),
        })
    }

    fn triangles(&self) -> u64 {
        match self {
            Self::Nothing => 0,
            Self::Flat(faces) => faces.iter().map(flat::Face::triangles).sum(),
            Self::Turned(turned) => turned.triangles(),
        }
    }
}

/// How many parts of a full circle keep the sagitta r (1 − cos(π / n)) within a distance; never
/// fewer than `least`.
fn parts_of_circle(radius: f64, sagitta: f64, least: u64) -> u64 {
    // 1 − cos x = 2 sin²(x / 2), which does not cancel where x is small.
    let sine = (sagitta / radius / 2.0).sqrt().min(1.0);
    // A conversion of a number that is too large, or infinite, gives the largest integer.
    ((PI / (2.0 * sine.asin())).ceil() as u64).max(least)
}

/// Vertices and triangles while they come together.
#[derive(Default)]
struct Soup {
    positions: Vec<Point3>,
    normals: Vec<Normal3>,
    uvs: Vec<[f32; 2]>,
    triangles: Vec<[u32; 3]>,
}

impl Soup {
    /// Adds a vertex and says which it is.
    fn vertex(&mut self, position: Point3<f64>, normal: Normal3<f64>, uv: [f32; 2]) -> u32 {
        self.positions.push(position.cast());
        self.normals.push(normal.cast());
        self.uvs.push(uv);
        self.positions.len() as u32 - 1
    }

    fn into_mesh(self) -> TriangleMesh {
        TriangleMesh::new(self.positions, self.triangles)
            .and_then(|mesh| mesh.with_normals(self.normals))
            .and_then(|mesh| mesh.with_uvs(self.uvs))
            .expect("each vertex was added with all it has, and each index is one of a vertex")
    }
}

#[cfg(test)]
mod tests;
