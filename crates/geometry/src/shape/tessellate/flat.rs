//! Shapes that are flat, face by face: triangles make them up exactly.

use super::Soup;
use crate::shape::polyhedron_face;
use crate::shape::slabs::Slabs;
use crate::shape::{ConvexPolyhedron, Cuboid, OrientedBox, Rectangle, Surface as _, Triangle};
use crate::{Axis, Normal3, Point3, Vector3};

/// A convex polygon.
pub(super) struct Face {
    normal: Normal3<f64>,
    /// With surface parameters; counter-clockwise seen from where the normal points to.
    corners: Vec<(Point3<f64>, [f32; 2])>,
}

impl Face {
    pub(super) fn triangles(&self) -> u64 {
        self.corners.len().saturating_sub(2) as u64
    }

    /// A fan around the first corner.
    pub(super) fn add_to(&self, soup: &mut Soup) {
        let corners = self.corners.iter();
        let indices: Vec<u32> = corners
            .map(|&(place, uv)| soup.vertex(place, self.normal, uv))
            .collect();
        let Some((&first, rest)) = indices.split_first() else {
            return;
        };
        let fan = rest.windows(2).map(|pair| [first, pair[0], pair[1]]);
        soup.triangles.extend(fan);
    }
}

const CORNERS: [[f32; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

pub(super) fn of_triangle(triangle: &Triangle) -> Face {
    let corners = triangle.corners.map(Point3::wide);
    Face {
        normal: triangle.normal_at(corners[0]),
        corners: corners
            .into_iter()
            .zip([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
            .collect(),
    }
}

pub(super) fn of_rectangle(rectangle: &Rectangle) -> Face {
    let [first, second] = rectangle.edges;
    let corner = |uv: [f32; 2]| {
        let [u, v] = uv.map(f64::from);
        (rectangle.frame.origin + first * u + second * v, uv)
    };
    Face {
        normal: rectangle.frame.z.to_normal(),
        corners: CORNERS.map(corner).to_vec(),
    }
}

pub(super) fn of_cuboid(cuboid: &Cuboid) -> Vec<Face> {
    let place = |local: Vector3<f64>| Point3::from(local.to_array());
    of_slabs(&cuboid.slabs, place, Vector3::to_normal)
}

pub(super) fn of_oriented_box(oriented: &OrientedBox) -> Vec<Face> {
    let frame = &oriented.frame;
    let place = |local| frame.world(local);
    of_slabs(&oriented.slabs, place, |local| frame.world_normal(local))
}

fn of_slabs(
    slabs: &Slabs,
    place: impl Fn(Vector3<f64>) -> Point3<f64>,
    turn: impl Fn(Vector3<f64>) -> Normal3<f64>,
) -> Vec<Face> {
    let sides = [slabs.lo, slabs.hi];
    let face = |number: usize| {
        // As in `Slabs`: twice the axis, plus one for the face on its far side.
        let (axis, far) = (Axis::ALL[number / 2], number % 2);
        let (s, t) = (axis.next(), axis.next().next());
        let corner = |[u, v]: [f32; 2]| {
            let mut local = Vector3::new(0.0, 0.0, 0.0);
            local[axis] = sides[far][axis];
            local[s] = sides[u as usize][s];
            local[t] = sides[v as usize][t];
            (place(local), [u, v])
        };
        let mut corners = CORNERS.map(corner).to_vec();
        // From s to t is counter-clockwise about the axis, which points inward on the near side.
        if far == 0 {
            corners.reverse();
        }
        Face {
            normal: turn(Slabs::normal(number)),
            corners,
        }
    };
    (0..6).map(face).collect()
}

pub(super) fn of_polyhedron(solid: &ConvexPolyhedron) -> Vec<Face> {
    let face = |face: &polyhedron_face::Face| Face {
        normal: face.plane().normal.to_normal(),
        corners: face
            .corners()
            .iter()
            .map(|&corner| (solid.centre + corner, face.uv(corner)))
            .collect(),
    };
    solid.faces.iter().map(face).collect()
}
