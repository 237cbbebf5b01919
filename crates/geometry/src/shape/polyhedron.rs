//! The convex polyhedron: what some half-spaces have in common.

use super::error::{ShapeError, direction, finite};
use super::frame::{LocalRay, nearest_of, report};
use super::interval::Interval;
use super::polyhedron_face::{Face, PlaneEquation, faces_of};
use super::{Surface, SurfacePoint, SurfaceSample};
use crate::{Aabb, Crossings, Normal3, Point3, Ray, Vector3, sampling};

/// How far a corner may lie in front of a face that is given by its corners, relative to the size of
/// the solid: corners in single precision are never quite in one plane.
const FLATNESS: f64 = 1e-5;

/// Everything behind a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// Any point of the plane.
    pub point: Point3,
    /// Where the outside is; of any length.
    pub normal: Normal3,
}

/// A convex solid with flat faces.
///
/// On each face (u, v) run along two perpendicular directions in its plane and reach from 0 to 1
/// over the face.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexPolyhedron {
    /// What the faces are relative to.
    pub(super) centre: Point3<f64>,
    pub(super) faces: Vec<Face>,
}

impl ConvexPolyhedron {
    /// What some half-spaces have in common. Half-spaces that cut nothing off are dropped.
    ///
    /// # Errors
    /// When a number is not finite, a normal is 0, there is no volume in common, or it is endless
    /// (reaches 10⁵ times further than the points given lie apart).
    pub fn from_half_spaces(half_spaces: &[HalfSpace]) -> Result<Self, ShapeError> {
        let mut planes = Vec::with_capacity(half_spaces.len());
        for half_space in half_spaces {
            finite("point", half_space.point.is_finite())?;
            let normal = direction("normal", half_space.normal.to_vector().wide())?;
            planes.push((half_space.point.wide(), normal));
        }
        Self::from_planes(&planes)
    }

    /// From corners and faces, each the indices of its corners, counter-clockwise seen from outside.
    /// Where rounding leaves the corners of a face not quite in one plane, the plane that fits them
    /// best counts.
    ///
    /// # Errors
    /// When a number is not finite, a face names a corner that is not there or has no area, a corner
    /// lies in front of a face, or the faces do not close.
    pub fn from_faces(corners: &[Point3], faces: &[Vec<u32>]) -> Result<Self, ShapeError> {
        let all = corners.iter().all(|corner| corner.is_finite());
        finite("corner", all)?;
        let size = Aabb::around(corners.iter().copied())
            .wide()
            .extent()
            .max_norm();
        let mut planes = Vec::with_capacity(faces.len());
        for (face, indices) in faces.iter().enumerate() {
            let (point, normal) = plane_of(corners, face, indices)?;
            let in_front = |corner: &Point3| (corner.wide() - point).dot(normal) > FLATNESS * size;
            if let Some(corner) = corners.iter().position(in_front) {
                return Err(ShapeError::NotConvex { face, corner });
            }
            planes.push((point, normal));
        }
        Self::from_planes(&planes)
    }

    /// From planes, each a point and a unit normal.
    pub(super) fn from_planes(planes: &[(Point3<f64>, Vector3<f64>)]) -> Result<Self, ShapeError> {
        let share = 1.0 / planes.len().max(1) as f64;
        let centre = planes
            .iter()
            .fold(Point3::new(0.0, 0.0, 0.0), |sum, (point, _)| {
                sum + point.to_vector() * share
            });
        let relative = |&(point, normal): &(Point3<f64>, Vector3<f64>)| PlaneEquation {
            normal,
            offset: (point - centre).dot(normal),
        };
        let reach = planes
            .iter()
            .map(|(point, _)| (*point - centre).length())
            .fold(0.0, f64::max);
        // Planes all through one point give no size; what is between them is endless.
        let reach = if reach > 0.0 { reach } else { 1.0 };
        let equations: Vec<_> = planes.iter().map(relative).collect();
        let faces = faces_of(&equations, reach)?;
        Ok(Self { centre, faces })
    }

