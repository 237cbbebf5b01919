//! The faces of a convex polyhedron, from its planes.

use super::ShapeError;
use super::frame::{nearest_of, unit};
use crate::triangle::share;
use crate::{Vector3, sampling};

/// An endless solid reaches this many times further than its planes' points lie apart.
const ENDLESS: f64 = 1e5;

/// Corners nearer than this, and faces and solids thinner, relative to the reach of the planes, come
/// from rounding.
const SLIVER: f64 = 1e-9;

/// The points with `normal · p == offset`, the solid being where it is less.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlaneEquation {
    pub(super) normal: Vector3<f64>,
    pub(super) offset: f64,
}

/// One face.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Face {
    plane: PlaneEquation,
    /// At least three, counter-clockwise seen from outside.
    corners: Vec<Vector3<f64>>,
    area: f64,
    /// Where u and v are 0, along each of two directions, and how fast they grow.
    chart: [(Vector3<f64>, f64); 2],
}

impl Face {
    fn new(plane: PlaneEquation, corners: Vec<Vector3<f64>>) -> Self {
        let (s, t) = plane.normal.orthonormal_basis();
        let chart = [s, t].map(|axis| {
            let along = corners.iter().map(|corner| corner.dot(axis));
            let least = along.clone().fold(f64::INFINITY, f64::min);
            let extent = along.fold(f64::NEG_INFINITY, f64::max) - least;
            (axis / extent, least / extent)
        });
        let area = area_of(&corners, plane.normal);
        Self {
            plane,
            corners,
            area,
            chart,
        }
    }

    #[inline]
    pub(super) fn plane(&self) -> &PlaneEquation {
        &self.plane
    }

    pub(super) fn corners(&self) -> &[Vector3<f64>] {
        &self.corners
    }

    pub(super) fn area(&self) -> f64 {
        self.area
    }

    pub(super) fn uv(&self, point: Vector3<f64>) -> [f32; 2] {
        self.chart
            .map(|(axis, start)| unit(point.dot(axis) - start))
    }

    /// From a point to the nearest point of the face.
    pub(super) fn to_nearest(&self, point: Vector3<f64>) -> Vector3<f64> {
        let normal = self.plane.normal;
        let down = normal * (self.corners[0] - point).dot(normal);
        let next = self.corners[1..].iter().chain(&self.corners[..1]);
        let edges = self.corners.iter().zip(next);
        let edges = edges.map(|(&from, &to)| (from - point, to - from));
        // The edges run counter-clockwise, so the inside is to the left of all of them.
        if edges
            .clone()
            .all(|(from, along)| normal.cross(along).dot(from) <= 0.0)
        {
            return down;
        }
        nearest_of(edges.map(|(from, along)| from + along * share(from, along)))
    }

    /// A uniform point, from a triangle of the fan around the first corner.
    pub(super) fn sample(&self, [x0, x1]: [f64; 2]) -> Vector3<f64> {
        let first = self.corners[0];
        let fan = self.corners[1..]
            .windows(2)
            .map(|pair| [pair[0] - first, pair[1] - first]);
        let areas = fan.clone().map(|[a, b]| a.cross(b).length());
        let (chosen, x0) = sampling::choose(x0, areas);
        let [u, v] = sampling::fold([x0, x1]);
        fan.clone()
            .nth(chosen)
            .map_or(first, |[a, b]| first + a * u + b * v)
    }
}

/// The faces of the solid behind all planes; `reach` is how far the points that gave the planes lie
/// from the origin. Planes that touch the solid nowhere, or only in an edge or a corner, have none.
pub(super) fn faces_of(planes: &[PlaneEquation], reach: f64) -> Result<Vec<Face>, ShapeError> {
    let mut faces: Vec<Face> = Vec::new();
    let mut endless = planes.is_empty();
    for (i, plane) in planes.iter().enumerate() {
        if planes[..i].iter().any(|other| same(plane, other, reach)) {
            continue;
        }
        let mut corners = square(plane, ENDLESS * reach);
        for other in planes.iter().filter(|other| !same(plane, other, reach)) {
            corners = clipped(&corners, other);
        }
        let far = |corner: &Vector3<f64>| corner.length() > 0.5 * ENDLESS * reach;
        endless |= corners.iter().any(far);
        corners = without_repeats(corners, SLIVER * reach);
        if corners.len() >= 3 && area_of(&corners, plane.normal) > (SLIVER * reach).powi(2) {
            faces.push(Face::new(*plane, corners));
        }
    }
    if endless {
        return Err(ShapeError::Unbounded);
    }
    // Each face is the base of a pyramid with its tip at a corner of the first face.
    let volume: f64 = faces.first().map_or(0.0, |first| {
        let tip = first.corners[0];
        let pyramid = |face: &Face| face.area * (face.plane.offset - face.plane.normal.dot(tip));
        faces.iter().map(pyramid).sum::<f64>() / 3.0
    });
    let area: f64 = faces.iter().map(Face::area).sum();
    if !(volume > area * SLIVER * reach) {
        return Err(ShapeError::NoVolume);
    }
    Ok(faces)
}

/// Whether two planes are one, given twice.
fn same(a: &PlaneEquation, b: &PlaneEquation, reach: f64) -> bool {
    (a.normal - b.normal).max_norm() <= 1e-12 && (a.offset - b.offset).abs() <= 1e-12 * reach
}

/// A square in a plane, so large that it stands for all of it.
fn square(plane: &PlaneEquation, half: f64) -> Vec<Vector3<f64>> {
    let middle = plane.normal * plane.offset;
    let (s, t) = plane.normal.orthonormal_basis();
    let (s, t) = (s * half, t * half);
    vec![
        middle - s - t,
        middle + s - t,
        middle + s + t,
        middle - s + t,
    ]
}

/// What of a convex polygon is behind a plane: Sutherland, Hodgman, "Reentrant Polygon Clipping",
/// Communications of the ACM 17(1), 1974.
fn clipped(corners: &[Vector3<f64>], plane: &PlaneEquation) -> Vec<Vector3<f64>> {
    let over = |corner: Vector3<f64>| plane.normal.dot(corner) - plane.offset;
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (i, &corner) in corners.iter().enumerate() {
        let next = corners[(i + 1) % corners.len()];
        let (here, there) = (over(corner), over(next));
        if here <= 0.0 {
            kept.push(corner);
        }
        if (here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0) {
            kept.push(corner + (next - corner) * (here / (here - there)));
        }
    }
    kept
}

/// The corners, but those that are nearly where their predecessor is.
fn without_repeats(corners: Vec<Vector3<f64>>, nearly: f64) -> Vec<Vector3<f64>> {
    let mut kept: Vec<Vector3<f64>> = Vec::with_capacity(corners.len());
    for corner in corners {
        let repeats = |other: &Vector3<f64>| (*other - corner).max_norm() <= nearly;
        if kept.last().is_some_and(repeats) || kept.first().is_some_and(repeats) {
            continue;
        }
        kept.push(corner);
    }
    kept
}

fn area_of(corners: &[Vector3<f64>], normal: Vector3<f64>) -> f64 {
    let first = corners[0];
    let fan = corners[1..].windows(2);
    fan.map(|pair| (pair[0] - first).cross(pair[1] - first).dot(normal) / 2.0)
        .sum()
}