    /// How many faces there are.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// The corners of each face, counter-clockwise seen from outside.
    pub fn face_corners(&self) -> impl Iterator<Item = Vec<Point3<f64>>> {
        self.faces.iter().map(|face| {
            let corners = face.corners().iter();
            corners.map(|&corner| self.centre + corner).collect()
        })
    }

    fn clip(&self, local: &LocalRay) -> Interval {
        let mut inside = Interval::LINE;
        for (i, face) in self.faces.iter().enumerate() {
            let plane = face.plane();
            inside.cut(
                plane.offset - plane.normal.dot(local.origin),
                plane.normal.dot(local.direction),
                i,
            );
        }
        inside
    }
}

impl Surface for ConvexPolyhedron {
    fn crossings(&self, ray: &Ray<f64>) -> Crossings {
        let mut found = Crossings::new();
        let Some(local) = LocalRay::about(ray, self.centre) else {
            return found;
        };
        for (s, face) in self.clip(&local).ends() {
            report(&mut found, ray, local.t(s), || {
                self.faces[face].uv(local.at(s))
            });
        }
        found
    }

    fn bounds(&self) -> Aabb {
        let corners = self.faces.iter().flat_map(Face::corners);
        Aabb::enclosing(Aabb::around(corners.map(|&corner| self.centre + corner)))
    }

    fn to_nearest(&self, point: Point3<f64>) -> Vector3<f64> {
        let local = point - self.centre;
        nearest_of(self.faces.iter().map(|face| face.to_nearest(local)))
    }

    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint {
        let local = point - self.centre;
        // Of the planes, the point is furthest out over the one that it is on.
        let over = |face: &&Face| face.plane().normal.dot(local) - face.plane().offset;
        let nearest = self.faces.iter().max_by(|a, b| over(a).total_cmp(&over(b)));
        let (normal, uv) = nearest.map_or((Vector3::new(0.0, 0.0, 1.0), [0.0, 0.0]), |face| {
            (face.plane().normal, face.uv(local))
        });
        let normal = normal.to_normal();
        SurfacePoint { normal, uv }
    }

    fn area(&self) -> f64 {
        self.faces.iter().map(Face::area).sum()
    }

    fn sample(&self, [x0, x1]: [f32; 2]) -> Option<SurfaceSample> {
        let (face, x0) = sampling::choose(f64::from(x0), self.faces.iter().map(Face::area));
        let face = self.faces.get(face)?;
        Some(SurfaceSample {
            point: self.centre + face.sample([x0, f64::from(x1)]),
            normal: face.plane().normal.to_normal(),
            pdf: 1.0 / self.area(),
        })
    }
}

/// The plane of a face, a point and a unit normal, by Newell's method.
fn plane_of(
    corners: &[Point3],
    face: usize,
    indices: &[u32],
) -> Result<(Point3<f64>, Vector3<f64>), ShapeError> {
    let mut points = Vec::with_capacity(indices.len());
    for &index in indices {
        let corner = corners.get(index as usize);
        let corner = corner.ok_or(ShapeError::IndexOutOfRange {
            face,
            index,
            corners: corners.len(),
        })?;
        points.push(corner.wide());
    }
    let Some(&first) = points.first() else {
        return Err(ShapeError::FaceWithoutArea { face });
    };
    let (mut normal, mut sum) = (Vector3::new(0.0, 0.0, 0.0), Vector3::new(0.0, 0.0, 0.0));
    for (i, &point) in points.iter().enumerate() {
        let next = points[(i + 1) % points.len()];
        normal += (point - first).cross(next - first);
        sum += point - first;
    }
    let normal = normal
        .normalized()
        .ok_or(ShapeError::FaceWithoutArea { face })?;
    Ok((first + sum / points.len() as f64, normal))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn half_space(point: [f32; 3], normal: [f32; 3]) -> HalfSpace {
        let (point, normal) = (Point3::from(point), Normal3::from(normal));
        HalfSpace { point, normal }
    }

    fn cube() -> Vec<HalfSpace> {
        let sides = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let both = sides.into_iter().flat_map(|n| [n, n.map(|x: f32| -x)]);
        both.map(|n| half_space(n, n)).collect()
    }

    const TETRAHEDRON: [Point3; 4] = [
        Point3::new(0.0, 0.0, 0.0),
        Point3::new(1.0, 0.0, 0.0),
        Point3::new(0.0, 1.0, 0.0),
        Point3::new(0.0, 0.0, 1.0),
    ];

    fn tetrahedron_faces() -> Vec<Vec<u32>> {
        vec![vec![0, 2, 1], vec![0, 1, 3], vec![0, 3, 2], vec![1, 2, 3]]
    }

    #[test]
    fn nothing_bounds_nothing() {
        let none = ConvexPolyhedron::from_half_spaces(&[]);
        assert_eq!(none, Err(ShapeError::Unbounded));
        let open = ConvexPolyhedron::from_half_spaces(&cube()[..5]);
        assert_eq!(open, Err(ShapeError::Unbounded));
        let one = ConvexPolyhedron::from_half_spaces(&cube()[..1]);
        assert_eq!(one, Err(ShapeError::Unbounded));
        let nan = ConvexPolyhedron::from_half_spaces(&[half_space([f32::NAN; 3], [1.0; 3])]);
        assert!(matches!(nan, Err(ShapeError::NotFinite { .. })));
    }

    #[test]
    fn half_spaces_that_have_nothing_or_a_plane_in_common_are_refused() {
        for height in [-2.0, -1.0] {
            let mut sides = cube();
            sides.push(half_space([0.0, 0.0, height], [0.0, 0.0, 1.0]));
            let refused = ConvexPolyhedron::from_half_spaces(&sides);
            assert_eq!(refused, Err(ShapeError::NoVolume), "{height}");
        }
    }

    #[test]
    fn half_spaces_that_cut_nothing_off_are_dropped() {
        let mut sides = cube();
        sides.push(half_space([0.0, 0.0, 3.0], [0.0, 0.0, 1.0]));
        sides.push(half_space([0.5, 0.5, 1.0], [0.0, 0.0, 9.0]));
        sides.push(half_space([1.0, 1.0, 1.0], [1.0, 1.0, 1.0]));
        let solid = ConvexPolyhedron::from_half_spaces(&sides).unwrap();
        assert_eq!(solid.face_count(), 6);
        assert!((solid.area() - 24.0).abs() < 1e-9);
    }

    #[test]
    fn faces_are_checked_one_by_one() {
        let with = |face: Vec<u32>| {
            let mut faces = tetrahedron_faces();
            faces[3] = face;
            ConvexPolyhedron::from_faces(&TETRAHEDRON, &faces).unwrap_err()
        };
        assert_eq!(
            with(vec![1, 2, 9]).to_string(),
            "face 3 uses corner 9, but there are 4"
        );
        assert_eq!(with(vec![1, 2]), ShapeError::FaceWithoutArea { face: 3 });
        assert_eq!(with(vec![]), ShapeError::FaceWithoutArea { face: 3 });
        let (face, corner) = (3, 0);
        assert_eq!(with(vec![1, 3, 2]), ShapeError::NotConvex { face, corner });
        let missing = ConvexPolyhedron::from_faces(&TETRAHEDRON, &tetrahedron_faces()[..3]);
        assert_eq!(missing, Err(ShapeError::Unbounded));
    }

    #[test]
    fn a_tetrahedron_is_crossed_through_edges_and_corners() {
        let solid = ConvexPolyhedron::from_faces(&TETRAHEDRON, &tetrahedron_faces()).unwrap();
        let inside = Point3::new(0.1, 0.1, 0.1);
        let edge = Point3::new(0.5, 0.0, 0.5);
        for target in TETRAHEDRON.map(Point3::wide).into_iter().chain([edge]) {
            let crossings = solid.crossings(&Ray::new(inside, target - inside));
            assert_eq!(crossings.len(), 1);
            assert!((crossings[0].t - 1.0).abs() < 1e-12);
        }
    }
}
